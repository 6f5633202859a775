#include "lightdb/character_notation.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

namespace seaglare::lightdb {
namespace {

constexpr double metres_per_foot = 0.3048;  // exact, international foot
constexpr double longest_period_s = 3600;   // beyond it a period is a slip of the pen

struct Spelling {
    std::string_view pattern;  // '.': dots and blanks may stand here
    ClassKind kind;
};

// Longest first. INT 1 (chart symbols) section P 10, the NGA's dotted forms, and the older English ones.
constexpr std::array<Spelling, 19> spellings{{
    {"Int.V.Qk.Fl", ClassKind::interrupted_very_quick},
    {"Int.Qk.Fl", ClassKind::interrupted_quick},
    {"I.Qk.Fl", ClassKind::interrupted_quick},
    {"V.Qk.Fl", ClassKind::very_quick},
    {"Qk.Fl", ClassKind::quick},
    {"I.U.Q", ClassKind::interrupted_ultra_quick},
    {"I.V.Q", ClassKind::interrupted_very_quick},
    {"I.Q", ClassKind::interrupted_quick},
    {"U.Q", ClassKind::ultra_quick},
    {"V.Q", ClassKind::very_quick},
    {"Q", ClassKind::quick},
    {"L.Fl", ClassKind::long_flashing},
    {"Fl", ClassKind::flashing},
    {"Iso", ClassKind::isophase},
    {"E.Int", ClassKind::isophase},
    {"Occ", ClassKind::occulting},
    {"Oc", ClassKind::occulting},
    {"Mo", ClassKind::morse},
    {"F", ClassKind::fixed},
}};

struct ColourSpelling {
    std::string_view word;
    Colour colour;
};
constexpr std::array<ColourSpelling, 11> colour_spellings{{
    {"Bu", Colour::blue},
    {"Bl", Colour::blue},
    {"Or", Colour::orange},
    {"Vi", Colour::violet},
    {"Am", Colour::yellow},
    {"W", Colour::white},
    {"R", Colour::red},
    {"G", Colour::green},
    {"Y", Colour::yellow},
    {"B", Colour::blue},
    {"V", Colour::violet},
}};

// Remarks in brackets that do not change what is seen.
constexpr std::array<std::string_view, 10> silent_brackets{"neon", "occas", "occasional", "sync", "exting",
                                                           "priv", "t",     "p",          "u",    "temp"};

char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}
bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

class Reader {
  public:
    explicit Reader(std::string_view text) : text_(text) {}

    Notation read() {
        while (skip_blanks(), at_ < text_.size())
            read_piece();
        if (notation_.terms.empty() && !notation_.alternating && notation_.prefixes.empty())
            fail(0, "no class of light: expected F, Oc, Iso, Fl, LFl, Q, VQ, UQ, IQ, Mo or Al");
        if (joined_) fail(text_.size(), "a class is missing after the '+'");
        return std::move(notation_);
    }

  private:
    [[noreturn]] static void fail(std::size_t where, const std::string& text) {
        throw CharacterError(where, text);
    }

    char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

    void skip_blanks() {
        while (at_ < text_.size() &&
               (is_blank(text_[at_]) || text_[at_] == '.' || text_[at_] == ',' || text_[at_] == ';'))
            ++at_;
    }

    // The end of `pattern` in the text from `at_`, or npos.
    std::size_t match(std::string_view pattern) const {
        std::size_t i = at_;
        for (const char p : pattern) {
            if (p == '.') {
                while (i < text_.size() && (text_[i] == '.' || text_[i] == ' '))
                    ++i;
                continue;
            }
            if (i >= text_.size() || lower(text_[i]) != lower(p)) return std::string_view::npos;
            ++i;
        }
        return i;
    }

    // A whole word: no letter follows it.
    bool take_word(std::string_view word) {
        const std::size_t end = match(word);
        if (end == std::string_view::npos || (end < text_.size() && is_letter(text_[end]))) return false;
        at_ = end;
        return true;
    }

