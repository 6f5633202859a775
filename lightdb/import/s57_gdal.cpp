// LIGHTS objects through GDAL (MIT), whose S57 driver reads ISO 8211 cells with their updates.
#include <ogrsf_frmts.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string_view>
#include <utility>

#include "lightdb/import/s57.h"

namespace seaglare::lightdb::s57 {
namespace {

// The attributes that read_light() asks for.
constexpr std::array<const char*, 16> asked = {"OBJNAM", "LITCHR", "SIGGRP", "SIGPER", "SIGSEQ", "COLOUR",
                                               "SECTR1", "SECTR2", "ORIENT", "HEIGHT", "VALNMR", "MLTYLT",
                                               "CATLIT", "LITVIS", "EXCLIT", "STATUS"};

// Lists as "1,3": GDAL gives them as lists of strings, or as one string with commas, depending on its options.
std::string text_of(OGRFeature& feature, int field) {
    if (!feature.IsFieldSetAndNotNull(field)) return {};
    const OGRFieldType type = feature.GetFieldDefnRef(field)->GetType();
    if (type != OFTStringList && type != OFTIntegerList) return feature.GetFieldAsString(field);
    std::string list;
    const auto add = [&](const std::string& item) { list += (list.empty() ? "" : ",") + item; };
    if (type == OFTStringList) {
        for (char** item = feature.GetFieldAsStringList(field); item != nullptr && *item != nullptr; ++item)
            add(*item);
    } else {
        int count = 0;
        const int* codes = feature.GetFieldAsIntegerList(field, &count);
        for (int i = 0; i < count; ++i)
            add(std::to_string(codes[i]));
    }
    return list;
}

std::string text_of(OGRFeature& feature, const char* name) {
    const int field = feature.GetFieldIndex(name);
    return field < 0 ? std::string() : text_of(feature, field);
}

using Position =
    std::pair<std::int64_t, std::int64_t>;  // in 1e-7 degrees: equal for what S-57 puts at one point

const OGRPoint* point_of(OGRFeature& feature) {
    const OGRGeometry* geometry = feature.GetGeometryRef();
    if (geometry == nullptr || wkbFlatten(geometry->getGeometryType()) != wkbPoint || geometry->IsEmpty())
        return nullptr;
    return geometry->toPoint();
}

Position position_of(const OGRPoint& point) {
    return {std::llround(point.getY() * 1e7), std::llround(point.getX() * 1e7)};
}

struct Structure {
    std::string name;
    bool floating = false;
};

bool is_floating(std::string_view object_class) {
    return object_class.starts_with("BOY") || object_class == "LITFLT" || object_class == "LITVES";
}

// Lighthouses, beacons and buoys carry the names, and say whether a light floats; they stand at the lights' position.
std::map<Position, Structure> structures_of(GDALDataset& cell) {
    std::map<Position, Structure> structures;
    for (OGRLayer* layer : cell.GetLayers()) {
        const std::string_view object_class = layer->GetName();
        const bool carries = is_floating(object_class) || object_class.starts_with("BCN") ||
                             object_class == "LNDMRK" || object_class == "PILPNT" ||
                             object_class == "OFSPLF" || object_class == "SILTNK" ||
                             object_class == "BUISGL" || object_class == "MORFAC";
        if (!carries) continue;
        for (const auto& feature : *layer) {
            const OGRPoint* point = point_of(*feature);
            if (point == nullptr) continue;
            Structure& structure = structures[position_of(*point)];
            structure.floating = structure.floating || is_floating(object_class);
            if (structure.name.empty()) structure.name = text_of(*feature, "OBJNAM");
        }
    }
    return structures;
}

// The feature's identifier is made of agency, FIDN and FIDS; FIDN alone tells the lights of a cell apart.
std::string id_of(OGRFeature& feature) {
    const std::string fidn = text_of(feature, "FIDN");
    return "LIGHTS " + (fidn.empty() ? "feature " + std::to_string(feature.GetFID()) : "FIDN " + fidn);
}

struct Close {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};

}  // namespace

bool can_read_cells() {
    return true;
}

Cell read_cell(const std::string& path) {
    GDALAllRegister();
    const std::unique_ptr<GDALDataset, Close> cell(static_cast<GDALDataset*>(
        GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr)));
    if (!cell) throw CellError("cannot read '" + path + "': " + CPLGetLastErrorMsg());
    OGRLayer* lights = cell->GetLayerByName("LIGHTS");
    Cell result;
    result.name = "S-57 cell " + std::filesystem::path(path).stem().string();
    if (lights == nullptr) {
        if (std::string_view(cell->GetDriverName()) == "S57") return result;  // a cell without lights
        throw CellError("'" + path + "' has no layer LIGHTS");
    }
    const std::map<Position, Structure> structures = structures_of(*cell);
    for (const auto& row : *lights) {
        Feature feature;
        feature.id = id_of(*row);
        for (const char* name : asked)
            if (std::string text = text_of(*row, name); !text.empty()) feature.attributes.emplace(name, text);
        if (const OGRPoint* point = point_of(*row)) {
            feature.latitude_deg = point->getY();
            feature.longitude_deg = point->getX();
            if (const auto found = structures.find(position_of(*point)); found != structures.end()) {
                feature.structure_name = found->second.name;
                feature.floating = found->second.floating;
            }
        } else {
            feature.latitude_deg = 1000;  // no position: import_features() reports it
        }
        result.features.push_back(std::move(feature));
    }
    return result;
}

}  // namespace seaglare::lightdb::s57
