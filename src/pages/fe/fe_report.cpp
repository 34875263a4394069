#include "pages/fe/fe_pages.hpp"

#include "analysis/prepare/ready.hpp"
#include "core/file.hpp"
#include "core/units.hpp"
#include "core/version.hpp"
#include "fe2d/run/run_watches.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/joint_bond.hpp"
#include "scene/planes.hpp"
#include "scene/plausible.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"
#include "scene/write.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

namespace damslip::pages {

namespace {

using units::mm;
constexpr std::size_t stress_records = 4; ///< whose stresses are shown
constexpr double no_slip = 1e-7;          ///< less is none [m]

const ContactRun* find(const std::vector<ContactRun>& runs, auto&& condition)
{
    const auto at = std::ranges::find_if(runs, condition);
    return at == runs.end() ? nullptr : &*at;
}

struct LiftSlip {
    double slip = 0.0;  ///< largest |slip| of the lift joints in all runs [m]
    double error = 0.0; ///< what is open of it [m]; NaN: not known
    std::string words;  ///< "lift joint neck", "base", "interface at 45 m"
};

/// "lift joint neck", "lift joint at 66 m", "base", "interface at 45 m": a body on a seam has joints other than lifts.
std::string words_of(const fe2d::LiftResult& lift)
{
    const bool named = !lift.name.empty() && !lift.name.starts_with("lift at ");
    return named && lift.plane.starts_with("lift joint") ? "lift joint " + lift.name : lift.plane;
}

LiftSlip largest_lift_slip(const std::vector<ContactRun>& runs)
{
    LiftSlip largest;
    for (const ContactRun& r : runs)
        for (std::size_t k = 0; k < r.fe.lifts.size(); ++k) {
            const fe2d::LiftResult& lift = r.fe.lifts[k];
            if (reported(r.fe.status, lift.largest_slip).value_or(0.0) > largest.slip)
                largest = {lift.largest_slip, lift_error(r, k).total, words_of(lift)};
        }
    return largest;
}

/// "record El Centro NS, polarity -1", and whether it was run alone.
std::string record_of(const ContactRun& run)
{
    return fmt::format("record {}, polarity {:+d}{}", run.record, run.polarity, run.both ? "" : " alone");
}

/// "3 records, both polarities"
std::string number_of(const std::vector<ContactRun>& runs)
{
    std::size_t records = 0;
    for (std::size_t i = 0; i < runs.size(); ++i) records += i == 0 || runs[i].record != runs[i - 1].record;
    const std::string each = records > 1 ? fmt::format("{} records", records) : "";
    if (!runs.front().both) return each;
    return each.empty() ? "both polarities" : each + " and both polarities";
}

/// Two digits, and no exponent where there are more.
std::string two_digits(double metres)
{
    const double value = metres / mm;
    return value < 100.0 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value);
}

/// ", ± 6.1 mm (step 0.18, mesh 5.9)"
std::string error_text(const SlipError& e)
{
    const std::string step = e.modes ? "step and modes" : "step";
    if (std::isnan(e.step)) return ", no error estimate (the step is fixed)";
    if (std::isnan(e.total))
        return fmt::format(", ± {} mm by the {}, that of the mesh is not known", two_digits(e.step), step);
    if (std::isnan(e.mesh)) return fmt::format(", ± {} mm ({} only)", two_digits(e.total), step);
    return fmt::format(", ± {} mm ({} {}, mesh {})", two_digits(e.total), step, two_digits(e.step), two_digits(e.mesh));
}

/// The smallest sliding factor after the earthquake of runs that stand then; infinite: none has one.
double factor_after(const std::vector<ContactRun>& runs)
{
    double least = std::numeric_limits<double>::infinity();
    for (const ContactRun& r : runs)
        if (has_slip(r) && !falls_after(r) && !open_after(r) && r.fe.after.sliding_factor > 0.0)
            least = std::min(least, r.fe.after.sliding_factor);
    return least;
}

std::string slip_sentence(const Scene& scene, const std::vector<ContactRun>& runs)
{
    const ContactRun& worst = worst_of(runs);
    const std::optional<double> most = reported(worst.fe.status, worst.fe.max_slip);
    if (!most) return worst.label() + ": " + text_of(worst.fe.notes);
    const double slip = std::abs(*most);
    const std::string over = number_of(runs), unanswered = unanswered_words(runs);
    if (status_row(worst.fe.status).slip == SlipMeaning::lower_bound) // no error holds for what has not ended
        return fmt::format("The {} slides at least {:.4g} mm by finite elements and had not come to rest ({}){}.",
                           sliding_body(scene), slip / mm, record_of(worst),
                           scene.criteria.allowable_slip
                               ? fmt::format("; allowable: {:.4g} mm", *scene.criteria.allowable_slip / mm)
                               : "");
    std::string out =
        !unanswered.empty()
            ? fmt::format("No largest slip over {}: {}. The {} slides {:.4g} mm by finite elements in {}",
                          over.empty() ? "the runs" : over, unanswered, sliding_body(scene), slip / mm,
                          record_of(worst))
        : slip < no_slip ? fmt::format("The {} does not slide in {}", sliding_body(scene),
                                       over.empty() ? record_of(worst) : "any of " + over)
                         : fmt::format("The {} slides {:.4g} mm at most by finite elements{} ({})", sliding_body(scene),
                                       slip / mm, over.empty() ? "" : " over " + over, record_of(worst));
    out += error_text(slip_error(worst));
    if (const LiftSlip lift = largest_lift_slip(runs); lift.slip > no_slip)
        out += fmt::format("; {} {:.4g} mm{}", lift.words, lift.slip / mm,
                           std::isfinite(lift.error) ? fmt::format(" ± {} mm", two_digits(lift.error)) : "");
    if (worst.rigid)
        if (const auto rigid = reported(worst.rigid->status, worst.rigid->max_slip))
            out += fmt::format("; the rigid block {:.4g} mm{}", *rigid / mm, over.empty() ? "" : " in that run");
    if (scene.criteria.allowable_slip)
        out += fmt::format("; allowable: {:.4g} mm", *scene.criteria.allowable_slip / mm);
    if (const double after = factor_after(runs); std::isfinite(after))
        out += fmt::format("; sliding factor after the earthquake {:.3g}", after);
    return out + ".";
}

/// The checks of the combinations that fail; of the sliding factor after the earthquake that of the runs, too.
std::string failed_words(const Scene& scene, const std::vector<ContactRun>& runs,
                         const std::vector<sliding::Equilibrium>& combinations)
{
    std::string words = failed_checks(combinations);
    const Combination after = sliding::after_earthquake(scene);
    const std::optional<double> required = sliding::requirements(scene, after).sliding;
    if (const double factor = factor_after(runs); required && factor < *required)
        words += fmt::format("{}{} by finite elements {}", words.empty() ? "" : "; ", after.name,
                             unmet_words(factor, *required));
    return words;
}

/// A sentence for each run that needs one, in the order of the runs. One self-excited run (the worst, or else the first) explains the
/// cause and the remedy; the sentences of the others give how far the dam slid.
std::vector<std::string> run_sentences(const std::vector<ContactRun>& runs)
{
    const auto by_itself = [](const ContactRun& r) { return r.fe.status == Status::self_excited; };
    const auto first = std::ranges::find_if(runs, by_itself);
    const ContactRun* in_headline = first == runs.end()         ? nullptr
                                    : by_itself(worst_of(runs)) ? &worst_of(runs)
                                                                : &*first;
    std::vector<std::string> sentences;
    for (const ContactRun& r : runs)
        sentences.push_back(by_itself(r) && &r != in_headline
                                ? fmt::format("Self-excited, too: slid at least {:.4g} mm.", 1e3 * std::abs(r.fe.slip))
                                : text_of(r.fe.notes));
    return sentences;
}

/// What a reader has to know beside the slip: runs that fail otherwise, and those without an answer.
std::string remarks(const std::vector<ContactRun>& runs)
{
    std::string out;
    const std::vector<std::string> sentences = run_sentences(runs);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const ContactRun &r = runs[i],
                         *before = i == 0 ? nullptr : &runs[i - 1]; // polarities have their stages in common
        if (falls_after(r)) out += " After the earthquake it does not stand: " + text_of(r.fe.after.notes());
        if (open_after(r)) out += " The state after the earthquake is not resolved: " + text_of(r.fe.after.notes());
        for (const fe2d::LiftResult& lift : r.fe.lifts)
            if (lift.cut_factor < 1.0)
                out += fmt::format(" {}: what is above {} does not stand with full head in its crack after the earthquake, "
                                   "sliding factor {:.3g}.",
                                   r.label(), words_of(lift), lift.cut_factor);
        const bool worst = &r == &worst_of(runs) && !reported(r.fe.status, r.fe.max_slip);
        const bool said = before && before->fe.status == r.fe.status && sentences[i - 1] == sentences[i];
        if (r.fe.status != Status::at_rest && !worst && !said) out += " " + r.label() + ": " + sentences[i];
    }
    return out;
}

