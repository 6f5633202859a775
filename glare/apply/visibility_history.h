// Which light of a frame was which in the frame before, and how much of what is seen now counts: temporal smoothing of
// visibility that is the same at every frame rate. Pure bookkeeping on the CPU; the values themselves stay on the GPU
// (occlusion.h). What is kept is in proportion to the lights of one frame.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "glare/apply/light_instance.h"

namespace seaglare::glare {

class VisibilityHistory {
  public:
    // Beyond, a step in time is a jump: everything is seen for the first time.
    static constexpr double longest_step_s = 1;
    // A clock that stands still for more frames than this is a simulation that is paused while the camera moves.
    static constexpr int longest_standstill_frames = 8;
    // A light that is further than this from where it was a frame ago is another one, or the camera has cut.
    static constexpr double cos_largest_turn = 0.94;  // 20 degrees
    static constexpr double largest_approach = 2;     // in distance, nearer or farther

    // Takes the step from the last frame's time to this one's. With y the value kept, g what is seen and a time constant,
    // y' = (g - y)/smoothing_s has the exact step y += blend() (g - y), blend = 1 - exp(-dt/smoothing_s): two half steps are
    // one step. smoothing_s 0: what is seen counts at once.
    void begin(double time_s, double smoothing_s);
    double blend() const { return blend_; }
    // Whatever was seen before says nothing any more.
    bool begins_anew() const { return anew_; }

    // For each light its index in the frame before, or -1 when it is seen for the first time. `tags` parallel to `lights`.
    // Keeps what the next frame needs; call once a frame, after begin(). No allocation in a steady frame.
    void match(std::span<const LightInstance> lights, std::span<const std::uint32_t> tags,
               std::vector<std::int32_t>& previous);

    // The same for lights as they come from the database, by their own tags.
    void match(std::span<const PointSource> lights, std::vector<std::int32_t>& previous);

    void clear() { last_.clear(); }

  private:
    struct Entry {
        std::uint32_t tag = 0;
        std::int32_t index = 0;
        std::array<float, 3> direction{};
        float distance_m = 0;
    };
    template <class EntryOf>
    void match_all(std::size_t count, const EntryOf& entry_of, std::vector<std::int32_t>& previous);

    bool begun_ = false;
    double time_s_ = 0;
    double blend_ = 1;
    bool anew_ = true;
    int standstill_ = 0;
    std::vector<Entry> last_;  // by tag
    std::vector<Entry> now_;
};

}  // namespace seaglare::glare
