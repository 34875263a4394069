#include "cli/explain_command.hpp"

#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/tied_scheme.hpp"
#include "core/usage_error.hpp"
#include "pages/explain/explain_page.hpp"
#include "scene/water.hpp"
#include "pages/fe/water_notes.hpp"
#include "scene/plausible.hpp"

#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

/// How the water takes part, by the computed first frequency where the scene leaves it open, and what its length and end are good for.
std::vector<std::string> water_notes(const Ready& ready)
{
    std::vector<std::string> notes;
    if (!has_water(ready.given)) return notes;
    if (ready.reservoir) notes.push_back(ready.reservoir->reason + "; --reduced takes added mass");
    if (ready.given.reservoir->model == ReservoirModel::acoustic)
        for (std::string& warning : reservoir_warnings(ready.given, 20.0)) notes.push_back(std::move(warning));
    return notes;
}

/// The scene's records for the estimate of seconds; none where a file is not there, which only a run has to have.
Records records_at_hand(const Scene& scene)
{
    for (const RecordFiles& r : scene.motion.records)
        if (!std::filesystem::exists(r.horizontal)) return nullptr;
    return load_records(scene, Method::finite_elements);
}

/// The FE model that a run of this scene would hold, and what the run costs.
void add_model(const Ready& ready, Explained& out)
{
    out.plan = ready.plan; // names the water that was chosen
    out.model = fe2d::build_model(ready.scene, ready.model_options());
    if (ready.plan.on(Effect::acoustic_water) && has_water(ready.scene)) out.water = fe2d::build_fluid(ready.scene);
    out.cost = contact_cost(ready);
    for (std::string& note : water_notes(ready)) out.notes.push_back(std::move(note));
    out.notes.push_back(time_scheme_note(ready.given));
}

} // namespace

int explain(const ExplainArguments& arguments, const Streams& streams)
{
    if (arguments.ablate) return ablate(arguments, streams);
    const Scene given = read_run_scene(arguments.inputs, streams);
    if (arguments.method == "fe")
        need_section(given, "damslip explain --method fe", "leave --method out: the wedge is rigid");
    const Method method = arguments.method == "fe" ? Method::finite_elements : Method::rigid_block;
    Explained out{given, arguments.method, make_effect_plan(given, method), {}, {}, {}, note_texts(given.notes)};
    if (method == Method::finite_elements)
        add_model(prepare(given, method, records_at_hand(given), {.stop = streams.stop}), out);
    streams.out << (streams.form == Form::json ? explain_json(out).dump(2) + "\n" : explain_text(out));
    return exit_ok;
}

} // namespace damslip::cli
