#include "lightdb/character_practice.h"

#include <algorithm>
#include <array>

namespace seaglare::lightdb {

QuickRate quick_rate(ClassKind kind) {
    switch (kind) {
        case ClassKind::very_quick:
        case ClassKind::interrupted_very_quick:
            return {0.5, 60.0 / 159, 60.0 / 80, 0.2, "120"};
        case ClassKind::ultra_quick:
        case ClassKind::interrupted_ultra_quick:
            return {0.25, 0.2, 60.0 / 160, 0.125, "240"};
        default:
            return {1.0, 60.0 / 79, 60.0 / 50, 0.3, "60"};
    }
}

bool is_quick(ClassKind kind) {
    return kind == ClassKind::quick || kind == ClassKind::very_quick || kind == ClassKind::ultra_quick;
}
bool is_interrupted(ClassKind kind) {
    return kind == ClassKind::interrupted_quick || kind == ClassKind::interrupted_very_quick ||
           kind == ClassKind::interrupted_ultra_quick;
}

std::string_view morse_code(char letter) {
    static constexpr std::array<std::string_view, 26> letters{
        ".-", "-...", "-.-.", "-..",  ".",   "..-.", "--.", "....", "..",   ".---", "-.-",  ".-..", "--",
        "-.", "---",  ".--.", "--.-", ".-.", "...",  "-",   "..-",  "...-", ".--",  "-..-", "-.--", "--.."};
    static constexpr std::array<std::string_view, 10> digits{"-----", ".----", "..---", "...--", "....-",
                                                             ".....", "-....", "--...", "---..", "----."};
    return letter >= 'A' ? letters[static_cast<std::size_t>(letter - 'A')]
                         : digits[static_cast<std::size_t>(letter - '0')];
}

int counted(const ClassTerm& term) {
    int count = 0;
    for (const int group : term.groups)
        count += group;
    return count;
}

double usual_period_s(const std::vector<ClassTerm>& terms, std::size_t colours) {
    double period_s = 0;
    for (const ClassTerm& term : terms) {
        const double count = std::max(1, counted(term));
        switch (term.kind) {
            case ClassKind::fixed:
                period_s += 2.0 * static_cast<double>(std::max<std::size_t>(2, colours));
                break;
            case ClassKind::isophase:
                period_s += 4;
                break;
            case ClassKind::morse:
                period_s += 10;
                break;
            case ClassKind::long_flashing:
                period_s += 5 * count + 5;
                break;
            case ClassKind::occulting:
            case ClassKind::flashing:
                period_s += 2 * count + 3;
                break;
            default:
                period_s += is_interrupted(term.kind) ? 10 : quick_rate(term.kind).pitch_s * count + 5;
        }
    }
    return period_s;
}

}  // namespace seaglare::lightdb
