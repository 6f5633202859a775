// The symbol table of the library, as the loader sees it.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>

namespace {

std::string output_of(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::string text;
    std::array<char, 4096> buffer{};
    while (pipe != nullptr && std::fgets(buffer.data(), buffer.size(), pipe.get()) != nullptr)
        text += buffer.data();
    return text;
}

TEST(Symbols, OneIsExported) {
    const std::string table = output_of("nm -D --defined-only --without-symbol-versions " SEAGLARE_LIBRARY);
    ASSERT_FALSE(table.empty()) << "nm gave nothing";
    std::string functions;
    for (std::size_t at = 0; at < table.size();) {
        const std::size_t end = table.find('\n', at);
        const std::string line = table.substr(at, end - at);
        at = end + 1;
        // The version's own name is an absolute symbol (A): no code or data of ours.
        if (line.find(" A ") == std::string::npos)
            functions += line.substr(line.find_last_of(' ') + 1) + "\n";
    }
    EXPECT_EQ(functions, "seaglare_get_api\n");
}

TEST(Symbols, NoGlFunctionIsAskedOfTheLoader) {
    // A host may have no libGL of that name, or another one: every entry point comes from its get_proc.
    const std::string undefined = output_of("nm -D --undefined-only " SEAGLARE_LIBRARY);
    ASSERT_FALSE(undefined.empty());
    EXPECT_EQ(undefined.find(" gl"), std::string::npos) << undefined;
    EXPECT_EQ(undefined.find(" egl"), std::string::npos) << undefined;
    EXPECT_EQ(undefined.find("fftw"), std::string::npos) << "FFTW is GPL and must not be linked";
    const std::string needed = output_of("readelf -d " SEAGLARE_LIBRARY);
    EXPECT_EQ(needed.find("libGL"), std::string::npos);
    EXPECT_EQ(needed.find("libEGL"), std::string::npos);
    EXPECT_NE(needed.find("libseaglare.so.1"), std::string::npos)
        << "the soname carries the ABI's major version";
}

}  // namespace
