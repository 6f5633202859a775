// What a Document owns: the text with its name, and the memory of the tree.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lightdb/json/value.h"

namespace seaglare::json {

// Memory that only grows and goes all at once. What lies in it needs no destructor.
class Arena {
  public:
    // Blocks of this size; what is large beside it gets a block of its own, so that what was begun is not left half empty.
    explicit Arena(std::size_t block_bytes) : block_bytes_(block_bytes) {}

    void* allocate(std::size_t bytes, std::size_t alignment) {
        const std::size_t start = (used_ + alignment - 1) & ~(alignment - 1);
        if (start + bytes > capacity_) return allocate_in_new_block(bytes);
        used_ = start + bytes;
        return block_ + start;
    }

  private:
    void* allocate_in_new_block(std::size_t bytes) {
        const bool of_its_own = bytes > block_bytes_ / 4;
        blocks_.push_back(std::make_unique_for_overwrite<std::byte[]>(of_its_own ? bytes : block_bytes_));
        if (of_its_own) return blocks_.back().get();
        block_ = blocks_.back().get();
        capacity_ = block_bytes_;
        used_ = bytes;
        return block_;
    }

    std::vector<std::unique_ptr<std::byte[]>> blocks_;
    std::byte* block_ = nullptr;
    std::size_t used_ = 0;
    std::size_t capacity_ = 0;
    std::size_t block_bytes_;
};

class Source {
  public:
    // Zero bytes after the text: the parser may read that far ahead, and a zero ends every token.
    static constexpr std::size_t padding_bytes = 16;

    Source(std::string_view file, std::size_t size)
        : file_(file),
          buffer_(std::make_unique_for_overwrite<char[]>(size + padding_bytes)),
          size_(size),
          arena_(std::min<std::size_t>(size / 2 + 256, std::size_t{1} << 20)) {
        std::memset(buffer_.get() + size, 0, padding_bytes);
    }

    const std::string& file() const { return file_; }
    char* data() { return buffer_.get(); }
    std::string_view text() const { return {buffer_.get(), size_}; }
    Arena& arena() { return arena_; }
    Location location(std::size_t offset) const;

  private:
    std::string file_;
    std::unique_ptr<char[]> buffer_;
    std::size_t size_;
    Arena arena_;
};

}  // namespace seaglare::json
