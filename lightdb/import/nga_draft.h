// A record of the List with its fields read and its neighbours known, before it becomes lights. Internal to
// lightdb/import/nga*.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightdb/import/nga.h"
#include "lightdb/import/nga_remarks.h"

namespace seaglare::lightdb::nga {

struct Draft {
    std::size_t index = 0;
    std::string volume;    // "116"
    std::string aid_type;  // "Lighted Aids"
    bool removed = false;
    std::string number;  // "3690 / C1532.603"
    int char_no = 1;
    std::string own_name;  // without its dashes
    std::string name;      // made full from the headings above it
    std::string characteristic;
    std::string position_text;
    std::optional<std::pair<double, double>> position_deg;
    std::vector<double> heights_m;
    std::vector<std::pair<std::optional<Colour>, double>> ranges_nm;
    Remarks remarks;
    std::string notice;                // "2016/08"
    std::optional<std::size_t> front;  // of a range's rear light
    std::vector<double>
        range_line_deg;  // bearings from seaward on which this light and its partner are in line
    std::string sync_group;
    std::string misplaced;  // why the position cannot be right
    std::vector<std::string> doubts;

    std::string full_number() const {
        return char_no > 1 ? number + " no. " + std::to_string(char_no) : number;
    }
    bool is_racon() const;
};

// Names, front and rear, range lines and groups of synchronized lights, over the whole List in its order.
struct Heading {
    std::string region;
    std::string subregion;
    std::string raw_name;
};
void link_records(std::vector<Draft>& drafts, const std::vector<Heading>& headings);

// The lights of one record; throws CharacterError when its characteristic is none. Fills the phase list's findings and
// the doubts of `report`.
std::vector<ImportedLight> lights_of(const Draft& draft, RecordReport& report);

}  // namespace seaglare::lightdb::nga
