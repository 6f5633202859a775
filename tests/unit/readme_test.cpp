// README.md cannot rot: what it shows is compiled, what it names exists.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

TEST(Readme, ShowsTheHostThatIsCompiled) {
    EXPECT_EQ(std::system(SEAGLARE_SOURCE_DIR "/scripts/check_readme 2>&1"), 0)
        << "the reason is printed above";
}

TEST(Readme, NamesOnlyFilesThatExist) {
    const fs::path root = SEAGLARE_SOURCE_DIR;
    std::ostringstream text;
    text << std::ifstream(root / "README.md").rdbuf();
    const std::string readme = text.str();

    // Links, and paths in code spans.
    const std::regex name(
        R"(\]\(([^):#]+)\)|`((?:scripts|config|plugin_api|host_stub|lightdb|glare|tests)/[^` ]*)`)");
    int names = 0;
    for (std::sregex_iterator match(readme.begin(), readme.end(), name), end; match != end; ++match) {
        const std::string path = (*match)[1].matched ? (*match)[1].str() : (*match)[2].str();
        EXPECT_TRUE(fs::exists(root / path)) << path;
        ++names;
    }
    EXPECT_GE(names, 10) << "the pattern no longer finds what README.md names";
}

}  // namespace
