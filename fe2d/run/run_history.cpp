#include "fe2d/run/run_history.hpp"

#include "core/input_error.hpp"
#include "fe2d/contact/anchor_law.hpp"
#include "fe2d/contact/bond_law.hpp"
#include "fe2d/run/base_water.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdlib.h>
#include <string>
#include <unistd.h>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double rest_share = 1e-4; ///< change of the slip within the rest time that counts as rest [-]
constexpr double rest_slip = 1e-7;  ///< the same, absolute [m]

double middle_of(const Plane& plane)
{
    return 0.5 * (plane.distance[0] + plane.distance[plane.main_pairs() - 1]);
}

/// Linear interpolation of pair values at the middle of the base.
VectorXd weights_at_middle(const Plane& plane)
{
    const VectorXd& d = plane.distance;
    const double middle = middle_of(plane);
    Index i = 0;
    while (i + 2 < plane.main_pairs() && d[i + 1] < middle) ++i;
    const double share = (middle - d[i]) / (d[i + 1] - d[i]);
    VectorXd weights = VectorXd::Zero(plane.pairs());
    weights[i] = 1.0 - share;
    weights[i + 1] = share;
    return weights;
}

/// Pressure of acoustic water, p = s φ̇, at the nodes of its mesh; zero where it is held [Pa].
VectorXd pressure_at_nodes(const WaterBody& water, const NodeOrder& order, const VectorXd& rate)
{
    const DofMap& dofs = water.water.dofs;
    const int nodes = water.water.reservoir.mesh.node_count();
    VectorXd pressure = VectorXd::Zero(nodes);
    for (int node = 0; node < nodes; ++node) {
        const int unknown = dofs(node);
        if (unknown == no_dof) continue;
        const Index place = water.place[static_cast<std::size_t>(unknown)];
        pressure[node] = water.scale * rate[2 * order.new_node[static_cast<std::size_t>(place / 2)] + place % 2];
    }
    return pressure;
}

} // namespace

bool at_rest(const std::vector<double>& time, const std::vector<double>& slip, double rest_time)
{
    const double limit = std::max(rest_slip, rest_share * std::abs(slip.back()));
    for (std::size_t k = time.size(); k-- > 0;) {
        if (std::abs(slip[k] - slip.back()) > limit) return false;
        if (time.back() - time[k] >= rest_time - 1e-9) return true;
    }
    return false;
}

bool at_rest(const RunHistory& history, double rest_time)
{
    for (const LiftHistory& lift : history.lifts)
        if (!at_rest(history.time, lift.slip, rest_time)) return false;
    return at_rest(history.time, history.slip, rest_time);
}

BaseRotation::BaseRotation(const Plane& plane)
{
    const VectorXd weights = plane.weights();
    const VectorXd arm = plane.distance.array() - weights.dot(plane.distance);
    moments_ = weights.cwiseProduct(arm);
    inertia_ = moments_.dot(arm);
}

double BaseRotation::of(const Eigen::Ref<const VectorXd>& opening) const
{
    return -moments_.dot(opening) / inertia_;
}

double base_rotation(const Plane& plane, const VectorXd& opening)
{
    return BaseRotation(plane).of(opening);
}

namespace {

/// What a motion has spent, and those before it. Kinetic, strain and what the laws say are of the state.
Energy with_spent(Energy now, const Energy& before)
{
    for (const auto term : {&Energy::damping, &Energy::numerical, &Energy::friction, &Energy::radiated,
                            &Energy::external, &Energy::contact_normal, &Energy::impact})
        now.*term += before.*term;
    return now;
}

std::vector<BaseRotation> rotations_of(const ContactPlanes& planes)
{
    std::vector<BaseRotation> rotations;
    for (Index k = 0; k < planes.count(); ++k) rotations.emplace_back(planes[k]);
    return rotations;
}

} // namespace

HistoryRecorder::HistoryRecorder(const ContactMotion& dynamics, RunHistory& history, PairSeries series,
                                 const HistoryBefore& before)
    : dynamics_(dynamics), history_(history), series_(series), start_(before.slip_zero),
      to_middle_(weights_at_middle(dynamics.structure().plane())), crest_start_(before.crest_zero), before_(before),
      rotations_(rotations_of(dynamics.structure().planes()))
{
    crest_ = 2 * dynamics.structure().order().new_node[dynamics.structure().model().mesh.crest.back()];
}

