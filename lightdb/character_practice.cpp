#include "lightdb/character_practice.h"

#include <array>

namespace seaglare::lightdb {

QuickRate quick_rate(ClassKind kind) {
    switch (kind) {
        case ClassKind::very_quick:
        case ClassKind::interrupted_very_quick:
            return {0.5, 60.0 / 159, 0.2, "120"};
        case ClassKind::ultra_quick:
        case ClassKind::interrupted_ultra_quick:
            return {0.25, 0.2, 0.125, "240"};
        default:
            return {1.0, 60.0 / 79, 0.3, "60"};
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

}  // namespace seaglare::lightdb
