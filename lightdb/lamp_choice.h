// From what a file calls a lamp to its spectrum.
//
// A name is one of glare/colour/named_spectra.h ("led_white", "planck:2700"), a table (.csv, .spdx: spectrum_file.h) or a
// spectrum file, JSON with exactly one of the first four keys (config/schema/spectrum.schema.json):
//     { "table": "lamp.spdx",                                      relative to this file
//       "gaussians": [{"peak_nm": 450, "fwhm_nm": 20, "power": 0.9}],  or "sigma_nm"; their sum
//       "planck_k": 2856,
//       "source": "a",                                             another name
//       "filter": "red",                                           a glass before it: named_filter(), or a table
//       "name": "…", "reference": "…" }                            for people
#pragma once

#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "lightdb/light_spectrum.h"

namespace seaglare::lightdb {

// What is wrong with a lamp's name, in words to be put behind the place of it; or with a file, with the place in that.
class LampError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Whether it is the name of a file and not that of a lamp or a glass.
bool is_lamp_file(std::string_view name);

// Lamps that were read, so that equal choices share one.
class LampShelf {
  public:
    // Paths are taken as they are. Throws LampError, std::bad_alloc.
    SharedLamp lamp(const LampChoice& choice);

  private:
    std::map<std::pair<std::string, std::string>, SharedLamp> lamps_;
};

// The lamps of a light that shows these colours, from how its file says it: `chosen` without lamps, whose paths are taken
// as they are. Throws LampError where a lamp is none, and where one lamp cannot serve all the colours.
SharedLightSpectrum resolved(LightSpectrum chosen, const std::array<bool, LightSpectrum::colours>& shown,
                             LampShelf& shelf);

}  // namespace seaglare::lightdb
