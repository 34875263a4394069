// Audit B1: which component a file holds, by its header and its name; stations paired, files of three channels being stations.
#include "agency_files.hpp"
#include "analysis/prepare/record_list.hpp"
#include "program_answer.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace damslip {

namespace {

class Audit3Suite : public testing::Test {
protected:
    void SetUp() override
    {
        folder =
            std::filesystem::temp_directory_path() / ("damslip audit3 " + std::to_string(::getpid()) +
                                                      testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
    /// A pulse, up or down, of 3 m/s2 or less.
    void pulse(const std::string& name, double peak, const std::string& comments = "") const
    {
        write(name,
              comments + fmt::format("time_s,accel_m_s2\n0,0\n0.2,{}\n0.4,{}\n0.6,0\n0.8,0\n", peak, -0.5 * peak));
    }
    std::string esm(const std::string& stream, const std::string& values) const
    {
        agency_files::Esm file;
        file.dt = "0.200000", file.count = "5", file.pga = "", file.values = values;
        std::string text = file.text();
        return text.replace(text.find("STREAM: HNE"), 11, "STREAM: " + stream);
    }
    std::string station() const
    {
        std::string text;
        for (const auto& [component, scale] : {std::pair(" 90 DEG", 1.0), {" UP", -0.5}, {" 360 DEG", 0.8}}) {
            agency_files::Csmip file;
            file.component = component;
            file.data = "    5 POINTS OF ACCEL DATA EQUALLY SPACED AT  .200 SEC.  (UNITS: CM/SEC/SEC)\r\n" +
                        agency_files::fields({0.0, 300.0 * scale, -150.0 * scale, 0.0, 0.0}, 8, 10, 3);
            text += file.text();
        }
        return text;
    }
    std::string dam() const
    {
        write("dam.toml",
              "[section]\nheight_m = 10\nbase_m = 20\n[dam]\ndensity_kg_m3 = 2000\n[contact]\nfriction = 0.15\n");
        return (folder / "dam.toml").string();
    }
    /// "name: vertical (column), other" of each record.
    std::vector<std::string> read_list(const std::string& pattern) const
    {
        list = record_list((folder / pattern).string());
        std::vector<std::string> rows;
        for (std::size_t i = 0; i < list.records.size(); ++i) {
            const RecordFiles& r = list.records[i];
            rows.push_back(r.name + " | " + (r.vertical ? r.vertical->filename().string() : "-") +
                           (r.vertical_column.empty() ? "" : " " + r.vertical_column) + " | " +
                           (r.other_horizontal ? r.other_horizontal->filename().string() : "-"));
        }
        return rows;
    }
    std::string notes() const
    {
        std::string all;
        for (const std::string& note : list.notes) all += note + "\n";
        return all;
    }
    std::filesystem::path folder;
    mutable RecordList list;
};

using Rows = std::vector<std::string>;

TEST_F(Audit3Suite, B1_ComponentFromTheHeader)
{
    for (const auto& [stream, values] :
         {std::pair("HNE", "0\n300\n-150\n0\n0\n"), {"HNN", "0\n240\n-120\n0\n0\n"}, {"HNZ", "0\n-150\n75\n0\n0\n"}})
        write(std::string("XX.TEST..") + stream + ".D.20200101.000000.C.ACC.ASC", esm(stream, values));
    EXPECT_EQ(read_list(""), (Rows{"XX.TEST..HNE.D.20200101.000000.C.ACC | XX.TEST..HNZ.D.20200101.000000.C.ACC.ASC | "
                                   "XX.TEST..HNN.D.20200101.000000.C.ACC.ASC",
                                   "XX.TEST..HNN.D.20200101.000000.C.ACC | XX.TEST..HNZ.D.20200101.000000.C.ACC.ASC | "
                                   "XX.TEST..HNE.D.20200101.000000.C.ACC.ASC"}));
    EXPECT_EQ(list.events, (Rows{"XX.TEST.D.20200101.000000.C.ACC", "XX.TEST.D.20200101.000000.C.ACC"}));
    EXPECT_EQ(notes(), "");
    // The same by the verticals as they are named one by one.
    write("right.csv",
          "horizontal,vertical\nXX.TEST..HNE.D.20200101.000000.C.ACC.ASC,XX.TEST..HNZ.D.20200101.000000.C.ACC.ASC\n"
          "XX.TEST..HNN.D.20200101.000000.C.ACC.ASC,XX.TEST..HNZ.D.20200101.000000.C.ACC.ASC\n");
    const auto slips = [&](const std::string& records) {
        const ProgramAnswer a = answer_of({"screen", dam(), "--records", records, "--json", "--quiet"});
        EXPECT_EQ(a.code, 0) << a.talk;
        return nlohmann::json::parse(a.out)["displacements"].dump();
    };
    EXPECT_EQ(slips((folder / "*.ASC").string()), slips((folder / "right.csv").string()));
}

TEST_F(Audit3Suite, B1_NamesThatDoNotSayIt)
{
    for (const auto& [name, stream] : {std::pair("rec1.asc", "HNE"), {"rec2.asc", "HNZ"}, {"rec3.asc", "HNN"}})
        write(name, esm(stream, "0\n3\n-1\n0\n0\n"));
    EXPECT_EQ(read_list(""),
              (Rows{"rec1 | rec2.asc | rec3.asc", "rec3 | rec2.asc | rec1.asc"})); // of one event and station
}

TEST_F(Audit3Suite, B1_HeaderAgainstName)
{
    pulse("a_UP.csv", 1.0, "# component: NS\n");
    pulse("a_EW.csv", 2.0);
    EXPECT_EQ(read_list(""), (Rows{"a_EW | - | a_UP.csv", "a_UP | - | a_EW.csv"}));
    EXPECT_NE(notes().find("a_UP.csv: horizontal by its header (NS), vertical by its name: the header counts."),
              std::string::npos)
        << notes();
}

TEST_F(Audit3Suite, B1_WhatIsUnpairedIsSaid)
{
    for (const char* name : {"a_h.csv", "a_v.csv", "b090.csv", "c-DWN.csv", "pulse.csv"}) pulse(name, 1.0);
    EXPECT_EQ(read_list(""), (Rows{"a_h | a_v.csv | -", "b090 | - | -", "pulse | - | -"}));
    EXPECT_NE(notes().find("c-DWN.csv is a vertical component without a horizontal one: it is left out."),
              std::string::npos)
        << notes();
    EXPECT_NE(notes().find("without a vertical component: b090, pulse."), std::string::npos) << notes();
    EXPECT_NE(notes().find("neither header nor name says the component, taken as horizontal: pulse.csv."),
              std::string::npos)
        << notes();
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"screen", dam(), "--records", (folder / "*.csv").string()},
          {"sweep", dam(), "--records", (folder / "*.csv").string(), "--method", "rigid", "--friction", "0.2"},
          {"slide", "--yield-g", "0.05", "--records", (folder / "*.csv").string()}})
        EXPECT_NE(answer_of(command).talk.find("without a vertical component: b090, pulse."), std::string::npos)
            << command.front();
    EXPECT_NE(answer_of({"record", "suite", (folder / "*.csv").string()}).out.find("without a vertical component"),
              std::string::npos);
}

