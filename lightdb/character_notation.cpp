#include "lightdb/character_notation.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "lightdb/character_scanner.h"
#include "lightdb/character_spelling.h"
#include "lightdb/units.h"

namespace seaglare::lightdb {
namespace {

constexpr double highest_m = 5000;         // as in light files
constexpr double longest_period_s = 3600;  // beyond it a period is a slip of the pen
constexpr double farthest_range_nm = 60;
constexpr int most_lamps = 20;
constexpr int most_flashes = 20;
constexpr std::size_t longest_morse = 20;

class Reader {
  public:
    explicit Reader(std::string_view text) : scan_(text) {}

    Notation read() {
        for (scan_.skip_separators(); !scan_.at_end(); scan_.skip_separators())
            read_piece();
        if (notation_.terms.empty() && !notation_.alternating && notation_.prefixes.empty()) {
            scan_.fail(0,
                       "no class of light: expected F, Oc, Iso, Fl, LFl, Q, VQ, UQ, IQ, IVQ, IUQ, Mo or Al");
        }
        if (joined_) scan_.fail_here("a class is missing after the '+': expected one, as in Q(6)+LFl");
        settle_ranges();
        return std::move(notation_);
    }

  private:
    // A figure that may be the range of the colours right before it.
    struct ColourFigure {
        std::vector<Colour> colours;
        double range_nm;
        bool has_unit;
        std::size_t where;
    };

    void read_piece() {
        const bool after_fixed = std::exchange(after_fixed_, false);
        if (scan_.at_digit()) return read_figures();
        const char c = scan_.peek();
        if ((c == '/' || c == '-') && !figures_.empty() && run_.empty() && is_letter(scan_.peek(1))) {
            return scan_.advance();  // "W12/R9M"
        }
        if (read_colour_of_run()) return;
        run_.clear();
        if (c == '(') return read_bracket();
        if (c == '+' || c == '&') {
            if (notation_.terms.empty())
                scan_.fail_here("nothing stands before the '" + std::string(1, c) + "': expected a class");
            joined_ = c == '+';
            after_fixed_ = after_fixed && c == '&';
            return scan_.advance();
        }
        if (!scan_.at_letter()) {
            scan_.fail_here("unexpected '" + shown_character() +
                            "': expected a class, a colour, a bracket or a figure");
        }
        read_word(after_fixed);
    }

    // A whole UTF-8 sequence, so that the message is text.
    std::string shown_character() const {
        std::string shown(1, scan_.peek());
        if ((static_cast<unsigned char>(shown[0]) & 0x80) == 0) return shown;
        for (std::size_t i = 1; i < 4 && (static_cast<unsigned char>(scan_.peek(i)) & 0xC0) == 0x80; ++i)
            shown += scan_.peek(i);
        return shown;
    }

    void read_word(bool after_fixed) {
        if (!after_fixed && phases_may_stand_here()) {
            if (const auto phase = take_listed_phase(scan_)) return notation_.phases.push_back(*phase);
        }
        for (const char* silent : {"period", "ev", "every", "and", "Lt", "Lts", "Ldg"})
            if (scan_.take_word(silent)) return;
        const std::size_t start = scan_.at();
        if (scan_.take("Gp")) return warn_of_old_form(start, "the bracket alone");
        for (const char* prefix : {"Aero", "Dir"})
            if (scan_.take(prefix)) return add_once(notation_.prefixes, prefix);
        if (scan_.take_word("vert")) return notation_.arrangement = "vert", void();
        if (scan_.take_word("hor") || scan_.take_word("horiz")) return notation_.arrangement = "hor", void();
        if (scan_.take("Alt")) {
            notation_.alternating = true;
            return warn_of_old_form(start, "Al");
        }
        if (scan_.take("Al")) return notation_.alternating = true, void();
        if (read_short_long() || read_class()) return;
        // The whole word: of "Racon" the R has been taken for a colour.
        std::size_t begin = start;
        while (begin > 0 && is_letter(scan_.between(begin - 1, begin)[0]))
            --begin;
        std::size_t length = 0;
        while (is_letter(scan_.peek(length)))
            ++length;
        scan_.fail_here(
            "'" + std::string(scan_.between(begin, start + length)) +
            "' is neither a class nor a colour of light: expected F, Oc, Iso, Fl, LFl, Q, VQ, UQ, IQ, "
            "IVQ, IUQ, Mo, Al, Dir, Aero or W, R, G, Y, Bu, Or, Vi");
    }