Section statics_section(const std::vector<ContactRun>& runs)
{
    return {"Static stages", {rows_part(contact_stage_table(runs))}};
}

std::vector<std::string> after_earthquake(const std::vector<ContactRun>& runs)
{
    std::vector<std::string> list;
    for (const ContactRun& r : runs)
        if (falls_after(r) || open_after(r)) list.push_back(r.label() + ": " + text_of(r.fe.after.notes()));
    return list;
}

/// Slips, friction, opening of the worst run: for the top of the page.
std::vector<std::pair<std::string, std::string>> key_figures(const Scene& scene, const std::vector<ContactRun>& runs)
{
    std::vector<std::pair<std::string, std::string>> list;
    if (runs.empty()) return list;
    const ContactRun& worst = worst_of(runs);
    const auto millimetres = [](Status status, double slip) {
        const std::optional<double> known = reported(status, std::abs(slip));
        return known ? fmt::format("{:.4g} mm", *known / mm) : word(status);
    };
    const std::optional<double> at_least = slid_at_least(worst.fe.status, worst.fe.slip);
    list.emplace_back("Largest slip on the way, FE", at_least ? fmt::format("at least {:.4g} mm", *at_least / mm)
                                                            : millimetres(worst.fe.status, worst.fe.max_slip));
    list.emplace_back("Rock", rock_words(scene));
    list.emplace_back("Worst run", worst.label());
    list.emplace_back("Rigid block, same motion",
                      worst.rigid ? millimetres(worst.rigid->status, worst.rigid->max_slip) : "slides statically");
    if (scene.criteria.allowable_slip)
        list.emplace_back("Allowable slip", fmt::format("{:.4g} mm", *scene.criteria.allowable_slip / mm));
    list.emplace_back("Friction μ", fmt::format("{:.4g}", base_strength(scene).friction));
    if (!worst.fe.stages.empty())
        list.emplace_back("Needs statically μ ≥", fmt::format("{:.4g}", worst.fe.stages.back().critical_friction));
    if (worst.fe.modes > 0) {
        list.emplace_back("Elastic modes", fmt::format("{}", worst.fe.modes));
        return list;
    }
    double open = 0.0;
    for (const ContactRun& r : runs)
        for (const double length : r.fe.history.open_length) open = std::max(open, length);
    list.emplace_back("Largest open length", fmt::format("{:.3g} m", open));
    return list;
}

