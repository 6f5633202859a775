// How code inside the library reports what a caller must do: thrown anywhere, turned into a result code at the border.
#pragma once

#include <stdexcept>
#include <string>

#include "plugin_api/seaglare.h"

namespace seaglare::plugin {

class Failure : public std::runtime_error {
  public:
    Failure(seaglare_result code, const std::string& text) : std::runtime_error(text), code_(code) {}
    seaglare_result code() const { return code_; }

  private:
    seaglare_result code_;
};

[[noreturn]] inline void invalid_argument(const std::string& text) {
    throw Failure(SEAGLARE_ERROR_INVALID_ARGUMENT, text);
}

}  // namespace seaglare::plugin
