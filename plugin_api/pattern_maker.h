// Makes the pattern of a moment as the configuration says that it moves: anew, mixed from two instants, or from a flip book.
// On OpenCL; without it, or when it fails later, on the CPU. A pure function of (eye, settings, seed, moment): what was made
// before only decides what it costs. One thread at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "glare/eye/eye_model.h"
#include "glare/psf/motion_keys.h"
#include "glare/psf/pattern.h"

namespace seaglare::plugin {

class PatternMaker {
  public:
    // Compiles kernels where there is OpenCL. Never fails for want of a device.
    PatternMaker(const glare::EyeModel& eye, const glare::PatternSettings& settings, std::uint64_t seed,
                 bool use_opencl);

    // The pattern of this moment, into memory of the caller's. Falls back to the CPU when OpenCL fails. Throws as a
    // PatternSource does when that fails, too; `pattern` is then good for nothing but another call.
    void make(const glare::EyeMoment& moment, glare::Pattern& pattern);
    // Makes a page of a flip book that make() will want, for the moment it was last called with. False: there is none.
    bool turn_ahead();

    void prepare(const glare::LampList& lamps);
    void warm_up(const glare::PatternRequest& request);

    bool degraded() const { return !reason_.empty(); }
    const std::string& reason() const { return reason_; }  // why there is no OpenCL; empty: there is
    std::string device_name() const { return source_->device_name(); }
    glare::DeviceMemory device_memory() const { return source_->device_memory(); }
    // Host memory of the patterns kept between calls: keys and pages.
    std::size_t kept_bytes() const;

    // Whether what was made for one request serves the other as it is.
    static bool serves(const glare::PatternRequest& made, std::uint64_t made_list,
                       const glare::PatternRequest& wanted, std::uint64_t wanted_list);

    // Without OpenCL the pattern stands still but for blinks, which dim it: the request with the pupil at rest, in steps of a
    // hundredth, and a blink in steps of a 32nd.
    static glare::PatternRequest standing(const glare::PatternRequest& request);

  private:
    struct Kept {
        glare::PatternRequest request;
        std::uint64_t lamp_list = 0;
        glare::Pattern pattern;
        std::uint64_t used = 0;
    };
    void fall_back(const std::string& reason);
    template <class Work>
    void or_on_the_cpu(const Work& work);
    void make_now(const glare::EyeMoment& moment, glare::Pattern& pattern);
    Kept* find(const glare::PatternRequest& request);
    Kept& claim(double pitch);
    const glare::Pattern& keep(const glare::PatternRequest& request, int& launches);
    std::size_t most_kept() const;  // of one pitch

    glare::EyeModel eye_;
    glare::PatternSettings settings_;
    std::uint64_t seed_;
    std::unique_ptr<glare::PatternSource> source_;
    std::string reason_;
    std::vector<std::unique_ptr<Kept>> kept_;
    std::uint64_t clock_ = 0;
    struct Pitch {
        double pitch = 0;
        std::uint64_t used = 0;
    };
    std::vector<Pitch> pitches_;
    // Of the book that was last looked into: pages from here on have not been made, or not been looked for.
    glare::EyeMoment ahead_;
    int page_ahead_ = 0;
    int pages_ahead_ = 0;
};

}  // namespace seaglare::plugin