    bool take(std::string_view pattern) {
        const std::size_t end = match(pattern);
        if (end == std::string_view::npos) return false;
        at_ = end;
        return true;
    }

    double read_number() {
        double value = 0;
        const char* first = text_.data() + at_;
        const auto [last, error] =
            std::from_chars(first, text_.data() + text_.size(), value, std::chars_format::fixed);
        if (error != std::errc{} || !std::isfinite(value)) fail(at_, "expected a number");
        at_ += static_cast<std::size_t>(last - first);
        return value;
    }

    void read_piece() {
        const char c = peek();
        if (is_digit(c)) return read_figures();
        if (c == '(') return read_bracket();
        if (c == '+' || c == '&') {
            if (notation_.terms.empty()) fail(at_, "nothing stands before the '" + std::string(1, c) + "'");
            joined_ = c == '+';
            ++at_;
            return;
        }
        if (!is_letter(c)) fail(at_, "unexpected '" + std::string(1, c) + "'");
        if (read_phase()) return;
        if (take_word("period") || take_word("ev") || take_word("every") || take_word("Gp") ||
            take_word("and") || take_word("Lt") || take_word("Lts"))
            return;
        if (take("Aero")) return notation_.prefixes.emplace_back("Aero"), void();
        if (take("Dir")) return notation_.prefixes.emplace_back("Dir"), void();
        if (take_word("vert")) return notation_.arrangement = "vert", void();
        if (take_word("hor") || take_word("horiz")) return notation_.arrangement = "hor", void();
        if (take("Alt") || take("Al")) return notation_.alternating = true, void();
        if (read_class() || read_colour()) return;
        std::size_t end = at_;
        while (end < text_.size() && is_letter(text_[end]))
            ++end;
        fail(at_,
             "'" + std::string(text_.substr(at_, end - at_)) + "' is neither a class nor a colour of light");
    }

    bool read_class() {
        for (const Spelling& spelling : spellings) {
            const std::size_t start = at_;
            // "FLFl" is fixed and long flashing, not "FL" and "Fl".
            if (spelling.pattern == "Fl" && match("F.L.Fl") != std::string_view::npos) continue;
            if (!take(spelling.pattern)) continue;
            ClassTerm term;
            term.kind = spelling.kind;
            std::vector<ClassTerm>& terms = notation_.terms;
            const bool sum = std::exchange(joined_, false);
            if (!terms.empty() && !sum) {
                const bool flash = term.kind == ClassKind::flashing ||
                                   term.kind == ClassKind::long_flashing || term.kind == ClassKind::quick;
                if (terms.size() == 1 && terms[0].kind == ClassKind::fixed && flash &&
                    !notation_.fixed_under) {
                    notation_.fixed_under = true;
                    terms[0] = term;
                    return true;
                }
                fail(start, "a second class of light: write classes of one light with '+', two lights apart");
            }
            terms.push_back(std::move(term));
            return true;
        }
        return false;
    }

    bool read_colour() {
        for (const ColourSpelling& spelling : colour_spellings) {
            if (!take(spelling.word)) continue;
            for (const Colour known : notation_.colours)
                if (known == spelling.colour) return true;  // "Q(9)W+LFl.W": said twice, meant once
            notation_.colours.push_back(spelling.colour);
            return true;
        }
        return false;
    }

    // "fl. 0.5s", "lt. 4.0s", "ec. 1.5s". In capitals, or before any class, "Fl" is a class.
    bool read_phase() {
        const std::size_t start = at_;
        const bool light = peek() == 'f' || peek() == 'l';
        if (joined_ || (notation_.terms.empty() && !notation_.alternating && notation_.prefixes.empty()))
            return false;
        if (!(text_.substr(at_, 2) == "fl" || text_.substr(at_, 2) == "lt" || text_.substr(at_, 2) == "ec"))
            return false;
        at_ += 2;
        while (peek() == '.' || is_blank(peek()))
            ++at_;
        if (!is_digit(peek())) return at_ = start, false;
        const double duration_s = read_number();
        while (is_blank(peek()))
            ++at_;
        if (peek() != 's') fail(at_, "a duration needs its unit, s");
        ++at_;
        if (duration_s <= 0) fail(start, "a phase lasts longer than 0 s");
        if (duration_s > longest_period_s) fail(start, "a phase lasts no longer than an hour");
        notation_.phases.push_back({duration_s, light});
        return true;
    }