HistoryRecorder::HistoryRecorder(const ContactMotion& dynamics, RunHistory& history, PairSeries series,
                                 double frame_interval)
    : dynamics_(dynamics), history_(history), series_(series), start_(dynamics.state().contact.slip),
      to_middle_(weights_at_middle(dynamics.structure().plane())),
      rotations_(rotations_of(dynamics.structure().planes()))
{
    const Mesh& mesh = dynamics.structure().model().mesh;
    crest_ = 2 * dynamics.structure().order().new_node[mesh.crest.back()];
    crest_start_ = dynamics.state().u[crest_];
    history_ = {};
    if (frame_interval > 0.0) history_.frames = std::make_shared<FrameSpool>(frame_interval);
    history_.lifts.resize(static_cast<std::size_t>(dynamics.structure().planes().count() - 1));
}

void HistoryRecorder::reserve(std::size_t rows)
{
    RunHistory& h = history_;
    rows += h.time.size();
    for (auto* series : {&h.time,
                         &h.ground_h,
                         &h.ground_v,
                         &h.slip,
                         &h.slip_heel,
                         &h.slip_middle,
                         &h.slip_toe,
                         &h.rocking,
                         &h.crest_x,
                         &h.normal_force,
                         &h.shear_force,
                         &h.normal_position,
                         &h.moment,
                         &h.open_length,
                         &h.slipping_length,
                         &h.largest_opening,
                         &h.imbalance,
                         &h.slide.thrust_over_friction,
                         &h.slide.lift_offs,
                         &h.slide.unloaded_share,
                         &h.slide.rate})
        series->reserve(rows);
    h.energy.reserve(rows);
    for (LiftHistory& lift : h.lifts)
        for (auto* series : {&lift.slip, &lift.rocking, &lift.normal_force, &lift.largest_opening})
            series->reserve(rows);
    if (series_ == PairSeries::none) return;
    const std::size_t values = rows * static_cast<std::size_t>(dynamics_.structure().plane().pairs());
    for (auto* series : {&h.by_pair.pressure, &h.by_pair.shear, &h.by_pair.slip, &h.by_pair.opening})
        series->reserve(values);
    h.by_pair.state.reserve(values);
}

void HistoryRecorder::add()
{
    const DynamicState& s = dynamics_.state();
    const ContactMemory& c = s.contact;
    const ContactPlanes& planes = dynamics_.structure().planes();
    const Plane& plane = planes.base();
    const Index m = plane.pairs();
    slip_ = c.slip - start_;
    const VectorXd& slip = slip_;
    double open = 0.0, slipping = 0.0;
    for (Index i = 0; i < m; ++i) {
        const ContactState state = c.states[static_cast<std::size_t>(i)];
        if (state == ContactState::open) open += plane.area[i] / plane.share;
        if (is_slip(state)) slipping += plane.area[i] / plane.share;
    }
    c.contact_force(contact_force_);
    const VectorXd& force = contact_force_;
    const Index main = plane.main_pairs();
    const double normal = force.head(main).sum(), about_heel = force.head(main).dot(plane.distance.head(main));
    history_.time.push_back(before_.time + s.time);
    history_.ground_h.push_back(s.ground.h);
    history_.ground_v.push_back(s.ground.v);
    history_.slip.push_back(planes.mean(0, slip));
    history_.slip_heel.push_back(slip[0]);
    history_.slip_middle.push_back(to_middle_.dot(slip.head(m)));
    history_.slip_toe.push_back(slip[main - 1]);
    history_.rocking.push_back(rotations_.front().of(c.opening.head(m)));
    history_.crest_x.push_back(s.u[crest_] - crest_start_);
    history_.normal_force.push_back(normal);
    history_.shear_force.push_back(-force.segment(planes.pairs(), main).sum());
    history_.normal_position.push_back(normal > 0.0 ? about_heel / normal : std::numeric_limits<double>::quiet_NaN());
    history_.moment.push_back(about_heel - normal * middle_of(plane));
    history_.open_length.push_back(open);
    history_.slipping_length.push_back(slipping);
    history_.largest_opening.push_back(c.opening.head(m).maxCoeff());
    if (const auto* water = c.laws.find<CrackWater>()) {
        const JointWaterReport& report = water->report();
        history_.crack_length.push_back(report.crack.upstream);
        history_.wet_length.push_back(report.wet_length);
        for (const double pressure : report.pressure) history_.joint_pressure.push_back(static_cast<float>(pressure));
    }
    history_.energy.push_back(with_spent(dynamics_.energy(), before_.spent));
    history_.imbalance.push_back(before_.imbalance + dynamics_.energy_imbalance());
    add_lifts(force);
    add_anchors();
    if (history_.frames && history_.frames->due(history_.time.back())) add_frame(force);
    if (series_ == PairSeries::none) return;
    add_pairs(force);
    history_.states.look(s, history_.time.back(), history_.slip.back(), history_.crest_x.back());
}

