// The border: no exception and no floating-point environment crosses it, in either direction.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <system_error>

#include "glare/device/gl.h"
#include "lightdb/json/value.h"
#include "plugin_api/context.h"
#include "plugin_api/failure.h"
#include "plugin_api/fp_environment.h"

namespace seaglare::plugin {

// Keeps the text where copy_last_error finds it. context may be NULL.
void report_result(Context* context, seaglare_result code, const char* text) noexcept;

// Runs one call of the interface; what it throws becomes the result code with its text.
template <class Body>
seaglare_result at_border(Context* context, Body&& body) noexcept {
    const FpEnvironment ours;
    seaglare_result code = SEAGLARE_ERROR_INTERNAL;
    try {
        try {
            return body();
        } catch (const Failure& failure) {
            report_result(context, failure.code(), failure.what());
            return failure.code();
        } catch (const json::Error& error) {
            code = SEAGLARE_ERROR_PARSE;
            report_result(context, code, error.what());
        } catch (const glare::GlTooOld& error) {
            code = SEAGLARE_ERROR_UNSUPPORTED;
            report_result(context, code, error.what());
        } catch (const glare::GlError& error) {
            code = SEAGLARE_ERROR_GL;
            report_result(context, code, error.what());
        } catch (const std::system_error& error) {
            code = SEAGLARE_ERROR_FILE;
            report_result(context, code, error.what());
        } catch (const std::bad_alloc&) {
            code = SEAGLARE_ERROR_OUT_OF_MEMORY;
            report_result(context, code, "out of memory");
        } catch (const std::invalid_argument& error) {
            code = SEAGLARE_ERROR_INVALID_ARGUMENT;
            report_result(context, code, error.what());
        } catch (const std::exception& error) {
            code = SEAGLARE_ERROR_INTERNAL;
            report_result(context, code, error.what());
        }
    } catch (...) {
        report_result(context, SEAGLARE_ERROR_INTERNAL, "an exception of unknown type");
    }
    return code;
}

}  // namespace seaglare::plugin
