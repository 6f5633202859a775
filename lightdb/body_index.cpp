#include "lightdb/body_index.h"

#include <algorithm>
#include <cmath>

#include "lightdb/geodesy.h"
#include "lightdb/light_marks.h"

namespace seaglare::lightdb {

namespace {

// Room to move. Little beside the miles that lights carry; upwards only what a swell heaves, for the height decides where
// the horizon is. A ship at 20 knots has used it up after 25 s.
constexpr Vec3 room_m = {256, 256, 2};
// Beyond it rounding would be more than the room, and on a round Earth there is nothing.
constexpr double farthest_m = 1e9;

// Of a body's box turned and moved into the scene, with all that rounding may do to a light in it.
BoxTree::Box in_scene(const BoxTree::Box& box, const BodyPose& pose) {
    Vec3 centre_m{};
    Vec3 half_m{};
    for (std::size_t i = 0; i < 3; ++i) {
        centre_m[i] = (box.low_m[i] + box.high_m[i]) / 2;
        half_m[i] = (box.high_m[i] - box.low_m[i]) / 2;
    }
    const Vec3 axes[3] = {rotate(pose.orientation, {1, 0, 0}), rotate(pose.orientation, {0, 1, 0}),
                          rotate(pose.orientation, {0, 0, 1})};
    const Vec3 at_m = pose.position_m + rotate(pose.orientation, centre_m);
    BoxTree::Box result;
    for (std::size_t i = 0; i < 3; ++i) {
        const double reach_m = std::abs(axes[0][i]) * half_m[0] + std::abs(axes[1][i]) * half_m[1] +
                               std::abs(axes[2][i]) * half_m[2];
        result.low_m[i] = at_m[i] - reach_m;
        result.high_m[i] = at_m[i] + reach_m;
    }
    return result;
}

BoxTree::Box with_room(BoxTree::Box box) {
    for (std::size_t i = 0; i < 3; ++i) {
        box.low_m[i] -= room_m[i];
        box.high_m[i] += room_m[i];
    }
    return box;
}

// How far a box must stay inside the one in the tree: more than the rounding of a light's place, whatever its way.
BoxTree::Box with_slack(BoxTree::Box box) {
    constexpr double slack_m = 1e-3;
    for (std::size_t i = 0; i < 3; ++i) {
        box.low_m[i] -= slack_m;
        box.high_m[i] += slack_m;
    }
    return box;
}

bool is_bounded(const BoxTree::Box& box) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(box.low_m[i] > -farthest_m && box.high_m[i] < farthest_m)) return false;
    }
    return true;
}

GroupBounds bounds_for(const BoxTree::Bounds& bounds, const CullingEye& eye) {
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double below_m = bounds.box.low_m[i] - eye.eye_m[i];
        const double above_m = eye.eye_m[i] - bounds.box.high_m[i];
        const double outside_m = below_m > 0 ? below_m : above_m > 0 ? above_m : 0;
        square += outside_m * outside_m;
    }
    double highest_m = bounds.box.high_m[2] - eye.water_level_m;
    if (eye.round_earth) {
        const double east_m = std::max(std::abs(bounds.box.low_m[0]), std::abs(bounds.box.high_m[0]));
        const double north_m = std::max(std::abs(bounds.box.low_m[1]), std::abs(bounds.box.high_m[1]));
        highest_m += (east_m * east_m + north_m * north_m) / (2 * earth_radius_m);
    }
    return {std::sqrt(square), highest_m, static_cast<double>(bounds.reach.peak_cd),
            static_cast<double>(bounds.reach.radius_m), bounds.reach.lights};
}

}  // namespace

void BodyIndex::withdraw(Body& body) {
    if (body.leaf != BoxTree::none) tree_.erase(body.leaf);
    body.leaf = BoxTree::none;
    if (body.unbounded_rank == nowhere) return;
    unbounded_[body.unbounded_rank] = unbounded_.back();
    bodies_[unbounded_.back()].unbounded_rank = body.unbounded_rank;
    unbounded_.pop_back();
    body.unbounded_rank = nowhere;
}

