// The ladder as object, text and CSV.
#include "pages/accuracy/accuracy_report.hpp"

#include "core/version.hpp"
#include "pages/accuracy/accuracy_tables.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/report_provenance.hpp"
#include "scene/write.hpp"

#include <nlohmann/json.hpp>

namespace damslip::pages {

nlohmann::ordered_json accuracy_json(const AccuracyReportInput& in)
{
    const Judgement& judged = in.judgement;
    auto j = json_header("accuracy", in.scene);
    j["records"] = nlohmann::ordered_json::array();
    for (const RecordPair& pair : in.records) j["records"].push_back(pair.files.name);
    j["tolerance"] = in.tolerance;
    j["top"] = nullptr;
    j["top_open"] = nullptr;
    j["choice"] = nullptr;
    if (judged.top) j["top"] = rung_id(in.results[*judged.top].rung);
    if (judged.top_error) j["top_open"] = *judged.top_error;
    if (judged.choice) j["choice"] = {{"rung", rung_id(in.results[*judged.choice].rung)}, {"command", in.command}};
    j["rungs"] = json_of(rung_table(in.results, judged));
    j["models"] = json_of(model_table(in.results, judged));
    j["slips"] = json_of(slip_table(in.results, in.records));
    j["messages"] = in.messages;
    return j;
}

std::string accuracy_text(const AccuracyReportInput& in)
{
    std::string all = in.scene.title + "\n\n" + text(rung_table(in.results, in.judgement)) + "\n" +
                      text(model_table(in.results, in.judgement)) + "\n" +
                      choice_sentence(in.results, in.judgement, in.tolerance) + "\n";
    if (!in.command.empty()) all += "  " + in.command + "\n";
    for (const std::string& message : in.messages) all += "note: " + message + "\n";
    return all;
}

std::string accuracy_csv(const Scene& scene, const std::vector<RungResult>& results, const Judgement& judgement)
{
    return csv(rung_table(results, judgement),
               {"damslip " + program_version() + " accuracy", "scene " + scene_hash(scene)});
}

nlohmann::ordered_json one_rung_json(const RungResult& result, const std::vector<RecordPair>& records)
{
    auto j = json_header("accuracy");
    j["rung"] = rung_id(result.rung);
    j["runs"] = json_of(one_rung_table(result, records));
    j["status"] = word(result.status);
    j["remark"] = result.remark;
    return j;
}

std::string one_rung_text(const RungResult& result, const std::vector<RecordPair>& records)
{
    return text(one_rung_table(result, records)) + "status: " + word(result.status) + "\n" +
           (result.remark.empty() ? "" : "note: " + result.remark + "\n");
}

} // namespace damslip::pages
