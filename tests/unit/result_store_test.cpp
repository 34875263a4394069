// The database of a sweep: every bit comes back; what is damaged, foreign or unfinished is never taken for a row.
#include "analysis/sweep/result_store.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "store_changes.hpp"
#include "sweep_scene.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip::sweep_tests {

namespace {

const SweepIdentity identity{"1.0", "scene-hash", "records-hash", "friction 0.7,0.8", 10};

FinishedRow row_of(std::size_t id, double slip, const std::string& status = "at rest")
{
    FinishedRow done;
    done.id = id;
    done.results.slip = done.results.max_slip = slip;
    done.results.slip_error = 0.1;
    done.results.critical_friction = 3.0;
    done.results.status = status;
    return done;
}

class ResultStoreFile : public SweepScene {
protected:
    std::filesystem::path file() const { return folder / "r.sqlite"; }
    void write_rows(const std::vector<FinishedRow>& rows, bool done = false) const
    {
        ResultStore store(file(), identity, {}, StoreStart::fresh);
        for (const FinishedRow& r : rows) store.append({&r, 1});
        if (done) store.mark_done();
    }
    std::vector<FinishedRow> rows() const { return ResultStore(file(), identity, {}, StoreStart::resume).rows(0, 9); }
    std::string refusal(const SweepIdentity& now, const Shard& shard, StoreStart start) const
    {
        try {
            ResultStore store(file(), now, shard, start);
        } catch (const InputError& error) {
            return error.what();
        }
        return "taken";
    }
};

void expect_same(const FinishedRow& a, const FinishedRow& b)
{
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.good, b.good);
    EXPECT_EQ(a.results, b.results);
    EXPECT_EQ(a.history, b.history);
}