/// Without the load combinations.
Headline slip_headline(const Scene& scene, const std::vector<ContactRun>& runs)
{
    if (runs.empty()) return {"No earthquake was run.", Outcome::none, "No answer."};
    if (const ContactRun* r = find(runs, [](const ContactRun& run) { return fails_statically(run.fe.status); }))
        return {"The dam has no equilibrium without any earthquake. " + text_of(r->fe.notes), Outcome::fail, "FAIL"};
    const std::optional<double>& allowable = scene.criteria.allowable_slip;
    const std::string cracks = crack_sentence(runs), sentence = slip_sentence(scene, runs) + remarks(runs) + cracks;
    const Verdict verdict = verdict_of(runs, allowable);
    if (verdict == Verdict::fail) return {sentence, Outcome::fail, "FAIL"};
    if (const ContactRun* r = find(runs, [](const ContactRun& run) { return !is_answer(run.fe.status); }))
        return {sentence, Outcome::unresolved, word(r->fe.status)};
    if (find(runs, open_after)) return {sentence, Outcome::unresolved, word(Status::not_resolved)};
    if (!allowable) return {sentence, Outcome::none, "No criterion for the slip."};
    if (verdict == Verdict::pass && cracks.empty()) return {sentence, Outcome::pass, "PASS"};
    if (verdict == Verdict::pass)
        return {sentence, Outcome::pass,
                runs.front().unsettled_cracks.empty() ? "PASS, cracking not modelled" : "PASS, the path of a crack not settled"};
    if (find(runs, [](const ContactRun& run) { return run.leaves_out; }))
        return {sentence, Outcome::unresolved, "undecided: they leave out what the scene asks for, see the notes"};
    const bool known = !find(runs, [](const ContactRun& run) { return std::isnan(slip_error(run).total); });
    return {sentence, Outcome::unresolved, known ? "undecided within ±" : "undecided: the error is not known"};
}

