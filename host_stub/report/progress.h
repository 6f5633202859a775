// How far a report is, for people who wait: a line that is written over on a terminal, else a line a minute.
#pragma once

#include <chrono>
#include <string>

namespace seaglare::report {

class Progress {
  public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    // What follows is this part of the whole, 0 ... 1: from then on lines say when the whole may be done.
    void part(double from, double to);
    // What is being done now, and the fraction of the part that is done (negative: not known).
    void show(const std::string& what, double fraction = -1);

  private:
    using Clock = std::chrono::steady_clock;

    bool terminal_;
    std::size_t width_ = 0;
    Clock::time_point begun_ = Clock::now();
    Clock::time_point last_line_ = begun_;
    double from_ = 0;
    double to_ = 0;        // not above from_: nobody said what the whole is
    double furthest_ = 0;  // a part whose tasks each begin at 0 does not go back
};

// "about 3 min left" after so many seconds for so much of the whole; nothing while that says too little.
std::string time_left(double elapsed_s, double whole_fraction);

}  // namespace seaglare::report
