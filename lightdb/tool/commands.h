// What `seaglare-lights` does, apart from its command line: each command returns the exit status, prints results to
// `out` and what went wrong to `err`.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace seaglare::lights_tool {

// 0: done and nothing wrong; 1: the input is wrong; 2: a file could not be read or written.
int validate(const std::vector<std::string>& files, std::ostream& out, std::ostream& err);
int check_json(const std::string& file, std::ostream& err);

// A light's character explained as JSON, or written as charts do. `phases` or `sigseq` (one at most) take the place of the
// durations in the text: see lightdb/phase_list.h.
struct CharacterRequest {
    std::string text;
    std::string phases;        // "fl. 0.8s, ec. 2.2s", or JSON
    std::string sigseq;        // "00.8+(02.2)"
    bool format_only = false;  // the notation to `out`, warnings to `err`
};
int explain_character(const CharacterRequest& request, std::ostream& out, std::ostream& err);
int explain_character(const std::string& text, std::ostream& out, std::ostream& err);

}  // namespace seaglare::lights_tool
