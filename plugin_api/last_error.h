// The text of the last error, per thread: of one context, and of calls that have none (create, get_api).
#pragma once

#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace seaglare::plugin {

class LastError {
  public:
    void set(std::string_view text);
    std::string get() const;  // of the calling thread; empty when it has had none

  private:
    struct Entry {
        std::thread::id thread;
        std::string text;
    };
    // Threads come and go and none tells us: the oldest text makes room.
    static constexpr std::size_t most_threads = 256;
    mutable std::mutex mutex_;
    std::vector<Entry> entries_;
};

// Of calls without a context. Cut to 1023 bytes.
void set_contextless_error(std::string_view text) noexcept;
std::string_view contextless_error() noexcept;

// Copies `text` with its null into `size` bytes, cut at a whole UTF-8 character. size > 0.
void copy_text(std::string_view text, char* buffer, std::size_t size) noexcept;

}  // namespace seaglare::plugin
