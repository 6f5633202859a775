#include "plugin_api/pattern_store.h"

#include <algorithm>
#include <exception>
#include <new>

namespace seaglare::plugin {

namespace {

// Windows that are being resized ask for a new pitch in every frame. A source keeps a pattern until sixteen other
// pitches have been asked for: fewer pointers than that are kept.
constexpr std::size_t most_pitches = 8;

std::uint64_t version_of(const glare::PatternRequest& request) {
    return request.lamp_list != nullptr ? request.lamp_list->version : 0;
}

}  // namespace

PatternStore::PatternStore(const glare::EyeModel& eye, const glare::PatternSettings& settings,
                           std::uint64_t seed, bool use_opencl)
    : eye_(eye), settings_(settings), seed_(seed) {
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

void PatternStore::fall_back(const std::string& reason) {
    made_.clear();
    source_ = glare::make_cpu_pattern_source(eye_, settings_, seed_);
    reason_ = "the glare pattern is made on the CPU and does not move: " + reason;
}

const glare::Pattern& PatternStore::pattern(const glare::PatternRequest& request) {
    const auto found = made_.find(request.pitch);
    if (found != made_.end()) {
        const glare::PatternRequest& last = found->second.request;
        const bool same_instant =
            last.pupil_mm == request.pupil_mm && last.time_s == request.time_s && last.lids == request.lids &&
            last.vitreous_roll_rad == request.vitreous_roll_rad && (request.lamps & ~last.lamps) == 0 &&
            found->second.lamp_list == version_of(request) &&
            last.largest_disc_nodes >= request.largest_disc_nodes;
        if (same_instant) {
            reused_ = true;
            return *found->second.pattern;
        }
    }
    const std::uint64_t before = found != made_.end() ? found->second.generation : 0;
    made_.erase(request.pitch);  // the source may write over it, and then fail
    const glare::Pattern* pattern = nullptr;
    try {
        pattern = &source_->make(request);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        if (degraded()) throw;
        fall_back(error.what());
        pattern = &source_->make(request);
    }
    if (made_.size() >= most_pitches) made_.clear();
    made_[request.pitch] = {request, pattern, pattern->generation, version_of(request)};
    reused_ = pattern->generation == before;  // a source may find its own pattern good enough
    return *pattern;
}

void PatternStore::prepare(const glare::LampList& lamps) {
    try {
        source_->prepare(lamps);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        if (degraded()) throw;
        fall_back(error.what());
        source_->prepare(lamps);
    }
}

void PatternStore::warm_up(double pitch) {
    made_.clear();  // the source writes over the pattern of this pitch
    try {
        source_->warm_up(pitch);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        if (degraded()) throw;
        fall_back(error.what());
        source_->warm_up(pitch);
    }
}

}  // namespace seaglare::plugin
