// Many short texts in one piece of memory, by pair: name and source of a light. A text costs its bytes and eight.
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace seaglare::lightdb {

class TextPool {
  public:
    using Handle = std::uint32_t;  // 0: both texts are empty

    Handle add(std::string_view first, std::string_view second) {
        if (first.empty() && second.empty()) return 0;
        const std::size_t at = bytes_.size();
        const std::size_t size = head + first.size() + second.size();
        constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
        if (size > most || at > most - size) throw std::length_error("names of lights exceed 4 GB");
        bytes_.reserve(at + size > bytes_.capacity() ? (at + size) / 8 * 9 + 64 : 0);
        append(static_cast<std::uint32_t>(first.size()));
        append(static_cast<std::uint32_t>(second.size()));
        bytes_.append(first).append(second);
        return static_cast<Handle>(at);
    }
    // Valid until the pool changes.
    std::pair<std::string_view, std::string_view> get(Handle handle) const {
        if (handle == 0) return {};
        const std::uint32_t first = length(handle);
        const std::uint32_t second = length(handle + sizeof(std::uint32_t));
        const std::string_view all(bytes_);
        return {all.substr(handle + head, first), all.substr(handle + head + first, second)};
    }
    // The bytes stay until the pool is packed: see wants_packing().
    void forget(Handle handle) {
        if (handle == 0) return;
        const auto [first, second] = get(handle);
        forgotten_ += head + first.size() + second.size();
    }
    bool wants_packing() const { return forgotten_ > bytes_.size() / 2 + 65536; }
    std::size_t memory_bytes() const { return bytes_.capacity(); }

  private:
    static constexpr std::size_t head = 2 * sizeof(std::uint32_t);
    void append(std::uint32_t number) {
        char raw[sizeof number];
        std::memcpy(raw, &number, sizeof number);
        bytes_.append(raw, sizeof raw);
    }
    std::uint32_t length(std::size_t at) const {
        std::uint32_t number = 0;
        std::memcpy(&number, bytes_.data() + at, sizeof number);
        return number;
    }

    std::string bytes_ = std::string(1, '\0');
    std::size_t forgotten_ = 0;
};

}  // namespace seaglare::lightdb
