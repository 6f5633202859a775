// Many short texts in large pages, by pair: name and source of a light. A pair costs its bytes and eight. What is there is
// never moved: adding one to a million takes no longer than adding the first.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace seaglare::lightdb {

class TextPool {
  public:
    using Handle = std::uint32_t;  // 0: both texts are empty; else page * page_size + place in it + 1

    Handle add(std::string_view first, std::string_view second) {
        if (first.empty() && second.empty()) return 0;
        constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
        const std::size_t size = head + first.size() + second.size();
        if (pages_.empty() || pages_.back().size() + size > page_size) {
            // A pair larger than a page has one of its own, that is longer.
            if (pages_.size() >= most / page_size || first.size() > most || second.size() > most)
                throw std::length_error("names of lights exceed 4 GB");
            pages_.emplace_back();
            // The first one grows as any text does: most pools are small.
            if (pages_.size() > 1) pages_.back().reserve(std::max(size, page_size));
        }
        std::string& page = pages_.back();
        const std::size_t at = page.size();
        append(page, static_cast<std::uint32_t>(first.size()));
        append(page, static_cast<std::uint32_t>(second.size()));
        page.append(first).append(second);
        bytes_ += size;
        return static_cast<Handle>((pages_.size() - 1) * page_size + at + 1);
    }
    // Valid until the pool changes.
    std::pair<std::string_view, std::string_view> get(Handle handle) const {
        if (handle == 0) return {};
        const std::string_view page = pages_[(handle - 1) / page_size];
        const std::size_t at = (handle - 1) % page_size;
        const std::uint32_t first = length(page, at);
        const std::uint32_t second = length(page, at + sizeof(std::uint32_t));
        return {page.substr(at + head, first), page.substr(at + head + first, second)};
    }
    // The bytes stay until the pool is packed: see wants_packing().
    void forget(Handle handle) {
        if (handle == 0) return;
        const auto [first, second] = get(handle);
        forgotten_ += head + first.size() + second.size();
    }
    bool wants_packing() const { return forgotten_ > bytes_ / 2 + 65536; }
    std::size_t memory_bytes() const {
        std::size_t bytes = pages_.capacity() * sizeof(std::string);
        for (const std::string& page : pages_)
            bytes += page.capacity();
        return bytes;
    }

  private:
    static constexpr std::size_t head = 2 * sizeof(std::uint32_t);
    static constexpr std::size_t page_size = 65536;
    static void append(std::string& page, std::uint32_t number) {
        char raw[sizeof number];
        std::memcpy(raw, &number, sizeof number);
        page.append(raw, sizeof raw);
    }
    static std::uint32_t length(std::string_view page, std::size_t at) {
        std::uint32_t number = 0;
        std::memcpy(&number, page.data() + at, sizeof number);
        return number;
    }

    std::vector<std::string> pages_;
    std::size_t bytes_ = 0;
    std::size_t forgotten_ = 0;
};

}  // namespace seaglare::lightdb