    // "6s", "10m", "33ft", "12-9M", "12/10/8M", and the "2" of "2 F.R.(vert)".
    void read_figures() {
        const std::size_t start = at_;
        std::vector<double> figures{read_number()};
        char separator = 0;
        while ((peek() == '-' || peek() == '/') && is_digit(peek(1))) {
            if (separator != 0 && separator != peek()) fail(at_, "a list of ranges mixes '-' and '/'");
            separator = peek();
            ++at_;
            figures.push_back(read_number());
        }
        while (is_blank(peek()))
            ++at_;
        const bool alone = figures.size() == 1;
        if (take_word("sec") || (alone && take_word("s")) ||
            (alone && peek() == 's' && !is_letter(peek(1)) && (++at_, true))) {
            if (notation_.period_s && *notation_.period_s != figures[0])
                fail(start, "a second, different period");
            if (figures[0] <= 0) fail(start, "a period is longer than 0 s");
            if (figures[0] > longest_period_s) fail(start, "a period is no longer than an hour");
            notation_.period_s = figures[0];
        } else if (take_word("nm") || take_word("miles") ||
                   (peek() == 'M' && !is_letter(peek(1)) && (++at_, true))) {
            if (!notation_.ranges_nm.empty()) fail(start, "a second range");
            for (const double figure : figures)
                if (figure <= 0 || figure > 60) fail(start, "a nominal range lies between 0 and 60 M");
            notation_.ranges_nm = std::move(figures);
            notation_.range_separator = separator;
        } else if (alone && (take_word("ft") || take_word("feet"))) {
            set_height(start, figures[0] * metres_per_foot);
        } else if (alone && peek() == 'm' && !is_letter(peek(1))) {
            ++at_;
            set_height(start, figures[0]);
        } else if (alone && notation_.terms.empty() && notation_.lamp_count == 0 && figures[0] >= 1 &&
                   figures[0] <= 20 && figures[0] == std::floor(figures[0])) {
            notation_.lamp_count = static_cast<int>(figures[0]);
        } else if (alone && peek() == '(' && !notation_.terms.empty() &&
                   notation_.terms.back().groups.empty() && figures[0] == std::floor(figures[0]) &&
                   figures[0] <= 20) {
            read_misplaced_group(start, static_cast<int>(figures[0]));
        } else {
            fail(start,
                 "a number without its unit: s (period), m or ft (height) or M (range in nautical miles)");
        }
    }

    void set_height(std::size_t where, double height_m) {
        if (notation_.height_m) fail(where, "a second height");
        notation_.height_m = height_m;
    }

    // "Fl.2(G)" for "Fl(2)G": the bracket went around the wrong neighbour.
    void read_misplaced_group(std::size_t where, int count) {
        ++at_;
        skip_blanks();
        const std::size_t colour_at = at_;
        if (!read_colour()) fail(colour_at, "expected a colour in the bracket");
        skip_blanks();
        if (peek() != ')') fail(at_, "a bracket is not closed");
        ++at_;
        set_groups(where, {count});
        notation_.warnings.push_back("read '" + std::string(text_.substr(where, at_ - where)) + "' as (" +
                                     std::to_string(count) + ") and a colour");
    }

