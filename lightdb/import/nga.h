// The U.S. NGA List of Lights as the NGA publishes it in JSON ({"ngalol": [...]}), read into lights of our own. Every
// record is accounted for: it gave lights, or it stands in the report with the reason why not.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightdb/json/value.h"
#include "lightdb/light.h"

namespace seaglare::lightdb::nga {

// One light of a light file. Facts as the List has them, in SI; what was chosen where the List is silent is in `notes`.
struct ImportedLight {
    std::string name;
    double latitude_deg = 0;
    double longitude_deg = 0;
    double height_m = 0;    // above mean high water
    double radius_m = 0;    // of the lantern, by range: the List does not give it
    std::string character;  // chart notation, with the durations the List gives
    std::vector<std::pair<Colour, double>> nominal_range_nm;
    std::vector<Sector> sectors;  // true bearings from seaward
    std::string sync_group;
    bool all_day = false;  // "Shown 24 hours"
    std::string source;    // "NGA Pub. 116 (2016/08), 3690 / C1532.603"
    std::vector<std::string> notes;
};

enum class Outcome { imported, racon, duplicate, no_position, not_understood, outside_area };

// What became of one record, in the order of the List.
struct RecordReport {
    std::size_t index = 0;  // in the file's array
    std::string number;     // "3690 / C1532.603 no. 2"
    std::string name;
    Outcome outcome = Outcome::not_understood;
    std::string reason;  // for all but `imported`
    std::vector<std::string>
        doubts;  // things of an imported record that were not understood or contradict each other
    int light_count = 0;
    bool has_phase_list = false;
    bool phase_list_adds_up = false;
};

struct Area {
    double south_deg = -90;
    double west_deg = -180;
    double north_deg = 90;
    double east_deg = 180;
    // Or a circle: its centre and radius in nautical miles.
    std::optional<std::pair<double, double>> centre_deg;
    double radius_nm = 0;

    bool contains(double latitude_deg, double longitude_deg) const;
};

struct Import {
    std::vector<ImportedLight> lights;
    std::vector<RecordReport> records;

    std::size_t count(Outcome outcome) const;
};

// Throws json::Error when the document is not a List of Lights. Records are never a reason to throw.
Import import_list(const json::Value& root, std::string_view file, const Area& area = {});

// A light file, stable to the byte.
std::string light_file_text(const Import& import);

// Counts that add up, then every record that gave no light and every doubt, one a line.
std::string report_text(const Import& import);

}  // namespace seaglare::lightdb::nga
