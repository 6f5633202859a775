// The conformance corpus against the parser, and through the tool: exit status, line and column.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

#include "lightdb/json/value.h"
#include "lightdb/json/writer.h"
#include "lightdb/tool/commands.h"
#include "tests/unit/json_conformance/accepted.h"
#include "tests/unit/json_conformance/left_open.h"
#include "tests/unit/json_conformance/refused.h"

namespace seaglare::json {
namespace {

using json_conformance::Case;
using json_conformance::Verdict;

std::vector<Case> all_cases() {
    std::vector<Case> cases = json_conformance::accepted_cases();
    for (auto* more : {json_conformance::refused_cases, json_conformance::left_open_cases}) {
        std::vector<Case> next = more();
        cases.insert(cases.end(), next.begin(), next.end());
    }
    // Too long to write down.
    const auto nested = [](const std::string& open, int depth) {
        return json_conformance::repeated(open, depth);
    };
    cases.push_back({"n_structure_100000_open_arrays", Verdict::refuse, nested("[", 100000)});
    cases.push_back({"n_structure_100000_open_objects", Verdict::refuse, nested("{\"a\":", 100000)});
    cases.push_back({"n_structure_50000_of_both", Verdict::refuse, nested("[{\"\":", 50000)});
    cases.push_back({"i_structure_100000_arrays_closed", Verdict::ours_refuses,
                     nested("[", 100000) + nested("]", 100000)});
    cases.push_back({"n_structure_100000_close_arrays", Verdict::refuse, nested("]", 100000)});
    cases.push_back({"y_array_100000_elements", Verdict::accept, "[" + nested("0,", 99999) + "0]"});
    cases.push_back({"y_array_100000_empty_arrays", Verdict::accept, "[" + nested("[],", 99999) + "[]]"});
    cases.push_back({"n_array_100000_commas", Verdict::refuse, "[" + nested(",", 100000) + "]"});
    cases.push_back(
        {"y_object_100000_members", Verdict::accept, "{" + nested("\"a\":0,", 99999) + "\"b\":0}"});
    cases.push_back({"y_string_of_a_million", Verdict::accept, "\"" + nested("x", 1000000) + "\""});
    cases.push_back({"n_string_of_a_million_unclosed", Verdict::refuse, "\"" + nested("x", 1000000)});
    cases.push_back(
        {"y_space_a_million", Verdict::accept, nested(" ", 1000000) + "0" + nested("\n", 1000000)});
    cases.push_back({"y_number_a_million_digits", Verdict::accept, "0." + nested("7", 1000000)});
    return cases;
}

bool is_accepted(const Case& c) {
    return c.verdict == Verdict::accept || c.verdict == Verdict::ours_accepts;
}

TEST(JsonConformance, NamesSayWhatIsExpected) {
    for (const Case& c : all_cases()) {
        const char first = c.verdict == Verdict::accept ? 'y' : c.verdict == Verdict::refuse ? 'n' : 'i';
        EXPECT_EQ(c.name.substr(0, 2), std::string(1, first) + "_") << c.name;
    }
    EXPECT_GT(all_cases().size(), 600U);
}

TEST(JsonConformance, EveryDocumentIsAcceptedOrRefusedAsTheStandardSays) {
    for (const Case& c : all_cases()) {
        std::string error;
        try {
            parse(c.text, c.name);
        } catch (const Error& refused) {
            error = refused.what();
        }
        EXPECT_EQ(error.empty(), is_accepted(c)) << c.name << ": " << error;
    }
}

// The parser reads ahead in words of eight bytes: what stands before must make no difference.
TEST(JsonConformance, VerdictsDoNotDependOnWhereTheDocumentStandsInMemory) {
    for (const Case& c : all_cases()) {
        if (c.text.size() > 1000 || c.text.starts_with("\xEF\xBB")) continue;
        for (std::size_t spaces = 1; spaces < 16; ++spaces) {
            bool accepted = true;
            try {
                parse(std::string(spaces, ' ') + c.text, c.name);
            } catch (const Error&) {
                accepted = false;
            }
            EXPECT_EQ(accepted, is_accepted(c)) << c.name << " after " << spaces << " spaces";
        }
    }
}

TEST(JsonConformance, WhatIsAcceptedSurvivesBeingWritten) {
    const auto written = [](const Document& document) {
        Writer writer;
        writer.value(document.root());
        return writer.take();
    };
    for (const Case& c : all_cases()) {
        if (!is_accepted(c)) continue;
        const std::string once = written(parse(c.text, c.name));
        EXPECT_EQ(written(parse(once, c.name)), once) << c.name;
    }
}

// One line: "FILE:LINE:COLUMN: text", with numbers that begin at 1.
bool is_message_about(const std::string& file, const std::string& text) {
    if (!text.starts_with(file + ":")) return false;
    const char* at = text.c_str() + file.size() + 1;
    const char* const end = text.c_str() + text.size();
    for (int number = 0; number < 2; ++number) {
        unsigned value = 0;
        const auto [after, failed] = std::from_chars(at, end, value);
        if (failed != std::errc() || value == 0 || after == end || *after != ':') return false;
        at = after + 1;
    }
    return end - at > 2 && *at == ' ' && std::find(at, end, '\n') == end - 1;
}

TEST(JsonConformance, TheToolExitsWithNothingOrOneAndNamesLineAndColumn) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("seaglare_json_" + std::to_string(getpid()));
    std::filesystem::create_directory(folder);
    for (const Case& c : all_cases()) {
        const std::string file = (folder / (c.name + ".json")).string();
        std::ofstream(file, std::ios::binary) << c.text;
        std::ostringstream err;
        EXPECT_EQ(lights_tool::check_json(file, err), is_accepted(c) ? 0 : 1) << c.name;
        if (is_accepted(c)) {
            EXPECT_EQ(err.str(), "") << c.name;
        } else if (c.text.find('\n') == std::string::npos) {
            EXPECT_TRUE(is_message_about(file, err.str())) << c.name << ": " << err.str();
        }
    }
    // Kept, they can be given to the program itself, under sanitizers, too.
    if (std::getenv("SEAGLARE_KEEP_CONFORMANCE_FILES") == nullptr) std::filesystem::remove_all(folder);
}

TEST(JsonConformance, KeysThatStandTwiceAreJsonButNoLightFile) {
    const std::string file =
        (std::filesystem::temp_directory_path() / ("seaglare_twice_" + std::to_string(getpid()) + ".json"))
            .string();
    const std::string light = R"({"name":"a","position":[0,0,5],"intensity_cd":100)";
    struct Row {
        std::string text;
        const char* place;
    };
    const Row rows[] = {
        {"{\"lights\":[],\n\"lights\":[]}", ":2:1:"},
        {"{\"lights\":[" + light + ",\n  \"name\":\"b\"}]}", ":2:3:"},
        {"{\"lights\":[" + light + ",\n\"n\\u0061me\":\"b\"}]}", ":2:1:"},
        {"{\"lights\":[" + light + ",\"sectors\":[{\"colour\":\"R\",\"from\":1,\"to\":2,\n\"to\":3}]}]}",
         ":2:1:"},
        {"{\"origin\":{\"lat\":1,\"lon\":2,\n \"lat\":3},\"lights\":[]}", ":2:2:"},
    };
    for (const Row& row : rows) {
        std::ofstream(file, std::ios::binary) << row.text;
        std::ostringstream out;
        std::ostringstream err;
        EXPECT_EQ(lights_tool::check_json(file, err), 0) << err.str();
        EXPECT_EQ(lights_tool::validate({file}, out, err), 1) << row.text;
        EXPECT_NE(err.str().find(row.place), std::string::npos) << err.str();
        EXPECT_NE(err.str().find("twice"), std::string::npos) << err.str();
    }
    std::filesystem::remove(file);
}

}  // namespace
}  // namespace seaglare::json
