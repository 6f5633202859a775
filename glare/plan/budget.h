// What a frame may cost: in error, and in time. Read from config/quality. Plain data and pure functions.
#pragma once

namespace seaglare::glare {

struct Budget {
    // What all omissions together may change any channel of any pixel by, in 8-bit display codes. 0: nothing is left out.
    double max_error_codes = 0.5;
    // For the whole frame, ms; 0: whatever it takes. More than max_error_codes is then given up where time is short, as far
    // as most_error_codes.
    double time_ms = 0;
    double most_error_codes = 4;  // the most that a time budget raises max_error_codes to
};

// How the error is divided. Omissions add up in a pixel, so each kind has its part and the parts add up to one.
namespace budget_part {
inline constexpr double lights = 0.2;   // whole lights left out
inline constexpr double skirts = 0.3;   // skirts left to the smooth tail
inline constexpr double tails = 0.15;   // tails that end
inline constexpr double grid = 0.15;    // the tails' coarse grid
inline constexpr double pattern = 0.2;  // the pattern: reused, of another lamp, without discs or rod hue
}  // namespace budget_part

}  // namespace seaglare::glare
