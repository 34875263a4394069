// The journal of a sweep: torn and damaged lines, foreign and unfinished journals.
#include "analysis/sweep/sweep_journal.hpp"
#include "core/input_error.hpp"
#include "sweep_scene.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sweep_tests {

namespace {

const SweepIdentity identity{"1.0", "scene-hash", "records-hash", "friction 0.7,0.8", 10};

FinishedRow row(std::size_t id, double slip, const std::string& status = "at rest")
{
    FinishedRow done;
    done.id = id;
    done.results.slip = done.results.max_slip = slip;
    done.results.slip_error = 0.1;
    done.results.critical_friction = 3.0;
    done.results.status = status;
    return done;
}

class SweepJournal : public SweepScene {
protected:
    std::filesystem::path file() const { return folder / "r.csv.journal"; }
    void write_rows(const std::vector<FinishedRow>& rows, const char* done = nullptr) const
    {
        Journal journal(file(), identity, {}, JournalStart::fresh);
        for (const FinishedRow& r : rows) journal.append({&r, 1});
        if (done) journal.mark_done();
    }
    std::string refusal(const SweepIdentity& now, const Shard& shard, JournalStart start) const
    {
        try {
            Journal journal(file(), now, shard, start);
        } catch (const InputError& error) {
            return error.what();
        }
        return "taken";
    }
};

TEST_F(SweepJournal, GivesBackEveryBit)
{
    std::vector<FinishedRow> rows{
        row(7, 0.1 + 0.2), row(2, -0.0), row(0, 5e-324), row(9, 1e300, "a \"quoted\", line\nwith μ"), {4, false, {}}};
    rows[1].history = {0.06, {0.0, -0.0000001, 0.1 + 0.2}};
    write_rows(rows);
    Journal journal(file(), identity, {}, JournalStart::resume);
    const std::vector<FinishedRow> found = journal.finished_rows(0, 9);
    std::sort(rows.begin(), rows.end(), [](const FinishedRow& a, const FinishedRow& b) { return a.id < b.id; });
    ASSERT_EQ(found.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(found[i].id, rows[i].id);
        EXPECT_EQ(found[i].good, rows[i].good);
        EXPECT_EQ(found[i].results, rows[i].results);
        EXPECT_EQ(found[i].history, rows[i].history);
    }
    EXPECT_TRUE(std::signbit(*found[1].results.slip)); // of row 2
    EXPECT_EQ(journal.damaged(), 0u);
}

// A stop can leave any part of the last line: cut there, the rows before it are whole, and what is appended is too.
TEST_F(SweepJournal, ALineTornAnywhereIsDropped)
{
    write_rows({row(1, 0.5), row(2, 0.25)});
    const std::string whole = content("r.csv.journal");
    const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
    for (std::size_t end = last; end < whole.size(); ++end) {
        write("r.csv.journal", whole.substr(0, end));
        {
            Journal journal(file(), identity, {}, JournalStart::resume);
            ASSERT_EQ(journal.finished(), 1u) << end;
            EXPECT_EQ(journal.damaged(), end == last ? 0u : 1u);
            const FinishedRow again = row(2, 0.25);
            journal.append({&again, 1});
        }
        ASSERT_EQ(content("r.csv.journal"), whole) << end;
    }
}

// What was begun and is not finished was stopped; a torn line of begun rows is cut off like any other.
TEST_F(SweepJournal, KnowsWhatWasStopped)
{
    const std::vector<std::size_t> together{1, 2, 3};
    for (int run = 0; run < 2; ++run) {
        Journal journal(file(), identity, {}, run == 0 ? JournalStart::fresh : JournalStart::resume);
        journal.begin(together);
        const FinishedRow finished = row(2, 0.5);
        if (run == 1) journal.append({&finished, 1});
    }
    write("r.csv.journal", content("r.csv.journal") + "begun 3 4");
    Journal journal(file(), identity, {}, JournalStart::resume);
    EXPECT_EQ(journal.stopped(), (std::map<std::size_t, int>{{1, 2}, {3, 2}}));
    EXPECT_EQ(journal.damaged(), 1u);
    EXPECT_EQ(journal.finished(), 1u);
}

TEST_F(SweepJournal, OnlyBegunRowsAreNothingToLose)
{
    {
        Journal journal(file(), identity, {}, JournalStart::fresh);
        const std::vector<std::size_t> together{1, 2, 3};
        journal.begin(together);
    }
    EXPECT_EQ(refusal(identity, {}, JournalStart::fresh), "taken");
}

TEST_F(SweepJournal, ALineWithAnotherChecksumIsLeftAside)
{
    write_rows({row(1, 0.5), row(2, 0.25), row(3, 0.125)});
    std::string text = content("r.csv.journal");
    text.replace(text.find("0.25"), 4, "0.26");
    write("r.csv.journal", text);
    Journal journal(file(), identity, {}, JournalStart::resume);
    const std::vector<FinishedRow> found = journal.finished_rows(0, 9);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[1].id, 3u);
    EXPECT_EQ(journal.damaged(), 1u);
}

// Every bit of a line counts, the last bytes that fill no word included: rows of ids of one to four digits have lines of
// different lengths.
TEST_F(SweepJournal, OneFlippedBitIsFound)
{
    SweepIdentity many = identity;
    many.rows = 10'000;
    for (const std::size_t id : {7u, 77u, 777u, 7777u}) {
        {
            Journal journal(file(), many, {}, JournalStart::fresh);
            const std::vector<FinishedRow> rows{row(id, 0.1 + 0.2), row(0, 0.5)};
            journal.append(rows);
        }
        const std::string whole = content("r.csv.journal");
        const std::size_t end = whole.rfind('\n', whole.size() - 2), begin = whole.rfind('\n', end - 1) + 1;
        for (std::size_t bit = 8 * begin; bit < 8 * end; ++bit) {
            std::string text = whole;
            text[bit / 8] = static_cast<char>(text[bit / 8] ^ 1 << bit % 8);
            write("r.csv.journal", text);
            const Journal journal(file(), many, {}, JournalStart::resume);
            ASSERT_EQ(journal.finished(), 1u) << id << ", bit " << bit - 8 * begin;
            ASSERT_GE(journal.damaged(), 1u);
        }
        std::filesystem::remove(file());
    }
}

