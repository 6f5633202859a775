#include "plugin_api/pattern_maker.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>

#include "glare/psf/pattern_mix.h"

namespace seaglare::plugin {

namespace {

// Patterns kept for a pitch that has not been asked for while so many others were are free for another.
constexpr std::uint64_t stale_after = 64;

std::uint64_t version_of(const glare::PatternRequest& request) {
    return request.lamp_list != nullptr ? request.lamp_list->version : 0;
}

}  // namespace

PatternMaker::PatternMaker(const glare::EyeModel& eye, const glare::PatternSettings& settings,
                           std::uint64_t seed, bool use_opencl)
    : eye_(eye), settings_(settings), seed_(seed) {
    glare::validate(settings.motion);
    if (!use_opencl) {
        fall_back("OpenCL was not asked for");
        return;
    }
    try {
        source_ = glare::make_cl_pattern_source(eye_, settings_, seed_);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        fall_back(error.what());
    }
}

void PatternMaker::fall_back(const std::string& reason) {
    source_ = glare::make_cpu_pattern_source(eye_, settings_, seed_);
    kept_.clear();
    pages_ahead_ = 0;
    reason_ = "the glare pattern is made on the CPU and does not move: " + reason;
}

template <class Work>
void PatternMaker::or_on_the_cpu(const Work& work) {
    try {
        work();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        if (degraded()) throw;
        fall_back(error.what());
        work();
    }
}

bool PatternMaker::serves(const glare::PatternRequest& made, std::uint64_t made_list,
                          const glare::PatternRequest& wanted, std::uint64_t wanted_list) {
    return made.pitch == wanted.pitch && made.pupil_mm == wanted.pupil_mm &&
           made.resting_pupil_mm == wanted.resting_pupil_mm && made.time_s == wanted.time_s &&
           made.lids == wanted.lids && made.vitreous_roll_rad == wanted.vitreous_roll_rad &&
           (wanted.lamps & ~made.lamps) == 0 && made_list == wanted_list &&
           made.largest_disc_nodes >= wanted.largest_disc_nodes;
}

glare::PatternRequest PatternMaker::standing(const glare::PatternRequest& request) {
    const double step = std::log(1.01);  // one of a twentieth would show: 6 codes beside a bright light
    glare::PatternRequest still = request;
    still.pupil_mm = request.resting_pupil_mm > 0 ? request.resting_pupil_mm : request.pupil_mm;
    if (still.pupil_mm > 0 && std::isfinite(still.pupil_mm))
        still.pupil_mm = std::exp(std::round(std::log(still.pupil_mm) / step) * step);
    still.resting_pupil_mm = still.pupil_mm;
    still.time_s = 0;
    still.lids.squint = std::round(still.lids.squint * 20) / 20;
    still.lids.blink = std::round(still.lids.blink * 32) / 32;  // cheap: it dims the pattern
    still.vitreous_roll_rad = 0;
    return still;
}

std::size_t PatternMaker::most_kept() const {
    // Two are mixed, and one may be made for the next.
    return settings_.motion.mode == glare::MotionMode::flip_book
               ? static_cast<std::size_t>(settings_.motion.frames)
               : 3;
}

PatternMaker::Kept* PatternMaker::find(const glare::PatternRequest& request) {
    const std::uint64_t version = version_of(request);
    const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const auto& kept) {
        return kept->pattern.generation != 0 && serves(kept->request, kept->lamp_list, request, version);
    });
    return found == kept_.end() ? nullptr : found->get();
}

PatternMaker::Kept& PatternMaker::claim(double pitch) {
    const auto is_stale = [&](const std::unique_ptr<Kept>& kept) {
        const auto of_pitch = std::find_if(pitches_.begin(), pitches_.end(),
                                           [&](const Pitch& p) { return p.pitch == kept->request.pitch; });
        return of_pitch == pitches_.end() || of_pitch->used + stale_after < clock_;
    };
    const auto stale = std::find_if(kept_.begin(), kept_.end(), is_stale);
    if (stale != kept_.end()) return **stale;
    Kept* oldest = nullptr;
    std::size_t of_this_pitch = 0;
    for (const auto& kept : kept_) {
        if (kept->request.pitch != pitch) continue;
        ++of_this_pitch;
        if (oldest == nullptr || kept->used < oldest->used) oldest = kept.get();
    }
    if (oldest != nullptr && of_this_pitch >= most_kept()) return *oldest;
    return *kept_.emplace_back(std::make_unique<Kept>());
}

