#include "lightdb/import/nga_ranges.h"

#include <algorithm>

#include "lightdb/character.h"
#include "lightdb/photometry.h"

namespace seaglare::lightdb::nga {

Ranges::Listed Ranges::listed_nm(Colour colour) const {
    Listed listed;
    for (const auto& [of, range_nm] : draft_.ranges_nm) {
        if (of && *of != colour) continue;
        listed.largest = std::max(listed.largest, range_nm);
        listed.smallest = std::min(listed.smallest, range_nm);
    }
    return listed;
}

double Ranges::largest_nm(Colour colour, std::vector<std::string>& notes) const {
    auto [largest, smallest] = listed_nm(colour);
    for (const SectorItem& item : draft_.remarks.sectors)
        if (item.arc.range_nm &&
            std::find(item.colours.begin(), item.colours.end(), colour) != item.colours.end())
            largest = std::max(largest, *item.arc.range_nm);
    for (const Arc& arc : draft_.remarks.visible)
        if (arc.range_nm) largest = std::max(largest, *arc.range_nm);
    if (largest > 0) {
        if (smallest < largest)
            notes.push_back("ranges of " + plain_number(smallest) + " to " + plain_number(largest) +
                            " M are given for " + std::string(colour_letter(colour)) + ": the largest");
        return largest;
    }
    if (draft_.ranges_nm.empty()) {
        notes.push_back("no range is given: " + plain_number(assumed_range_nm) + " M assumed");
        return assumed_range_nm;
    }
    for (const auto& [of, range_nm] : draft_.ranges_nm)
        largest = largest == 0 ? range_nm : std::min(largest, range_nm);
    notes.push_back("no range is given for " + std::string(colour_letter(colour)) + ": " +
                    plain_number(largest) + " M, the smallest of the others, assumed");
    return largest;
}

double Ranges::dim_factor(Colour colour, std::vector<std::string>& notes) const {
    const auto [largest, smallest] = listed_nm(colour);
    if (smallest < largest) return factor(smallest, largest);
    static const std::string note =
        "the weaker sectors are given no range: a quarter of the intensity assumed";
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
    return assumed_dim_factor;
}

double Ranges::factor(double range_nm, double largest_nm) {
    return std::min(1.0, intensity_for_range_cd(range_nm) / intensity_for_range_cd(largest_nm));
}

}  // namespace seaglare::lightdb::nga