// Of two words that stand in each other's place: their sum is the same, and so is what a checksum without order would say.
TEST_F(SweepJournal, TwoWordsThatChangedPlacesAreFound)
{
    write_rows({row(1, 0.5), row(2, 0.25)});
    const std::string whole = content("r.csv.journal");
    const std::size_t end = whole.rfind('\n', whole.size() - 2);
    const std::size_t text = whole.rfind('\n', end - 1) + 1 + 17; // 16 digits and a blank come first
    for (std::size_t first = text; first + 16 <= end; first += 8)
        for (std::size_t second = first + 8; second + 8 <= end; second += 8) {
            std::string swapped = whole;
            swapped.replace(first, 8, whole, second, 8).replace(second, 8, whole, first, 8);
            if (swapped == whole) continue;
            write("r.csv.journal", swapped);
            const Journal journal(file(), identity, {}, JournalStart::resume);
            ASSERT_EQ(journal.finished(), 1u) << first - text << " and " << second - text;
        }
}

// Journals before 6 have another checksum: not one of their rows would be taken.
TEST_F(SweepJournal, RefusesOneOfTheFormatBefore)
{
    write_rows({row(1, 0.5)});
    std::string text = content("r.csv.journal");
    ASSERT_EQ(text.find("damslip sweep journal 6\n"), 0u);
    text.replace(text.find('6'), 1, "5");
    write("r.csv.journal", text);
    for (const JournalStart start : {JournalStart::fresh, JournalStart::resume})
        EXPECT_NE(refusal(identity, {}, start).find("this is not a journal of a sweep."), std::string::npos);
    EXPECT_EQ(content("r.csv.journal"), text);
}

TEST_F(SweepJournal, RefusesOtherInputsAndSaysWhich)
{
    write_rows({row(1, 0.5)});
    const auto says = [&](SweepIdentity now, const Shard& shard, const std::string& part) {
        const std::string words = refusal(now, shard, JournalStart::resume);
        EXPECT_NE(words.find("this journal belongs to a sweep of other inputs: " + part), std::string::npos) << words;
        EXPECT_EQ(refusal(now, shard, JournalStart::fresh), words);
    };
    SweepIdentity other = identity;
    other.scene = "x";
    says(other, {}, "scene (other contents).");
    other.records = "y";
    says(other, {}, "scene (other contents); records (other contents).");
    other = identity;
    other.version = "1.1";
    says(other, {}, "version (1.1 now, 1.0 there).");
    other = identity;
    other.grid = "friction 0.7";
    says(other, {}, "grid (friction 0.7 now, friction 0.7,0.8 there).");
    says(identity, {1, 2}, "part (1/2 now, 0/1 there).");
    write("r.csv.journal", "some notes of mine\n");
    EXPECT_NE(refusal(identity, {}, JournalStart::fresh).find("this is not a journal of a sweep."), std::string::npos);
    EXPECT_EQ(content("r.csv.journal"), "some notes of mine\n");
}

TEST_F(SweepJournal, AFreshStartTakesNothingThatIsUnfinished)
{
    write_rows({row(1, 0.5)});
    const std::string words = refusal(identity, {}, JournalStart::fresh);
    EXPECT_NE(words.find("1 rows of this sweep are finished here."), std::string::npos) << words;
    EXPECT_NE(words.find("add  --resume"), std::string::npos) << words;

    std::filesystem::remove(file());
    write_rows({row(1, 0.5)}, "done");
    SweepIdentity other = identity;
    other.scene = "x";
    EXPECT_EQ(refusal(other, {}, JournalStart::fresh), "taken"); // the table of the other sweep is written
    Journal journal(file(), other, {}, JournalStart::resume);
    EXPECT_EQ(journal.finished(), 0u);
    EXPECT_NE(refusal(other, {}, JournalStart::resume).find("another process is writing this journal."),
              std::string::npos);
}

// From the outside: one changed sample of a record, one other friction, another part.
TEST_F(SweepScene, ResumingWithOtherInputsIsRefused)
{
    const std::string out = path("r.csv");
    ASSERT_EQ(sweep({"--friction", "0.1", "--out", out}).code, 0);
    const std::string table = content("r.csv");
    EXPECT_EQ(sweep({"--friction", "0.1", "--out", out, "--resume"}).code, 0);
    EXPECT_EQ(content("r.csv"), table);
    EXPECT_EQ(sweep({"--friction", "0.1,0.2", "--out", out, "--resume"}).code, 3);
    EXPECT_EQ(sweep({"--friction", "0.1", "--scheme", "slammer", "--out", out, "--resume"}).code, 3);
    write("late.csv", "time_s,accel_m_s2\n0,0\n1,0\n2,2.6\n3,0\n4,0\n");
    const Answer record = sweep({"--friction", "0.1", "--out", out, "--resume"});
    EXPECT_EQ(record.code, 3);
    EXPECT_NE(record.talk.find("records (other contents)"), std::string::npos) << record.talk;
    EXPECT_EQ(content("r.csv"), table);
    EXPECT_EQ(sweep({"--friction", "0.1", "--out", out}).code, 0); // a new sweep replaces what is done
    EXPECT_NE(content("r.csv"), table);
}

} // namespace

} // namespace damslip::sweep_tests
