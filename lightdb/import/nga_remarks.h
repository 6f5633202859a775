// Sectors and synchronisation from the prose of the List's remarks. Internal to lightdb/import/nga*.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightdb/light.h"

namespace seaglare::lightdb::nga {

enum class Strength { plain, unintensified, intensified };

struct Arc {
    double from_deg = 0;
    double to_deg = 0;
    Strength strength = Strength::plain;
    std::optional<double> range_nm;  // "Visible (5M) 095°-135°"
};

// "Oc.(2)W.(6M)-224°42`": an arc with its colours and, where it differs from the light's, its class.
struct SectorItem {
    Arc arc;
    std::vector<Colour> colours;  // empty: obscured; two: alternating
    std::string light_class;      // "Oc.(2)", "Al." or empty
};

struct Remarks {
    std::vector<SectorItem> sectors;
    std::vector<Arc> visible;
    std::vector<Arc> obscured;
    std::vector<Arc> intensified;    // elsewhere dimmer
    std::vector<Arc> unintensified;  // elsewhere stronger
    bool range_line_only = false;
    std::vector<double> range_line_deg;  // where the remark itself gives the bearing
    bool intensified_on_range_line = false;
    bool faint_elsewhere = false;
    bool all_day = false;
    bool sync_with_front = false;
    bool sync_with_rear = false;
    std::vector<std::string> sync_with;       // feature numbers: "5284"
    std::vector<std::string> seen_sometimes;  // "Occasional", "Shown on request": kept as notes
    std::vector<std::string> doubts;
    std::vector<std::string> unread;  // sentences that nothing here looks for: "Range 3M by day"
};

Remarks read_remarks(std::string_view text);

// "Rear, 340 meters 288^ from front" gives 288: the bearing on which front and rear are in line.
std::optional<double> bearing_from_front(std::string_view name);

}  // namespace seaglare::lightdb::nga
