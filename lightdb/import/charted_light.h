// A light as electronic charts describe it: one object for each colour of a sectored light, with its attributes apart.
// S-57 cells and OpenSeaMap share this model (OpenSeaMap's tags are S-57's attributes by name), so they share how the
// objects at one place become lights.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightdb/import/imported_light.h"

namespace seaglare::lightdb {

enum class Visibility { plain, intensified, unintensified, faint, obscured };

// Attributes as their source has them; what it does not say is empty.
struct ChartedLight {
    std::string id;           // "light 2": which of the objects of its place, for messages; may be empty
    std::string name;         // of its own, such as "Upper light"
    std::string light_class;  // as charts write it: "Fl", "Q+LFl", "Al Fl"; empty: not given
    std::string group;        // "2", "2+1", "A", or in brackets one after another: "(6)(1)"
    std::vector<Colour> colours;
    std::optional<double> period_s;
    std::string sequence;                   // S-57 SIGSEQ: "00.8+(02.2)", eclipses in brackets
    std::optional<double> sector_from_deg;  // true, from seaward
    std::optional<double> sector_to_deg;
    std::optional<double> orientation_deg;  // of a direction or leading light: true, from seaward
    std::optional<double> height_m;
    std::optional<double> range_nm;
    int lamps = 1;            // shown together
    bool vertical = false;    // above each other
    bool horizontal = false;  // beside each other
    bool directional = false;
    bool leading = false;
    bool aero = false;  // aeronautical, or on an obstruction to aircraft
    bool front = false;
    bool rear = false;
    bool synchronized = false;
    bool day_only = false;  // a lamp of its own for the day
    bool all_day = false;   // shown day and night
    Visibility visibility = Visibility::plain;
    std::vector<std::string> notes;  // "fog light", "private": kept in the light's source
};

struct ChartedPlace {
    std::string name;    // of the structure
    std::string record;  // "node 123": names sync groups and nameless lights
    std::string source;  // "OpenStreetMap node 123 (ODbL)"
    double latitude_deg = 0;
    double longitude_deg = 0;
    bool floating = false;
    std::vector<ChartedLight> lights;
};

struct ChartedResult {
    std::vector<ImportedLight> lights;
    std::vector<std::string> doubts;    // contradictions and what was not understood, by the object's id
    std::vector<std::string> left_out;  // objects that gave no light, with the reason
};

// Objects with sectors and the same character, period, sequence, height and count of lamps are one light; the others
// are lights of their own. Lights of one place whose sectors do not overlap come from one lantern and keep step.
ChartedResult lights_of(const ChartedPlace& place);

// The class with its group, as charts write it: "Fl" and "2+1" give "Fl(2+1)", "Q+LFl" and "6" "Q(6)+LFl", "Mo" and "(A)"
// "Mo(A)". A group of one, and the empty bracket of a fixed part, are left out.
std::string class_with_group(const std::string& light_class, const std::string& group);

// The phases of a SIGSEQ text as the List of Lights writes them, "fl. 0.8s, ec. 2.2s". Nothing when it is no sequence.
std::optional<std::string> durations_of_sequence(const std::string& sequence);

}  // namespace seaglare::lightdb