void HistoryRecorder::finish()
{
    if (history_.frames && history_.frames->last_time() < history_.time.back())
        add_frame(dynamics_.state().contact.contact_force());
}

void HistoryRecorder::add_frame(const VectorXd& force)
{
    const DynamicState& s = dynamics_.state();
    const ContactMemory& c = s.contact;
    const VectorXd& area = dynamics_.structure().planes().area();
    RunFrame frame;
    frame.time = history_.time.back();
    frame.mean_slip = history_.slip.back();
    frame.dam = s.u;
    frame.rock = s.rock;
    frame.pressure = force.head(area.size()).cwiseQuotient(area);
    frame.shear = -force.tail(area.size()).cwiseQuotient(area);
    frame.slip = c.slip - start_;
    frame.opening = c.opening;
    if (const auto* water = c.laws.find<CrackWater>()) frame.joint_water = water->report().pressure;
    if (const WaterBody* water = dynamics_.structure().water())
        frame.water = pressure_at_nodes(*water, dynamics_.structure().order(), s.v);
    for (const ContactState state : c.states) frame.states.push_back(static_cast<double>(state));
    history_.frames->add(frame);
}

void HistoryRecorder::add_lifts(const VectorXd& force)
{
    const ContactMemory& c = dynamics_.state().contact;
    const ContactPlanes& planes = dynamics_.structure().planes();
    for (Index k = 1; k < planes.count(); ++k) {
        const Index first = planes.first(k), pairs = planes[k].pairs();
        LiftHistory& lift = history_.lifts[static_cast<std::size_t>(k - 1)];
        lift.slip.push_back(planes.mean(k, slip_));
        lift.rocking.push_back(rotations_[static_cast<std::size_t>(k)].of(c.opening.segment(first, pairs)));
        lift.normal_force.push_back(force.segment(first, pairs).sum());
        lift.largest_opening.push_back(c.opening.segment(first, pairs).maxCoeff());
        const auto* bond = c.laws.find<BondLaw>();
        const BondLengths lengths = bond ? bond->lengths(first, pairs) : BondLengths{};
        if (!(lengths.bonded > 0.0)) continue;
        lift.damaged.push_back(lengths.damaged);
        lift.broken.push_back(lengths.broken);
    }
}

void HistoryRecorder::add_anchors()
{
    const auto* law = dynamics_.state().contact.laws.find<AnchorLaw>();
    if (!law) return;
    const std::vector<AnchorOutcome> now = law->outcomes();
    history_.anchors.resize(now.size());
    for (std::size_t k = 0; k < now.size(); ++k) {
        history_.anchors[k].name = now[k].name;
        history_.anchors[k].force.push_back(now[k].history.force);
    }
}

void HistoryRecorder::add_pairs(const VectorXd& force)
{
    const ContactMemory& c = dynamics_.state().contact;
    const VectorXd& area = dynamics_.structure().plane().area;
    const Index m = area.size(), tangential = dynamics_.structure().pairs();
    PairHistory& pairs = history_.by_pair;
    pairs.pairs = m;
    for (Index i = 0; i < m; ++i) {
        pairs.pressure.push_back(force[i] / area[i]);
        pairs.shear.push_back(-force[tangential + i] / area[i]);
        pairs.slip.push_back(c.slip[i] - start_[i]);
        pairs.opening.push_back(c.opening[i]);
    }
    pairs.state.insert(pairs.state.end(), c.states.begin(), c.states.begin() + m);
}

namespace {

[[noreturn]] void refuse_spool()
{
    throw InputError(Diagnostic{"", 0, 0, "The frames of the run could not be kept in a temporary file.",
                                "room on the disk of temporary files (TMPDIR, else /tmp)",
                                "free some, or ask for fewer frames"});
}

/// In the folder of temporary files; gone with its last reader. Null where none can be had.
std::FILE* nameless_file()
{
    std::error_code none;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(none);
    if (none) return nullptr;
    std::string name = (folder / "damslip_frames_XXXXXX").string();
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) return nullptr;
    unlink(name.c_str());
    std::FILE* file = fdopen(descriptor, "w+b");
    if (!file) close(descriptor);
    return file;
}

void write_values(std::FILE* file, const double* values, std::size_t count)
{
    if (std::fwrite(&count, sizeof count, 1, file) != 1 || std::fwrite(values, sizeof(double), count, file) != count)
        refuse_spool();
}