    // In capitals, before any class, or right after "F", "fl" is a class.
    bool phases_may_stand_here() const {
        return !joined_ && (!notation_.terms.empty() || notation_.alternating || !notation_.prefixes.empty());
    }

    static void add_once(std::vector<std::string>& list, std::string_view word) {
        if (std::find(list.begin(), list.end(), word) == list.end()) list.emplace_back(word);
    }

    void warn_of_old_form(std::size_t start, const std::string& today) {
        std::string written(scan_.between(start, scan_.at()));
        std::replace(written.begin(), written.end(), '\n', ' ');
        notation_.warnings.push_back("'" + written + "' is an old form: charts write " + today + " today");
    }

    // "S-L Fl", short-long flashing.
    bool read_short_long() {
        const std::size_t start = scan_.at();
        if (!notation_.terms.empty() || !(scan_.take("S-L.Fl") || scan_.take("S.L.Fl"))) return false;
        notation_.class_at = scan_.given_place(start);
        notation_.terms = {{ClassKind::flashing, {}, {}}, {ClassKind::long_flashing, {}, {}}};
        notation_.class_end = scan_.given_place(scan_.at());
        warn_of_old_form(start, "Fl+LFl");
        return true;
    }

    bool read_class() {
        for (const ClassSpelling& spelling : class_spellings()) {
            const std::size_t start = scan_.at();
            // "FLFl" is fixed and long flashing, not "FL" and "Fl".
            if (spelling.pattern == "Fl" && scan_.goes_on("F.L.Fl")) continue;
            if (!scan_.take(spelling.pattern)) continue;
            if (spelling.old_form) warn_of_old_form(start, std::string(class_abbreviation(spelling.kind)));
            add_class(start, spelling.kind);
            after_fixed_ = spelling.kind == ClassKind::fixed;
            notation_.class_end = scan_.given_place(scan_.at());
            return true;
        }
        return false;
    }

    void add_class(std::size_t start, ClassKind kind) {
        std::vector<ClassTerm>& terms = notation_.terms;
        const bool sum = std::exchange(joined_, false);
        if (terms.empty()) notation_.class_at = scan_.given_place(start);
        if (terms.empty() || sum) return terms.push_back({kind, {}, {}});
        const bool flash =
            kind == ClassKind::flashing || kind == ClassKind::long_flashing || kind == ClassKind::quick;
        if (terms.size() == 1 && terms[0].kind == ClassKind::fixed && flash && !notation_.fixed_under) {
            notation_.fixed_under = true;
            terms[0].kind = kind;
            return;
        }
        // "FlLFl", as OpenSeaMap writes flashes and long flashes.
        if (terms.size() == 1 && terms[0].kind == ClassKind::flashing && kind == ClassKind::long_flashing)
            return terms.push_back({kind, {}, {}});
        scan_.fail(start, "a second class of light: write classes of one light with '+', two lights apart");
    }

    std::optional<Colour> take_colour() {
        for (const ColourSpelling& spelling : colour_spellings())
            if (scan_.take(spelling.word)) return spelling.colour;
        return std::nullopt;
    }

    bool at_colour() const {
        const auto spellings = colour_spellings();
        return std::any_of(spellings.begin(), spellings.end(),
                           [&](const ColourSpelling& spelling) { return scan_.goes_on(spelling.word); });
    }

    bool read_colour_of_run() {
        if (!scan_.at_letter() || a_word_goes_first()) return false;
        const auto colour = take_colour();
        if (!colour) return false;
        if (std::find(run_.begin(), run_.end(), *colour) != run_.end()) run_.clear();  // "WR R 8M"
        run_.push_back(*colour);
        add_colour(*colour);
        return true;
    }

