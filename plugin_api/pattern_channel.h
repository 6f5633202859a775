// The patterns of one pitch: the one that is shown, the next that is being made, and what is asked for. Two tables take
// turns; a third is there only while a view on another thread still draws with an old one.
//
// Guarded by the store's mutex, but for what is said to belong to the maker: the thread that holds the store's maker.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "glare/apply/prepared_pattern.h"
#include "glare/psf/motion_keys.h"
#include "plugin_api/pattern_maker.h"

namespace seaglare::plugin {

// How long a jump of the eye takes in the picture: an adaptation set to another value, a lamp that comes into view.
inline constexpr double pattern_blend_s = 0.15;
// Lamps stay in the patterns made ahead for so long after they were last seen: lights flash, and each flash would begin with
// the pattern of another lamp.
inline constexpr double lamp_linger_s = 10;

// What views did with patterns is prepared for so many more that they ask for: plans change from frame to frame.
inline constexpr std::uint64_t use_lingers = 64;

// A pattern that views draw with. While pins are held, nobody writes to it.
struct PatternSlot {
    glare::Pattern pattern;
    // Made of it, for views to read beyond the frame: never null. A view may still have it when the pattern is written over;
    // the slot has another by then.
    std::shared_ptr<glare::PreparedPattern> prepared = std::make_shared<glare::PreparedPattern>();
    glare::PatternRequest request;  // its lamp_list is null: see lamp_list
    std::uint64_t lamp_list = 0;    // the version of that
    bool exact = false;             // of its request and nothing else: no blend
    bool shown = false;             // a view has had it
    std::atomic<int> pins{0};
};

class PatternChannel {
  public:
    explicit PatternChannel(double pitch) : pitch_(pitch) {}

    double pitch() const { return pitch_; }
    // For another pitch: forgets what it has, keeps its memory. Not while busy().
    void take_over(double pitch);
    bool busy() const;
    std::uint64_t used = 0;  // the store's clock when it was last asked for

    // The pattern for a frame at this time: the same for every viewer of one instant; otherwise the newest, unless it is of a
    // later instant and the one before it is nearer. A viewer that asks again at the same time has come to its next frame:
    // the host has paused. Null: none has been made.
    PatternSlot* choose(double time_s, const void* viewer);
    // What a viewer that waited for its own pattern has: of the one shown before, nothing is kept.
    void show(PatternSlot& slot, double time_s);
    PatternSlot* newest() const { return newest_; }
    // A pattern exactly as asked for, if one of them is.
    PatternSlot* serving(const glare::PatternRequest& request) const;

    // Adds the lamps seen lately to a request that is seen now.
    std::uint32_t lingering_lamps(std::uint32_t lamps, double time_s);

    // What a view does with the patterns of this pitch, and what all of them did lately.
    void note_use(const glare::PatternUse& use);
    glare::PatternUses uses() const;
    void forget_use(const glare::ClShared& context);

    // What the next pattern shall be. A later wish takes the place of an earlier one.
    struct Wish {
        glare::EyeMoment moment;
        double interval_s = 0;
        std::uint64_t order = 0;
        glare::PatternUses uses;  // as of when it is taken
    };
    const std::optional<Wish>& wish() const { return wish_; }
    // Not while the last pattern has not been shown: the next but one would need copies of its own on every device.
    bool wish_is_due() const;
    // False: what is there serves already.
    bool ask(const glare::EyeMoment& moment, const glare::PatternRequest& as_made, double interval_s,
             std::uint64_t order);
    Wish take_wish();

    // A slot to write to, held until publish() or give_up(). For the maker.
    PatternSlot& claim();
    void publish(PatternSlot& slot);
    void give_up();

    // For the maker, without the store's mutex. Makes the wish's pattern into a claimed slot, and what its uses ask for;
    // `blended`: after a jump of the eye it goes over from what was shown before, in pattern_blend_s. Throws as
    // PatternMaker::make.
    void make(PatternMaker& maker, glare::PatternPreparer& preparer, const Wish& wish, PatternSlot& slot,
              bool blended);

    // As of the last publish().
    std::size_t host_bytes() const;
    std::size_t prepared_host_bytes() const { return prepared_host_bytes_; }
    std::size_t device_bytes() const { return device_bytes_; }
    // Appends everything that is prepared: views that come back to these patterns go without. For the maker.
    void let_go_of_prepared(std::vector<std::shared_ptr<glare::PreparedPattern>>& to);

  private:
    void begin_or_end_blend(const Wish& wish);
    void renew_prepared(PatternSlot& slot);

    double pitch_;
    std::vector<std::unique_ptr<PatternSlot>> slots_;
    PatternSlot* newest_ = nullptr;
    PatternSlot* shown_ = nullptr;
    double shown_time_s_ = 0;
    std::array<const void*, 16> viewers_{};  // that have had it at that time
    std::size_t viewer_count_ = 0;
    PatternSlot* claimed_ = nullptr;
    std::optional<Wish> wish_;
    std::array<double, glare::most_lamps> lamp_seen_s_{};
    std::uint32_t lamps_seen_ = 0;
    bool blending_ = false;  // as of the last publish()
    std::vector<std::shared_ptr<glare::PreparedPattern>>
        read_on_;  // no slot's, as they were read when it was written
    struct Use {
        glare::PatternUse use;
        std::uint64_t at = 0;
    };
    std::array<Use, glare::most_gather_contexts> gathers_;
    std::uint64_t draws_at_ = 0;
    std::uint64_t grids_at_ = 0;
    std::uint64_t asked_ = 0;  // note_use() so often
    std::size_t prepared_host_bytes_ = 0;
    std::size_t device_bytes_ = 0;

    // The maker's.
    std::optional<glare::PatternRequest> last_;  // that make() was called with
    glare::Pattern from_;
    glare::Pattern target_;
    double blended_s_ = 0;
    bool blend_ = false;
};

}  // namespace seaglare::plugin
