// What to do about a mistake in a file: loading ends at the first, checking writes it down and goes on.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lightdb/json/value.h"

namespace seaglare::lightdb {

class Mistakes {
  public:
    enum class Policy { stop_at_first, collect };
    // Nobody reads more, and finding the line of each reads the text up to it.
    static constexpr std::size_t most_collected = 200;

    explicit Mistakes(Policy policy) : policy_(policy) {}

    // Runs a part of the reading. Its json::Error ends everything (stop_at_first) or is kept, and the answer is false.
    template <class Part>
    bool attempt(const Part& part) {
        if (policy_ == Policy::stop_at_first) {
            part();
            return true;
        }
        try {
            part();
            return true;
        } catch (const json::Error& error) {
            add(error.what());
            return false;
        }
    }

    bool full() const { return texts_.size() >= most_collected; }
    const std::vector<std::string>& texts() const { return texts_; }  // "FILE:LINE:COL: text"

  private:
    void add(std::string_view text) {
        for (const std::string& known : texts_) {
            if (known == text) return;
        }
        if (!full()) texts_.emplace_back(text);
    }

    Policy policy_;
    std::vector<std::string> texts_;
};

}  // namespace seaglare::lightdb