/// What the page, and the answer, of contact runs begin from.
FePageFrame contact_frame(const FeReport::Input& in, const std::vector<ContactRun>& runs)
{
    const std::string modes =
        in.reduced ? fmt::format(" on {} elastic modes of the dam", runs.empty() ? 0 : runs.front().fe.modes) : "";
    return {.scene = in.scene,
            .plan = in.plan,
            .records = in.records,
            .model = in.model.model(),
            .water = in.model.water() ? &in.model.water()->water : nullptr,
            .uplift = in.uplift,
            .kind = "finite elements with contact" + modes,
            .method = fmt::format("plane-strain finite elements, {} unknowns, {} contact pairs{}; rigid block for "
                                  "comparison with events located exactly",
                                  in.model.model().dofs.count, in.model.structure().pairs(),
                                  in.reduced ? "; earthquake" + modes + ", static stages by the full model" : ""),
            .reduced = in.reduced};
}

} // namespace

Headline fe_headline(const Scene& scene, const std::vector<ContactRun>& runs,
                     const std::vector<sliding::Equilibrium>& combinations)
{
    return with_failed_checks(slip_headline(scene, runs), failed_words(scene, runs, combinations));
}

FeReport::FeReport(const Input& input) : in_(input), stresses_(stress_view(input.model)) {}

void FeReport::add(const ContactRun& run, const GroundMotion& motion)
{
    if (motions_.empty() || motions_.back().name != motion.name) motions_.push_back(motion); // once for both polarities
    const std::size_t number = sections_.size() + 1;
    Section section{"Record " + run.label()};
    if (!run.fe.notes.empty()) section.parts.push_back(Paragraph{text_of(run.fe.notes)});
    const bool of_pairs = run.fe.history.by_pair.pairs > 0;
    if (run.fe.history.time.size() < 2 || (!of_pairs && run.fe.modes == 0)) {
        sections_.push_back(std::move(section));
        return;
    }
    std::optional<sliding::SlideResult> rigid;
    if (in_.rigid.state == sliding::StaticState::at_rest)
        rigid = slide_model(in_.scene, in_.rigid, motion, 1, sliding::HistoryOutput::samples);
    const RunView view{run, rigid ? &*rigid : nullptr, in_.scene.criteria.allowable_slip,
                       fmt::format("record{}", number), in_.records.size() * (run.both ? 2 : 1)};
    for (Chart& chart : history_charts(view)) section.parts.emplace_back(std::move(chart));
    if (of_pairs) section.parts.emplace_back(base_states(view));
    if (of_pairs)
        for (Chart& chart : base_charts(view)) section.parts.emplace_back(std::move(chart));
    if (auto chart = bond_chart(view, in_.scene)) section.parts.emplace_back(std::move(*chart));
    if (auto chart = base_water_chart(view)) section.parts.emplace_back(std::move(*chart));
    sections_.push_back(std::move(section));
    if (of_pairs && stress_records_ < stress_records) {
        ++stress_records_;
        add_stresses(in_.model, run.label(), run.fe, stresses_);
    }
}

