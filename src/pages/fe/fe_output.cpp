#include "pages/fe/fe_pages.hpp"

#include "analysis/prepare/ready.hpp"
#include "core/file.hpp"
#include "fe2d/model/static_solution.hpp"
#include "fe2d/output/vtu.hpp"
#include "pages/report/page.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/planes.hpp"
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
