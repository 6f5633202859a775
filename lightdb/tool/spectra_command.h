// `seaglare-lights spectra`: which lamps have names, and what a spectrum in a file is.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace seaglare::lights_tool {

struct SpectraRequest {
    std::vector<std::string>
        names;           // of lamps or of files (lightdb/lamp_choice.h); none: every named lamp and glass
    std::string filter;  // a glass before each of them; empty: none
    bool json = false;
};

// One line, or one JSON object, for each lamp: its chromaticity, scotopic per photopic luminance, where half of its light
// lies, the named lamp nearest to it and the region of COLREG Annex I that it lies in. To `out`; what is wrong to `err`. 0:
// done; 1: one of them is no spectrum; 2: a file cannot be read.
int list_spectra(const SpectraRequest& request, std::ostream& out, std::ostream& err);

}  // namespace seaglare::lights_tool