TEST_F(Audit3Suite, B1_AllPositionsAndCodes)
{
    const struct {
        Rows files; ///< two horizontal ones, then the vertical one
        const char* base;
    } suites[] = {
        {{"RSN181_H-E06140.AT2", "RSN181_H-E06230.AT2", "RSN181_H-E06-UP.AT2"}, "RSN181_H-E06"},
        {{"ABC-000.AT2", "ABC-090.AT2", "ABC-DWN.AT2"}, "ABC"},
        {{"LOS000.AT2", "LOS270.AT2", "LOSUP.AT2"}, "LOS"},
        {{"RSN4863_65036NS.AT2", "RSN4863_65036EW.AT2", "RSN4863_65036UD.AT2"}, "RSN4863_65036"},
        {{"AKT0010311091313.NS2", "AKT0010311091313.EW2", "AKT0010311091313.UD2"}, "AKT0010311091313.2"},
        {{"TKY001.NS", "TKY001.EW", "TKY001.UD"}, "TKY001"},
        {{"IV.MODE.00.HNE.D.2012.ASC", "IV.MODE.00.HNN.D.2012.ASC", "IV.MODE.00.HNZ.D.2012.ASC"}, "IV.MODE.00.D.2012"},
        {{"CH.SAUR.HGE.txt", "CH.SAUR.HGN.txt", "CH.SAUR.HGZ.txt"}, "CH.SAUR"},
        {{"KO.X.BN1.txt", "KO.X.BN2.txt", "KO.X.BNZ.txt"}, "KO.X"},
        {{"2023_4614_ap_RawAcc_E.asc", "2023_4614_ap_RawAcc_N.asc", "2023_4614_ap_RawAcc_U.asc"},
         "2023_4614_ap_RawAcc"},
        {{"NS_elcentro.csv", "EW_elcentro.csv", "UD_elcentro.csv"}, "elcentro"},
        {{"sta_N-S.txt", "sta_E-W.txt", "sta_U-D.txt"}, "sta"},
        {{"st1-H1.txt", "st1-H2.txt", "st1-V.txt"}, "st1"},
        {{"st_N10E.txt", "st_N80W.txt", "st_vert.txt"}, "st"},
        {{"st1.e", "st1.n", "st1.z"}, "st1"},
        {{"quake_long_acc.txt", "quake_tran_acc.txt", "quake_vert_acc.txt"}, "quake_acc"},
        {{"recordN.txt", "recordE.txt", "recordZ.txt"}, "record"},
        {{"RJK_090_acc.txt", "RJK_180_acc.txt", "RJK_UP_acc.txt"}, "RJK_acc"}};
    for (const auto& suite : suites) {
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
        for (const std::string& name : suite.files) pulse(name, 1.0 + static_cast<double>(name.back()));
        (void)read_list("");
        ASSERT_EQ(list.records.size(), 2u) << suite.files[0] << " " << notes();
        for (std::size_t i = 0; i < 2; ++i) {
            ASSERT_TRUE(list.records[i].vertical) << suite.files[i];
            EXPECT_EQ(list.records[i].vertical->filename().string(), suite.files[2]);
            EXPECT_EQ(list.events[i], suite.base);
        }
        EXPECT_EQ(notes(), "") << suite.files[0];
    }
}

