// What making a pattern must not do to the process it is a guest of.
#include <clocale>
#include <csignal>
#include <cstring>

#include "glare/device/cl_device.h"
#include "tests/cl/pattern_fixture.h"

namespace seaglare::glare {
namespace {

void hosts_handler(int) {}

struct Handlers {
    std::vector<std::pair<bool, struct sigaction>> actions;
    sigset_t mask{};
    Handlers() {
        for (int number = 1; number <= SIGRTMAX; ++number) {
            struct sigaction action = {};
            const bool known = sigaction(number, nullptr, &action) == 0;
            actions.emplace_back(known, action);
        }
        sigprocmask(SIG_SETMASK, nullptr, &mask);
    }
};

void expect_same(const Handlers& before, const char* when) {
    const Handlers now;
    for (std::size_t i = 0; i < now.actions.size(); ++i) {
        if (!before.actions[i].first) continue;
        const auto& a = before.actions[i].second;
        const auto& b = now.actions[i].second;
        EXPECT_EQ(a.sa_handler, b.sa_handler) << when << ": signal " << i + 1;
        // The C library adds SA_RESTORER whenever an action is set, the default ones that PoCL replaced included.
        constexpr int restorer = 0x04000000;
        EXPECT_EQ(a.sa_flags | restorer, b.sa_flags | restorer) << when << ": signal " << i + 1;
        for (int s = 1; s <= SIGRTMAX; ++s)
            EXPECT_EQ(sigismember(&a.sa_mask, s), sigismember(&b.sa_mask, s)) << when << ": signal " << i + 1;
    }
    for (int s = 1; s <= SIGRTMAX; ++s)
        EXPECT_EQ(sigismember(&before.mask, s), sigismember(&now.mask, s)) << when << ": mask " << s;
}

TEST(HostProcess, SignalHandlersAndLocaleAreTheHosts) {
    // As a host with a crash reporter would: PoCL 3.1 replaces these inside clGetDeviceIDs.
    for (int number : {SIGSEGV, SIGFPE, SIGTERM, SIGUSR1}) {
        struct sigaction action = {};
        action.sa_handler = hosts_handler;
        sigemptyset(&action.sa_mask);
        sigaddset(&action.sa_mask, SIGUSR2);
        ASSERT_EQ(sigaction(number, &action, nullptr), 0);
    }
    if (std::setlocale(LC_ALL, "C.UTF-8") == nullptr) GTEST_SKIP() << "no locale C.UTF-8 here";
    const std::string locale_name = std::setlocale(LC_ALL, nullptr);
    const locale_t thread_locale = uselocale(nullptr);
    const Handlers before;

    PatternSettings settings;
    settings.transform_size = 256;
    SEAGLARE_CL_SOURCE(source, young_eye(), settings, sample_d65(5));
    expect_same(before, "after making the source");
    source->warm_up(1 / 869.1);
    expect_same(before, "after warming up");
    PatternRequest request;
    request.pupil_mm = 6;
    request.pitch = 1 / 869.1;
    source->make(request);
    expect_same(before, "after a pattern");
    EXPECT_EQ(std::setlocale(LC_ALL, nullptr), locale_name);
    EXPECT_EQ(uselocale(nullptr), thread_locale);
}

TEST(HostProcess, ErrorsNameTheCallAndTheCode) {
    const ClError error("clCreateBuffer(skirt)", CL_OUT_OF_RESOURCES);
    EXPECT_STREQ(error.what(), "OpenCL: clCreateBuffer(skirt) failed with CL_OUT_OF_RESOURCES");
    EXPECT_EQ(cl_code_name(-9999), "-9999");
}

TEST(HostProcess, SettingsThatCannotWorkAreRefusedByName) {
    PatternSettings settings;
    settings.transform_size = 500;
    EXPECT_THROW(make_cl_pattern_source(young_eye(), settings, 1), std::invalid_argument);
    settings = {};
    settings.plane_width_mm = 0;
    EXPECT_THROW(make_cl_pattern_source(young_eye(), settings, 1), std::invalid_argument);
}

}  // namespace
}  // namespace seaglare::glare
