#include "analysis/prepare/lift_modes.hpp"

#include "analysis/prepare/flexible_mass.hpp"
#include "analysis/prepare/ready.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/time/structure_system.hpp"
#include "records/measure/measures.hpp"
#include "scene/planes.hpp"
#include "scene/rock_mass.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip {

namespace {

constexpr int wanted_modes = 20;
constexpr double acoustic_modes_to = 20.0; ///< [Hz]

/// Means over a level of the dam: where its edges cross the level, linear along an edge and from crossing to crossing.
class LevelMean {
public:
    LevelMean(const fe2d::Mesh& mesh, double level)
    {
        std::vector<Crossing> all;
        int crossed = 0;
        for (int e = 0; e < mesh.dam_element_count; ++e) {
            const fe2d::Element& element = mesh.elements[static_cast<std::size_t>(e)];
            double low = level, high = level;
            for (int i = 0; i < element.size(); ++i) {
                const int a = element.nodes[static_cast<std::size_t>(i)],
                          b = element.nodes[static_cast<std::size_t>((i + 1) % element.size())];
                const Point p = mesh.nodes[static_cast<std::size_t>(a)], q = mesh.nodes[static_cast<std::size_t>(b)];
                low = std::min(low, p.y), high = std::max(high, p.y);
                if ((p.y <= level) == (q.y <= level)) continue;
                const double share = (level - p.y) / (q.y - p.y);
                all.push_back({p.x + share * (q.x - p.x), a, b, share});
            }
            if (!(low < level && level < high)) continue;
            row_ += high - low;
            ++crossed;
        }
        if (crossed > 0) row_ /= crossed;
        std::sort(all.begin(), all.end(), [](const Crossing& s, const Crossing& t) { return s.x < t.x; });
        const double length = all.back().x - all.front().x;
        middle_ = 0.5 * (all.back().x + all.front().x);
        for (std::size_t i = 0; i < all.size(); ++i) { // a trapezoid: half of both neighbouring distances
            const double before = i > 0 ? all[i].x - all[i - 1].x : 0.0, after = i + 1 < all.size() ? all[i + 1].x - all[i].x : 0.0;
            const double weight = length > 0.0 ? 0.5 * (before + after) / length : 1.0 / static_cast<double>(all.size());
            nodes_.push_back({all[i].a, weight * (1.0 - all[i].share)});
            nodes_.push_back({all[i].b, weight * all[i].share});
        }
    }
    double middle() const { return middle_; } ///< x of the level's middle [m]
    double row() const { return row_; }       ///< height of the elements that the level crosses [m]; 0: a line of edges
    /// Of a field on the unknowns, its component.
    double of(const fe2d::Model& model, const Eigen::MatrixXd& field, Eigen::Index column, int component) const
    {
        double sum = 0.0;
        for (const auto& [node, weight] : nodes_)
            if (const int dof = model.dofs(node, component); dof != fe2d::no_dof) sum += weight * field(dof, column);
        return sum;
    }

private:
    struct Crossing {
        double x = 0.0;
        int a = 0, b = 0;
        double share = 0.0;
    };
    std::vector<std::pair<int, double>> nodes_; ///< and their weights
    double middle_ = 0.0, row_ = 0.0;
};

/// Sums of nodal forces above a level [N/m], and their moment about a point at it, in the sense of a push downstream [N m/m]. A
/// node stands for half a row of elements above and below it.
struct Above {
    double x = 0.0, y = 0.0, moment = 0.0;
};
template <class Forces>
Above above(const std::vector<Unknown>& unknowns, Point about, double row, Forces&& force)
{
    Above sum;
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
        const Unknown& u = unknowns[i];
        const double up = u.at.y - about.y, share = row > 0.0 ? std::clamp(up / row + 0.5, 0.0, 1.0) : up > 0.0 ? 1.0 : up < 0.0 ? 0.0 : 0.5;
        if (share == 0.0) continue;
        const double f = share * force(static_cast<Eigen::Index>(i));
        (u.component == 0 ? sum.x : sum.y) += f;
        sum.moment += u.component == 0 ? f * (u.at.y - about.y) : -f * (u.at.x - about.x);
    }
    return sum;
}