    // "VQ", "vert" and "Gp" begin like colours.
    bool a_word_goes_first() const {
        for (const ClassSpelling& spelling : class_spellings())
            if (scan_.goes_on(spelling.pattern)) return true;
        return scan_.goes_on("Gp") || scan_.goes_on("vert");
    }

    void add_colour(Colour colour) {  // "Q(9)W+LFl.W": said twice, meant once
        std::vector<Colour>& known = notation_.colours;
        if (std::find(known.begin(), known.end(), colour) == known.end()) known.push_back(colour);
    }

    // "6s", "10m", "33ft", "12-9M", "12/10/8M", "269°", the "12" of "W 12 R 8", and the "2" of "2 F.R.(vert)".
    void read_figures() {
        const std::size_t start = scan_.at();
        std::vector<double> figures{scan_.read_number()};
        const char separator = read_more_figures(figures);
        const std::vector<Colour> run = std::exchange(run_, {});
        const std::size_t end = scan_.at();
        scan_.skip_blanks();
        const bool alone = figures.size() == 1;
        if (alone && (take_any_word({"s", "sec", "secs", "second", "seconds"}) || take_unit("s")))
            return set_period(start, figures[0]);
        if (take_any_word({"nm", "nmi", "mile", "miles"}) || take_unit("M")) {
            return set_ranges(start, std::move(figures), separator, run);
        }
        if (alone && take_any_word({"ft", "feet", "foot"})) {
            return set_height(start, std::round(figures[0] * metres_per_foot * 1e6) / 1e6);
        }
        if (alone && (take_any_word({"metres", "meters"}) || take_unit("m")))
            return set_height(start, figures[0]);
        if (!alone && take_unit("m")) {  // a light has one height
            notation_.warnings.push_back("read '" + std::string(scan_.between(start, scan_.at())) +
                                         "' as ranges in nautical miles: charts write M");
            return set_ranges(start, std::move(figures), separator, run);
        }
        if (alone && scan_.take_exact("\xC2\xB0")) return set_direction(start, figures[0]);
        const bool whole = figures[0] == std::floor(figures[0]) && figures[0] <= most_lamps;
        if (alone && !run.empty()) {
            scan_.go_back(end);
            if (scan_.at_letter() && !at_colour()) fail_for_unit(start);
            figures_.push_back({run, checked_range_nm(start, figures[0]), false, start});
            return;
        }
        if (alone && notation_.terms.empty() && notation_.lamp_count == 0 && figures[0] >= 1 && whole) {
            notation_.lamp_count = static_cast<int>(figures[0]);
            return;
        }
        if (alone && scan_.peek() == '(' && !notation_.terms.empty() &&
            notation_.terms.back().groups.empty() && whole) {
            return read_misplaced_group(start, static_cast<int>(figures[0]));
        }
        fail_for_unit(start);
    }

    [[noreturn]] void fail_for_unit(std::size_t where) const {
        scan_.fail(where,
                   "a number without its unit: expected s (period), m or ft (height) or M (range in nautical "
                   "miles)");
    }

    bool take_any_word(std::initializer_list<std::string_view> words) {
        return std::any_of(words.begin(), words.end(),
                           [this](std::string_view word) { return scan_.take_word(word); });
    }

    bool take_unit(std::string_view unit) {
        const char next = scan_.peek(unit.size());
        const bool goes_on =
            is_letter(next) && next == lower(next);  // "6sW12M": a capital begins something else
        if (!scan_.rest().starts_with(unit) || goes_on) return false;
        scan_.advance(unit.size());
        return true;
    }

    // The rest of "12-9" or "12 / 10 / 8"; what separates the figures, 0 for none.
    char read_more_figures(std::vector<double>& figures) {
        char separator = 0;
        for (;;) {
            const std::size_t end = scan_.at();
            scan_.skip_blanks();
            const char c = scan_.peek();
            if (c == '-' || c == '/') {
                const std::size_t where = scan_.at();
                scan_.advance();
                scan_.skip_blanks();
                if (scan_.at_digit()) {
                    if (separator != 0 && separator != c)
                        scan_.fail(where, "a list of ranges mixes '-' and '/': expected one of them");
                    separator = c;
                    figures.push_back(scan_.read_number());
                    continue;
                }
            }
            scan_.go_back(end);
            return separator;
        }
    }

