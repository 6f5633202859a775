// Visibilities on their way from the GPU to the CPU, a frame or two late: a ring of pixel buffers with fences that are asked
// and never waited for. For ways to add lights that do not read the GPU's texture.
//
// GL moves the pixels by itself; on a software rasteriser, which has nothing to move them with, glReadPixels waits for the
// depth to be drawn, as any way from there to the CPU would.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "glare/device/gl_object.h"

namespace seaglare::glare {

class VisibilityReadback {
  public:
    explicit VisibilityReadback(const Gl& gl) : gl_(gl) {}
    ~VisibilityReadback();
    VisibilityReadback(const VisibilityReadback&) = delete;
    VisibilityReadback& operator=(const VisibilityReadback&) = delete;

    // Takes in what has arrived. `anew`: what was seen before says nothing any more.
    void poll(bool anew);
    // A frame's lights, by tag, in the order of the texels that follow. False: the GPU is behind, this frame is not read,
    // unless it `must`: then the oldest that is under way is given up.
    bool begin(std::span<const std::uint32_t> tags, bool must = false);
    // Between begin() and end(): of the framebuffer bound for reading, rows of `width` texels of which one each is a light.
    // Leaves no pixel pack buffer bound.
    void read(int width, int first_row, int rows);
    void end();
    // In place of end(): waits for the GPU and takes in this very frame.
    void end_now();

    // The latest that has arrived of a light; nothing when it was not in that frame.
    std::optional<float> known(std::uint32_t tag) const;
    double memory_bytes() const;
    void forget();

  private:
    struct Value {
        std::uint32_t tag = 0;
        float visibility = 1;
    };
    struct Slot {
        GlObject buffer;
        std::size_t bytes = 0;
        GLsync fence = nullptr;
        std::uint64_t frame = 0;
        std::vector<std::uint32_t> tags;
    };
    void take(Slot& slot);
    void make_room(Slot& slot, std::size_t bytes);

    const Gl& gl_;
    std::array<Slot, 3> slots_;
    Slot* current_ = nullptr;
    std::size_t offset_ = 0;
    std::uint64_t frame_ = 0;
    std::uint64_t known_frame_ = 0;  // older ones count no more
    std::vector<Value> known_;       // by tag
};

}  // namespace seaglare::glare
