#include "lightdb/import/nga_remarks.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "lightdb/import/nga_text.h"

namespace seaglare::lightdb::nga {
namespace {

std::string lower_case(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}
bool starts_with(std::string_view text, std::string_view part) {
    return text.substr(0, part.size()) == part;
}

// What belongs to radar, to sound or to the structure.
bool says_nothing_of_light(std::string_view low) {
    static constexpr std::array<std::string_view, 12> words{
        "radar reflector", "racon", "(3 & 10cm)", "(3cm)", "(10cm)", "ais ",
        "pilot station",   "siren", "horn",       "bell",  "dgps",   "wind generator"};
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return starts_with(low, word); });
}

// "(unintensified)", "(intensified)", "(6M)"; false when the bracket says something else.
bool read_qualifier(Cursor& cursor, Arc& arc) {
    const std::size_t start = cursor.at();
    if (!cursor.take('(')) return true;
    if (cursor.take("unintensified")) {
        arc.strength = Strength::unintensified;
    } else if (cursor.take("intensified")) {
        arc.strength = Strength::intensified;
    } else if (const auto range = cursor.number(); range && *range > 0 && *range <= 38 && cursor.take('M')) {
        arc.range_nm = *range;
    } else {
        cursor.go_to(start);
        return false;
    }
    if (cursor.take(')')) return true;
    cursor.go_to(start);
    return false;
}

// Reads "a-b", "-b" (from where the last one ended) or, as a slip of the pen, "b" and "-a-b".
enum class ArcResult { read, no_start, nothing };
ArcResult read_limits(Cursor& cursor, std::optional<double>& last_end, Arc& arc) {
    const std::size_t start = cursor.at();
    if (!cursor.take('-')) cursor.take("\xE2\x80\x93");  // an en dash in some volumes
    const auto first = cursor.bearing_deg();
    if (!first) return cursor.go_to(start), ArcResult::nothing;
    const std::size_t after_first = cursor.at();
    if (cursor.take('-') || cursor.take("\xE2\x80\x93") || cursor.take("to ")) {
        if (const auto second = cursor.bearing_deg()) {
            arc.from_deg = *first;
            arc.to_deg = *second;
            last_end = *second;
            return ArcResult::read;
        }
        cursor.go_to(after_first);
    }
    const std::optional<double> from = last_end;
    last_end = *first;
    if (!from) return ArcResult::no_start;
    arc.from_deg = *from;
    arc.to_deg = *first;
    return ArcResult::read;
}

// The class before a sector's colour: "Oc.(2)", "F.", "L.Fl.", "Al.". Empty when a colour stands there at once.
std::string read_class(Cursor& cursor) {
    static constexpr std::array<std::string_view, 8> classes{"L.Fl.", "Al.",  "Iso.", "Fl.",
                                                             "Oc.",   "V.Q.", "Q.",   "F."};
    cursor.skip_blanks();
    for (const std::string_view word : classes) {
        if (!starts_with(cursor.rest(), word)) continue;
        std::string text(word);
        cursor.go_to(cursor.at() + word.size());
        if (cursor.peek() == '(' && std::isdigit(static_cast<unsigned char>(cursor.peek(1))) != 0)
            while (!cursor.at_end()) {
                text += cursor.peek();
                cursor.step();
                if (text.back() == ')') break;
            }
        return text;
    }
    return {};
}

class RemarksReader {
  public:
    explicit RemarksReader(std::string_view text) : text_(text), cursor_(text) {}

    Remarks read() {
        for (;;) {
            while (!cursor_.at_end() &&
                   (cursor_.peek() == '.' || cursor_.peek() == ',' || cursor_.peek() == ' ' ||
                    cursor_.peek() == '\n' || cursor_.peek() == '\t'))
                cursor_.step();
            if (cursor_.at_end()) return std::move(out_);
            if (!read_sector()) read_sentence();
        }
    }