    void set_period(std::size_t where, double period_s) {
        if (notation_.period_s && *notation_.period_s != period_s)
            scan_.fail(where, "a second, different period: expected one");
        if (period_s <= 0) scan_.fail(where, "a period is longer than 0 s");
        if (period_s > longest_period_s) scan_.fail(where, "a period is no longer than an hour");
        notation_.period_s = period_s;
        notation_.period_at = scan_.given_place(where);
    }

    void set_height(std::size_t where, double height_m) {
        if (notation_.height_m) scan_.fail(where, "a second height: expected one");
        if (height_m > highest_m) scan_.fail(where, "a height is no more than 5000 m");
        notation_.height_m = height_m;
    }

    void set_direction(std::size_t where, double direction_deg) {
        if (notation_.direction_deg) scan_.fail(where, "a second direction: expected one");
        if (direction_deg > 360) scan_.fail(where, "a direction lies between 000° and 360°");
        notation_.direction_deg = direction_deg;
    }

    double checked_range_nm(std::size_t where, double range_nm) const {
        if (!(range_nm > 0) || range_nm > farthest_range_nm)
            scan_.fail(where, "a nominal range lies between 0 and 60 M");
        return range_nm;
    }

    void set_ranges(std::size_t where, std::vector<double> figures, char separator,
                    const std::vector<Colour>& run) {
        for (const double figure : figures)
            checked_range_nm(where, figure);
        if (figures.size() == 1 && !run.empty()) {
            figures_.push_back({run, figures[0], true, where});
            return;
        }
        if (!notation_.ranges_nm.empty()) scan_.fail(where, "a second range: expected one");
        notation_.ranges_nm = std::move(figures);
        notation_.range_separator = separator;
        notation_.ranges_at = scan_.given_place(where);
    }

    // "WRG 12M" holds for all, "W 12 R 8 G 8" for each; one figure without a unit could be anything.
    void settle_ranges() {
        if (figures_.empty()) return;
        const ColourFigure& first = figures_.front();
        const bool any_unit = std::any_of(figures_.begin(), figures_.end(),
                                          [](const ColourFigure& figure) { return figure.has_unit; });
        if (figures_.size() == 1 && !any_unit) fail_for_unit(first.where);
        if (!notation_.ranges_nm.empty()) scan_.fail(first.where, "a second range: expected one");
        notation_.ranges_at = scan_.given_place(first.where);
        if (figures_.size() == 1 && (first.colours.size() > 1 || notation_.colours.size() == 1)) {
            notation_.ranges_nm = {first.range_nm};
            return;
        }
        for (const ColourFigure& figure : figures_) {
            for (const Colour colour : figure.colours) {
                for (const auto& [known, range_nm] : notation_.colour_ranges_nm)
                    if (known == colour)
                        scan_.fail(figure.where, "a second range of one colour: expected one");
                notation_.colour_ranges_nm.emplace_back(colour, figure.range_nm);
            }
        }
    }

    // "Fl.2(G)" for "Fl(2)G": the bracket went around the wrong neighbour.
    void read_misplaced_group(std::size_t where, int count) {
        scan_.advance();
        scan_.skip_separators();
        const std::size_t colour_at = scan_.at();
        const auto colour = take_colour();
        if (!colour) scan_.fail(colour_at, "expected a colour in the bracket");
        add_colour(*colour);
        scan_.skip_separators();
        if (scan_.peek() != ')') scan_.fail_here("a bracket is not closed: expected ')'");
        scan_.advance();
        set_groups(where, {count});
        notation_.warnings.push_back("read '" + std::string(scan_.between(where, scan_.at())) + "' as (" +
                                     std::to_string(count) + ") and a colour");
    }