Page FeReport::page(const std::vector<ContactRun>& runs, const std::vector<std::string>& messages,
                    const std::string& spread) const
{
    const FePageFrame frame = contact_frame(in_, runs);
    Page page = begin_fe_page(frame);
    page.headline = fe_headline(in_.scene, runs, in_.combinations);
    page.key_figures = key_figures(in_.scene, runs);
    std::vector<std::string> warnings = messages;
    for (std::string& w : after_earthquake(runs)) warnings.push_back(std::move(w));
    page.warnings.insert(page.warnings.begin(), warnings.begin(), warnings.end());

    const std::optional<double>& allowable = in_.scene.criteria.allowable_slip;
    Section slip{"Slip"};
    for (Table& table : std::vector{run_answer_table(runs, allowable), contact_slip_table(runs), run_out_table(runs),
                                    crack_table(runs), contact_event_table(runs), contact_lift_table(runs, allowable),
                                    traced_table(in_.traced, in_.scene), bond_table(runs), contact_anchor_table(runs), base_water_table(in_.scene, runs)})
        if (!table.rows.empty()) slip.parts.push_back(rows_part(std::move(table)));
    if (!spread.empty()) slip.parts.push_back(Paragraph{spread});
    const bool slides = find(runs, [](const ContactRun& r) { return std::abs(r.fe.max_slip) >= no_slip; });
    if (!slides) page.sections.push_back(statics_section(runs));
    page.sections.push_back(std::move(slip));
    if (slides) page.sections.push_back(statics_section(runs));
    if (!stresses_.states.empty()) {
        MeshView view = stresses_;
        if (sections_.size() > stress_records_)
            view.note += fmt::format(" The first {} of {} runs.", stress_records_, sections_.size());
        page.sections.push_back({"Stresses", {std::move(view)}});
    }
    std::vector<Section> appendix = add_worse_polarities(runs, sections_, page);
    std::vector<Table> how{run_solution_table(runs, false), contact_law_table(runs), joint_flow_table(runs),
                           contact_energy_table(runs), contact_count_table(runs)};
    std::erase_if(how, [](const Table& table) { return table.rows.empty(); });
    end_fe_page(frame, motions_, how, page);
    std::move(appendix.begin(), appendix.end(), std::back_inserter(page.sections));
    order_sections(in_.scene.criteria.report_order, page);
    return page;
}

// The answer of contact runs: one JSON object, text, and the files of each run.

