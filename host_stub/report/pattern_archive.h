// Reference patterns on disk: the slow part of a report is made once.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "glare/reference/frame_shape.h"

namespace seaglare::report {

// A maker that keeps what reference::make_reference returns in files of `folder`, named by a hash of everything that it
// depends on: the aperture's geometry, the spectra, the pixels. Files of another machine's byte order, or cut short, are
// made anew. `progress` gets what is being done and the fraction done. The folder is created when something is kept.
reference::PatternMaker archived_patterns(std::filesystem::path folder,
                                          std::function<void(const std::string&, double)> progress);

}  // namespace seaglare::report
