// The lamps that hosts name (seaglare_light.spectrum), each made once and shared by all lights that have it.
#pragma once

#include <array>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "lightdb/lamp_choice.h"

namespace seaglare::plugin {

// Any thread.
class NamedLamps {
  public:
    using Colours = std::array<bool, lightdb::LightSpectrum::colours>;

    // What a light that shows these colours has when its lamp is called `name`, as in a light file: one of
    // glare/colour/named_spectra.h. Throws Failure INVALID_ARGUMENT for a name that is none, with what it may have meant.
    lightdb::SharedLightSpectrum find(const std::string& name, const Colours& shown);

  private:
    std::mutex mutex_;
    lightdb::LampShelf shelf_;
    std::map<std::pair<std::string, Colours>, lightdb::SharedLightSpectrum> known_;
};

}  // namespace seaglare::plugin