  private:
    bool read_sector() {
        const std::size_t start = cursor_.at();
        const std::optional<double> last_end = last_end_;
        SectorItem item;
        const bool partly = cursor_.take("partially obscured");
        const bool obscured = !partly && (cursor_.take("obscured") || cursor_.take("obsc."));
        if (!partly && !obscured) {
            item.light_class = read_class(cursor_);
            while (const auto colour = cursor_.colour())
                item.colours.push_back(*colour);
            if (item.colours.empty()) return cursor_.go_to(start), false;
        }
        // "obsc.-039°" continues a chain; "Obscured 010°-020°" is a sentence of its own over whatever colour is there.
        if (obscured && !cursor_.take('-') && !out_.sectors.empty()) return cursor_.go_to(start), false;
        if (obscured) cursor_.go_to(start), cursor_.take("obscured") || cursor_.take("obsc.");
        if (partly && !last_end_) return cursor_.go_to(start), false;
        if (!read_qualifier(cursor_, item.arc)) return cursor_.go_to(start), false;
        std::optional<double> end = last_end_;
        switch (read_limits(cursor_, end, item.arc)) {
            case ArcResult::nothing:
                last_end_ = last_end;
                return cursor_.go_to(start), false;
            case ArcResult::no_start:
                last_end_ = end;
                out_.doubts.push_back("a sector has no first limit: '" + piece(start) + "'");
                return true;
            case ArcResult::read:
                break;
        }
        if (partly) {
            note_partly(start);
            return true;
        }
        last_end_ = end;
        out_.sectors.push_back(std::move(item));
        return true;
    }

    std::string piece(std::size_t start) const {
        return std::string(text_.substr(start, cursor_.at() - start));
    }
    void note_partly(std::size_t start) { out_.seen_sometimes.push_back(piece(start)); }

    // To a line break, or a dot that ends a sentence: not the one in "Sep. 1", "F.R." or "W. end".
    std::string_view take_sentence() {
        const std::size_t start = cursor_.at();
        std::size_t end = start;
        for (; end < text_.size() && text_[end] != '\n'; ++end) {
            if (text_[end] != '.') continue;
            std::size_t blanks = 0;
            while (end + 1 + blanks < text_.size() && text_[end + 1 + blanks] == ' ')
                ++blanks;
            if (blanks >= 2 || end + 1 + blanks >= text_.size()) break;
        }
        cursor_.go_to(end);
        return text_.substr(start, end - start);
    }

    void read_sentence() {
        const std::string_view sentence = take_sentence();
        const std::string low = lower_case(sentence);
        const bool all_day = contains(low, "shown 24 hours") && !contains(low, "nov.") &&
                             !contains(low, "sep.") && !contains(low, "apr.");
        if (all_day) out_.all_day = true;
        if (starts_with(low, "visible") || contains(low, "visible on range line only"))
            return read_visible(sentence, low);
        if (contains(low, "intensified on range line") || contains(low, "intensified) on range line"))
            return out_.intensified_on_range_line = true, void();
        if (starts_with(low, "intensified") || starts_with(low, "sectors intensified"))
            return read_arcs(sentence, out_.intensified);
        if (starts_with(low, "unintensified")) return read_arcs(sentence, out_.unintensified);
        if (starts_with(low, "not shown") && contains(low, "-")) return read_arcs(sentence, out_.obscured);
        if (starts_with(low, "obscured") || starts_with(low, "obsc.")) {
            if (contains(low, "within")) return out_.seen_sometimes.emplace_back(sentence), void();
            return read_arcs(sentence, out_.obscured);
        }
        if (contains(low, "synchronized")) return read_sync(sentence, low);
        if (contains(low, "occasional") || contains(low, "on request") || contains(low, "reserve light") ||
            contains(low, "partially obs") || contains(low, "fog light") || contains(low, "when required") ||
            contains(low, "seasonal") || contains(low, "fishing light") || contains(low, "shown in fog") ||
            starts_with(low, "shown by day") || starts_with(low, "shows bearing"))
            return out_.seen_sometimes.emplace_back(sentence), void();
        if (!all_day && !says_nothing_of_light(low))
            out_.unread.emplace_back(sentence.substr(0, sentence.find_last_not_of(" .") + 1));
    }

