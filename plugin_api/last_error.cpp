#include "plugin_api/last_error.h"

#include <algorithm>
#include <cstring>

namespace seaglare::plugin {

namespace {

// Trivial, so that no thread-exit destructor pins the library after dlclose.
thread_local char contextless[1024] = "";

}  // namespace

void LastError::set(std::string_view text) {
    const std::lock_guard lock(mutex_);
    const auto self = std::this_thread::get_id();
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.thread == self; });
    if (found != entries_.end()) {
        found->text = text;
        return;
    }
    if (entries_.size() == most_threads) entries_.erase(entries_.begin());
    entries_.push_back({self, std::string(text)});
}

std::string LastError::get() const {
    const std::lock_guard lock(mutex_);
    const auto self = std::this_thread::get_id();
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.thread == self; });
    return found == entries_.end() ? std::string() : found->text;
}

void copy_text(std::string_view text, char* buffer, std::size_t size) noexcept {
    std::size_t length = std::min(text.size(), size - 1);
    if (length < text.size()) {
        // 10xxxxxx continues a character: step back to where it begins.
        while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U)
            --length;
    }
    if (length > 0) std::memcpy(buffer, text.data(), length);
    buffer[length] = '\0';
}

void set_contextless_error(std::string_view text) noexcept {
    copy_text(text, contextless, sizeof contextless);
}

std::string_view contextless_error() noexcept {
    return contextless;
}

}  // namespace seaglare::plugin
