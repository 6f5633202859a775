// Small documents in the manner of the public conformance suites, by the rules of RFC 8259: y_ must be accepted, n_ must
// be refused, and i_ is left to the parser (section 9), with what ours decides.
#pragma once

#include <string>
#include <vector>

namespace seaglare::json_conformance {

enum class Verdict { accept, refuse, ours_accepts, ours_refuses };

struct Case {
    std::string name;
    Verdict verdict;
    std::string text;
};

inline std::string repeated(const std::string& text, int count) {
    std::string result;
    for (int i = 0; i < count; ++i)
        result += text;
    return result;
}

}  // namespace seaglare::json_conformance
