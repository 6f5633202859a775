// An array that grows without ever moving what it holds: a store of a million lights gets one more without a frame
// waiting for a copy of them all.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace seaglare::lightdb {

template <class T>
class Chunked {
  public:
    static constexpr std::size_t chunk_size = 4096;

    std::size_t size() const { return size_; }
    std::size_t capacity() const {
        return chunks_.empty() ? 0 : (chunks_.size() - 1) * chunk_size + chunks_.back().capacity();
    }
    // Grows only. What is new has the value given.
    void resize(std::size_t count, const T& value = T()) {
        while (size_ < count) {
            if (chunks_.empty() || chunks_.back().size() == chunk_size) {
                chunks_.emplace_back();
                // The first one grows as any vector does: most stores are small.
                if (chunks_.size() > 1) chunks_.back().reserve(chunk_size);
            }
            const std::size_t before = chunks_.back().size();
            const std::size_t more = std::min(count - size_, chunk_size - before);
            chunks_.back().resize(before + more, value);
            size_ += more;
        }
    }
    T& operator[](std::size_t i) { return chunks_[i / chunk_size][i % chunk_size]; }
    const T& operator[](std::size_t i) const { return chunks_[i / chunk_size][i % chunk_size]; }

  private:
    std::vector<std::vector<T>> chunks_;  // all full but the last
    std::size_t size_ = 0;
};

}  // namespace seaglare::lightdb