const glare::Pattern& PatternMaker::keep(const glare::PatternRequest& request, int& launches) {
    ++clock_;
    auto of_pitch = std::find_if(pitches_.begin(), pitches_.end(),
                                 [&](const Pitch& p) { return p.pitch == request.pitch; });
    if (of_pitch == pitches_.end()) {
        std::erase_if(pitches_, [&](const Pitch& p) { return p.used + stale_after < clock_; });
        of_pitch = pitches_.insert(pitches_.end(), Pitch{request.pitch, 0});
    }
    of_pitch->used = clock_;
    Kept* kept = find(request);
    if (kept == nullptr) {
        kept = &claim(request.pitch);
        kept->pattern.generation = 0;  // what follows may throw
        source_->make_into(request, kept->pattern);
        kept->request = request;
        kept->request.lamp_list = nullptr;  // it may end before this does
        kept->lamp_list = version_of(request);
        launches += kept->pattern.kernel_launches;
    }
    kept->used = clock_;
    return kept->pattern;
}

void PatternMaker::make_now(const glare::EyeMoment& moment, glare::Pattern& pattern) {
    const glare::PatternMotion& motion = settings_.motion;
    if (degraded()) {
        source_->make_into(standing(moment.request), pattern);
        return;
    }
    if (motion.mode == glare::MotionMode::every_frame) {
        source_->make_into(moment.request, pattern);
        return;
    }
    const glare::MotionKeys keys = glare::motion_keys(eye_, motion, seed_, moment);
    int launches = 0;
    const glare::Pattern& first = keep(keys.list[0].request, launches);
    const glare::MotionKeys::Key& last = keys.list[static_cast<std::size_t>(keys.count - 1)];
    const glare::Pattern& second = keep(last.request, launches);
    const double later = keys.count > 1 ? last.weight : 0;
    glare::mix_patterns(first, second, later, pattern, keys.share);
    pattern.kernel_launches = launches;
    pattern.pupil_mm = moment.request.pupil_mm;
    if (motion.mode == glare::MotionMode::flip_book) {
        ahead_ = moment;
        page_ahead_ = last.page + 1;
        pages_ahead_ = motion.frames;
    }
}

void PatternMaker::make(const glare::EyeMoment& moment, glare::Pattern& pattern) {
    or_on_the_cpu([&] { make_now(moment, pattern); });
}

bool PatternMaker::turn_ahead() {
    bool made = false;
    while (!made && pages_ahead_ > 0 && !degraded()) {
        --pages_ahead_;
        const int page = page_ahead_++ % settings_.motion.frames;
        const glare::PatternRequest request =
            glare::flip_book_page(eye_, settings_.motion, seed_, ahead_, page);
        if (find(request) != nullptr) continue;
        or_on_the_cpu([&] {
            int launches = 0;
            if (!degraded()) keep(request, launches);
        });
        made = true;
    }
    return made;
}

void PatternMaker::prepare(const glare::LampList& lamps) {
    or_on_the_cpu([&] { source_->prepare(lamps); });
}

void PatternMaker::warm_up(const glare::PatternRequest& request) {
    or_on_the_cpu([&] {
        const double pupil_mm = degraded() ? standing(request).pupil_mm : request.pupil_mm;
        source_->warm_up(request.pitch, pupil_mm);
    });
}

std::size_t PatternMaker::kept_bytes() const {
    std::size_t total = 0;
    for (const auto& kept : kept_)
        total += kept->pattern.skirt.capacity() * sizeof(float);
    return total;
}

}  // namespace seaglare::plugin
