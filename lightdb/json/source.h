// What a Document owns: the text with its name, and the memory of the tree.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightdb/json/value.h"

namespace seaglare::json {

// A piece of memory for text or tree; not cleared.
using Block = std::unique_ptr<char[]>;

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
        blocks_.push_back(std::make_unique_for_overwrite<char[]>(of_its_own ? bytes : block_bytes_));
        if (of_its_own) return blocks_.back().get();
        block_ = blocks_.back().get();
        capacity_ = block_bytes_;
        used_ = bytes;
        return block_;
    }

    std::vector<Block> blocks_;
    char* block_ = nullptr;
    std::size_t used_ = 0;
    std::size_t capacity_ = 0;
    std::size_t block_bytes_;
};

class Source {
  public:
    // Zero bytes after the text: the parser may read that far ahead, and a zero ends every token.
    static constexpr std::size_t padding_bytes = 16;

    // Room for `size` bytes of text and the zeros behind them, which the constructor writes.
    static Block make_buffer(std::size_t size) {
        return std::make_unique_for_overwrite<char[]>(size + padding_bytes);
    }

    // `buffer` holds `size` bytes of text and has room for the padding.
    Source(std::string_view file, Block buffer, std::size_t size)
        : file_(file),
          buffer_(std::move(buffer)),
          size_(size),
          arena_(std::min(size / 2 + 256, largest_block_bytes)) {
        std::memset(buffer_.get() + size, 0, padding_bytes);
    }

    const std::string& file() const { return file_; }
    std::string_view text() const { return {buffer_.get(), size_}; }
    Arena& arena() { return arena_; }
    Location location(std::size_t offset) const;

  private:
    // Small enough for malloc to hand the same memory to the next document: what comes fresh from the kernel costs a fault
    // a page, which together take longer than parsing.
    static constexpr std::size_t largest_block_bytes = std::size_t{1} << 20;

    std::string file_;
    Block buffer_;
    std::size_t size_;
    Arena arena_;
};

}  // namespace seaglare::json
