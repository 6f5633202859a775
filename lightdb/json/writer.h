// Writes JSON: pretty, stable (the same data give the same bytes), and exact (a number read back is the same
// double).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightdb/json/value.h"

namespace seaglare::json {

// Calls in the order of the text: `writer.begin_object(); writer.key("a"); writer.value(1.5);
// writer.end_object();`. Precondition: the calls describe one JSON value; debug builds assert it.
class Writer {
  public:
    // Containers opened with `Layout::line` are written on one line: for coordinates and short tables.
    enum class Layout { block, line };

    void begin_object(Layout layout = Layout::block) { begin('{', layout); }
    void end_object() { end('}'); }
    void begin_array(Layout layout = Layout::block) { begin('[', layout); }
    void end_array() { end(']'); }
    void key(std::string_view name);

    void value(
        double number);  // shortest text that reads back as the same double; NaN and infinity become null
    void value(std::string_view text);  // must be UTF-8; what is not becomes U+FFFD
    void value(const char* text) { value(std::string_view(text)); }
    void value(bool boolean);
    void value(const Value& tree);  // a whole parsed value
    void null();

    template <class T>
    void member(std::string_view name, const T& of) {
        key(name);
        value(of);
    }

    // The text so far, with a line feed at its end.
    std::string take();

  private:
    struct Level {
        bool inline_ = false;
        bool empty = true;
    };
    void begin(char bracket, Layout layout);
    void end(char bracket);
    void before_value();
    void line_break();
    void quote(std::string_view text);

    std::string text_;
    std::vector<Level> levels_;
    bool after_key_ = false;
};

}  // namespace seaglare::json