namespace {

/// CSV files of one run, and its fields.
void write_run(const std::filesystem::path& folder, const FeReport::Input& in, const ContactRun& r)
{
    const auto write = [&](const std::string& kind, const Table& table, const std::string& legend = {}) {
        std::vector<std::string> comments{"damslip " + program_version() + " fe", "scene " + in.plan.scene_hash,
                                          "record " + r.label(), "status " + word(r.fe.status)};
        if (!legend.empty()) comments.push_back(legend);
        write_file(folder / (run_file(kind, in.scene, r.record, r.suffix()) + ".csv"), csv(table, comments));
    };
    const std::string letters = "states: s sticks, d slips downstream, u slips upstream, o open, p pulled",
                      signs = "pressure: effective, compression positive; shear: on the dam, positive where it resists "
                              "downstream slip; slip positive downstream";
    write("history", contact_history_table(r.fe.history));
    if (r.fe.history.by_pair.pairs == 0) return;
    write("base", base_table(r.fe), signs);
    write("contact", pair_table(r.fe), signs + "; " + letters);
    write("states", state_map(r.fe.history), letters);
}

/// Values of the pairs on the dam's contact nodes, zero elsewhere.
std::vector<fe2d::VtuArray> contact_arrays(const fe2d::Mesh& mesh, const fe2d::RunResult& r)
{
    const auto on_nodes = [&](const std::string& name, const Eigen::VectorXd& values) {
        Eigen::MatrixXd at = Eigen::MatrixXd::Zero(1, static_cast<Eigen::Index>(mesh.nodes.size()));
        for (Eigen::Index i = 0; i < values.size(); ++i)
            at(0, mesh.contact.dam_nodes[static_cast<std::size_t>(i)]) = values[i];
        return fe2d::VtuArray{name, at};
    };
    return {on_nodes("contact_pressure_Pa", r.pair_pressure), on_nodes("contact_shear_Pa", r.pair_shear),
            on_nodes("contact_slip_m", r.pair_slip), on_nodes("contact_opening_m", r.pair_opening)};
}

} // namespace

void keep_contact_run(const std::filesystem::path& folder, const FeReport::Input& in, const ContactRun& r,
                      FieldSeries& fields)
{
    if (!folder.empty()) write_run(folder, in, r);
    if (r.fe.displacement.size() == 0) return;
    Eigen::VectorXd elastic = r.fe.displacement; // gravity's part carries stress where it does not count as motion
    if (r.fe.zero_displacement.size() > 0) elastic += r.fe.zero_displacement;
    fields.add(r.record + r.suffix() + "_end", r.fe.end_time, r.fe.displacement, elastic,
               contact_arrays(in.model.model().mesh, r.fe));
}

/// Of a run that came to rest but moved on after the record.
std::string walked_sentence(double slip, const fe2d::RunOutFigures& f)
{
    const std::vector<Note> lift_offs = fe2d::lift_off_notes(f);
    return fmt::format("{:.3g} mm of the slip of {:.4g} mm came after the record, with the ground at rest: it may be "
                       "the model that goes on sliding (docs/fe-contact.md, A dam that goes on sliding).{}{}",
                       1e3 * std::abs(f.slip_at_rest), 1e3 * std::abs(slip), lift_offs.empty() ? "" : " ",
                       text_of(lift_offs));
}

void add_run_messages(const std::vector<ContactRun>& runs, std::vector<std::string>& messages)
{
    const std::vector<std::string> sentences = run_sentences(runs);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const ContactRun& r = runs[i];
        if (r.fe.status != Status::at_rest) messages.push_back(r.label() + ": " + sentences[i]);
        if (has_slip(r) && r.fe.run_out.ratchets())
            messages.push_back(r.label() + ": " + walked_sentence(r.fe.slip, r.fe.run_out));
        for (const AnchorOutcome& anchor : r.fe.anchors)
            if (anchor.history.snapped_at)
                messages.push_back(
                    fmt::format("{}: {} snapped at {:.4g} s.", r.label(), anchor.name, *anchor.history.snapped_at));
    }
}

std::vector<std::string> contact_messages(const Scene& scene, const std::vector<ContactRun>& runs,
                                          const std::vector<std::string>& of_rock)
{
    std::vector<std::string> messages; // the rigid base first, then what is unusual in the scene
    if (const std::optional<std::string> note = base_note(scene)) messages.push_back(*note);
    for (std::string& note : note_texts(scene.notes)) messages.push_back(std::move(note));
    for (std::string& note : contact_law_notes(scene)) messages.push_back(std::move(note));
    messages.insert(messages.end(), of_rock.begin(), of_rock.end());
    if (scene.reservoir && scene.reservoir->model == ReservoirModel::acoustic)
        for (std::string& warning : reservoir_warnings(scene, 20.0)) messages.push_back(std::move(warning));
    for (std::string& note : base_water_notes(scene, runs)) messages.push_back(std::move(note));
    add_run_messages(runs, messages);
    return messages;
}