    void set_groups(std::size_t where, std::vector<int> groups) {
        if (notation_.terms.empty()) scan_.fail(where, "a group stands before its class");
        ClassTerm& term = notation_.terms.back();
        if (term.kind == ClassKind::fixed || term.kind == ClassKind::isophase ||
            term.kind == ClassKind::morse)
            scan_.fail(where, "this class of light has no groups: expected none");
        if (!term.groups.empty()) scan_.fail(where, "a second group: expected one, as in (2+1)");
        for (const int group : groups)
            if (group < 1 || group > most_flashes) scan_.fail(where, "a group counts 1 to 20");
        term.groups = std::move(groups);
        notation_.class_end = scan_.given_place(scan_.at());
    }

    void read_bracket() {
        const std::size_t start = scan_.at();
        const std::size_t length = scan_.rest().find(')');
        if (length == std::string_view::npos) scan_.fail(start, "a bracket is not closed: expected ')'");
        const std::string_view written = scan_.rest().substr(1, length - 1);
        std::string inside;
        for (std::size_t i = 0; i < written.size(); ++i) {
            const char c = written[i];
            // "(occas.)", but not "(1.5)", which is no group of 15
            const bool dot = c == '.' && !(i + 1 < written.size() && is_digit(written[i + 1]));
            if (c != ' ' && c != '\t' && c != '\n' && c != '\r' && !dot) inside += c;
        }
        scan_.advance(length + 1);
        if (inside.empty()) scan_.fail(start, "an empty bracket: expected a group or a remark");
        if (!notation_.terms.empty() && notation_.terms.back().kind == ClassKind::morse &&
            notation_.terms.back().morse.empty()) {
            return set_morse(start, inside);
        }
        if (is_digit(inside[0])) return set_groups(start, read_groups(start, inside));
        read_remark(start, inside);
    }

    void set_morse(std::size_t where, const std::string& letters) {
        if (letters.size() > longest_morse) scan_.fail(where, "Mo shows at most 20 letters");
        for (const char c : letters) {
            if (!is_letter(c) && !is_digit(c)) scan_.fail(where, "Morse letters are A to Z and 0 to 9");
            notation_.terms.back().morse += is_letter(c) ? static_cast<char>(lower(c) - 'a' + 'A') : c;
        }
    }

    void read_remark(std::size_t where, const std::string& inside) {
        std::string word;
        for (const char c : inside)
            word += lower(c);
        if (word == "vert" || word == "hor" || word == "horiz") {
            notation_.arrangement = word == "vert" ? "vert" : "hor";
            return;
        }
        for (const RemarkSpelling& remark : remark_spellings()) {
            if (word != remark.word) continue;
            add_once(notation_.remarks, remark.abbreviation);
            if (!remark.assumption.empty()) add_once(notation_.assumptions, remark.assumption);
            return;
        }
        scan_.fail(where, "'(" + inside +
                              ")' is neither a group nor a known remark: expected (3), (2+1), (vert), (hor), "
                              "(occas), (fog), (priv) …");
    }

    std::vector<int> read_groups(std::size_t where, const std::string& inside) const {
        std::vector<int> groups;
        const char* at = inside.data();
        const char* const end = at + inside.size();
        for (;;) {
            int group = 0;
            const auto [next, error] = std::from_chars(at, end, group);
            if (error != std::errc{} || !is_digit(*at))
                scan_.fail(where, "a group is written like (3) or (2+1)");
            groups.push_back(group);
            if (groups.size() > static_cast<std::size_t>(most_flashes))
                scan_.fail(where, "a group counts 1 to 20");
            if (next == end) return groups;
            if (*next != '+' || next + 1 == end) scan_.fail(where, "a group is written like (3) or (2+1)");
            at = next + 1;
        }
    }

    Scanner scan_;
    Notation notation_;
    bool after_fixed_ = false;           // the last piece was "F", or "F &"
    bool joined_ = false;                // a '+' waits for its second class
    std::vector<Colour> run_;            // the colours that the text has just named, one after the other
    std::vector<ColourFigure> figures_;  // ranges written behind colours
};

}  // namespace

Notation read_notation(std::string_view text) {
    return Reader(text).read();
}

}  // namespace seaglare::lightdb
