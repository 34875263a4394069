#pragma once

#include "core/status.hpp"
#include "scene/scene.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <optional>
#include <string>
#include <vector>

namespace damslip::sliding {

/// Where the effective resultant cuts the base.
enum class ResultantZone {
    kern,        ///< middle third: no tension
    middle_half, ///< within a quarter of the base from its middle
    base,        ///< within the base
    outside      ///< outside, N' <= 0, or the joint cracked through
};

/// Required value of one check; none: no criterion.
struct Requirements {
    std::optional<double>
        sliding; ///< least factor, peak strength (residual strength in a combination that uses it) [-]
    std::optional<double> sliding_residual; ///< least factor, residual strength [-]
    std::optional<double> flotation;        ///< [-]
    std::optional<double> overturning;      ///< [-]
    std::optional<ResultantZone> resultant; ///< at least this far inside
    std::string source;                     ///< document they are taken from
};

enum class Verdict { pass, fail, no_criterion };

struct Check {
    std::string quantity; ///< "sliding, peak strength"
    double value =
        0.0; ///< factor [-]; for the resultant its distance from the middle of the base over the base length [-]
    std::optional<double> required; ///< [-]
    Verdict verdict = Verdict::no_criterion;
    std::string source;
};

/// What one load combination needs besides scene and combination.
struct EquilibriumOptions {
    SeepageProfile seepage; ///< for uplift.model = "seepage"
    Crack opened;           ///< post-seismic: joint opened by the earthquake, holds the full head [m]
};

/// Limit equilibrium of one load combination. Base quantities are normal to and along the base; positive: N'
/// compression, shear and eccentricity downstream, stress compression.
struct Equilibrium {
    std::string name;
    CombinationKind kind = CombinationKind::usual;
    CrackRule crack_rule = CrackRule::none;
    std::string follows;          ///< post-seismic: the extreme combination that opened the joint; empty: none did
    std::optional<double> of_pga; ///< a_h over the largest PGA of the records, where both are known [-]
    double k_h = 0.0, k_v = 0.0;  ///< seismic coefficients a / 9.80665 [-]; a_h upstream, a_v up
    std::optional<double> reservoir_level, tailwater_level;  ///< above the heel [m]
    double friction = 0.0, cohesion = 0.0;                   ///< used for `sliding_factor` [-], [Pa]
    double residual_friction = 0.0, residual_cohesion = 0.0; ///< [-], [Pa]

    BaseFrame frame;
    std::vector<Load> loads;      ///< inertia and hydrodynamic force included, uplift not
    Force load;                   ///< their sum
    CrackedBase base;             ///< uplift, crack, N' and its position
    double cohesive_length = 0.0; ///< A' [m^2/m], the length of a base without thickness

