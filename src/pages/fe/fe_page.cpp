#include "pages/fe/fe_pages.hpp"

#include "analysis/prepare/ready.hpp"
#include "core/units.hpp"
#include "core/word_in.hpp"
#include "fe2d/mesh/faces.hpp"
#include "fe2d/model/static_solution.hpp"
#include "pages/scene/scene_pages.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
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

} // namespace damslip::pages
