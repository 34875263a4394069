#include "analysis/prepare/ready.hpp"
#include "core/file.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "fe2d/mesh/faces.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/output/vtu.hpp"
#include "pages/fe/fe_pages.hpp"
#include "pages/report/page.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/planes.hpp"
#include "scene/write.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace damslip::pages {

Page begin_fe_page(const FePageFrame& in)
{
    const std::optional<std::string> first = in.slides ? base_note(in.scene) : std::nullopt;
    Page page = begin_page(in.scene, "Sliding in an earthquake: " + in.kind + ". " + (first ? *first + ". " : ""),
                           in.plan.scene_hash);
    page.warnings = record_warnings(in.records);
    page.sections.push_back({"Section", {section_drawing(in.scene, in.uplift, dam_mesh_lines(in.model.mesh))}});
    return page;
}

void end_fe_page(const FePageFrame& in, const std::vector<GroundMotion>& motions, const std::vector<Table>& tables,
                 Page& page)
{
    if (!motions.empty()) page.sections.push_back(records_section(motions, 1));
    Section model{"Model and solution",
                  {effect_part(in.plan),
                   rows_part(count_table(in.model.counts, in.water),
                             {"Elements and unknowns by what they are for; non-zeros: stored entries of stiffness and "
                              "mass that would not be there without it; bytes: of what is stored for it."})}};
    for (const Table& table : tables) model.parts.push_back(rows_part(table));
    page.sections.push_back(std::move(model));
    page.sections.push_back(limits_section(in.scene, Method::finite_elements));
    end_page(in.scene, in.records, page, {{"method", in.method}}, in.plan.scene_hash);
}

std::vector<Section> add_worse_polarities(const std::vector<ContactRun>& runs, std::vector<Section> sections,
                                          Page& page)
{
    std::vector<Section> others;
    std::size_t shown = 0;
    for (std::size_t i = 0; i < sections.size(); ++i) {
        const bool worst = std::ranges::none_of(runs, [&](const ContactRun& r) {
            return r.record == runs[i].record && (milder(runs[i], r) || (!milder(r, runs[i]) && &r < &runs[i]));
        });
        if (worst) {
            sections[i].fold = shown++ < open_records ? Fold::open : Fold::folded;
            page.sections.push_back(std::move(sections[i]));
            continue;
        }
        sections[i].title = "Appendix: " + sections[i].title;
        sections[i].fold = Fold::folded;
        others.push_back(std::move(sections[i]));
    }
    return others;
}

namespace {

constexpr double MPa = 1e6;

const char* words(fe2d::Instant instant)
{
    return word_in(instant, {{fe2d::Instant::start, "before the earthquake"},
                             {fe2d::Instant::leans_downstream, "crest farthest downstream of the base"},
                             {fe2d::Instant::leans_upstream, "crest farthest upstream of the base"},
                             {fe2d::Instant::slides_fastest, "largest slip rate"},
                             {fe2d::Instant::end, "end"}});
}

/// von Mises stress in plane strain, with σ_zz = ν (σ_xx + σ_yy) [Pa].
double von_mises(const Eigen::Vector3d& s, double poisson_ratio)
{
    const double z = poisson_ratio * (s[0] + s[1]), a = s[0] - s[1], b = s[1] - z, c = z - s[0];
    return std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * s[2] * s[2]);
}

} // namespace

std::vector<Polyline> dam_mesh_lines(const fe2d::Mesh& mesh)
{
    std::set<std::pair<int, int>> seen;
    std::vector<Polyline> lines;
    for (int e = 0; e < mesh.dam_element_count; ++e) {
        const fe2d::Element& element = mesh.elements[static_cast<std::size_t>(e)];
        for (int i = 0; i < element.size(); ++i) {
            const int a = element.nodes[static_cast<std::size_t>(i)],
                      b = element.nodes[static_cast<std::size_t>((i + 1) % element.size())];
            if (seen.insert(std::minmax(a, b)).second)
                lines.push_back({mesh.nodes[static_cast<std::size_t>(a)], mesh.nodes[static_cast<std::size_t>(b)]});
        }
    }
    return lines;
}

