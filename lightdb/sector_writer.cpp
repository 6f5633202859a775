#include "lightdb/sector_writer.h"

#include "lightdb/character.h"

namespace seaglare::lightdb {

void write_sector(json::Writer& writer, const Sector& sector) {
    writer.begin_object(json::Writer::Layout::line);
    writer.key("colour");
    if (sector.colour) {
        writer.value(colour_letter(*sector.colour));
    } else {
        writer.null();
    }
    writer.member("from", sector.from_deg);
    writer.member("to", sector.to_deg);
    if (sector.intensity_factor != 1) writer.member("intensity_factor", sector.intensity_factor);
    if (sector.transition_deg != 0) writer.member("transition_deg", sector.transition_deg);
    if (sector.from_elevation_deg != -90) writer.member("from_elevation", sector.from_elevation_deg);
    if (sector.to_elevation_deg != 90) writer.member("to_elevation", sector.to_elevation_deg);
    writer.end_object();
}

}  // namespace seaglare::lightdb
