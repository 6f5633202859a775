// A set of slots that is filled in any order and emptied in ascending order: what is drawn then does not hang on
// how the lights came to be indexed. Filling is O(1) a light, emptying O(lights in it + slots / 4096).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace seaglare::lightdb {

class LightMarks {
  public:
    // Room for slots 0 ... count - 1. The set must be empty.
    void resize(std::size_t count) {
        words_.resize((count + 63) / 64);
        summary_.resize((words_.size() + 63) / 64);
    }
    void mark(std::uint32_t slot) {
        const std::size_t word = slot / 64;
        words_[word] |= std::uint64_t{1} << (slot % 64);
        summary_[word / 64] |= std::uint64_t{1} << (word % 64);
    }
    template <typename Function>
    void take_all(const Function& function) {
        for (std::size_t s = 0; s < summary_.size(); ++s) {
            for (std::uint64_t groups = summary_[s]; groups != 0; groups &= groups - 1) {
                const std::size_t word = s * 64 + static_cast<std::size_t>(std::countr_zero(groups));
                for (std::uint64_t bits = words_[word]; bits != 0; bits &= bits - 1)
                    function(static_cast<std::uint32_t>(word * 64 +
                                                        static_cast<std::size_t>(std::countr_zero(bits))));
                words_[word] = 0;
            }
            summary_[s] = 0;
        }
    }

  private:
    std::vector<std::uint64_t> words_;
    std::vector<std::uint64_t> summary_;  // which words are not 0
};

}  // namespace seaglare::lightdb
