#include "verification/pages/manual.hpp"

#include "core/file.hpp"
#include "core/version.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>

namespace damslip::pages {

namespace {

using verification::Check;

/// Figures that others printed: modes, factors, slips, coefficients.
const std::set<std::string>& published_cases()
{
    static const std::set<std::string> ids{
        "sliding.empirical.values",     "sliding.equilibrium.reference-dam", "sliding.neighbours.plane-failure",
        "sliding.neighbours.wedge-modes", "sliding.neighbours.wedge-example", "fe.static.cooks-membrane",
        "fe.quadratic.cooks-membrane",  "fe.quadratic.frequencies",          "fe.modes.tapered-membrane",
        "fe.modes.reference-dam",       "fe.modes.koyna",                    "fe.modes.pine-flat",
        "fe2d.fluid.reference-modes",   "fe2d.rock.radiating-pine-flat",     "fe2d.seepage.thesis-dam",
        "fe2d.damping.rayleigh",        "probability.philox",                "probability.ishigami"};
    return ids;
}

/// Another module, mesh, step or scheme of the program itself.
const std::set<std::string>& own_cases()
{
    static const std::set<std::string> ids{"sliding.equilibrium.yield-is-limit-equilibrium",
                                           "sliding.equilibrium.scaling",
                                           "sliding.equilibrium.mirror",
                                           "sliding.block.sequence",
                                           "sliding.block.broad-band",
                                           "sliding.rocking.slides-like-the-block",
                                           "sliding.neighbours.flexible-impulses",
                                           "sliding.neighbours.flexible-decoupled",
                                           "sliding.neighbours.wedge-vertical-motion",
                                           "sliding.planes.base",
                                           "fe.run.sequence",
                                           "fe.anchor.slider-with-bar",
                                           "fe.contact.rigid-limit-undamped",
                                           "fe.contact.rigid-limit-damped",
                                           "fe.contact.incline",
                                           "fe.contact.explicit-rigid-base",
                                           "fe.contact.moreau-rock",
                                           "fe.contact.moreau-rigid-base",
                                           "fe.quadratic.sliding-dam",
                                           "fe.quadratic.rigid-limit",
                                           "fe.mesh.imported-frequency",
                                           "fe.modes.squat-wall",
                                           "fe.reduction.slip",
                                           "fe.sliding.penalty-to-exact",
                                           "fe.sliding.hardest-steps-by-lemke",
                                           "fe.sliding.order-in-step",
                                           "fe2d.time.modal-dam",
                                           "fe2d.time.modal-truncation",
                                           "fe2d.time.central-difference-dam",
                                           "fe2d.fluid.symmetric-form",
                                           "fe2d.fluid.energy",
                                           "fe2d.fluid.time-against-frequency",
                                           "fe2d.radiating.size-of-the-box",
                                           "fe2d.radiating.large-box",
                                           "fe2d.radiating.reduction",
                                           "fe2d.radiating.ground-at-rest",
                                           "fe2d.radiating.everywhere",
                                           "fe2d.rock.radiating-tied",
                                           "fe2d.rock.radiating-transfer",
                                           "fe2d.rock.radiating-energy",
                                           "fe2d.rock.massless-limit",
                                           "fe2d.rock.schemes",
                                           "fe2d.rock.size-of-the-box",
                                           "fe2d.rock.floor-box",
                                           "fe2d.rock.floor-limits",
                                           "fe2d.rock.floor-energy",
                                           "probability.missing",
                                           "probability.same-bits"};
    return ids;
}

bool all_pass(const CaseOutcome& o)
{
    return std::all_of(o.checks.begin(), o.checks.end(), [](const Check& c) { return c.passed(); });
}

Table class_table(const std::vector<CaseOutcome>& outcomes, const std::vector<HardOutcome>& hard,
                  const std::vector<SourceOutcome>& external)
{
    struct Row {
        std::string basis;
        std::size_t cases = 0, numbers = 0, outside = 0;
    };
    std::vector<Row> rows;
    for (const Basis basis : {Basis::closed, Basis::published, Basis::own}) {
        Row row{word(basis)};
        for (const CaseOutcome& o : outcomes) {
            if (basis_of(*o.subject) != basis) continue;
            ++row.cases;
            row.numbers += o.checks.size();
            for (const Check& c : o.checks) row.outside += !c.passed();
        }
        rows.push_back(row);
    }
    Row two{"two methods on a scene that is hard to compute"};
    for (const HardOutcome& o : hard) ++two.cases, ++two.numbers, two.outside += !o.passed();
    rows.push_back(two);
    for (const SourceOutcome& s : external) {
        if (s.results.empty()) continue; // its folder is not at hand
        const std::string& id = s.subject->id;
        const char* const kind = id == "slammer" ? "another program: " : id == "rea-liaw-chopra-1972" ? "measured on a dam: " : "published: ";
        Row row{kind + id, 1, s.results.size()};
        for (const external::Result& r : s.results) row.outside += !r.within();
        rows.push_back(row);
    }
    return table_of<Row>("What it rests on",
                         {{{"basis", "basis"}, &Row::basis},
                          {{"cases", "cases"}, [](const Row& r) { return count_cell(r.cases); }},
                          {{"numbers", "numbers"}, [](const Row& r) { return count_cell(r.numbers); }},
                          {{"outside", "outside"}, [](const Row& r) { return count_cell(r.outside); }}},
                         rows);
}

Table case_table(const std::vector<CaseOutcome>& outcomes)
{
    using O = CaseOutcome;
    return table_of<O>("All cases",
                       {{{"case", "case"}, [](const O& o) { return o.subject->id; }},
                        {{"claim", "claim"}, [](const O& o) { return o.subject->claim; }},
                        {{"basis", "basis"}, [](const O& o) { return word(basis_of(*o.subject)); }},
                        {{"source", "source"}, [](const O& o) { return o.subject->source; }},
                        {{"numbers", "numbers"}, [](const O& o) { return count_cell(o.checks.size()); }},
                        {{"verdict", "verdict"}, [](const O& o) { return all_pass(o) ? "PASS" : "FAIL"; }}},
                       outcomes);
}

/// Reference and tolerance, without any value of ours.
Table reference_table(const CaseOutcome& o)
{
    return table_of<Check>("",
                           {{{"quantity", "quantity"}, &Check::quantity},
                            {{"unit", "unit"}, &Check::unit},
                            {{"reference", "reference", "", 7}, &Check::expected},
                            {{"allowed", "allowed"}, &tolerance_text},
                            {{"verdict", "verdict"}, [](const Check& c) { return c.passed() ? "PASS" : "FAIL"; }}},
                           o.checks);
}

std::string sentence(const char* name, std::string text)
{
    if (!text.ends_with('.')) text += '.';
    return name + (": " + text);
}

Section sheet(const CaseOutcome& o)
{
    return {o.subject->id,
            {Paragraph{o.subject->claim}, Paragraph{sentence("Source", o.subject->source)},
             Paragraph{sentence("Tolerance", o.subject->tolerance)}, rows_part(reference_table(o))}};
}

} // namespace

Basis basis_of(const verification::Case& subject)
{
    return published_cases().contains(subject.id) ? Basis::published : own_cases().contains(subject.id) ? Basis::own : Basis::closed;
}

const char* word(Basis basis)
{
    return basis == Basis::closed ? "closed form" : basis == Basis::published ? "published figure" : "another method of our own";
}

const std::vector<std::string>& cases_with_sheet()
{
    static const std::vector<std::string> ids{
        "sliding.block.pulses",       "sliding.block.sines",         "sliding.block.vertical",     "sliding.block.inclined",
        "sliding.equilibrium.reference-dam", "sliding.equilibrium.crack", "sliding.planes.seam",   "sliding.planes.lifts",
        "sliding.rocking.free-period", "sliding.empirical.values",   "fe.element.patch-test",      "fe.static.cooks-membrane",
        "fe.modes.koyna",             "fe.modes.pine-flat",          "fe2d.fluid.frequency-response", "fe2d.radiating.half-plane",
        "fe.contact.rigid-limit-undamped", "fe.contact.coulomb-oscillator", "fe2d.bond.bar",      "fe2d.seepage.sheet-pile"};
    return ids;
}

std::string record_digest(const std::vector<CaseOutcome>& outcomes)
{
    std::string record;
    for (const CaseOutcome& o : outcomes)
        for (const Check& c : o.checks)
            record += fmt::format("{}\t{}\t{}\t{:.6g}\t{:.6g}\t{}\t{}\n", o.subject->id, c.quantity, c.unit, c.expected, c.tolerance,
                                  static_cast<int>(c.measure), c.passed() ? "pass" : "fail");
    return sha256(record);
}

Page manual_page(const std::vector<CaseOutcome>& outcomes, const std::vector<HardOutcome>& hard,
                 const std::vector<SourceOutcome>& external, const std::string& errata)
{
    Page page;
    page.title = "Verification manual of damslip " + program_version();
    page.subtitle = "What the program is held against. References and tolerances first, the values of this build at the end.";
    std::size_t checks = 0, failed = 0;
    for (const CaseOutcome& o : outcomes)
        for (const Check& c : o.checks) ++checks, failed += !c.passed();
    for (const HardOutcome& o : hard) failed += !o.passed();
    const std::string digest = record_digest(outcomes);
    const bool of_release = digest == program_verification();
    page.headline = {fmt::format("{} cases with {} numbers and {} hard scenes: {}. {}", outcomes.size(), checks, hard.size(),
                                 failed == 0 ? "all within their tolerances" : fmt::format("{} outside their tolerance", failed),
                                 of_release ? "The record is that of the release, which every report of it names."
                                            : "The record is not that of the release."),
                     failed == 0 && of_release ? Outcome::pass : Outcome::fail, failed == 0 && of_release ? "PASS" : "FAIL"};
    page.footer = "verification record " + digest.substr(0, 16);
    page.sections.push_back({"What it rests on",
                             {rows_part(class_table(outcomes, hard, external)),
                              Paragraph{"Closed form: derived by hand or integrated independently. Published: printed by others. Another method of "
                                        "our own: a second module, mesh, step or scheme of this program, which shows that two codes agree and no more."}}});
    page.sections.push_back({"All cases", {rows_part(case_table(outcomes))}});
    for (const std::string& id : cases_with_sheet())
        for (const CaseOutcome& o : outcomes)
            if (o.subject->id == id) page.sections.push_back(sheet(o));
    page.sections.push_back({"Scenes that are hard to compute", {rows_part(hard_table(hard))}});
    page.sections.push_back({"Results of others", {rows_part(evidence_table(external)), rows_part(missed_table(external))}});
    page.sections.push_back({"Errata", {Listing{"ERRATA.md", errata}}});
    page.sections.push_back({"Values of this build", {Paragraph{"Kept apart from the references, so that a later build can be held against them."},
                                                      rows_part(check_table(outcomes))}});
    page.provenance = {{"version", program_version()}, {"verification record", digest}, {"record of the release", program_verification()}};
    return page;
}

} // namespace damslip::pages