MeshView stress_view(const fe2d::EarthquakeRun& run)
{
    const fe2d::Mesh& mesh = run.model().mesh;
    MeshView view;
    view.title = "Stresses on the deformed mesh";
    view.nodes = mesh.nodes;
    for (const fe2d::Element& e : mesh.elements) view.elements.push_back(e.nodes);
    view.front_nodes = static_cast<std::size_t>(mesh.dam_node_count);
    view.fields = {{"major principal stress, tension positive", "MPa"},
                   {"minor principal stress, tension positive", "MPa", true},
                   {"vertical stress, tension positive", "MPa"},
                   {"von Mises stress", "MPa"}};
    view.note =
        "Total stresses: gravity, water and earthquake. Deformations are magnified, the dam's mean slip is drawn "
        "to scale; dashed: the dam before any load. First shown is the instant with the largest tension in the dam; "
        "the envelope is of the instants that are kept of each run, so between them a stress may be larger. The "
        "colours end where 1 % of the dam's values lie beyond, since stresses in corners grow with every finer mesh.";
    return view;
}

namespace {

MeshView::State stress_state(const fe2d::EarthquakeRun& run, const std::string& name, const fe2d::StoredState& state,
                             const Eigen::VectorXd& zero)
{
    const fe2d::Model& model = run.model();
    const Eigen::VectorXd u = run.displacement_of(state);
    const fe2d::StressField stress = fe2d::stress_field(model, u);
    const Eigen::Vector2d shift = state.slip * run.structure().plane().tangent;
    const Eigen::MatrixXd at_nodes = node_vectors(model.dofs, zero.size() ? Eigen::VectorXd(u - zero) : u);

    MeshView::State shown;
    shown.name = name;
    shown.time = state.time;
    shown.shift_x = shift.x();
    shown.shift_y = shift.y();
    shown.values.resize(4); // stress_view()
    for (int node = 0; node < model.mesh.node_count(); ++node) {
        const bool dam = node < model.mesh.dam_node_count;
        shown.ux.push_back(at_nodes(0, node) - (dam ? shift.x() : 0.0));
        shown.uy.push_back(at_nodes(1, node) - (dam ? shift.y() : 0.0));
        const Eigen::Vector3d s = stress.nodal.col(node);
        const fe2d::PrincipalStress principal = fe2d::principal_stress(s);
        const fe2d::Materials& m = model.materials;
        shown.values[0].push_back(principal.major / MPa);
        shown.values[1].push_back(principal.minor / MPa);
        shown.values[2].push_back(s[1] / MPa);
        shown.values[3].push_back(von_mises(s, dam ? m.dam.poisson_ratio : m.rock.poisson_ratio) / MPa);
    }
    return shown;
}

} // namespace

void add_stresses(const fe2d::EarthquakeRun& run, const std::string& record, const fe2d::RunResult& result,
                  MeshView& view)
{
    for (const fe2d::StoredState& state : result.history.states.states()) {
        const bool start = state.instant == fe2d::Instant::start;
        if (start && !view.states.empty()) continue;
        const std::string name = start ? words(state.instant) : record + ": " + words(state.instant);
        view.states.push_back(stress_state(run, name, state, result.zero_displacement));
    }
}

