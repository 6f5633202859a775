// LIGHTS objects of S-57 cells, from their attributes as text: IHO S-57 edition 3.1, Appendix A, chapter 2. Needs no
// library that reads cells.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lightdb/import/charted_light.h"

namespace seaglare::lightdb::s57 {

// "LITCHR" to "2": acronyms to values, lists with commas ("1,3"). A missing or empty value is "not given".
using Attributes = std::map<std::string, std::string, std::less<>>;

// One LIGHTS object. What is not understood goes to `doubts` and is left out.
ChartedLight read_light(const Attributes& attributes, std::vector<std::string>& doubts);

// Whether the object is a light that a ship could see: not so one that is disused, extinguished or does not exist.
// `reason` then says why not.
bool is_shown(const Attributes& attributes, std::string& reason);

// A LIGHTS object at its place.
struct Feature {
    std::string id;              // "LIGHTS FIDN 1234567"
    std::string structure_name;  // OBJNAM of what carries it, if known
    bool floating = false;       // on a buoy, a float or a light vessel
    double latitude_deg = 0;
    double longitude_deg = 0;
    Attributes attributes;
};

struct FeatureReport {
    std::string id;
    std::string name;
    bool imported = false;
    std::string reason;  // why not
    std::vector<std::string> doubts;
};

struct Import {
    std::vector<ImportedLight> lights;
    std::vector<FeatureReport> records;  // one for each feature, in order
};

// Features at one position are one place: see charted_light.h. `cell` names the source: "S-57 cell DK5OSTBT, edition 4".
Import import_features(const std::vector<Feature>& features, std::string_view cell);

std::string light_file_text(const Import& import, std::string_view cell);

}  // namespace seaglare::lightdb::s57