std::vector<std::string> bond_messages(const Scene& scene, const fe2d::Mesh& mesh)
{
    std::vector<std::string> messages;
    const std::vector<LiftJoint> joints = joints_of(scene);
    for (std::size_t k = scene.mesh.file ? 0 : 1; k <= mesh.lifts.size(); ++k) {
        const bool base = k == 0;
        const LiftJoint* lift = base ? nullptr : &joints[k - 1];
        const Contact& strength = base ? scene.contact : lift->strength;
        const fe2d::NodeChain& nodes = base ? mesh.contact.dam_nodes : mesh.lifts[k - 1].upper_nodes;
        const auto modulus = joint_modulus(scene, base);
        if (!modulus || !breaks_by_energy(strength) || nodes.size() < 2) continue;
        const Point &from = mesh.nodes[static_cast<std::size_t>(nodes.front())],
                    &to = mesh.nodes[static_cast<std::size_t>(nodes.back())];
        const double length = std::hypot(to.x - from.x, to.y - from.y) / static_cast<double>(nodes.size() - 1);
        const CarriedBond carried = carried_bond(strength, *modulus, length);
        if (!carried.lowered) continue;
        messages.push_back(fmt::format(
            "{}: elements of {:.3g} m are longer than a quarter of the bond's process zone; FE runs with tensile "
            "strength {:.4g} kPa and cohesion {:.4g} kPa, fracture energies kept. Elements of at most {:.3g} m carry "
            "the "
            "whole bond (E' G/(4 f^2), Bazant & Oh 1983): {}.",
            base                 ? std::string("base")
            : lift->name.empty() ? fmt::format("lift joint {}", k)
                                 : lift->name,
            length, 1e-3 * carried.tensile_strength, 1e-3 * carried.cohesion, bond_element_length(strength, *modulus),
            scene.mesh.file ? "give a finer mesh" : "give a mesh.size_m of about that"));
    }
    return messages;
}

void add_points(const Scene& scene, const std::vector<ContactRun>& runs, Answer& answer, const std::string& name)
{
    answer.next(fmt::format("damslip assess {}", scene.file.string()));
    if (runs.empty()) return;
    const ContactRun& worst = worst_of(runs);
    const SlipError error = slip_error(worst);
    std::string governs = record_of(worst);
    if (const auto& open = worst.fe.history.open_length; !open.empty())
        governs += fmt::format("; {:.3g} m of the base open at most", *std::ranges::max_element(open));
    if (!worst.fe.stages.empty())
        governs += fmt::format("; without earthquake it needs a friction of {:.3g}, given {:.3g}",
                               worst.fe.stages.back().critical_friction, base_strength(scene).friction);
    if (const ContactRun* most = most_tensioned(runs)) governs += "; concrete " + crack_words(*most);
    answer.point(name, governs);
    constexpr double wide = 0.1; // of the slip
    if (error.total > wide * std::abs(worst.fe.max_slip))
        answer.point("look at", error.mesh > error.step
                                    ? "the ±, most of it the mesh's: a smaller mesh.size_m"
                                    : "the ±, most of it the step's: a smaller time.slip_tolerance");
}