template <class Values>
void read_values(std::FILE* file, Values& values)
{
    std::size_t count = 0;
    if (std::fread(&count, sizeof count, 1, file) != 1) refuse_spool();
    values.resize(count);
    if (std::fread(values.data(), sizeof(double), count, file) != count) refuse_spool();
}

/// The parts of a frame, in the order of the file.
template <class Frame, class Take>
void for_each_part(Frame& frame, const Take& take)
{
    take(frame.dam);
    take(frame.rock);
    take(frame.pressure);
    take(frame.shear);
    take(frame.slip);
    take(frame.opening);
    take(frame.joint_water);
    take(frame.water);
    take(frame.states);
}

} // namespace

FrameSpool::FrameSpool(double interval) : file_(nameless_file()), interval_(interval)
{
    if (!file_) refuse_spool();
}

void FrameSpool::add(const RunFrame& frame)
{
    std::fseek(file_.get(), 0, SEEK_END);
    const long place = std::ftell(file_.get());
    const double instant[] = {frame.time, frame.mean_slip};
    write_values(file_.get(), instant, 2);
    for_each_part(frame, [&](const auto& part) {
        write_values(file_.get(), part.data(), static_cast<std::size_t>(part.size()));
    });
    places_.push_back(place);
    last_ = frame.time;
    next_ = interval_ * (std::floor(frame.time / interval_ + 1e-9) + 1.0);
}

RunFrame FrameSpool::read(std::size_t index) const
{
    std::fseek(file_.get(), places_[index], SEEK_SET);
    RunFrame frame;
    std::vector<double> instant;
    read_values(file_.get(), instant);
    frame.time = instant[0];
    frame.mean_slip = instant[1];
    for_each_part(frame, [&](auto& part) { read_values(file_.get(), part); });
    if (!change_.at) return frame;
    const double change = change_.at(frame.time);
    frame.mean_slip += change;
    frame.slip.array() += change;
    frame.dam += change * change_.sliding;
    return frame;
}

void StateKeeper::look(const DynamicState& state, double time, double slip, double crest_x)
{
    const auto keep = [&](Instant instant) {
        StoredState& kept = kept_[static_cast<std::size_t>(instant)]; // its vectors keep their memory
        kept.instant = instant;
        kept.time = time;
        kept.slip = slip;
        kept.dam = state.u;
        kept.rock = state.rock;
    };
    if (kept_.empty()) {
        kept_.resize(static_cast<std::size_t>(Instant::end) + 1);
        keep(Instant::start);
        keep(Instant::end);
        return;
    }
    const StoredState& before = kept_.back();
    const double lean = crest_x - slip, rate = std::abs(slip - before.slip) / (time - before.time);
    if (lean > lean_down_) {
        lean_down_ = lean;
        keep(Instant::leans_downstream);
    }
    if (lean < lean_up_) {
        lean_up_ = lean;
        keep(Instant::leans_upstream);
    }
    if (rate > rate_) {
        rate_ = rate;
        keep(Instant::slides_fastest);
    }
    keep(Instant::end);
}

void StateKeeper::slide(const SlipChange& change)
{
    for (StoredState& kept : kept_) {
        if (kept.dam.size() == 0) continue;
        kept.slip += change.at(kept.time);
        kept.dam += change.at(kept.time) * change.sliding;
    }
}

void slide(const std::vector<double>& change, const VectorXd& sliding, double level, RunHistory& history)
{
    for (std::size_t row = 0; row < change.size(); ++row) history.crest_x[row] += level * change[row];
    for (std::vector<double>* slip : {&history.slip, &history.slip_heel, &history.slip_middle, &history.slip_toe})
        for (std::size_t row = 0; row < change.size(); ++row) (*slip)[row] += change[row];
    PairHistory& pairs = history.by_pair;
    for (std::size_t i = 0; i < pairs.slip.size(); ++i) pairs.slip[i] += change[i / static_cast<std::size_t>(pairs.pairs)];
    const SlipChange of_dam{[change, times = history.time](double time) {
                                const auto next = std::lower_bound(times.begin(), times.end(), time);
                                return change[static_cast<std::size_t>(std::min(next, times.end() - 1) - times.begin())];
                            },
                            sliding};
    history.states.slide(of_dam);
    if (history.frames) history.frames->slide(of_dam);
}

std::vector<StoredState> StateKeeper::states() const
{
    std::vector<StoredState> list;
    std::copy_if(kept_.begin(), kept_.end(), std::back_inserter(list),
                 [](const StoredState& s) { return s.dam.size() > 0; });
    std::stable_sort(list.begin(), list.end(),
                     [](const StoredState& a, const StoredState& b) { return a.time < b.time; });
    return list;
}

} // namespace damslip::fe2d
