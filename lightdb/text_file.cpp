#include "lightdb/text_file.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace seaglare::lightdb {

std::string read_text_file(const std::string& path, std::size_t most_bytes) {
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    errno = 0;
    const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
    const auto cannot = [&](int code) { return std::system_error(code, std::generic_category(), path); };
    if (!file) throw cannot(errno != 0 ? errno : EIO);
    std::string text;
    std::string piece(std::size_t{64} << 10U, '\0');
    while (const std::size_t got = std::fread(piece.data(), 1, piece.size(), file.get())) {
        text.append(piece, 0, got);
        if (text.size() > most_bytes) throw cannot(EFBIG);
    }
    if (std::ferror(file.get()) != 0) throw cannot(errno != 0 ? errno : EIO);
    return text;
}

bool ends_with_ignoring_case(std::string_view text, std::string_view end) {
    return text.size() >= end.size() &&
           std::equal(end.begin(), end.end(), text.end() - static_cast<std::ptrdiff_t>(end.size()),
                      [](char a, char b) {
                          return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
                      });
}

}  // namespace seaglare::lightdb
