// The nominal ranges of a record, and how much weaker its weak sectors are. Internal to lightdb/import/nga*.cpp.
#pragma once

#include <string>
#include <vector>

#include "lightdb/import/nga_draft.h"

namespace seaglare::lightdb::nga {

// In the List's order; a range without a colour holds for all colours.
class Ranges {
  public:
    explicit Ranges(const Draft& draft) : draft_(draft) {}

    // Largest nominal range of the colour in nautical miles; what had to be assumed goes to `notes`.
    double largest_nm(Colour colour, std::vector<std::string>& notes) const;

    // Factor on the intensity of a dimmed sector: from the colour's smallest range, or assumed and noted.
    double dim_factor(Colour colour, std::vector<std::string>& notes) const;

    // Of the intensity for `largest_nm` that gives `range_nm`, at most 1.
    static double factor(double range_nm, double largest_nm);

  private:
    // Of the ranges that hold for the colour, nautical miles; 0 and a huge one where there is none.
    struct Listed {
        double largest = 0;
        double smallest = 1e9;
    };
    Listed listed_nm(Colour colour) const;

    const Draft& draft_;
};

}  // namespace seaglare::lightdb::nga
