#include "pages/fe/fe_output.hpp"

#include "core/file.hpp"
#include "core/units.hpp"
#include "fe2d/statics/stress.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::pages {

namespace {

/// Major and minor principal stress of each column (xx, yy, xy) [Pa].
Eigen::MatrixXd principal(const Eigen::Matrix3Xd& stress)
{
    Eigen::MatrixXd out(2, stress.cols());
    for (Eigen::Index i = 0; i < stress.cols(); ++i) {
        const fe2d::PrincipalStress p = fe2d::principal_stress(stress.col(i));
        out(0, i) = p.major;
        out(1, i) = p.minor;
    }
    return out;
}

} // namespace

Table count_table(fe2d::ModelCounts counts, const fe2d::FluidModel* water)
{
    if (water)
        counts.add({.effect = "acoustic water",
                    .elements = water->reservoir.mesh.element_count(),
                    .unknowns = water->unknowns(),
                    .nonzeros = water->mass.nonZeros() + water->damping.nonZeros() + water->stiffness.nonZeros()});
    Table t;
    t.title = "Model";
    t.columns = {{"effect", "effect", "", 4},
                 {"elements", "elements", "", 4},
                 {"unknowns", "unknowns", "", 4},
                 {"nonzeros", "non-zeros", "", 4},
                 {"bytes", "bytes", "", 4}};
    for (const fe2d::EffectCount& e : counts.effects)
        t.rows.push_back({e.effect, e.elements, e.unknowns, e.nonzeros, e.bytes});
    t.rows.push_back({std::string("sum"), counts.elements, counts.unknowns, counts.nonzeros, counts.bytes});
    return t;
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

nlohmann::ordered_json worst_json(const std::vector<ContactRun>& runs, const std::optional<double>& allowable)
{
    if (runs.empty()) return nullptr;
    const ContactRun& worst = worst_of(runs);
    const auto number = [&](double metres, double unit) {
        const std::optional<double> known = reported(worst.fe.status, metres);
        return known ? nlohmann::ordered_json(*known / unit) : nlohmann::ordered_json();
    };
    return {{"record", worst.record},
            {"polarity", worst.polarity},
            {"status", word(worst.fe.status)},
            {"max_slip_m", number(worst.fe.max_slip, 1.0)},
            {"total_error_mm", number(slip_error(worst).total, units::mm)},
            {"verdict", word(verdict_of(worst, allowable))}};
}

std::string headline_text(const Headline& headline)
{
    return headline.sentence + "\n" + headline.verdict + "\n";
}

void FieldSeries::add(const std::string& name, double time, const Eigen::VectorXd& displacement,
                      const Eigen::VectorXd& elastic, std::vector<fe2d::VtuArray> more)
{
    if (folder_.empty()) return;
    const fe2d::StressField stress = fe2d::stress_field(model_.mesh, model_.dofs, model_.materials, elastic);
    const std::string file = fmt::format("fields_{:04d}_{}.vtu", entries_.size(), file_word(name));
    std::vector<fe2d::VtuArray> nodal{{"displacement_m", node_vectors(model_.dofs, displacement)},
                                      {"stress_xx_yy_xy_Pa", stress.nodal},
                                      {"principal_major_minor_Pa", principal(stress.nodal)}};
    std::move(more.begin(), more.end(), std::back_inserter(nodal));
    fe2d::write_vtu(folder_ / file, model_.mesh, nodal, {{"centre_stress_xx_yy_xy_Pa", stress.centre}});
    entries_.push_back({time, file});
}

void FieldSeries::write_collection() const
{
    if (!folder_.empty() && !entries_.empty()) fe2d::write_pvd(folder_ / "fields.pvd", entries_);
}

void finish_output(const std::filesystem::path& folder, const Scene& scene, const std::string& summary_json,
                   const FieldSeries& fields)
{
    if (folder.empty()) return;
    fields.write_collection();
    write_file(folder / "summary.json", summary_json);
    write_file(folder / "scene.resolved.toml", resolved_toml(scene));
}

} // namespace damslip::pages
