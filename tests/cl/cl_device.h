// What a test that needs OpenCL begins with. Only a machine without a device is skipped: any other error is a failure.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "glare/device/cl_device.h"
#include "glare/device/cl_signal_guard.h"

namespace seaglare::glare {

inline bool says_no_device(const std::string& reason) {
    return reason.find("no platform") != std::string::npos || reason.find("no device") != std::string::npos;
}

// Null where there is none; `reason` says what is missing.
inline std::unique_ptr<ClDevice> cl_device(std::string& reason) {
    const SignalGuard guard;
    try {
        return std::make_unique<ClDevice>();
    } catch (const std::runtime_error& error) {
        reason = error.what();
        return nullptr;
    }
}

// Statements for the body of a test: `name` is a device.
#define SEAGLARE_CL_DEVICE(name)                                          \
    const SignalGuard name##_guard;                                       \
    std::string name##_reason;                                            \
    const auto name = cl_device(name##_reason);                           \
    if (!name && !says_no_device(name##_reason)) FAIL() << name##_reason; \
    if (!name) GTEST_SKIP() << name##_reason

}  // namespace seaglare::glare