void BodyIndex::place(std::uint32_t body_id, Body& body) {
    if (body.lights.empty()) return withdraw(body);
    const BoxTree::Box box = in_scene(body.box, body.pose);
    const bool bounded = is_bounded(body.box) && is_bounded(box);
    if (bounded && body.leaf != BoxTree::none && tree_.box_of(body.leaf).contains(with_slack(box))) {
        return tree_.set_reach(body.leaf, body.reach);
    }
    if (!bounded && body.unbounded_rank != nowhere) return;
    withdraw(body);
    if (bounded) {
        body.leaf = tree_.insert({with_room(box), body.reach}, body_id);
        return;
    }
    unbounded_.push_back(body_id);
    body.unbounded_rank = static_cast<std::uint32_t>(unbounded_.size() - 1);
}

void BodyIndex::set_pose(std::uint32_t body_id, const BodyPose& pose) {
    Body& body = bodies_[body_id];
    body.pose = pose;
    body.posed = true;
    place(body_id, body);
}

const BodyPose* BodyIndex::pose(std::uint32_t body_id) const {
    const auto found = bodies_.find(body_id);
    return found != bodies_.end() && found->second.posed ? &found->second.pose : nullptr;
}

std::uint32_t BodyIndex::insert(const LightArrays& lights, LightIndex light) {
    Body& body = bodies_[lights[light].body_id];
    if (body.lights.empty()) {
        body.box = {lights[light].position_m, lights[light].position_m};
        body.reach = {};
    }
    body.lights.push_back(light);
    ++body.reach.lights;
    if (!lights.is(light, light_flag::day_off)) ++body.reach.by_day;
    widen(lights, light);
    return static_cast<std::uint32_t>(body.lights.size() - 1);
}

LightIndex BodyIndex::erase(const LightArrays& lights, LightIndex light, std::uint32_t rank) {
    const std::uint32_t body_id = lights[light].body_id;
    Body& body = bodies_[body_id];
    body.lights[rank] = body.lights.back();
    body.lights.pop_back();
    --body.reach.lights;
    if (!lights.is(light, light_flag::day_off)) --body.reach.by_day;
    place(body_id, body);
    if (rank < body.lights.size()) return body.lights[rank];
    if (body.lights.empty() && !body.posed) bodies_.erase(body_id);
    return no_light;
}

void BodyIndex::widen(const LightArrays& lights, LightIndex light) {
    const HotLight& hot = lights[light];
    Body& body = bodies_[hot.body_id];
    for (std::size_t i = 0; i < 3; ++i) {
        body.box.low_m[i] = std::min(body.box.low_m[i], hot.position_m[i]);
        body.box.high_m[i] = std::max(body.box.high_m[i], hot.position_m[i]);
    }
    body.reach.peak_cd = std::max(body.reach.peak_cd, hot.peak_cd);
    body.reach.radius_m = std::max(body.reach.radius_m, hot.radius_m);
    place(hot.body_id, body);
}

void BodyIndex::collect(const CullingEye& eye, LightMarks& marks, LeftOutCounts& counts) const {
    const auto enter = [&](const BoxTree::Bounds& bounds) {
        if (eye.is_day && bounds.reach.by_day == 0) {
            counts.off_by_day += bounds.reach.lights;
            return false;
        }
        return !counts.leave_out(eye, bounds_for(bounds, eye));
    };
    const auto mark = [&](std::uint32_t body_id) {
        for (const LightIndex light : bodies_.at(body_id).lights)
            marks.mark(light);
    };
    tree_.visit(enter, mark);
    for (const std::uint32_t body_id : unbounded_)
        mark(body_id);
}

std::size_t BodyIndex::memory_bytes() const {
    std::size_t bytes = tree_.memory_bytes() + unbounded_.capacity() * sizeof(std::uint32_t) +
                        bodies_.bucket_count() * sizeof(void*);
    for (const auto& entry : bodies_)
        bytes += sizeof entry + 2 * sizeof(void*) + entry.second.lights.capacity() * sizeof(LightIndex);
    return bytes;
}

}  // namespace seaglare::lightdb