TEST_F(Audit3Suite, B1_BoreholeAndSurface)
{
    for (const char* name : {"K.EW1", "K.NS1", "K.UD1", "K.EW2", "K.NS2", "K.UD2"}) pulse(name, 1.0);
    (void)read_list("");
    ASSERT_EQ(list.records.size(), 4u);
    for (const RecordFiles& record : list.records)
        EXPECT_EQ(record.vertical->extension().string().back(), record.horizontal.extension().string().back());
}

TEST_F(Audit3Suite, B1_ThreeChannelsAreAStation)
{
    write("ce1.v2", station());
    const Rows rows{"ce1-90 | ce1.v2 UP | ce1.v2", "ce1-360 | ce1.v2 UP | ce1.v2"};
    EXPECT_EQ(read_list(""), rows);
    EXPECT_EQ(list.events, (Rows{"ce1", "ce1"}));
    write("list.csv", "horizontal,event,scale\nce1.v2,quake,2\n");
    EXPECT_EQ(read_list("list.csv"), rows);
    EXPECT_EQ(list.events, (Rows{"quake", "quake"}));
    EXPECT_EQ(list.records[1].scale, 2.0);
    write("chosen.csv", "horizontal,column,vertical,vertical_column\nce1.v2,360,ce1.v2,UP\n");
    EXPECT_EQ(read_list("chosen.csv"), (Rows{"ce1-360 | ce1.v2 UP | -"}));

    // As files of one component each.
    pulse("one_90.csv", 3.0), pulse("one_360.csv", 2.4), pulse("one_up.csv", -1.5);
    write("apart.csv", "horizontal,vertical\none_90.csv,one_up.csv\none_360.csv,one_up.csv\n");
    const auto slips = [&](const std::vector<std::string>& more) {
        std::vector<std::string> command{"screen", dam(), "--json", "--quiet", "--records"};
        command.insert(command.end(), more.begin(), more.end());
        const ProgramAnswer a = answer_of(command);
        EXPECT_EQ(a.code, 0) << a.talk;
        std::string slips;
        const auto answer = nlohmann::json::parse(a.out);
        for (const auto& row : answer["displacements"]) slips += row["slip_hv_mm"].dump() + " ";
        return slips;
    };
    EXPECT_EQ(slips({(folder / "*.v2").string()}), slips({(folder / "apart.csv").string()}));
    // A column that the user chose is not overruled.
    const ProgramAnswer one =
        answer_of({"screen", dam(), "--json", "--quiet", "--records", (folder / "*.v2").string(), "--column", "360"});
    EXPECT_EQ(nlohmann::json::parse(one.out)["records"].size(), 1u);

    // All that read a suite.
    EXPECT_EQ(answer_of({"slide", "--yield-g", "0.05", "--records", (folder / "*.v2").string()}).code, 0);
    const std::string out = (folder / "out.csv").string();
    EXPECT_EQ(answer_of({"record", "suite", (folder / "*.v2").string(), "--target-pga-m-s2", "2", "--out", out}).code,
              0);
    EXPECT_EQ(slips({out}).empty(), false);
    EXPECT_EQ(read_list("out.csv"), rows);
    write("fragility.toml",
          "[section]\nheight_m = 10\nbase_m = 20\n[dam]\ndensity_kg_m3 = 2000\n[contact]\nfriction = 0.15\n"
          "[sliding]\ntwo_way = false\n[probability]\nsamples = 16\n[[probability.variable]]\nname = \"mu\"\nkey = "
          "\"contact.friction\"\n"
          "lognormal = { median = 0.15, beta = 0.3 }\n[suite]\nfiles = \"*.v2\"\n[intensity]\nmeasure = \"PGA\"\n"
          "component = \"geomean\"\nlevels_m_s2 = [2.0, 4.0]\n[[limit]]\nquantity = \"slip\"\nabove_mm = 10\n");
    const ProgramAnswer fragility = answer_of({"fragility", (folder / "fragility.toml").string()});
    EXPECT_EQ(fragility.code, 0) << fragility.talk;
}

