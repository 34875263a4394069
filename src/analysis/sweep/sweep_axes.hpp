#pragma once

#include "core/input_error.hpp"
#include "scene/keys.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace damslip {

/// How a row of a sweep is computed.
enum class SweepKind { rigid, rigid_vertical, rocking, decoupled, coupled, regression, finite_elements };

/// Of the flexible block.
inline bool is_flexible(SweepKind kind)
{
    return kind == SweepKind::decoupled || kind == SweepKind::coupled;
}

/// Contact law, steps or rock of FE rows, in place of the scene's.
enum class FeLaw {
    scene,
    exact,
    penalty,
    slip_tolerance,
    goldgruber_2015,
    whole_steps, ///< the scene's law, but steps of time.dt without sub-steps
    radiating,   ///< the scene's law, rock that radiates ...
    massless     ///< ... or keeps all waves; as the scene where there is no rock
};

struct SweepMethod {
    std::string id; ///< as typed and printed: "rigid-v", "rocking", "coupled", "fe-exact", "jibson-1998"
    SweepKind kind = SweepKind::rigid;
    FeLaw law = FeLaw::scene;
    bool reduced = false; ///< FE on few modes of the dam
};

/// Ids of all methods: rigid, rigid-v, rocking, decoupled, coupled, the FE methods, and the regressions by their ids.
std::vector<std::string> sweep_methods();

/// The method of one of these ids.
const SweepMethod& sweep_method(const std::string& id);

/// As the table of keys and methods knows them.
Methods methods_of(const std::vector<SweepMethod>& list);

/// The scene with the contact law of an FE method. The law says how sticking gives way; exact, penalty and slip tolerance
/// have a hard joint. goldgruber_2015 puts the whole preset in place of what the scene says.
/// @param penalty_stiffness  of the law `penalty`; default: the scene's [N/m^3]
Scene with_law(Scene scene, FeLaw law, std::optional<double> penalty_stiffness);

/// Values of every axis of the grid but the records.
struct Axes {
    std::vector<double> friction;               ///< Coulomb mu [-]
    std::vector<double> level;                  ///< water surface above the heel at size 1 [m]
    std::vector<double> size;                   ///< of section, rock, water and elements (sized), factor [-]
    std::vector<double> scale;                  ///< of the motion, factor [-]
    std::vector<int> polarity;                  ///< signs on the horizontal component as filed: 1, -1
    std::vector<std::string> uplift, reservoir; ///< words as typed
    std::vector<std::string> opening{""};       ///< words of uplift.opening as typed; empty: the scene's
    std::vector<std::string> plane{""};         ///< what the rigid block slides on; empty: the base
    std::vector<double> plane_friction;         ///< of each plane, where `friction` does not vary it; empty: it does [-]
    std::vector<double> period, damping;        ///< T_s [s] and zeta [-] of the flexible block; empty: the scene's
    std::vector<SweepMethod> method;
    std::vector<Diagnostic> notes; ///< of values that are allowed but unusual

    bool finite_elements() const; ///< is there an FE method?
    bool flexible() const;        ///< is there a method of the flexible block?
};

/// The axes that leave the scene as it is: one value each, the polarities_of() the scene, the rigid block.
Axes axes_of(const Scene& scene);

/// Words of the water models an axis may have: "auto", "hydrostatic", "acoustic", and the added masses by their formula.
std::vector<std::string> reservoir_axis_words();

/// Is uplift.opening one of the axes?
inline bool has_opening_axis(const Axes& axes)
{
    return axes.opening.size() != 1 || !axes.opening.front().empty();
}

/// Are there planes to slide on other than the base?
inline bool has_plane_axis(const Axes& axes)
{
    return axes.plane.size() != 1 || !axes.plane.front().empty();
}

/// Peak friction of a plane of the scene by its name; "base" is the base [-]. @pre one of plane_names()
double plane_friction(const Scene& scene, const std::string& plane);

/// The scene with another water level [m], uplift model and water model, words as typed, then another size.
Scene variant(Scene scene, double level, const std::string& uplift, const std::string& reservoir, double size);
/// The axes in words, all digits, in a fixed order: what has to be equal for two sweeps to have the same rows.
std::string text_of(const Axes& axes);

/// A number for each axis of a sweep.
struct AxisNumbers {
    std::size_t friction = 0, plane = 0, level = 0, uplift = 0, opening = 0, reservoir = 0, size = 0, period = 0,
                damping = 0, scale = 0, polarity = 0, record = 0, method = 0;
};

/// Positions of one row on the axes.
using GridIndex = AxisNumbers;

/// The rows of a sweep: the Cartesian product friction x plane x level x uplift x opening water x reservoir x size x period x
/// damping x scale x polarity x record x method, numbered from 0 in this order, the last axis fastest. Its numbers are how many
/// values each axis has.
struct TaskList : AxisNumbers {
    TaskList() : AxisNumbers{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1} {}

    std::size_t rows() const { return friction * variants() * motions() * method; }
    std::size_t variants() const
    {
        return plane * level * uplift * opening * reservoir * size * period * damping;
    } ///< scenes but for the friction
    std::size_t motions() const { return record * scale * polarity; }
    std::size_t rows_of_model() const
    {
        return motions() * method;
    } ///< ids of one friction and variant follow each other

    GridIndex index(std::size_t id) const;
    std::size_t id(const GridIndex& at) const;
    std::size_t variant(const GridIndex& at) const; ///< 0 ... variants() - 1
    std::size_t motion(const GridIndex& at) const;  ///< 0 ... motions() - 1, polarity fastest, record slowest
};

/// Friction of the plane that a row slides on [-].
double friction_of(const Axes& axes, const GridIndex& at);

TaskList make_tasks(const Axes& axes, std::size_t records);

/// Part i of n of a sweep, i from 0.
struct Shard {
    std::size_t index = 0, count = 1;
    friend bool operator==(const Shard&, const Shard&) = default;
};

/// "2/4". @param flag  for messages @throws UsageError
Shard parse_shard(const std::string& text, const std::string& flag);

/// Ids of a part, ascending. The rows of each method are taken in the order variant, motion, friction, so that rows which
/// share a set-up stay together, and cut into n runs of equal length, give or take a row: every part gets its share
/// of each method.
std::vector<std::size_t> shard_rows(const TaskList& tasks, const Shard& shard);

} // namespace damslip
