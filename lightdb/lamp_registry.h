// The lamps of a light store: each spectrum that its lights have once, with its colour and with the pattern that it is
// drawn with.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "glare/colour/lamp_list.h"
#include "lightdb/light_spectrum.h"

namespace seaglare::lightdb {

class LampRegistry {
  public:
    using Index = std::uint16_t;

    struct Entry {
        glare::UnitColour colour;
        std::uint8_t lamp = 0;  // in list(): what PointSource::lamp is
        bool own_slot = true;   // false: list() is full, `lamp` is the nearest in it
        SharedLamp spectrum;    // null: a navigation colour, or free
        std::uint32_t users = 0;
    };

    // The navigation colours are entries 0 ... lamp_count - 1, whoever uses them.
    LampRegistry();

    // The entry of a spectrum, counted once more. Throws std::length_error beyond 65 535.
    Index intern(const SharedLamp& spectrum);
    void release(Index entry);

    const Entry& operator[](Index entry) const { return entries_[entry]; }
    const std::shared_ptr<const glare::LampList>& list() const { return list_; }
    // The largest channel, in lux per lux, that any of the named spectra has, rods counted as white; 0: there are none.
    double strongest_channel_per_lux() const { return strongest_; }
    // Spectra for which list() had no room.
    std::uint32_t without_slot() const { return without_slot_; }
    std::size_t memory_bytes() const;

  private:
    void rebuild();

    std::vector<Entry> entries_;
    std::shared_ptr<const glare::LampList> list_;
    double strongest_ = 0;
    std::uint32_t without_slot_ = 0;
};

}  // namespace seaglare::lightdb
