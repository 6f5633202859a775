// The U.S. NGA List of Lights as the NGA publishes it in JSON ({"ngalol": [...]}), read into lights of our own. Every
// record is accounted for: it gave lights, or it stands in the report with the reason why not.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightdb/import/imported_light.h"
#include "lightdb/json/value.h"

namespace seaglare::lightdb::nga {

enum class Outcome {
    imported,
    racon,
    duplicate,
    no_position,
    not_understood,
    outside_area,
    no_light,  // a radio aid or a station that corrects positions: the same service lists them
    removed    // "removeFromList": struck from the List
};

// What became of one record, in the order of the List.
struct RecordReport {
    std::size_t index = 0;  // in the file's array
    std::string number;     // "3690 / C1532.603 no. 2"
    std::string name;
    Outcome outcome = Outcome::not_understood;
    std::string reason;  // for all but `imported`
    std::vector<std::string>
        doubts;  // things of an imported record that were not understood or contradict each other
    std::vector<std::string> unread;  // sentences of its remarks that the importer does not look for
    int light_count = 0;
    bool has_phase_list = false;
    bool phase_list_adds_up = false;
};

struct Area {
    // A box; one whose west lies east of its east goes over the 180th meridian.
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
    std::vector<std::string> volumes;  // "116", in the order of the file
    std::vector<RecordReport> records;

    std::size_t count(Outcome outcome) const;
};

// The document is {"ngalol": [records]} or the bare array, of any volume (Pub. 110 to 116) or of several; keys that are not
// known are ignored. Throws json::Error when the document is not a List of Lights. Records are never a reason to throw.
Import import_list(const json::Value& root, std::string_view file, const Area& area = {});

// A light file, stable to the byte.
std::string light_file_text(const Import& import);

// Counts that add up, then every record that gave no light, every doubt, and the remarks that were not read, one a line.
std::string report_text(const Import& import);

}  // namespace seaglare::lightdb::nga
