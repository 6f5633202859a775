// What belongs to the process and the thread, and not to a library: locale, signal handlers, floating-point environment.
#include <gtest/gtest.h>

#include <dlfcn.h>

#include <array>
#include <cfenv>
#include <clocale>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#include "tests/abi/loaded_plugin.h"

namespace {

using namespace seaglare::test;

// A life with everything that needs no GL.
void live(const LoadedPlugin& plugin, std::uint32_t flags, seaglare_log_fn log = nullptr) {
    const TemporaryFile quality("quality.json", small_quality);
    auto info = sized<seaglare_create_info>();
    info.flags = flags;
    info.config_path = quality.path();
    info.log = log;
    seaglare_context* context = nullptr;
    ASSERT_GE(plugin->create(&info, &context), 0) << plugin.last_error(nullptr);
    auto light = sized<seaglare_light>();
    light.nominal_range_nm = 10;
    light.character = "Fl(2+1) R 12.5s";
    EXPECT_EQ(plugin->add_light(context, &light, nullptr), SEAGLARE_OK) << plugin.last_error(context);
    EXPECT_EQ(plugin->load_lights(context, "/nonexistent"), SEAGLARE_ERROR_FILE);
    EXPECT_EQ(plugin->destroy(context), SEAGLARE_OK);
}

using Handlers = std::array<struct sigaction, 32>;
Handlers signal_handlers() {
    Handlers handlers{};
    for (int signal = 1; signal < static_cast<int>(handlers.size()); ++signal)
        sigaction(signal, nullptr, &handlers[static_cast<std::size_t>(signal)]);
    return handlers;
}

TEST(Environment, SignalHandlersAreUnchanged) {
    const LoadedPlugin plugin;
    const Handlers before = signal_handlers();
    live(plugin, 0);
    const Handlers after = signal_handlers();
    for (std::size_t signal = 1; signal < before.size(); ++signal) {
        EXPECT_EQ(before[signal].sa_handler, after[signal].sa_handler) << "signal " << signal;
        // SA_RESTORER is the C library's own: it is there once anybody has called sigaction.
        constexpr int restorer = 0x04000000;
        EXPECT_EQ(before[signal].sa_flags | restorer, after[signal].sa_flags | restorer)
            << "signal " << signal;
    }
}

TEST(Environment, TheLocaleIsUnchangedAndNotObeyed) {
    const LoadedPlugin plugin;
    // A comma for a decimal point breaks numbers that are read or written with the locale.
    if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr && std::setlocale(LC_ALL, "da_DK.UTF-8") == nullptr)
        std::setlocale(LC_ALL, "C.UTF-8");
    const std::string before = std::setlocale(LC_ALL, nullptr);
    live(plugin, 0);
    EXPECT_EQ(std::setlocale(LC_ALL, nullptr), before);
    std::setlocale(LC_ALL, "C");
}

TEST(Environment, FloatingPointTrapsRoundingAndFlagsAreUnchanged) {
    const LoadedPlugin plugin;
    std::feclearexcept(FE_ALL_EXCEPT);
    std::fesetround(FE_UPWARD);
    std::feraiseexcept(FE_INEXACT);
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
#if defined(__x86_64__)
    const unsigned control = _mm_getcsr() | 0x8040U;  // flush to zero, denormals are zero
    _mm_setcsr(control);
#endif
    live(plugin, SEAGLARE_CREATE_NO_OPENCL);
#if defined(__x86_64__)
    EXPECT_EQ(_mm_getcsr() | 0x20U,
              control | 0x20U);  // but for "inexact", which the test's own arithmetic may set
#endif
    EXPECT_EQ(fegetexcept(), FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
    EXPECT_EQ(std::fegetround(), FE_UPWARD);
    EXPECT_EQ(std::fetestexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW | FE_UNDERFLOW), 0);
    fedisableexcept(FE_ALL_EXCEPT);
    std::fesetenv(FE_DFL_ENV);
}

TEST(Environment, AHostsCallbackRunsInTheHostsFloatingPointEnvironment) {
    const LoadedPlugin plugin;
    static int rounding_seen;
    rounding_seen = -1;
    std::fesetround(FE_DOWNWARD);
    live(plugin, SEAGLARE_CREATE_NO_OPENCL,
         [](void*, std::int32_t, const char*) { rounding_seen = std::fegetround(); });
    std::fesetenv(FE_DFL_ENV);
    EXPECT_EQ(rounding_seen, FE_DOWNWARD) << "-1: the log was never called";
}

TEST(Environment, TheLibraryCanBeOpenedAndClosedAgain) {
    for (int cycle = 0; cycle < 5; ++cycle) {
        const LoadedPlugin plugin;
        live(plugin, cycle % 2 == 0 ? SEAGLARE_CREATE_NO_OPENCL : 0);
    }
    // Without OpenCL, whose threads keep their libraries, a closed library is gone, also for threads that used it.
    void* still = dlopen(SEAGLARE_LIBRARY, RTLD_NOW | RTLD_NOLOAD);
    if (still != nullptr) {
        dlclose(still);
        GTEST_SKIP() << "an OpenCL driver keeps the library loaded";
    }
}

TEST(Environment, EachThreadHasItsOwnLastError) {
    const LoadedPlugin plugin;
    const QuickContext context(plugin);
    EXPECT_EQ(plugin->remove_light(context, 5), SEAGLARE_ERROR_STALE_ID);
    const std::string mine = plugin.last_error(context);
    std::string other = "not run";
    std::thread([&] {
        other = plugin.last_error(context);
        plugin->load_lights(context, nullptr);
    }).join();
    EXPECT_EQ(other, "");
    EXPECT_EQ(plugin.last_error(context), mine);
    EXPECT_NE(mine, "");
}

TEST(Environment, WithoutOpenClTheContextIsDegradedAndSaysWhy) {
    const LoadedPlugin plugin;
    const QuickContext asked(plugin);
    EXPECT_EQ(asked.created(), SEAGLARE_DEGRADED);
    EXPECT_NE(plugin.last_error(nullptr).find("made on the CPU"), std::string::npos);
    EXPECT_NE(plugin.last_error(asked).find("OpenCL was not asked for"), std::string::npos)
        << plugin.last_error(asked);
}

}  // namespace

// In a process of its own, because the OpenCL loader reads its environment once.
TEST(NoOpenClDriver, TheContextIsDegradedAndSaysWhy) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        {
            setenv("OCL_ICD_VENDORS", "/nonexistent", 1);
            setenv("OPENCL_VENDOR_PATH", "/nonexistent", 1);
            const LoadedPlugin plugin;
            const QuickContext context(plugin, 0);
            const bool right = context.created() == SEAGLARE_DEGRADED && !plugin.last_error(context).empty();
            std::exit(right ? 0 : 1);
        },
        ::testing::ExitedWithCode(0), "");
}