struct Found {
    fe2d::Model model;
    ModalForces horizontal, vertical;
    std::vector<sliding::TiedMode> modes;
};

Found find_modes(const Scene& given)
{
    Scene tied = given;
    tied.lifts.reset();
    tied.seams.clear();
    tied.lift_joints.clear();
    tied.planes = {};
    const bool by_record = tied.damping.method == DampingMethod::modified_rayleigh;
    const Ready ready = by_record ? prepare(std::move(tied), Method::finite_elements)
                                  : prepare(std::move(tied), Method::finite_elements, Records());
    const Scene& scene = ready.scene;
    const GroundMotion motion = ready.records().empty() ? GroundMotion() : ready.motion(ready.records().front());
    Found f{fe2d::build_model(with_massless_rock(scene), ready.model_options()), {}, {}, {}};
    std::optional<fe2d::FluidModel> water;
    std::optional<fe2d::CoupledModes> coupled;
    fe2d::NaturalModes modes;
    if (is_acoustic(scene)) {
        water = fe2d::build_fluid(scene);
        coupled = fe2d::coupled_modes_up_to(fe2d::coupled_pencil(f.model, *water), acoustic_modes_to, 5);
        if (coupled->status != fe2d::CoupledModesStatus::ok) refuse_modes(scene, "the modes were not all found.");
    } else {
        modes = fe2d::natural_modes(f.model, wanted_modes);
        if (modes.status != fe2d::ModesStatus::ok) refuse_modes(scene, "the modes were not all found.");
    }
    for (const ModalDirection direction : {ModalDirection::horizontal, ModalDirection::vertical})
        (direction == ModalDirection::horizontal ? f.horizontal : f.vertical) =
            modal_forces(scene, f.model, modes, coupled ? &*coupled : nullptr, water ? &*water : nullptr, direction);
    fe2d::RayleighConstants damping;
    if (scene.damping.method != DampingMethod::none)
        damping = (water ? fe2d::damping_of(scene, f.model, *water, motion) : fe2d::damping_of(scene, f.model, motion)).constants;
    const Eigen::MatrixXd& shape = coupled ? coupled->displacement : modes.shape;
    for (Eigen::Index n = 0; n < f.horizontal.frequency.size(); ++n) {
        // C = a_M M of the structure + b_K K, in a mode of modal mass 1 with the water in it.
        const Eigen::VectorXd phi = shape.col(n);
        const double omega = 2.0 * std::numbers::pi * f.horizontal.frequency[n];
        const double c = damping.mass * phi.dot(f.model.mass * phi) + damping.stiffness * phi.dot(f.model.stiffness * phi);
        f.modes.push_back({f.horizontal.frequency[n], c / (2.0 * omega)});
    }
    return f;
}

/// The rest is what makes all shares together `rigid`.
sliding::ModalShares shares(const std::vector<double>& of_mode, double rigid)
{
    sliding::ModalShares s{of_mode, rigid};
    for (const double w : of_mode) s.rest -= w;
    return s;
}

} // namespace

const sliding::TiedPart& LiftModes::part(double elevation) const
{
    return parts[static_cast<std::size_t>(std::find(elevations.begin(), elevations.end(), elevation) - elevations.begin())];
}

bool lifts_vibrate(const Scene& scene)
{
    return scene.lifts && scene.lifts->amplification == Amplification::modes;
}

