// `seaglare-lights lint`: what is odd in light files that are valid.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace seaglare::lights_tool {

struct LintRequest {
    std::vector<std::string> files;
    bool strict = false;  // findings make the exit status 1
    bool json = false;    // to `out`, for machines
};

// Findings to `out`, one a line, then their counts to `err`. 0: done, whatever was found; 1: a file is wrong, or strict and
// something was found; 2: a file could not be read. Files are compared within themselves and what they include.
int lint_files(const LintRequest& request, std::ostream& out, std::ostream& err);

}  // namespace seaglare::lights_tool
