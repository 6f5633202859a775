// Every GL state a host could miss, read one by one, and odd values to put in every slot beforehand. Knows nothing of what
// Seaglare saves.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/gl/headless_context.h"

namespace seaglare::test {

// Name of the state, with its index, to its value or values.
using GlSnapshot = std::map<std::string, std::vector<double>>;
GlSnapshot take_snapshot(const HeadlessContext& context);
// One line for each difference; empty: equal.
std::string differences(const GlSnapshot& before, const GlSnapshot& after);

// Objects of a host that leave no binding point empty. Lives as long as its context.
class PoisonedState {
  public:
    // Sets every slot to something that is not its default and would spoil a picture drawn under it. The framebuffers
    // bound for drawing and reading are odd ones, too.
    explicit PoisonedState(const HeadlessContext& context);
    GLuint program() const { return program_; }

  private:
    GLuint program_ = 0;
};

}  // namespace seaglare::test