LiftModes lift_modes(const Scene& scene)
{
    const Found found = find_modes(scene);
    const std::vector<Unknown> unknowns = unknowns_of(found.model);
    LiftModes all;
    all.elevations = lift_elevations(scene);
    for (const double elevation : all.elevations) {
        const LevelMean mean(found.model.mesh, elevation);
        const Point about{mean.middle(), elevation};
        sliding::TiedPart part;
        part.modes = found.modes;
        for (const bool up : {false, true}) {
            const ModalForces& f = up ? found.vertical : found.horizontal;
            const Eigen::VectorXd total = f.force.rowwise().sum() + f.residual; // of the rigid dam under 1 m/s^2
            const Above rigid = above(unknowns, about, mean.row(), [&](Eigen::Index i) { return total[i]; });
            const double mass = up ? rigid.y : rigid.x;
            // A force that the ground's motion makes has the sign of the motion's own axis: across it the signs differ.
            std::vector<double> joint_x, joint_y, force_x, force_y, moment;
            for (Eigen::Index n = 0; n < f.frequency.size(); ++n) {
                const double square = std::pow(2.0 * std::numbers::pi * f.frequency[n], 2.0);
                const Above sum = above(unknowns, about, mean.row(), [&](Eigen::Index i) { return f.force(i, n); });
                joint_x.push_back((up ? -square : square) * mean.of(found.model, f.displacement, n, 0));
                joint_y.push_back((up ? square : -square) * mean.of(found.model, f.displacement, n, 1));
                force_x.push_back((up ? -sum.x : sum.x) / mass);
                force_y.push_back((up ? sum.y : -sum.y) / mass);
                moment.push_back(sum.moment / rigid.moment);
            }
            const double across_x = up ? -rigid.x / mass : 1.0, across_y = up ? 1.0 : -rigid.y / mass;
            (up ? part.joint.h_of_v : part.joint.h_of_h) = shares(joint_x, up ? 0.0 : 1.0);
            (up ? part.joint.v_of_v : part.joint.v_of_h) = shares(joint_y, up ? 1.0 : 0.0);
            (up ? part.mean.h_of_v : part.mean.h_of_h) = shares(force_x, across_x);
            (up ? part.mean.v_of_v : part.mean.v_of_h) = shares(force_y, across_y);
            if (!up) all.overturning.push_back(shares(moment, 1.0));
        }
        all.parts.push_back(std::move(part));
    }
    return all;
}

std::vector<sliding::LiftAmplification> lift_amplification(const LiftModes& modes, const std::vector<sliding::SkippingMotion>& motions,
                                                           double ratio)
{
    std::vector<sliding::LiftAmplification> all(modes.parts.size());
    for (sliding::LiftAmplification& a : all) a = {0.0, 0.0, 1.0};
    if (modes.parts.empty()) return all;
    const std::vector<sliding::TiedMode>& tied = modes.parts.front().modes;
    Eigen::VectorXd frequency(static_cast<Eigen::Index>(tied.size()));
    std::vector<double> periods;
    for (std::size_t n = 0; n < tied.size(); ++n) {
        frequency[static_cast<Eigen::Index>(n)] = tied[n].frequency;
        periods.push_back(1.0 / tied[n].frequency);
    }
    const Eigen::MatrixXd correlation = fe2d::modal_correlations(frequency, ratio, fe2d::ModalRule::cqc);
    for (const sliding::SkippingMotion& skipping : motions) {
        const GroundMotion& motion = skipping.motion();
        const double pga = peak_of(motion.accel_h);
        if (!(pga > 0.0)) continue;
        const records::ResponseSpectrum spectrum = records::response_spectrum(motion.accel_h, motion.dt, periods, ratio);
        const auto peak = [&](const sliding::ModalShares& s) { // over that of the ground; the rest by the root of squares
            Eigen::VectorXd of_mode(frequency.size());
            for (Eigen::Index n = 0; n < of_mode.size(); ++n)
                of_mode[n] = s.of_mode[static_cast<std::size_t>(n)] *
                             spectrum.points[static_cast<std::size_t>(n)].pseudo_acceleration / pga;
            return std::hypot(fe2d::combined_peak(of_mode, correlation), s.rest);
        };
        for (std::size_t i = 0; i < all.size(); ++i) {
            const double mean = peak(modes.parts[i].mean.h_of_h);
            if (mean > all[i].mean) all[i] = {peak(modes.parts[i].joint.h_of_h), mean, peak(modes.overturning[i]) / mean};
        }
    }
    return all;
}

} // namespace damslip
