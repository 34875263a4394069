#include "pages/fe/fe_output.hpp"

#include "analysis/prepare/contact_law.hpp"
#include "core/file.hpp"
#include "core/units.hpp"
#include "fe2d/statics/stress.hpp"
#include "pages/report/page_html.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/effect_table.hpp"
#include "pages/scene/report_provenance.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>

namespace damslip::pages {

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

namespace {

/// The worst run by record and polarity, with its status, slip, error and verdict; null without runs.
nlohmann::ordered_json worst_json(const std::vector<ContactRun>& runs, const std::optional<double>& allowable)
{
    if (runs.empty()) return nullptr;
    const ContactRun& worst = worst_of(runs);
    const std::optional<double> walked = walked_at_least(worst.fe.status, worst.fe.slip);
    const auto number = [&](double metres, double unit) {
        const std::optional<double> known = reported(worst.fe.status, metres);
        return known ? nlohmann::ordered_json(*known / unit) : nlohmann::ordered_json();
    };
    return {{"record", worst.record},
            {"polarity", worst.polarity},
            {"status", word(worst.fe.status)},
            {"max_slip_m", number(worst.fe.max_slip, 1.0)},
            {"walked_at_least_m", walked ? nlohmann::ordered_json(*walked) : nlohmann::ordered_json()},
            {"total_error_mm", number(slip_error(worst).total, units::mm)},
            {"verdict", word(verdict_of(worst, allowable))}};
}

} // namespace

FeAnswer begin_fe_answer(FeKind kind, const FePageFrame& frame)
{
    const Table counts = count_table(frame.model.counts, frame.water);
    const std::optional<std::string> first = frame.slides ? base_note(frame.scene) : std::nullopt;
    FeAnswer answer{json_header("fe", frame.scene, frame.plan.scene_hash),
                    (first ? *first + "\n\n" : "") + frame.scene.title + "\n\n" + text(counts)};
    answer.json["base"] = kind == FeKind::tied ? "tied" : "contact";
    if (kind == FeKind::reduced) answer.json["reduced"] = true;
    answer.json["effects"] = json_of(effect_table(frame.plan));
    answer.json["model"] = json_of(counts);
    return answer;
}

Verdict joined_verdict(const Headline& headline, const std::vector<ContactRun>& runs,
                       const std::optional<double>& allowable)
{
    return headline.outcome == Outcome::fail ? Verdict::fail : verdict_of(runs, allowable);
}

void add_verdict(const Headline& headline, const std::vector<ContactRun>& runs, const std::optional<double>& allowable,
                 FeAnswer& answer)
{
    answer.json["headline"] = headline.sentence;
    answer.json["verdict"] = word(joined_verdict(headline, runs, allowable));
    answer.json["worst"] = worst_json(runs, allowable);
}

void end_fe_answer(const std::vector<std::string>& messages, FeAnswer& answer)
{
    answer.json["messages"] = messages;
    for (const std::string& message : messages) answer.text += "note: " + message + "\n";
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
    const fe2d::StressField stress = fe2d::stress_field(model_.mesh, model_.dofs, model_.materials, elastic);
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

void write_fe_files(const std::filesystem::path& folder, const Scene& scene, const FeAnswer& answer,
                    const FieldSeries& fields, const Page& page)
{
    fields.write_collection();
    write_file(folder / "summary.json", answer.json.dump(2) + "\n");
    write_file(folder / "scene.resolved.toml", resolved_toml(scene));
    write_file(folder / "report.html", page_html(page));
}

} // namespace damslip::pages
