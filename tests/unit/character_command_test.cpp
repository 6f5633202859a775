// `seaglare-lights character`: JSON, canonical notation, phases from outside, and messages with a place.
#include <gtest/gtest.h>

#include <sstream>

#include "lightdb/json/value.h"
#include "lightdb/tool/commands.h"

namespace seaglare::lights_tool {
namespace {

struct Answer {
    int status;
    std::string out;
    std::string err;
};

Answer ask(const CharacterRequest& request) {
    std::ostringstream out;
    std::ostringstream err;
    const int status = explain_character(request, out, err);
    return {status, out.str(), err.str()};
}

TEST(CharacterCommand, TheJsonNamesClassGroupsColoursRangesAndPhases) {
    const Answer answer = ask({"Gp Fl(2+1)WRG ev 10 sec 15m W 12 R 8 G 8", "", "", false});
    ASSERT_EQ(answer.status, 0) << answer.err;
    const json::Document document = json::parse(answer.out, "out");
    const json::Value& root = document.root();
    EXPECT_EQ(root.find("class")->string(), "Fl(2+1)");
    EXPECT_EQ(root.find("group")->string(), "(2+1)");
    const json::Value& part = root.find("parts")->array()[0];
    EXPECT_EQ(part.find("class")->string(), "Fl");
    EXPECT_EQ(part.find("group")->array()[0].number(), 2);
    EXPECT_EQ(part.find("group")->array()[1].number(), 1);
    EXPECT_EQ(root.find("colours")->array().size(), 3U);
    EXPECT_EQ(root.find("nominal_range_nm")->find("R")->number(), 8);
    EXPECT_EQ(root.find("height_m")->number(), 15);
    EXPECT_EQ(root.find("phases")->array().size(), 6U);
    EXPECT_EQ(root.find("warnings")->array().size(), 1U) << "Gp";
    EXPECT_EQ(root.find("assumptions")->array().size(), 1U) << "the flashes' length";
    EXPECT_EQ(root.find("written_phases"), nullptr);
}

TEST(CharacterCommand, AListThatMissesItsPeriodIsReportedAndShownAsGiven) {
    const Answer answer = ask({"Fl W 3s", "fl. 0.8s, ec. 2.0s", "", false});
    ASSERT_EQ(answer.status, 0) << answer.err;
    const json::Document document = json::parse(answer.out, "out");
    const json::Value& root = document.root();
    ASSERT_EQ(root.find("warnings")->array().size(), 1U);
    EXPECT_NE(root.find("warnings")->array()[0].string().find("add up to 2.8 s, the period is 3 s"),
              std::string_view::npos);
    ASSERT_EQ(root.find("written_phases")->array().size(), 2U);
    EXPECT_EQ(root.find("written_phases")->array()[1].find("eclipse")->number(), 2);
    EXPECT_EQ(root.find("phases")->array()[1].find("eclipse")->number(), 2);
    EXPECT_EQ(root.find("assumptions")->array().size(), 0U);
}

TEST(CharacterCommand, FormatPrintsTheNotationAndWarnsBesideIt) {
    const Answer answer = ask({"Qk.Fl.(6)+L.Fl. ev 15s 100ft", "", "", true});
    EXPECT_EQ(answer.status, 0);
    EXPECT_EQ(answer.out, "Q(6)+LFl W 15s 30.48m\n");
    EXPECT_NE(answer.err.find("old form"), std::string::npos);
    EXPECT_EQ(ask({"Fl W 3s", "", "00.8+(02.2)", true}).out, "Fl W 3s fl. 0.8s, ec. 2.2s\n");
    EXPECT_EQ(ask({"Fl W 3s", R"([{"lit": 0.8}, {"eclipse": 2.2}])", "", true}).out,
              "Fl W 3s fl. 0.8s, ec. 2.2s\n");
}

TEST(CharacterCommand, ErrorsNameThePlaceInWhicheverTextItIs) {
    const Answer wrong = ask({"Fl(2)R 5", "", "", false});
    EXPECT_EQ(wrong.status, 1);
    EXPECT_NE(wrong.err.find("at its character 8:"), std::string::npos) << wrong.err;
    EXPECT_TRUE(wrong.out.empty());
    // The middle dot is one character and two bytes.
    EXPECT_NE(ask({"Fl W 7\xC2\xB7"
                   "5s %",
                   "", "", false})
                  .err.find("at its character 11:"),
              std::string::npos);
    const Answer list = ask({"Fl R 5s", "", "00.8+(02.2", false});
    EXPECT_EQ(list.status, 1);
    EXPECT_NE(list.err.find("'00.8+(02.2', at its character 11: expected ')'"), std::string::npos)
        << list.err;
    EXPECT_EQ(ask({"Fl R 5s", "[{]", "", false}).status, 1);
}

}  // namespace
}  // namespace seaglare::lights_tool
