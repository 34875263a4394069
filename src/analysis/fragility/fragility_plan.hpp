#pragma once

#include "analysis/prepare/ready.hpp"
#include "probability/distribution.hpp"
#include "scene/fragility_input.hpp"

#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

namespace damslip {

/// Entries by their place: made by a rule each time they are asked for, or held. With a rule a list of a million takes no more memory than one of ten.
template <class Entry>
class PlannedList {
public:
    using Rule = std::function<Entry(std::size_t)>;

    PlannedList() = default;
    PlannedList(std::vector<Entry> held) : size_(held.size()), held_(std::move(held)) {}
    /// @param rule  the entry of a place 0 ... size - 1, always the same; from any thread
    PlannedList(std::size_t size, Rule rule) : size_(size), rule_(std::move(rule)) {}

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    Entry operator[](std::size_t place) const { return rule_ ? rule_(place) : held_[place]; }
    void push_back(Entry entry) ///< @pre no rule
    {
        held_.push_back(std::move(entry));
        size_ = held_.size();
    }
    void clear() { *this = PlannedList(); }

    class Iterator {
    public:
        using iterator_category = std::input_iterator_tag;
        using value_type = Entry;
        using difference_type = std::ptrdiff_t;
        using pointer = const Entry*;
        using reference = Entry;

        Iterator(const PlannedList& list, std::size_t place) : list_(&list), place_(place) {}
        Entry operator*() const { return (*list_)[place_]; }
        Iterator& operator++()
        {
            ++place_;
            return *this;
        }
        friend bool operator==(const Iterator& a, const Iterator& b) { return a.place_ == b.place_; }

    private:
        const PlannedList* list_;
        std::size_t place_;
    };
    Iterator begin() const { return {*this, 0}; }
    Iterator end() const { return {*this, size_}; }

private:
    std::size_t size_ = 0;
    Rule rule_;
    std::vector<Entry> held_;
};

/// Records that shake the dam, and what is known of each, at one place of all lists.
struct ShakingSuite {
    Records pairs;
    std::vector<std::string> event; ///< the earthquake a record is of: records of one event are no independent samples
    std::vector<double> weight;     ///< > 0, of any sum
    std::vector<double> intensity;  ///< of the motion as the scene scales it; SI, > 0
    std::vector<std::string> notes; ///< what was left out, and what is measured
    std::string made;               ///< records that were made of their seeds for this run, and where; empty: none
    double power = 1.0;             ///< the intensity grows with this power of a factor on the record: 2 of I_A, else 1
};

/// One draw of all variables.
struct FragilityDraw {
    std::vector<KeyValue> values;   ///< in the order of the variables; of a factor the factor
    std::vector<KeyChange> changes; ///< for SceneText::with()
};

/// One run: a draw of the variables, a record, a level.
struct FragilitySample {
    std::size_t draw = 0;      ///< place in FragilityPlan::draws
    std::size_t replicate = 0; ///< 0 ... replicates - 1
    std::size_t outer = 0;     ///< epistemic draw, 0 ... replicates * outer - 1
    std::size_t inner = 0;     ///< aleatory draw of it
    std::size_t level = 0;     ///< place in the levels; of a cloud 0
    std::size_t record = 0;
    int polarity = 1;
    double factor = 1.0; ///< on the record, on top of the scene's
    double x = 0.0;      ///< intensity reached [SI]
    double weight = 1.0; ///< of the record where the whole suite is run, 1 on average; else 1: it is drawn so
};

/// How many runs.
struct FragilitySizes {
    std::size_t samples = 1024; ///< per level and in all replicates together, at least; rounded up to whole blocks
    std::uint32_t stream = 0;   ///< plans with different numbers share no draw
};

/// All runs of a fragility, fixed before the first one. The place of a sample is its id.
///
/// Draws and samples of plan_fragility() are made from their places whenever they are asked for; held are four bytes a run for its record, and of Latin
/// hypercubes and Sobol' points four bytes more for each variable. Other plans hold all of theirs.
///
/// Draws of lack of knowledge (epistemic) are outer, each with the same inner draws of what varies by itself (aleatory) and of records. Inner draws
/// are those of the level (stripes), or the same at all levels (ida). A replicate is independent of all others; the inner draws of a
/// replicate serve all its outer ones.
struct FragilityPlan {
    FragilityInput input;
    ShakingSuite suite;
    PlannedList<FragilityDraw> draws;
    PlannedList<FragilitySample> samples; ///< by draw, ascending
    std::size_t replicates = 1, outer = 1,
                inner = 1;  ///< independent sets; epistemic draws of each; runs of each draw and level
    std::size_t levels = 1; ///< of a cloud 1
    bool epistemic = false, aleatory = false; ///< there are variables of this kind
    /// Nothing is drawn inside: each inner set is all records with all polarities, so that P of a draw is that of the suite.
    bool whole_suite = false;
    std::vector<std::string> scaled_far; ///< records beyond max_scale, with their factor: "ec8: 5.1 at 0.8 g"

    const std::vector<RandomVariable>& variables() const { return input.probability.variables; }
    bool draws_key(std::string_view beginning) const; ///< some variable has a key that begins so
};

/// What the file says of a key that is drawn as a factor, in the key's unit.
using NumberInFile = std::function<double(const std::string& key)>;

/// @throws InputError for laws and correlations outside their range, with their line; for factors beyond suite.max_scale, unless allowed
FragilityPlan plan_fragility(const FragilityInput& input, ShakingSuite suite, const FragilitySizes& sizes,
                             const std::filesystem::path& scene_file, const NumberInFile& written);

/// Reads the scene with both ends of every law, 2^-40 of its probability left beyond each, so that no run stops half-way at a value
/// that its key does not allow. @throws InputError with the law's line, the value, what the key allows and the fix
void check_fragility(const FragilityInput& input, const SceneText& text);

/// The law of a variable, without the factor's base. @throws InputError with the law's line
probability::Distribution law_of(const RandomVariable& variable, const std::filesystem::path& scene_file);

/// The draw of given uniform numbers, one a variable, dependent already where they are correlated.
FragilityDraw draw_of(const FragilityInput& input, std::span<const double> u, const std::filesystem::path& scene_file,
                      const NumberInFile& written);

} // namespace damslip