TEST_F(Audit3Suite, B1_ManyChannelsAreNoStation)
{
    agency_files::Csmip file;
    std::string text;
    for (const char* component : {" 90 DEG", " 90 DEG", " UP", " 360 DEG"}) {
        file.component = component;
        file.data = "    5 POINTS OF ACCEL DATA EQUALLY SPACED AT  .200 SEC.  (UNITS: CM/SEC/SEC)\r\n" +
                    agency_files::fields({0, 300, -150, 0, 0}, 8, 10, 3);
        text += file.text();
    }
    write("building.v2", text);
    EXPECT_NE(answer_of({"screen", dam(), "--records", (folder / "*.v2").string()})
                  .talk.find("the file holds 4 accelerograms"),
              std::string::npos);
}

TEST_F(Audit3Suite, B4_RecordInfoShowsAllChannels)
{
    write("ce1.v2", station());
    const ProgramAnswer a = answer_of({"record", "info", (folder / "ce1.v2").string(), "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    EXPECT_EQ(nlohmann::json::parse(a.out)["records"].size(), 3u);
    write("table.csv", "time_s,ns_g,ew_g\n0,0,1\n0.1,3,4\n");
    EXPECT_EQ(answer_of({"record", "info", (folder / "table.csv").string()}).code, 3);
}

} // namespace

} // namespace damslip
