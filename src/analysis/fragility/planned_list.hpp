#pragma once

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

} // namespace damslip
