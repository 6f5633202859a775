#include "lightdb/spatial_index.h"

#include <algorithm>
#include <array>
#include <utility>

#include "lightdb/light_marks.h"

namespace seaglare::lightdb {

namespace {

// settle() looks at so many loose lights: 0.1 ms.
constexpr std::size_t looked_at_per_frame = 4 * LightBlock::capacity;
// Blocks that have lost so many are given up.
constexpr std::size_t fewest_in_block = SpatialIndex::smallest_block / 2;

}  // namespace

void SpatialIndex::make_loose(LightIndex light) {
    loose_.push_back({light, frame_});
    place_[light] = {Home::loose, static_cast<std::uint32_t>(loose_.size() - 1)};
}

void SpatialIndex::leave_loose(LightIndex light) {
    const std::uint32_t at = place_[light].at;
    loose_[at] = loose_.back();
    place_[loose_[at].light].at = at;
    loose_.pop_back();
    place_[light] = {};
}

void SpatialIndex::leave_body(const LightArrays& lights, LightIndex light) {
    const std::uint32_t rank = place_[light].at;
    const LightIndex moved = bodies_.erase(lights, light, rank);
    if (moved != no_light) place_[moved].at = rank;
    place_[light] = {};
}

void SpatialIndex::leave_block(const LightArrays& lights, LightIndex light) {
    const std::size_t number = place_[light].at / LightBlock::capacity;
    LightBlock& block = blocks_[number]->block;
    block.take_out(rank_of(light), lights.is(light, light_flag::day_off));
    place_[light] = {};
    if (block.present() < fewest_in_block) dissolve(lights, number);
}

void SpatialIndex::dissolve(const LightArrays& lights, std::size_t number) {
    for (const LightIndex light : blocks_[number]->block.order()) {
        if (light == no_light) continue;
        place_[light] = {};
        if (lights.is(light, light_flag::awake)) make_loose(light);
    }
    blocks_[number].reset();
    free_blocks_.push_back(static_cast<std::uint32_t>(number));
    --block_count_;
}

void SpatialIndex::give_up_thin_block(const LightArrays& lights) {
    if (blocks_.empty()) return;
    block_cursor_ = (block_cursor_ + 1) % blocks_.size();
    const std::optional<Numbered>& looked_at = blocks_[block_cursor_];
    if (!looked_at || !looked_at->shown || frame_ - looked_at->switched < frames_to_forget) return;
    const LightBlock& block = looked_at->block;
    if (block.awake() * fewest_burning < block.present()) dissolve(lights, block_cursor_);
}

void SpatialIndex::insert(const LightArrays& lights, LightIndex light) {
    make_room(lights);
    if (!lights.is(light, light_flag::awake)) return;
    if (lights[light].body_id != 0) {
        place_[light] = {Home::body, bodies_.insert(lights, light)};
        return;
    }
    make_loose(light);
    if (++newcomers_ >= LightBlock::capacity) fold_newest(lights);
}

void SpatialIndex::erase(const LightArrays& lights, LightIndex light) {
    switch (place_[light].home) {
        case Home::none:
            return;
        case Home::loose:
            return leave_loose(light);
        case Home::body:
            return leave_body(lights, light);
        case Home::block:
            return leave_block(lights, light);
    }
}

void SpatialIndex::moved(const LightArrays& lights, LightIndex light) {
    switch (place_[light].home) {
        case Home::none:
            return;
        case Home::loose:
            loose_[place_[light].at].since = frame_;
            return;
        case Home::body:
            bodies_.widen(lights, light);
            return;
        case Home::block:
            leave_block(lights, light);
            // Unless the block was given up, and all that was in it is loose now: not so the one that left first.
            make_loose(light);
    }
}

void SpatialIndex::intensity_changed(const LightArrays& lights, LightIndex light) {
    if (place_[light].home == Home::body) bodies_.widen(lights, light);
    if (place_[light].home == Home::block) block_of(light).raise_peak(rank_of(light), lights[light].peak_cd);
}

void SpatialIndex::awake_changed(const LightArrays& lights, LightIndex light) {
    const bool awake = lights.is(light, light_flag::awake);
    if (place_[light].home == Home::block) {
        block_of(light).raise_peak(rank_of(light), lights[light].peak_cd);
        block_of(light).set_awake(rank_of(light), awake, lights.is(light, light_flag::day_off));
        blocks_[place_[light].at / LightBlock::capacity]->switched = frame_;
    } else if (awake) {
        insert(lights, light);
    } else {
        erase(lights, light);
    }
}

void SpatialIndex::clear() {
    *this = {};
}

void SpatialIndex::build_block(const LightArrays& lights, std::span<LightBlock::Entry> entries) {
    show_block(take_block(lights, LightBlock(lights, entries)));
}

std::size_t SpatialIndex::take_block(const LightArrays& lights, LightBlock taken) {
    make_room(lights);
    std::size_t number = blocks_.size();
    if (!free_blocks_.empty()) {
        number = free_blocks_.back();
        free_blocks_.pop_back();
    } else {
        blocks_.emplace_back();
    }
    const LightBlock& block = blocks_[number].emplace(Numbered{std::move(taken), frame_, false}).block;
    ++block_count_;
    for (std::size_t rank = 0; rank < block.order().size(); ++rank) {
        place_[block.order()[rank]] = {Home::block,
                                       static_cast<std::uint32_t>(number * LightBlock::capacity + rank)};
    }
    return number;
}

void SpatialIndex::build_blocks(const LightArrays& lights, std::span<LightBlock::Entry> entries) {
    if (entries.size() <= LightBlock::capacity) return build_block(lights, entries);
    const std::size_t middle = entries.size() / 2;
    LightBlock::halve(entries, middle);
    build_blocks(lights, entries.first(middle));
    build_blocks(lights, entries.subspan(middle));
}

void SpatialIndex::fold_newest(const LightArrays& lights) {
    newcomers_ = 0;
    const std::size_t count = std::min(loose_.size(), LightBlock::capacity);
    if (count < smallest_block) return;
    std::vector<LightBlock::Entry> entries(count);
    for (LightBlock::Entry& entry : entries) {
        entry = LightBlock::entry_of(lights, loose_.back().light);
        loose_.pop_back();
    }
    build_block(lights, entries);
}

void SpatialIndex::settle(const LightArrays& lights) {
    ++frame_;
    give_up_thin_block(lights);
    if (loose_.size() < smallest_block) return;
    // Those with a photometer and those without in blocks of their own: by day the first are left out as a whole.
    std::array<std::vector<LightIndex>, 2> settled;
    for (std::size_t i = 0; i < std::min(loose_.size(), looked_at_per_frame); ++i) {
        if (cursor_ >= loose_.size()) cursor_ = 0;
        const Loose& loose = loose_[cursor_++];
        if (frame_ - loose.since < frames_to_settle) continue;
        std::vector<LightIndex>& alike = settled[lights.is(loose.light, light_flag::day_off) ? 1 : 0];
        alike.push_back(loose.light);
        if (alike.size() == LightBlock::capacity) break;
    }
    const std::vector<LightIndex>& most = settled[settled[1].size() > settled[0].size() ? 1 : 0];
    if (most.size() < smallest_block) return;
    std::vector<LightBlock::Entry> entries;
    entries.reserve(most.size());
    for (const LightIndex light : most) {
        entries.push_back(LightBlock::entry_of(lights, light));
        leave_loose(light);
    }
    build_block(lights, entries);
}

void SpatialIndex::rebuild(const LightArrays& lights) {
    place_.resize(lights.size());
    std::vector<LightBlock::Entry> entries;
    for (LightIndex light = 0; light < lights.size(); ++light) {
        Place& place = place_[light];
        if (place.home != Home::loose && place.home != Home::block) continue;
        place = {};
        if (lights.is(light, light_flag::awake)) entries.push_back(LightBlock::entry_of(lights, light));
    }
    loose_.clear();
    blocks_.clear();
    free_blocks_.clear();
    block_count_ = 0;
    newcomers_ = 0;
    // By day the ones with a photometer are left out as whole blocks.
    const auto others = std::partition(entries.begin(), entries.end(), [&](const LightBlock::Entry& entry) {
        return lights.is(entry.light, light_flag::day_off);
    });
    for (const auto& [first, last] : {std::pair(entries.begin(), others), std::pair(others, entries.end())}) {
        const std::span<LightBlock::Entry> part(first, last);
        if (part.size() >= smallest_block) {
            build_blocks(lights, part);
        } else {
            for (const LightBlock::Entry& entry : part)
                make_loose(entry.light);
        }
    }
}

void SpatialIndex::collect(const CullingEye& eye, LightMarks& marks, LeftOutCounts& counts) const {
    for (const std::optional<Numbered>& numbered : blocks_) {
        if (numbered && numbered->shown) numbered->block.collect(eye, marks, counts);
    }
    for (const Loose& loose : loose_)
        marks.mark(loose.light);
    bodies_.collect(eye, marks, counts);
}

std::size_t SpatialIndex::memory_bytes() const {
    std::size_t bytes = place_.capacity() * sizeof(Place) + blocks_.capacity() * sizeof blocks_[0] +
                        free_blocks_.capacity() * sizeof free_blocks_[0] + loose_.capacity() * sizeof(Loose);
    for (const std::optional<Numbered>& numbered : blocks_)
        bytes += numbered ? numbered->block.memory_bytes() - sizeof(LightBlock) : 0;
    return bytes + bodies_.memory_bytes();
}

}  // namespace seaglare::lightdb
