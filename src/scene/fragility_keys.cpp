#include "core/intensity_measure.hpp"
#include "scene/keys.hpp"

namespace damslip {

namespace {

using namespace keys;

const Range positive = Range::above(0);

Key number_key(std::string name, Range range, std::string default_text, std::string meaning, std::string example,
               ValueKind kind = ValueKind::number)
{
    return number(std::move(name), none, range, std::move(default_text), std::move(meaning), std::move(example),
                  {kind});
}

/// Of several words; the first one is the default.
Key word_key(std::string name, std::vector<std::string> words, std::string meaning)
{
    std::string first = words.front(), example = "\"" + words.back() + "\"";
    return word(std::move(name), std::move(first), std::move(meaning), std::move(example),
                {ValueKind::word, {}, std::move(words)});
}

Key flag_key(std::string name, std::string meaning)
{
    return word(std::move(name), "false", std::move(meaning), "true", {ValueKind::flag});
}

Key law_key(std::string name, std::vector<LawNumber> numbers, std::string meaning, std::string example)
{
    Key key = word(std::move(name), "", std::move(meaning), std::move(example), {ValueKind::law});
    key.numbers = std::move(numbers);
    return key;
}

std::vector<Key> law_rows()
{
    const LawNumber low{"min"}, high{"max"}, from{"min", true}, to{"max", true};
    return {
        law_key(
            "lognormal",
            {{"median", false, true}, {"beta", false, true}, {"mean", false, true}, {"cov", false, true}, low, high},
            "law: median and beta, the standard deviation of ln x; or mean and cov, the coefficient of variation. "
            "min, max: the law on the condition that it lies between",
            "{ median = 0.77, beta = 0.15 }"),
        law_key("normal", {{"mean", true}, {"sd", true, true}, low, high},
                "law: mean and standard deviation; min, max as above", "{ mean = 2400, sd = 30 }"),
        law_key("uniform", {from, to}, "law: every number from min to max alike", "{ min = 0.6, max = 1.0 }"),
        law_key("triangular", {from, {"mode", true}, to}, "law: least, likeliest, largest",
                "{ min = 0.6, mode = 0.77, max = 1.0 }"),
        law_key("beta", {{"a", true, true}, {"b", true, true}, from, to},
                "law: exponents a and b of the beta distribution, spread from min to max",
                "{ a = 2, b = 3, min = 0.6, max = 1.0 }"),
        word("discrete", "",
             "law: one of these values (numbers, words of the choice, true, false) by its weight: a logic tree",
             "{ values = [\"seepage\", \"linear\"], weights = [0.6, 0.4] }", {ValueKind::discrete})};
}

KeyGroup variable_table()
{
    return {"probability.variable", Presence::list,
            "One thing that is not known, and its law: one of lognormal, normal, uniform, triangular, beta, discrete.",
            joined({{word("name", "the first key", "draws depend on it: another name, other draws", "\"mu\"",
                          {ValueKind::text}),
                     word("key", "required",
                          "number or choice of the scene in the unit of its spelling, lift_joint[NAME].friction of a "
                          "list; several keys in brackets take the same draw",
                          "\"contact.friction\"", {ValueKind::text_or_list}),
                     flag_key("factor", "true: the draw multiplies the number of the file"),
                     word_key("kind", {"aleatory", "epistemic"},
                              "aleatory: differs from earthquake to earthquake, makes P; epistemic: has one value that "
                              "is not known, makes the band of P")},
                    law_rows()})};
}

KeyGroup intensity_table()
{
    KeyGroup table{
        "intensity",
        Presence::optional,
        "How strong the shaking is. `fragility` needs it, with one list of levels.",
        {word("measure", "PGA", std::string(known_intensities), "\"SA(T1)\"", {ValueKind::text}),
         word_key(
             "component", {"as-used", "geomean"},
             "as-used: of the component that shakes the dam; geomean: geometric mean of both horizontal ones, as most "
             "hazard curves define it"),
         word_key(
             "design", {"stripes", "ida", "cloud"},
             "stripes: draws of their own at each level; ida: the same at all levels; cloud: records as they are")}};
    for (const auto& [name, meaning] : {std::pair{"levels_g", "ascending; of PGA, SA, avgSA"},
                                        {"levels_m_s2", "the same in m/s2"},
                                        {"levels_m_s", "ascending; of PGV, IA, CAV"},
                                        {"levels_cm_s", "the same in cm/s"}})
        table.keys.push_back(number_key(name, positive, "", meaning, "[0.1, 0.2, 0.4]", ValueKind::numbers));
    return table;
}

std::vector<KeyGroup> make_tables()
{
    std::vector<KeyGroup> tables;
    tables.push_back(
        {"probability",
         Presence::optional,
         "How `damslip fragility` draws. Other commands check the tables of a fragility, and compute nothing with "
         "them.",
         {number_key("seed", Range::between(0, 0x1p62), "1", "of all draws: the same seed, the same numbers", "1",
                     ValueKind::whole),
          word_key("sampling", {"sobol", "lhs", "random"}, "points of a sample; lhs: Latin hypercube"),
          number_key("replicates", Range::between(1, 10'000), "16",
                     "samples, each randomised by itself: their spread is the error", "8", ValueKind::whole),
          number_key("samples", Range::between(1, 100'000'000), "by --samples or --budget",
                     "draws of each replicate and epistemic draw", "64", ValueKind::whole),
          word_key("static_failure", {"infinite", "given-standing"},
                   "a draw whose dam does not stand without an earthquake: its slip is infinite; or it is left out, "
                   "since the dam stands today. Its share is printed")}});
    tables.push_back(variable_table());
    tables.push_back({"probability.correlation",
                      Presence::list,
                      "Two variables of one kind that go together (Gaussian copula).",
                      {word("between", "required", "names of two variables", "[\"mu\", \"c\"]", {ValueKind::names}),
                       number_key("spearman", Range::inside(-1, 1), "required", "their rank correlation", "-0.3")}});
    tables.push_back(
        {"suite",
         Presence::optional,
         "The records of a fragility; without it those of [motion].",
         {word("files", "those of [motion]",
               "folder, pattern, CSV with horizontal, vertical, other_horizontal, column, vertical_column, event, "
               "weight, magnitude, scale, or CSV of seeds with name, seed, pga_m_s2, target, whose records are made; "
               "from the folder of the scene",
               "\"suite/*.AT2\"", {ValueKind::text}),
          word_key("draw", {"balanced", "with-replacement"},
                   "balanced: each record as often as its weight says; with-replacement: by chance"),
          word_key("polarity", {"both", "as-recorded", "reversed"}, "of the horizontal component"),
          number_key("max_scale", positive, "4", "largest factor on a record; larger ones are refused", "4"),
          flag_key("allow_scaling", "true: factors beyond max_scale are used, and listed")}});
    tables.push_back(intensity_table());
    tables.push_back({"limit",
                      Presence::list,
                      "What is too much: a curve for each. `fragility` needs one at least, with one of the lengths.",
                      {word_key("quantity", {"slip", "largest-slip", "lift-off", "post-seismic-fs"},
                                "slip at the end, or largest on the way; of finite elements: largest opening of the "
                                "base, sliding factor after the earthquake"),
                       word("plane", "base",
                            "of a rigid block: the plane that slides, by name (a [[seam]], \"lift at 30 m\"), or any: "
                            "the one that slides furthest; the same in all limits",
                            "\"any\"", {ValueKind::text}),
                       number_key("below", positive, "", "of post-seismic-fs: too little below it", "1.1"),
                       number_key("above_mm", Range::at_least(0), "", "too much above it", "50"),
                       number_key("above_cm", Range::at_least(0), "", "the same in cm", "5"),
                       number_key("above_m", Range::at_least(0), "", "the same in m", "0.05")}});
    tables.push_back({"hazard",
                      Presence::optional,
                      "How often the site shakes how strongly: for rates per year.",
                      {word("curve", "required",
                            "CSV whose heading says measure, unit and kind (pga_g,annual_rate; poe_50_years; "
                            "return_period), or an export of OpenQuake or USGS",
                            "\"hazard.csv\"", {ValueKind::text}),
                       number_key("site", Range::between(-180, 360), "the only one",
                                  "longitude and latitude of the curve, where the file has several", "[14.5, 46.05]",
                                  ValueKind::numbers),
                       number_key("all_events", positive, "none",
                                  "annual rate of all events: bounds what lies below the lowest level", "0.5")}});
    return tables;
}

} // namespace

const std::vector<KeyGroup>& fragility_key_tables()
{
    static const std::vector<KeyGroup> tables = make_tables();
    return tables;
}

} // namespace damslip
