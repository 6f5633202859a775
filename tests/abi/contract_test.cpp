// CONTRACT.md cannot rot: every test it names exists, and no rule goes without a word on how it is held.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace {

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::set<std::string> tests_of_the_project() {
    std::set<std::string> names;
    const std::regex test(R"(TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\))");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(SEAGLARE_SOURCE_DIR "/tests")) {
        if (entry.path().extension() != ".cpp") continue;
        const std::string text = text_of(entry.path());
        for (std::sregex_iterator match(text.begin(), text.end(), test), end; match != end; ++match)
            names.insert((*match)[1].str() + "." + (*match)[2].str());
    }
    return names;
}

TEST(Contract, EveryTestItNamesExists) {
    const std::string contract = text_of(SEAGLARE_SOURCE_DIR "/plugin_api/CONTRACT.md");
    const std::set<std::string> tests = tests_of_the_project();
    const std::regex name(R"(`([A-Z]\w+\.[A-Z]\w+)`)");
    int named = 0;
    for (std::sregex_iterator match(contract.begin(), contract.end(), name), end; match != end;
         ++match, ++named)
        EXPECT_TRUE(tests.count((*match)[1].str()) == 1) << (*match)[1].str();
    EXPECT_GT(named, 40);
}

TEST(Contract, EveryRuleSaysHowItIsHeld) {
    const std::string contract =
        std::regex_replace(text_of(SEAGLARE_SOURCE_DIR "/plugin_api/CONTRACT.md"), std::regex(R"(\s+)"), " ");
    const std::regex begins(R"( (\d+)\. \*\*)");
    int rules = 0;
    std::sregex_iterator match(contract.begin(), contract.end(), begins), end;
    while (match != end) {
        EXPECT_EQ(std::stoi((*match)[1].str()), ++rules) << "rules are numbered in turn";
        const std::string after = match->suffix().str();
        ++match;
        const std::string rule =
            after.substr(0, match == end ? after.size() : after.size() - match->suffix().length());
        EXPECT_TRUE(rule.find("Held by `") != std::string::npos ||
                    rule.find("Not held.") != std::string::npos)
            << "rule " << rules;
    }
    EXPECT_GE(rules, 30);
}

}  // namespace