Table mesh_table(const fe2d::Mesh& mesh)
{
    struct Row {
        const fe2d::Mesh& mesh;
        fe2d::MeshQuality quality;
    };
    const std::vector<Row> rows{{mesh, fe2d::measure_quality(mesh)}};
    Table t = table_of<Row>(
        "Mesh",
        {{in_brief({"nodes", "nodes"}), [](const Row& r) { return r.mesh.nodes.size(); }},
         {in_brief({"quadrilaterals", "quadrilaterals"}), [](const Row& r) { return r.quality.quadrilaterals; }},
         {in_brief({"triangles", "triangles"}), [](const Row& r) { return r.quality.triangles; }},
         {in_brief({"dam_elements", "in the dam"}), [](const Row& r) { return r.mesh.dam_element_count; }},
         {in_brief({"base_nodes_dam", "base, dam"}), [](const Row& r) { return r.mesh.contact.dam_nodes.size(); }},
         {in_brief({"base_nodes_rock", "base, rock"}), [](const Row& r) { return r.mesh.contact.rock_nodes.size(); }},
         {{"smallest_edge_m", "smallest edge", "m", 4}, [](const Row& r) { return r.quality.smallest_edge; }},
         {{"largest_edge_m", "largest edge", "m", 4}, [](const Row& r) { return r.quality.largest_edge; }},
         {in_brief({"smallest_angle_deg", "smallest angle", "deg", 4}),
          [](const Row& r) { return r.quality.smallest_angle / units::degree; }},
         {in_brief({"smallest_scaled_jacobian", "scaled Jacobian", "-", 3}),
          [](const Row& r) { return r.quality.smallest_scaled_jacobian; }}},
        rows);
    if (!mesh.has_rock())
        t.notes.push_back("no rock: the base stands on a rigid plane.");
    else
        t.notes.push_back(mesh.contact.matching ? "the nodes of dam and rock face each other along the base."
                                                : "the nodes of dam and rock do not face each other along the base.");
    for (std::size_t i = 0; i < mesh.lifts.size(); ++i)
        t.notes.push_back(mesh.seam && (i == 0 || mesh.lifts[i].upright)
                              ? fmt::format("{}: {} pairs of nodes; base_nodes are those of the seam's path.",
                                            i == 0 ? "base" : "upright face", mesh.lifts[i].lower_nodes.size())
                              : fmt::format("lift joint {}: {} pairs of nodes.", i + 1, mesh.lifts[i].lower_nodes.size()));
    return t;
}

std::string import_note(const Scene& scene, const fe2d::ImportSummary& s)
{
    return fmt::format("{}: Gmsh {}, {} nodes; {} of no element of dam and rock left out, {} at the place of another "
                       "one joined, {} clockwise elements turned.",
                       scene.mesh.file->string(), s.version, s.file_nodes, s.unused, s.joined, s.flipped);
}

Eigen::MatrixXd principal_stresses(const Eigen::Matrix3Xd& stress)
{
    Eigen::MatrixXd out(2, stress.cols());
    for (Eigen::Index i = 0; i < stress.cols(); ++i) {
        const fe2d::PrincipalStress p = fe2d::principal_stress(stress.col(i));
        out(0, i) = p.major;
        out(1, i) = p.minor;
    }
    return out;
}

Table count_table(fe2d::ModelCounts counts, const fe2d::FluidModel* water)
{
    if (water)
        counts.add({.effect = "acoustic water",
                    .elements = water->reservoir.mesh.element_count(),
                    .unknowns = water->unknowns(),
                    .nonzeros = water->mass.nonZeros() + water->damping.nonZeros() + water->stiffness.nonZeros()});
    using E = fe2d::EffectCount;
    std::vector<E> rows = counts.effects;
    rows.push_back({"sum", counts.elements, counts.unknowns, counts.nonzeros, counts.bytes});
    return table_of<E>("Model",
                       {{{"effect", "effect"}, &E::effect},
                        {{"elements", "elements"}, &E::elements},
                        {{"unknowns", "unknowns"}, &E::unknowns},
                        {{"nonzeros", "non-zeros"}, &E::nonzeros},
                        {{"bytes", "bytes"}, &E::bytes}},
                       rows);
}

Eigen::MatrixXd node_vectors(const fe2d::DofMap& dofs, const Eigen::VectorXd& unknowns)
{
    Eigen::MatrixXd at_nodes = Eigen::MatrixXd::Zero(2, dofs.node_count());
    for (int node = 0; node < dofs.node_count(); ++node)
        for (int c = 0; c < 2; ++c)
            if (const int dof = dofs(node, c); dof != fe2d::no_dof) at_nodes(c, node) = unknowns[dof];
    return at_nodes;
}

Eigen::Vector2d crest_displacement(const fe2d::Model& model, const Eigen::VectorXd& displacement)
{
    return node_vectors(model.dofs, displacement).col(model.mesh.crest.back());
}

Answer begin_fe_answer(const FePageFrame& frame)
{
    Answer answer(json_header("fe", frame.scene, frame.plan.scene_hash));
    if (const std::optional<std::string> first = frame.slides ? base_note(frame.scene) : std::nullopt)
        answer += *first + "\n\n";
    answer += frame.scene.title + "\n\n";
    answer.set("base", frame.slides ? "contact" : "tied");
    if (frame.reduced) answer.set("reduced", true);
    answer.add("effects", effect_table(frame.plan), {.text = false});
    answer.add("model", count_table(frame.model.counts, frame.water));
    return answer;
}

