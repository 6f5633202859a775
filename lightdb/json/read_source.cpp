#include "lightdb/json/read_source.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

namespace seaglare::json {

namespace {

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

[[noreturn]] void throw_errno(const std::string& path) {
    throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(), path);
}

// The size that the file system states: a guess that spares copies, since files grow and pipes have none.
std::size_t stated_size(std::FILE* file) {
    struct stat status {};
    if (fstat(fileno(file), &status) != 0 || !S_ISREG(status.st_mode) || status.st_size < 0) return 0;
    return static_cast<std::size_t>(status.st_size);
}

}  // namespace

Error too_large(std::string_view file) {
    return {file, {}, "the text is larger than " + std::to_string(max_text_bytes) + " bytes"};
}

std::unique_ptr<Source> read_source(const std::string& path) {
    errno = 0;
    const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
    if (!file) throw_errno(path);
    const std::size_t stated = stated_size(file.get());
    if (stated > max_text_bytes) throw too_large(path);

    // One byte more than is stated: reading short of it is the end.
    std::size_t room = stated != 0 ? stated + 1 : std::size_t{1} << 16;
    std::size_t size = 0;
    Block buffer = Source::make_buffer(room);
    for (;;) {
        size += std::fread(buffer.get() + size, 1, room - size, file.get());
        if (size < room) break;
        if (size > max_text_bytes) throw too_large(path);
        room = std::min(2 * room, std::size_t{max_text_bytes} + 1);
        Block larger = Source::make_buffer(room);
        std::memcpy(larger.get(), buffer.get(), size);
        buffer = std::move(larger);
    }
    if (std::ferror(file.get()) != 0) throw_errno(path);
    return std::make_unique<Source>(path, std::move(buffer), size);
}

}  // namespace seaglare::json