    double shear = 0.0;        ///< T along the base, what anchors carry of it taken off [N/m]
    double anchor_force = 0.0; ///< sum of N of the anchors through the base, each P₀ or f_y A as it says [N/m]
    double dowel_force = 0.0;  ///< of grouted anchors, resists [N/m]
    double anchor_shear = 0.0; ///< Σ (N - P₀) sin ψ: what only slip brings about; it resists, it does not drive [N/m]
    /// (c A' + mu N')/|T|, peak (or residual where the combination says so) [-]. With anchors
    /// (c A' + mu N' + dowels + anchor_shear)/(T + anchor_shear) where anchor_shear is against that shear: 1 where
    /// T <= c A' + mu N' + dowels with N of every anchor in N' and T.
    double sliding_factor = 0.0;
    double friction_factor = 0.0;         ///< mu N'/|T|: without cohesion [-]
    double sliding_factor_residual = 0.0; ///< with residual friction, cohesion only if slip does not destroy it [-]
    double overturning_factor =
        0.0; ///< stabilising over overturning moment about the toe (the heel if T points upstream) [-]
    double flotation_factor = 0.0;   ///< weight over uplift less the water on top, EM 1110-2-2100 (3-2) [-]
    double resultant_from_toe = 0.0; ///< along the base [m]
    double eccentricity = 0.0;       ///< from the middle of the base [m]
    ResultantZone zone = ResultantZone::outside;
    double heel_stress = 0.0,
           toe_stress = 0.0; ///< effective, at the ends of the compressed part [Pa]; NaN where it is open or through
    double yield_acceleration = 0.0; ///< downstream [m/s^2], static uplift and crack of this combination, its k_v
    double yield_acceleration_upstream = 0.0; ///< [m/s^2]
    double tipping_acceleration = 0.0;        ///< a_h at which N' reaches the toe, uplift unchanged [m/s^2]
    double critical_friction = 0.0;           ///< mu at which sliding_factor is 1 [-]
    std::vector<Check> checks;
    std::vector<Note> notes;
};

/// Evaluates one combination.
/// - Static loads with the combination's levels and factors; water_factor covers reservoir, tailwater and crest water;
/// hydrodynamic
///   force and inertia are not factored.
/// - k_h, k_v: inertia (+m a_h, -m a_v) at the centroid, with k_profile the sum of its own at each height, and the added
///   mass' force -M^w a_g, a_g = (-a_h, +a_v).
/// - Crack rule with an earthquake (k_h or k_v not 0): `none` no crack; `static` the crack of the static loads, no
/// further opening;
///   `seismic-zero` no water pressure in what the earthquake opens (USBR 1987), `seismic-unchanged` pressure as before
///   it (USACE 1995, FERC 1991), `seismic-full` full head in it, drains ignored once reached (ICOLD 1986). Without one:
///   all but `none` mean the static crack.
/// - Post-seismic: `options.opened` holds the full head and no cohesion.
/// - A joint that is cracked through has no bond left and no stresses.
Equilibrium evaluate(const Scene& scene, const Combination& combination, const Requirements& required,
                     const EquilibriumOptions& options = {});

/// Words for tables and files: "usual", "kern", "seismic-full", "PASS".
const char* word(CombinationKind kind);
const char* word(ResultantZone zone);
const char* word(CrackRule rule);
const char* word(CrackStatus status);
const char* word(Verdict verdict);

/// The combination's own required values; what it leaves open from the scene's criteria document.
/// Errors: InputError for an unknown document or resultant word.
Requirements requirements(const Scene& scene, const Combination& combination);

/// Largest ground accelerations of the records, which the shares pga_fraction and pga_v_fraction are of.
struct PeakGround {
    double a_h = 0.0; ///< [m/s^2], its absolute value drives downstream
    double a_v = 0.0; ///< [m/s^2], its absolute value lightens the dam; 0: no vertical component
};

/// The scene's combinations; if it has none, made from it:
/// 1. usual: the scene's levels, no ice; 2. unusual, drains ineffective (with drains that lower the uplift); 3. unusual, ice (with ice);
/// 4. extreme, seismic: k_h and k_v are the shares criteria.pga_fraction (1) and pga_v_fraction (0) of the peaks, with ice
/// if there is any (as in the yield acceleration); left out for a_h = a_v = 0;
/// 5. post-seismic: residual strength, damaged curtain, ineffective drains, ice.
/// Shares given instead of k_h and k_v are replaced by their values.
std::vector<Combination> combinations(const Scene& scene, const PeakGround& peak = {});

/// The state after the earthquake: the scene's first post-seismic combination, else the fifth of the list above. What limit
/// equilibrium and finite elements take of curtain, drains and crack after the earthquake.
Combination after_earthquake(const Scene& scene);

/// Evaluates all combinations in their order.
/// One that names no crack rule is reported without crack and, where that leaves tension or the joint has been opened,
/// also with a crack, as "NAME, cracked": by the scene's rule, `static` where the scene says none; seismic:
/// `seismic-unchanged` where the scene has no seismic rule.
///
/// A post-seismic combination gets the joint that an extreme combination opened, filled with the full head: that of the
/// one it names in `follows`; of the governing one where it names none. Governing is the extreme combination after which
/// the sliding factor of this post-seismic combination (its own strength, with crack) is smallest; of equal ones that with
/// the longer crack, then the first by name. The order in the scene does not matter. A joint cracked through counts as
/// open from end to end.
std::vector<Equilibrium> evaluate_combinations(const Scene& scene, const PeakGround& peak = {},
                                               const SeepageProfile& seepage = {});

/// Uplift of one model on the scene and the friction that just holds against it, no crack.
struct UpliftComparison {
    UpliftModel model = UpliftModel::none;
    PressureProfile profile;
    UpliftResultant uplift;
    double critical_friction = 0.0; ///< [-]
};

/// Every model the scene has the data for: none, linear, curtain, drains, points, seepage (if a solver is given).
std::vector<UpliftComparison> compare_uplift(const Scene& scene, const SeepageProfile& seepage = {});

} // namespace damslip::sliding
