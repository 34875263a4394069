#include "analysis/fe/model_spread.hpp"

#include "core/units.hpp"
#include "scene/rock_mass.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

/// "+70 %"
std::string change_words(double share)
{
    const double percent = std::round(100.0 * share);
    return percent == 0.0 ? "within 1 %" : fmt::format("{:+.0f} %", percent);
}

struct Other {
    std::string what;
    Scene scene;
};

std::vector<Other> other_models(const Scene& given)
{
    std::vector<Other> others;
    if (rock_radiates(given)) others.push_back({"massless rock", with_massless_rock(given)});
    if (rock_kind(given) == RockKind::massless && given.time.scheme != TimeScheme::central_difference)
        others.push_back({"radiating rock", with_radiating_rock(given)});
    if (given.reservoir && given.reservoir->model == ReservoirModel::acoustic) {
        others.push_back({"added mass", given});
        others.back().scene.reservoir->model = ReservoirModel::added_mass;
    }
    return others;
}

/// The worst record alone.
Records record_of(const Ready& ready, const ContactRun& worst)
{
    std::vector<RecordPair> one;
    for (const RecordPair& pair : ready.records())
        if (pair.files.name == worst.record) one.push_back(pair);
    return std::make_shared<const std::vector<RecordPair>>(std::move(one));
}

ModelChoice run_other(const Other& other, const Ready& ready, const ContactRun& worst, Watch& watch)
{
    const Ready changed =
        prepare(other.scene, Method::finite_elements, record_of(ready, worst), {.stop = watch.stop()});
    FeOptions options;
    options.polarity = worst.polarity;
    options.mesh_error = false;
    ContactRuns runs(changed, options, watch);
    const std::vector<ContactRun> done = runs.run();
    if (done.empty()) return {other.what, false};
    return {other.what, true, done.front().fe.status, done.front().fe.max_slip};
}

} // namespace

std::vector<ModelChoice> model_spread(const Ready& ready, const std::vector<ContactRun>& runs, bool run_them,
                                      Watch& watch)
{
    std::vector<ModelChoice> spread;
    if (runs.empty()) return spread;
    const ContactRun& worst = worst_of(runs);
    const auto flipped = std::find_if(runs.begin(), runs.end(), [&](const ContactRun& r) {
        return r.record == worst.record && r.polarity == -worst.polarity;
    });
    if (flipped != runs.end())
        spread.push_back({"other polarity", true, flipped->fe.status, flipped->fe.max_slip});
    else
        spread.push_back({"other polarity", false});
    for (const Other& other : other_models(ready.given))
        spread.push_back(run_them && !watch.stop_asked() ? run_other(other, ready, worst, watch)
                                                         : ModelChoice{other.what, false});
    return spread;
}

std::string spread_line(const std::vector<ModelChoice>& spread, const std::vector<ContactRun>& runs)
{
    if (spread.empty() || runs.empty()) return "";
    const ContactRun& worst = worst_of(runs);
    const std::optional<double> slip = reported(worst.fe.status, std::abs(worst.fe.max_slip));
    std::string there, missing;
    for (const ModelChoice& choice : spread) {
        if (!choice.run) {
            missing += (missing.empty() ? "" : ", ") + choice.what;
            continue;
        }
        const std::optional<double> other = reported(choice.status, std::abs(choice.max_slip));
        there += (there.empty() ? "" : "; ") + choice.what + " ";
        if (!other)
            there += word(choice.status);
        else if (slip && *slip > 0.0)
            there += fmt::format("{:.4g} mm ({})", *other / units::mm, change_words(*other / *slip - 1.0));
        else
            there += fmt::format("{:.4g} mm", *other / units::mm);
    }
    std::string line = "Model spread, " + worst.label() + ": " + there;
    if (!missing.empty())
        line += fmt::format("{}{} not run{}", there.empty() ? "" : "; ", missing,
                            missing == "other polarity" ? "" : " (--spread runs the models)");
    return line + ".";
}

} // namespace damslip