Verdict joined_verdict(const Headline& headline, const std::vector<ContactRun>& runs,
                       const std::optional<double>& allowable)
{
    return headline.outcome == Outcome::fail ? Verdict::fail : verdict_of(runs, allowable);
}

std::string run_file(const std::string& kind, const Scene& scene, const std::string& record, const std::string& suffix)
{
    std::vector<std::string> names;
    for (const RecordFiles& files : scene.motion.records) names.push_back(files.name);
    return kind + "_" + file_word(record, names) + suffix;
}

void FieldSeries::add(const std::string& name, double time, const Eigen::VectorXd& displacement,
                      const Eigen::VectorXd& elastic, std::vector<fe2d::VtuArray> more)
{
    if (folder_.empty()) return;
    const fe2d::StressField stress = fe2d::stress_field(model_, elastic);
    const std::string file = fmt::format("fields_{:04d}_{}.vtu", entries_.size(), file_word(name));
    std::vector<fe2d::VtuArray> nodal{{"displacement_m", node_vectors(model_.dofs, displacement)},
                                      {"stress_xx_yy_xy_Pa", stress.nodal},
                                      {"principal_major_minor_Pa", principal_stresses(stress.nodal)}};
    std::move(more.begin(), more.end(), std::back_inserter(nodal));
    fe2d::write_vtu(folder_ / file, model_.mesh, nodal, {{"centre_stress_xx_yy_xy_Pa", stress.centre}});
    entries_.push_back({time, file});
}

void FieldSeries::write_collection() const
{
    if (!folder_.empty() && !entries_.empty()) fe2d::write_pvd(folder_ / "fields.pvd", entries_);
}

void write_fe_files(const std::filesystem::path& folder, const Scene& scene, const Answer& answer,
                    const FieldSeries& fields, const Page& page)
{
    fields.write_collection();
    answer.write(folder, {});
    Scene given = scene; // the file's cracks are traced again
    std::erase_if(given.lift_joints, [](const LiftJoint& joint) { return !joint.path.empty(); });
    write_file(folder / "scene.resolved.toml", resolved_toml(given));
    write_file(folder / "report.html", page_html(page));
}

namespace {

/// What does not change from frame to frame.
class FrameWriter {
public:
    FrameWriter(const FeReport::Input& of, std::filesystem::path folder, const Eigen::VectorXd& zero)
        : of_(of), folder_(std::move(folder)), zero_(zero), dam_(fe2d::part_of(mesh(), 0, mesh().dam_element_count)),
          rock_(fe2d::part_of(mesh(), mesh().dam_element_count, mesh().element_count()))
    {
        add_joint(mesh().contact.dam_nodes);
        for (const fe2d::LiftPlane& lift : mesh().lifts) add_joint(lift.upper_nodes);
        water_ = static_water();
    }

    /// @returns the name of the .vtm
    std::string write(std::size_t number, const fe2d::RunFrame& frame) const
    {
        const std::string name = fmt::format("{:05d}", number);
        std::vector<fe2d::VtmBlock> blocks;
        const auto block = [&](const std::string& what) {
            blocks.push_back({what, name + "_" + what + ".vtu"});
            return folder_ / blocks.back().file;
        };
        const Eigen::VectorXd elastic =
            of_.model.displacement_of({fe2d::Instant::end, 0.0, 0.0, frame.dam, frame.rock});
        const Eigen::VectorXd shown = zero_.size() > 0 ? Eigen::VectorXd(elastic - zero_) : elastic;
        const Eigen::MatrixXd displacement = node_vectors(of_.model.model().dofs, shown);
        const fe2d::StressField stress = fe2d::stress_field(of_.model.model(), elastic);
        write_solid(block("dam"), dam_, displacement, stress);
        if (!rock_.elements.empty()) write_solid(block("rock"), rock_, displacement, stress);
        if (const fe2d::WaterBody* water = of_.model.water(); water && frame.water.size() > 0)
            fe2d::write_vtu(block("water"), water->water.reservoir.mesh,
                            {{"pressure_Pa", Eigen::MatrixXd(frame.water.transpose())}}, {});
        write_joints(block("joints"), displacement, frame);
        fe2d::write_vtm(folder_ / (name + ".vtm"), blocks);
        return name + ".vtm";
    }

private:
    const fe2d::Mesh& mesh() const { return of_.model.model().mesh; }

