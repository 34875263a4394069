// What solvers have to say: every kind has a sentence that takes its values.
#include "core/status.hpp"

#include <gtest/gtest.h>

#include <string>

namespace {

using namespace damslip;

TEST(Notes, EverySentenceTakesItsValues)
{
    for (int k = 0; k <= static_cast<int>(NoteKind::modes_need_free_rock); ++k) {
        Note note{static_cast<NoteKind>(k)};
        const std::string sentence(sentence_of(note.kind));
        ASSERT_FALSE(sentence.empty());
        for (std::size_t at = sentence.find('{'); at != std::string::npos; at = sentence.find('{', at + 1)) {
            const std::string place = sentence.substr(at, sentence.find('}', at) - at);
            if (place.find(':') != std::string::npos)
                note.values.push_back(0.125); // digits: a number
            else
                note.values.push_back(std::string("name"));
        }
        const std::string text = text_of(note);
        EXPECT_EQ(text.find_first_of("{}"), std::string::npos) << text;
        for (NoteValue& value : note.values) // a count fits wherever a number does
            if (std::holds_alternative<double>(value)) value = std::int64_t{3};
        EXPECT_NO_THROW(text_of(note)) << sentence;
    }
}

TEST(Notes, CountsAndNumbersAreWrittenAsTheyAre)
{
    EXPECT_EQ(text_of(Note{NoteKind::records_not_run, {std::int64_t{1}}}), "1 record of the sequence was not run.");
    EXPECT_EQ(text_of(Note{NoteKind::records_not_run, {std::int64_t{12}}}), "12 records of the sequence were not run.");
    EXPECT_EQ(text_of(Note{NoteKind::still_sliding, {7.5}}),
              "Still sliding 7.5 s after the record's end: the slip is a lower bound.");
    EXPECT_EQ(text_of(Note{NoteKind::damping_of_modes, {100.0 * 0.07, 1.5, 3.0, 0.5, 0.001}}),
              "damping: 7 % at 1.5 and 3 Hz, a_M = 0.5 1/s, b_K = 0.001 s");
    const std::vector<Note> both{{NoteKind::in_record, {"second"}}, {NoteKind::interrupted, {2.0, 3.0}}};
    EXPECT_EQ(text_of(both), "In \"second\": Interrupted at 2.00 s, slip so far 3 mm.");
}

} // namespace
