// What those who draw need of a pattern besides itself: the halves of its textures, its copies on OpenCL devices. Made by the
// thread that makes patterns, so that the one that draws only takes up what is there. Nothing is made that nobody uses.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "glare/apply/gather_pattern.h"
#include "glare/apply/grid_texels.h"
#include "glare/apply/pattern_texels.h"
#include "glare/device/cl_device.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

// What a view does with patterns.
struct PatternUse {
    bool draws = false;                // skirts in GL
    bool grids = false;                // most of them on grids
    std::shared_ptr<ClShared> gather;  // the OpenCL context it gathers in; null: it does not
};

// Those of all views. Views of one OpenCL context need one copy; contexts beyond the last have to make their own.
inline constexpr std::size_t most_gather_contexts = 8;
struct PatternUses {
    bool draws = false;
    bool grids = false;
    std::array<std::shared_ptr<ClShared>, most_gather_contexts> gather;
    void add(const PatternUse& use);
};

struct PreparedPattern {
    PatternTexels texels;
    GridTexels grid_texels;
    struct Copies {
        std::shared_ptr<ClShared> context;
        GatherPattern pattern;
    };
    std::vector<std::unique_ptr<Copies>> copies;
    // Those that are of this pattern; null: there are none.
    const PatternTexels* texels_of(const Pattern& pattern) const;
    const GridTexels* grid_texels_of(const Pattern& pattern) const;
    const GatherPattern* copies_of(const Pattern& pattern, const ClShared& context) const;

    std::size_t device_bytes() const;
    std::size_t host_bytes() const {
        return (texels.halves.capacity() + grid_texels.departures.capacity()) * sizeof(Half);
    }

    // How many read it. While any does, nobody writes to it.
    mutable std::atomic<int> readers{0};
};

// Makes them, on queues of its own. One thread at a time.
class PatternPreparer {
  public:
    // Whatever `uses` asks for and `to` has not. An OpenCL context that fails gets no copies: who gathers in it finds out
    // by itself. What is not asked for is released.
    void prepare(const Pattern& pattern, const PatternUses& uses, PreparedPattern& to);
    // Keeps nothing of that context.
    void forget(const ClShared& shared) {
        std::erase_if(contexts_,
                      [&](const auto& context) { return context->device.shared().get() == &shared; });
    }

  private:
    struct Context {
        explicit Context(std::shared_ptr<ClShared> shared) : device(std::move(shared)) {}
        ClDevice device;
        GatherPatternWriter writer{device};
    };
    Context& context_of(const std::shared_ptr<ClShared>& shared);
    std::vector<std::unique_ptr<Context>> contexts_;
    GridTexelMaker grid_texels_;
};

}  // namespace seaglare::glare
