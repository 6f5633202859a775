// The lights of a context, with ids that carry a generation and bodies that move. No GL, no CL, no files.
//
// A light costs about 150 bytes and its texts, and what sets it apart from others: what every frame reads stands in an
// array of its own (light_arrays.h), what lights have in common is kept once (light_kinds.h; a kind is about 900 bytes, so
// a light that is like no other in its rhythm and sectors costs a kilobyte), and the spatial index takes some 20 bytes.
// memory_bytes() counts them; tests/benchmark/README.md has figures. Nothing in here moves when it grows, so that a light
// more is no slower to add to a million than to none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "lightdb/chunked.h"
#include "lightdb/light.h"
#include "lightdb/light_arrays.h"
#include "lightdb/light_batch.h"
#include "lightdb/light_kinds.h"
#include "lightdb/spatial_index.h"
#include "lightdb/text_pool.h"

namespace seaglare::lightdb {

class LightStore {
  public:
    // Normalises the orientation and fills a stable_key of 0. Amortised O(log n).
    LightId add(Light light);
    // The same for a light that keeps its id and its place in the order. false: stale, nothing is done.
    bool replace(LightId id, Light light);
    bool remove(LightId id);  // false: stale
    void clear();             // every id so far becomes stale; bodies are forgotten
    bool contains(LightId id) const { return slot_of(id) != no_light; }
    bool is_on_body(LightId id) const;            // false: on none, or stale
    std::optional<Light> find(LightId id) const;  // a copy; nothing: stale
    LightId id_of(LightIndex slot) const;         // 0: the slot is free or does not exist
    std::size_t size() const { return live_; }
    std::vector<LightId> ids() const;  // in load order

    // Loading many without a frame that waits for them: take_in() some at a time until none is left, with frames drawn in
    // between that do not see them, then show() all at once, in O(their blocks + their bodies' lights). The store is not to
    // be cleared in between. Whatever is thrown, drop() takes back what was taken in. Returns whether there are more.
    bool take_in(LightBatch& batch, std::size_t most);
    void show(LightBatch& batch);
    void drop(LightBatch& batch);

    // One property of one light, in O(1) but for a light that has kept still, O(log n). false: stale, nothing is
    // done.
    bool set_position(LightId id, const Vec3& position_m);  // scene or body; no longer geographic
    bool set_height(LightId id, double height_m);
    bool set_orientation(LightId id, const Quaternion& orientation);  // normalised on entry
    bool set_intensity(LightId id, double intensity_cd);  // of every colour that the light has by night
    bool set_visibility(LightId id, float visibility);
    bool set_on(LightId id, bool on);

    void set_body_pose(std::uint32_t body_id, const BodyPose& pose);  // normalises the orientation
    const BodyPose* body_pose(std::uint32_t body_id) const {          // nullptr: never posed
        return index_.body_pose(body_id);
    }

    // Once a frame, before evaluation: at most about a millisecond.
    void settle() { index_.settle(arrays_); }
    // After loading: orders the spatial index afresh. O(n log n); not in a frame.
    void optimise() { index_.rebuild(arrays_); }

    // What evaluation reads, by slot.
    std::size_t slot_count() const { return arrays_.size(); }
    const LightArrays& arrays() const { return arrays_; }
    const LightKinds::Kind& kind(LightIndex slot) const { return kinds_[arrays_[slot].kind]; }
    const LampRegistry& lamps() const { return kinds_.lamps(); }
    std::uint64_t stable_key(LightIndex slot) const { return arrays_[slot].stable_key; }
    Quaternion orientation(LightIndex slot) const;
    std::string_view name(LightIndex slot) const { return texts_.get(cold_[slot].text).first; }
    const SpatialIndex& index() const { return index_; }
    std::size_t kind_count() const { return kinds_.size(); }  // that differ
    // Lights that cannot shine: switched off, hidden, without an intensity, or nowhere.
    std::uint32_t asleep() const { return static_cast<std::uint32_t>(live_ - awake_); }

    // Of everything held for the lights, in bytes of capacity; what the allocator adds is not counted.
    std::size_t memory_bytes() const;

  private:
    // What only tools and files ask for.
    struct Cold {
        double latitude_deg = 0;
        double longitude_deg = 0;
        double height_m = 0;
        double true_north_deg = 0;
        double radius_m = 0;
        TextPool::Handle text = 0;  // name and source
    };

    LightIndex slot_of(LightId id) const;  // no_light: stale
    LightIndex free_slot();
    void set_data(LightIndex slot, Light light);
    void fill(LightIndex slot, Light light);
    void append_to_order(LightId id);
    void empty(LightIndex slot);
    bool may_shine(LightIndex slot) const;
    float effective_peak_cd(LightIndex slot) const;
    void wake_or_sleep(LightIndex slot);
    void pack_texts();

    LightArrays arrays_;
    Chunked<std::uint32_t> generation_;
    Chunked<Cold> cold_;
    std::unordered_map<LightIndex, Quaternion> orientation_;  // of those that are turned
    LightKinds kinds_;
    TextPool texts_;
    SpatialIndex index_;

    std::vector<LightIndex> free_;
    // Of all lights in load order, run after run; may hold stale ids, at most as many as live ones and a few.
    std::vector<std::vector<LightId>> order_;
    std::size_t ordered_ = 0;  // ids in it
    std::size_t live_ = 0;
    std::size_t awake_ = 0;
};

}  // namespace seaglare::lightdb