namespace {

/// The worst run by record and polarity, with its status, slip, error and verdict; null without runs.
nlohmann::ordered_json worst_json(const std::vector<ContactRun>& runs, const std::optional<double>& allowable)
{
    if (runs.empty()) return nullptr;
    const ContactRun& worst = worst_of(runs);
    const std::optional<double> at_least = slid_at_least(worst.fe.status, worst.fe.slip);
    const auto number = [&](double metres, double unit) {
        const std::optional<double> known = reported(worst.fe.status, metres);
        return known ? nlohmann::ordered_json(*known / unit) : nlohmann::ordered_json();
    };
    return {{"record", worst.record},
            {"polarity", worst.polarity},
            {"status", word(worst.fe.status)},
            {"max_slip_m", number(worst.fe.max_slip, 1.0)},
            {"walked_at_least_m", at_least ? nlohmann::ordered_json(*at_least) : nlohmann::ordered_json()},
            {"total_error_mm", number(slip_error(worst).total, units::mm)},
            {"verdict", word(verdict_of(worst, allowable))}};
}

} // namespace

Answer contact_answer(const FeReport::Input& in, const std::vector<ContactRun>& runs,
                      const std::vector<std::string>& messages, const std::string& spread)
{
    const std::optional<double>& allowable = in.scene.criteria.allowable_slip;
    const fe2d::RayleighConstants& damping = in.model.damping();
    const Eigen::Index pairs = in.model.structure().pairs();
    const Headline headline = fe_headline(in.scene, runs, in.combinations);
    Answer answer = begin_fe_answer(contact_frame(in, runs));
    answer += fmt::format("  {} contact pairs; damping a_M = {:.5g} 1/s, b_K = {:.5g} s\n  {}\n\n", pairs, damping.mass,
                          damping.stiffness, rock_line(in.scene, in.model));
    nlohmann::ordered_json paths; ///< by the name of the crack: points from the upstream face on
    answer.set("contact_pairs", pairs);
    answer.set("damping", {{"mass_coefficient_1_s", damping.mass}, {"stiffness_coefficient_s", damping.stiffness}});
    answer.set("rock", rock_json(in.scene, in.model));
    answer.add("stages", contact_stage_table(runs));
    answer.add("runs", contact_run_table(runs, allowable), {.text = false});
    answer.add("answer", run_answer_table(runs, allowable), {.brief = true, .data = false});
    const auto add_known = [&](const std::string& id, Table table, Places places = {}) {
        if (!table.rows.empty()) answer.add(id, std::move(table), places);
    };
    add_known("events", contact_event_table(runs));
    answer.add("solution", run_solution_table(runs, true), {.data = false});
    answer.add("slip", contact_slip_table(runs));
    answer.add("run_out", run_out_table(runs));
    answer.add("cracking", crack_table(runs));
    if (!joints_of(in.scene).empty()) answer.add("lift_joints", contact_lift_table(runs, allowable), {.brief = true});
    add_known("traced_cracks", traced_table(in.traced, in.scene), {.brief = true});
    for (const TracedCrack& crack : in.traced)
        for (const LiftJoint& joint : in.scene.lift_joints)
            if (joint.name == crack.name) {
                nlohmann::ordered_json path = nlohmann::ordered_json::array();
                for (const Point& p : joint.path) path.push_back({p.x, p.y});
                paths[crack.name] = std::move(path);
            }
    if (!paths.empty()) answer.set("crack_paths_m", paths);
    add_known("cracks", bond_table(runs));
    if (!in.scene.anchors.empty()) answer.add("anchors", contact_anchor_table(runs));
    answer.add("counts", contact_count_table(runs), {.text = false});
    answer.add("energy", contact_energy_table(runs), {.text = false});
    add_known("base_water", base_water_table(in.scene, runs));
    add_known("joint_flow", joint_flow_table(runs));
    if (with_exact_contact(in.scene)) answer.add("contact_law", contact_law_table(runs));
    answer.headline(headline);
    answer += spread.empty() ? "" : spread + "\n";
    answer.point("", spread);
    add_points(in.scene, runs, answer);
    answer.set("headline", headline.sentence);
    answer.set("verdict", word(joined_verdict(headline, runs, allowable)));
    answer.set("worst", worst_json(runs, allowable));
    answer.set("model_spread", spread);
    answer.notes("messages", messages);
    return answer;
}

} // namespace damslip::pages