    void read_visible(std::string_view sentence, const std::string& low) {
        if (contains(low, "by day") || contains(low, "illuminates")) return;
        if (contains(low, "on range line only")) return out_.range_line_only = true, void();
        if (contains(low, "on range") && contains(low, "only")) {
            out_.range_line_only = true;
            Cursor cursor(sentence);
            while (!cursor.at_end())
                if (const auto bearing = cursor.bearing_deg()) {
                    out_.range_line_deg.push_back(*bearing);
                } else {
                    cursor.step();
                }
            return;
        }
        if (contains(low, "faintly visible elsewhere")) out_.faint_elsewhere = true;
        const std::size_t partly = low.find("partially obscured");
        read_arcs(sentence.substr(0, partly), out_.visible);
        if (partly != std::string::npos) out_.seen_sometimes.emplace_back(sentence.substr(partly));
    }

    // Every "(6M) a-b" and ", (unintensified)-c" of a sentence.
    void read_arcs(std::string_view sentence, std::vector<Arc>& arcs) {
        Cursor cursor(sentence);
        std::optional<double> last_end;
        std::size_t found = 0;
        bool lone_limit = false;
        while (!cursor.at_end()) {
            Arc arc;
            const std::size_t start = cursor.at();
            if (cursor.take("intensified") && found > 0) {
                arc.strength = Strength::intensified;
            } else {
                cursor.go_to(start);
                if (cursor.peek() == '(') read_qualifier(cursor, arc);
            }
            const ArcResult result = read_limits(cursor, last_end, arc);
            if (result == ArcResult::read) {
                ++found;
                arcs.push_back(arc);
            } else if (result == ArcResult::no_start) {
                lone_limit = true;
            } else {
                cursor.go_to(start);
                if (!cursor.number()) cursor.go_to(start + 1);  // a whole figure at a time
            }
        }
        if (lone_limit) out_.doubts.push_back("an arc has one limit only: '" + std::string(sentence) + "'");
        if (found == 0 && !lone_limit)
            out_.doubts.push_back("not understood: '" + std::string(sentence) + "'");
    }

    void read_sync(std::string_view sentence, const std::string& low) {
        bool named = false;
        if (contains(low, "front")) named = out_.sync_with_front = true;
        if (contains(low, "rear")) named = out_.sync_with_rear = true;
        if (contains(low, "shoulder")) out_.sync_with_front = out_.sync_with_rear = named = false;
        for (std::size_t i = 0; i < sentence.size();) {
            if (std::isdigit(static_cast<unsigned char>(sentence[i])) == 0) {
                ++i;
                continue;
            }
            const std::size_t start = i;
            while (i < sentence.size() &&
                   (std::isdigit(static_cast<unsigned char>(sentence[i])) != 0 || sentence[i] == '.'))
                ++i;
            std::string number(sentence.substr(start, i - start));
            while (number.back() == '.')
                number.pop_back();
            out_.sync_with.push_back(std::move(number));
            named = true;
        }
        if (!named) out_.doubts.push_back("not understood: '" + std::string(sentence) + "'");
    }

    std::string_view text_;
    Cursor cursor_;
    Remarks out_;
    std::optional<double> last_end_;
};

}  // namespace

Remarks read_remarks(std::string_view text) {
    return RemarksReader(text).read();
}

std::optional<double> bearing_from_front(std::string_view name) {
    const std::size_t from = name.find(" from ");
    if (from == std::string_view::npos || !contains(name.substr(from), "front")) return std::nullopt;
    std::optional<double> bearing;
    Cursor cursor(name.substr(0, from));
    while (!cursor.at_end()) {
        const std::size_t start = cursor.at();
        const auto value = cursor.bearing_deg();
        const std::string_view read = name.substr(start, cursor.at() - start);
        if (value && (contains(read, "^") || contains(read, "\xC2\xB0"))) bearing = value;
        if (value) continue;
        if (!cursor.number()) cursor.go_to(start + 1);  // "340 meters": a whole figure at a time
    }
    return bearing;
}

}  // namespace seaglare::lightdb::nga