    void set_groups(std::size_t where, std::vector<int> groups) {
        if (notation_.terms.empty()) fail(where, "a group stands before its class");
        ClassTerm& term = notation_.terms.back();
        if (term.kind == ClassKind::fixed || term.kind == ClassKind::isophase ||
            term.kind == ClassKind::morse)
            fail(where, "this class of light has no groups");
        if (!term.groups.empty()) fail(where, "a second group");
        for (const int group : groups)
            if (group < 1 || group > 20) fail(where, "a group counts 1 to 20");
        term.groups = std::move(groups);
    }

    void read_bracket() {
        const std::size_t start = at_++;
        const std::size_t close = text_.find(')', at_);
        if (close == std::string_view::npos) fail(start, "a bracket is not closed");
        std::string inside;
        for (const char c : text_.substr(at_, close - at_))
            if (!is_blank(c) && c != '.') inside += c;
        at_ = close + 1;
        if (inside.empty()) fail(start, "an empty bracket");
        if (is_digit(inside[0])) return set_groups(start, read_groups(start, inside));
        if (!notation_.terms.empty() && notation_.terms.back().kind == ClassKind::morse &&
            notation_.terms.back().morse.empty()) {
            for (const char c : inside)
                if (std::isalnum(static_cast<unsigned char>(c)) == 0)
                    fail(start, "Morse letters are A to Z and 0 to 9");
            for (const char c : inside)
                notation_.terms.back().morse +=
                    static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
            return;
        }
        std::string word;
        for (const char c : inside)
            word += lower(c);
        if (word == "vert" || word == "hor" || word == "horiz") {
            notation_.arrangement = word == "vert" ? "vert" : "hor";
            return;
        }
        for (const std::string_view silent : silent_brackets)
            if (word == silent) return;
        fail(start, "'(" + inside + ")' is neither a group nor a known remark");
    }

    static std::vector<int> read_groups(std::size_t where, const std::string& inside) {
        std::vector<int> groups;
        const char* at = inside.data();
        const char* const end = at + inside.size();
        for (;;) {
            int group = 0;
            const auto [next, error] = std::from_chars(at, end, group);
            if (error != std::errc{}) fail(where, "a group is written like (3) or (2+1)");
            groups.push_back(group);
            if (next == end) return groups;
            if (*next != '+') fail(where, "a group is written like (3) or (2+1)");
            at = next + 1;
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
    Notation notation_;
    bool joined_ = false;  // a '+' waits for its second class
};

std::string_view kind_text(ClassKind kind) {
    switch (kind) {
        case ClassKind::fixed:
            return "F";
        case ClassKind::occulting:
            return "Oc";
        case ClassKind::isophase:
            return "Iso";
        case ClassKind::flashing:
            return "Fl";
        case ClassKind::long_flashing:
            return "LFl";
        case ClassKind::quick:
            return "Q";
        case ClassKind::very_quick:
            return "VQ";
        case ClassKind::ultra_quick:
            return "UQ";
        case ClassKind::interrupted_quick:
            return "IQ";
        case ClassKind::interrupted_very_quick:
            return "IVQ";
        case ClassKind::interrupted_ultra_quick:
            return "IUQ";
        case ClassKind::morse:
            return "Mo";
    }
    return "";
}

}  // namespace

Notation read_notation(std::string_view text) {
    return Reader(text).read();
}

std::string class_text(const Notation& notation) {
    std::string text;
    if (notation.alternating) text = notation.terms.empty() ? "Al" : "Al ";
    if (notation.fixed_under) text += "F";
    for (std::size_t i = 0; i < notation.terms.size(); ++i) {
        const ClassTerm& term = notation.terms[i];
        if (i > 0) text += "+";
        text += kind_text(term.kind);
        for (std::size_t g = 0; g < term.groups.size(); ++g)
            text += (g == 0 ? "(" : "+") + std::to_string(term.groups[g]);
        if (!term.groups.empty()) text += ")";
        if (!term.morse.empty()) text += "(" + term.morse + ")";
    }
    return text;
}

std::string number_text(double value) {
    std::array<char, 32> buffer{};
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed).ptr;
    return {buffer.data(), end};
}

}  // namespace seaglare::lightdb
