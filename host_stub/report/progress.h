// A progress line for people who watch: only when stderr is a terminal.
#pragma once

#include <string>

namespace seaglare::report {

class Progress {
  public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    // What is being done now, and the fraction done (negative: not known).
    void show(const std::string& what, double fraction = -1);

  private:
    bool terminal_;
    std::size_t width_ = 0;
};

}  // namespace seaglare::report