    void add_joint(const std::vector<int>& nodes)
    {
        Polyline& joint = joints_.emplace_back();
        for (const int node : nodes) {
            joint.push_back(mesh().nodes[static_cast<std::size_t>(node)]);
            joint_nodes_.push_back(node);
        }
    }

    /// Pressure of the water in the joints before the earthquake [Pa].
    Eigen::VectorXd static_water() const
    {
        Eigen::VectorXd pressure = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(joint_nodes_.size()));
        Eigen::Index at = 0;
        const auto add = [&](const std::vector<double>& distances, const PressureProfile& profile) {
            for (const double distance : distances)
                pressure[at++] = profile.empty() ? 0.0 : pressure_at(profile, distance);
        };
        add(mesh().contact.distance, of_.uplift);
        for (std::size_t k = 0; k < mesh().lifts.size(); ++k) {
            const std::vector<double>& distances = mesh().lifts[k].distance;
            const LiftJoint joint = joints_of(of_.scene)[k];
            add(distances, joint.water == JointWater::none && joint.pressures.empty()
                               ? PressureProfile{}
                               : fe2d::lift_water_profile(of_.scene, joint, distances.back()));
        }
        return pressure;
    }

    static void write_solid(const std::filesystem::path& file, const fe2d::MeshPart& part,
                            const Eigen::MatrixXd& displacement, const fe2d::StressField& stress)
    {
        const Eigen::Matrix3Xd at_nodes = part.at_nodes(stress.nodal);
        fe2d::write_vtu(file, part.mesh,
                        {{"displacement_m", part.at_nodes(displacement)},
                         {"stress_xx_yy_xy_Pa", at_nodes},
                         {"principal_major_minor_Pa", principal_stresses(at_nodes)}},
                        {{"centre_stress_xx_yy_xy_Pa", part.at_elements(stress.centre)}});
    }

    void write_joints(const std::filesystem::path& file, const Eigen::MatrixXd& displacement,
                      const fe2d::RunFrame& frame) const
    {
        Eigen::VectorXd water = water_;
        if (frame.joint_water.size() > 0) water.head(frame.joint_water.size()) = frame.joint_water;
        Eigen::MatrixXd moved(2, static_cast<Eigen::Index>(joint_nodes_.size()));
        for (std::size_t i = 0; i < joint_nodes_.size(); ++i)
            moved.col(static_cast<Eigen::Index>(i)) = displacement.col(joint_nodes_[i]);
        const Eigen::Map<const Eigen::VectorXd> states(frame.states.data(),
                                                       static_cast<Eigen::Index>(frame.states.size()));
        const auto row = [](const auto& values) { return Eigen::MatrixXd(values.transpose()); };
        fe2d::write_lines_vtu(file, joints_,
                              {{"displacement_m", moved},
                               {"opening_m", row(frame.opening)},
                               {"slip_m", row(frame.slip)},
                               {"normal_pressure_Pa", row(frame.pressure)},
                               {"shear_Pa", row(frame.shear)},
                               {"water_pressure_Pa", row(water)},
                               {"state", row(states)}});
    }

    const FeReport::Input& of_;
    std::filesystem::path folder_;
    const Eigen::VectorXd& zero_;
    fe2d::MeshPart dam_, rock_;
    std::vector<Polyline> joints_;
    std::vector<int> joint_nodes_;
    Eigen::VectorXd water_;
};

} // namespace

std::string write_frames(const std::filesystem::path& folder, const FeReport::Input& of, const ContactRun& run)
{
    const fe2d::FrameSpool* frames = run.fe.history.frames.get();
    if (!frames || frames->count() == 0) return {};
    const std::string series = run_file("frames", of.scene, run.record, run.suffix());
    const FrameWriter writer(of, folder / series, run.fe.zero_displacement);
    std::vector<fe2d::PvdEntry> entries;
    for (std::size_t i = 0; i < frames->count(); ++i) {
        const fe2d::RunFrame frame = frames->read(i);
        entries.push_back({frame.time, series + "/" + writer.write(i, frame)});
    }
    fe2d::write_pvd(folder / (series + ".pvd"), entries);
    return series + ".pvd";
}

} // namespace damslip::pages