TEST_F(ResultStoreFile, GivesBackEveryBit)
{
    std::vector<FinishedRow> written{row_of(7, 0.1 + 0.2), row_of(2, -0.0), row_of(0, 5e-324),
                                     row_of(9, 1e300, "a \"quoted\", line\nwith μ"), row_of(4, 1.0, "not resolved")};
    written[4].good = false;
    written[1].history = {0.06, {0.0, -0.0000001, 0.1 + 0.2}};
    written[2].results.event_slips = {0.1 + 0.2, -0.0, 5e-324};
    written[2].results.anchors = {{"a, \"b\"", 1e6 / 3.0, "yielded"}, {"c", 0.0, "elastic"}};
    written[3].results.lift_offs = 3.0;
    written[3].results.slip_low = std::numeric_limits<double>::infinity();
    write_rows(written);
    std::sort(written.begin(), written.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    const std::vector<FinishedRow> found = rows();
    ASSERT_EQ(found.size(), written.size());
    for (std::size_t i = 0; i < written.size(); ++i) expect_same(found[i], written[i]);
    EXPECT_TRUE(std::signbit(*found[1].results.slip)); // of row 2
    EXPECT_EQ(ResultStore(file()).damaged(), 0u);
}

TEST_F(ResultStoreFile, NotANumberIsNoValue)
{
    FinishedRow odd = row_of(3, 0.5);
    odd.results.slip_error = std::numeric_limits<double>::quiet_NaN();
    write_rows({odd});
    ASSERT_EQ(rows().size(), 1u);
    EXPECT_FALSE(rows()[0].results.slip_error);
}

// Rows by the thousand are written together; in what order they come, and how many at once, changes nothing.
TEST_F(ResultStoreFile, ManyRowsInAnyOrder)
{
    SweepIdentity many = identity;
    many.rows = 20'000;
    std::vector<FinishedRow> written;
    for (std::size_t k = 0; k < many.rows; ++k) written.push_back(row_of(k * 7919 % many.rows, 1.0 / (static_cast<double>(k) + 1.0)));
    for (std::size_t k = 0; k < many.rows; k += 5) written[k].results.opening = 0.25;
    {
        ResultStore store(file(), many, {}, StoreStart::fresh);
        for (std::size_t first = 0; first < many.rows; first += 250)
            store.append(std::span(written).subspan(first, 250));
    }
    std::sort(written.begin(), written.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    const ResultStore store(file(), many, {}, StoreStart::resume);
    EXPECT_EQ(store.finished(), many.rows);
    const std::vector<FinishedRow> found = store.rows(100, 299);
    ASSERT_EQ(found.size(), 200u);
    for (std::size_t i = 0; i < found.size(); ++i) expect_same(found[i], written[100 + i]);
}

// What was begun and is not finished was stopped.
TEST_F(ResultStoreFile, KnowsWhatWasStopped)
{
    const std::vector<std::size_t> together{1, 2, 3};
    for (int run = 0; run < 2; ++run) {
        ResultStore store(file(), identity, {}, run == 0 ? StoreStart::fresh : StoreStart::resume);
        store.begin(together);
        const FinishedRow finished = row_of(2, 0.5);
        if (run == 1) store.append({&finished, 1});
    }
    const ResultStore store(file(), identity, {}, StoreStart::resume);
    EXPECT_EQ(store.stopped(), (std::map<std::size_t, int>{{1, 2}, {3, 2}}));
    EXPECT_EQ(store.finished(), 1u);
}

TEST_F(ResultStoreFile, OnlyBegunRowsAreNothingToLose)
{
    {
        ResultStore store(file(), identity, {}, StoreStart::fresh);
        const std::vector<std::size_t> together{1, 2, 3};
        store.begin(together);
    }
    EXPECT_EQ(refusal(identity, {}, StoreStart::fresh), "taken");
}

// Any column of a row that another hand changed: the row is left out and may be written anew.
TEST_F(ResultStoreFile, AChangedRowIsLeftOut)
{
    for (const char* change :
         {"slip_m = 0.26", "slip_m = NULL", "hops = 1.0", "status = 'sliding at end'", "id = 5",
          "checksum = checksum + 1", "history = '[]'", "slip_m = max_slip_m, max_slip_m = slip_m"}) {
        FinishedRow whole = row_of(2, 0.25);
        whole.results.max_slip = 0.5;
        write_rows({row_of(1, 0.5), whole, row_of(3, 0.125)});
        sql(file(), fmt::format("UPDATE rows SET {} WHERE id = 2", change));
        {
            ResultStore store(file(), identity, {}, StoreStart::resume);
            EXPECT_EQ(store.damaged(), 1u) << change;
            EXPECT_EQ(store.finished(), 2u) << change;
            EXPECT_EQ(store.rows(0, 9).size(), 2u) << change;
            store.append({&whole, 1});
        }
        ASSERT_EQ(rows().size(), 3u) << change;
        expect_same(rows()[1], whole);
        std::filesystem::remove(file());
    }
}

// Every byte of the file, and every cut: refused, or its rows are those that were written.
TEST_F(ResultStoreFile, ADamagedFileNeverGivesAWrongRow)
{
    const std::vector<FinishedRow> written{row_of(1, 0.1 + 0.2), row_of(2, 0.25), row_of(3, 0.125, "sliding at end")};
    write_rows(written);
    const std::string whole = content("r.sqlite");
    std::size_t refused = 0, fewer = 0, tried = 0;
    const auto expect_never_wrong = [&](const std::string& bytes) {
        write("r.sqlite", bytes);
        std::filesystem::remove(folder / "r.sqlite-journal");
        ++tried;
        try {
            const ResultStore store(file(), identity, {}, StoreStart::resume);
            const std::vector<FinishedRow> found = store.rows(0, 9);
            fewer += found.size() < written.size();
            for (const FinishedRow& row : found) {
                ASSERT_GE(row.id, 1u);
                ASSERT_LE(row.id, 3u);
                expect_same(row, written[row.id - 1]);
            }
        } catch (const InputError&) {
            ++refused;
        }
    };
    for (std::size_t at = 0; at < whole.size(); ++at) {
        if (whole[at] == 0 && at % 256 != 0) continue; // most of it is empty
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ 1 << at % 8);
        expect_never_wrong(bytes);
    }
    for (std::size_t end = 1; end < whole.size(); end += 1001) expect_never_wrong(whole.substr(0, end));
    EXPECT_GT(refused, tried / 20);
    EXPECT_GT(fewer, 20u);
}

TEST_F(ResultStoreFile, RefusesWhatIsNoStoreAndAnotherFormat)
{
    write("r.sqlite", "some notes of mine\n");
    for (const StoreStart start : {StoreStart::fresh, StoreStart::resume})
        EXPECT_NE(refusal(identity, {}, start).find("this is not a database of a sweep"), std::string::npos);
    EXPECT_EQ(content("r.sqlite"), "some notes of mine\n");
    std::filesystem::remove(file());
    write_rows({row_of(1, 0.5)}, true);
    for (const char* change : {"PRAGMA user_version = 6", "PRAGMA user_version = 7; PRAGMA application_id = 1"}) {
        sql(file(), change);
        EXPECT_NE(refusal(identity, {}, StoreStart::fresh).find("this is not a database of a sweep"),
                  std::string::npos);
    }
}

// A journal of the text format before, unread beside the database that is not there yet.
TEST_F(ResultStoreFile, AnOldJournalIsNotIgnored)
{
    write("r.csv.journal", "damslip sweep journal 6\n");
    const std::string words = refusal(identity, {}, StoreStart::resume);
    EXPECT_NE(words.find("r.csv.journal: error: this journal is of an earlier version"), std::string::npos) << words;
    EXPECT_NE(words.find("or delete the journal"), std::string::npos) << words;
    EXPECT_EQ(refusal(identity, {}, StoreStart::fresh), "taken");
}

TEST_F(ResultStoreFile, RefusesOtherInputsAndSaysWhich)
{
    write_rows({row_of(1, 0.5)});
    const auto says = [&](SweepIdentity now, const Shard& shard, const std::string& part) {
        const std::string words = refusal(now, shard, StoreStart::resume);
        EXPECT_NE(words.find("this database belongs to a sweep of other inputs: " + part), std::string::npos) << words;
        EXPECT_EQ(refusal(now, shard, StoreStart::fresh), words);
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
}

TEST_F(ResultStoreFile, AFreshStartTakesNothingThatIsUnfinished)
{
    write_rows({row_of(1, 0.5)});
    const std::string words = refusal(identity, {}, StoreStart::fresh);
    EXPECT_NE(words.find("1 rows of this sweep are finished here."), std::string::npos) << words;
    EXPECT_NE(words.find("add  --resume"), std::string::npos) << words;

    std::filesystem::remove(file());
    write_rows({row_of(1, 0.5)}, true);
    SweepIdentity other = identity;
    other.scene = "x";
    EXPECT_EQ(refusal(other, {}, StoreStart::fresh), "taken"); // the table of the other sweep is written
    ResultStore store(file(), other, {}, StoreStart::resume);
    EXPECT_EQ(store.finished(), 0u);
    EXPECT_NE(refusal(other, {}, StoreStart::resume).find("another process has this database open."),
              std::string::npos);
}

// What docs/sweeps.md promises to those who ask the database themselves: the values of the CSV by their names.
TEST_F(SweepScene, TheViewHasTheRowsOfTheTable)
{
    ASSERT_EQ(sweep(with(grid, {"--out", path("r.csv")})).code, 0);
    std::istringstream lines(content("r.csv"));
    std::vector<std::string> names, fields;
    std::size_t rows = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line[0] == '#') continue;
        std::istringstream in(line);
        std::vector<std::string>& list = names.empty() ? names : fields;
        list.clear();
        for (std::string field; std::getline(in, field, ',');) list.push_back(field);
        if (&list == &names) continue;
        ++rows;
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (names[i] == "level_m" || names[i] == "yield_coefficient_g" || names[i] == "remark")
                continue; // not stored
            const std::string stored =
                sql(folder / "r.sqlite", fmt::format("SELECT {} FROM results WHERE id = {}", names[i], fields[0]));
            char* end = nullptr;
            const double number = std::strtod(fields[i].c_str(), &end);
            if (fields[i].empty() || *end != 0)
                EXPECT_EQ(stored, fields[i]) << names[i] << " of row " << fields[0];
            else
                EXPECT_NEAR(std::stod(stored), number, 1e-14 * std::abs(number)) << names[i] << " of row " << fields[0];
        }
    }
    EXPECT_EQ(rows, 96u);
    EXPECT_EQ(sql(folder / "r.sqlite", "SELECT rows || ' ' || part || ' ' || done FROM sweep"), "96 0/1 1");
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
