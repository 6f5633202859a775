// A get_proc whose functions count their calls and then do what they should: one small piece of machine code for each, so
// that no argument list has to be known.
#pragma once

#include <cstdint>
#include <string>

namespace seaglare::test {

class CountedGl {
  public:
    static bool possible();  // on this processor
    static void* get_proc(void* user, const char* name);
    static void reset();
    static std::uint64_t calls();  // of all functions, since reset()
    static std::uint64_t calls_of(const std::string& name);
};

}  // namespace seaglare::test
