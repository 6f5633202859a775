#include "glare/apply/cl_gather.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "glare/device/cl_signal_guard.h"

namespace seaglare::glare {

namespace {

constexpr std::size_t group_columns = tile_width / strip_nodes;
constexpr std::size_t node_bytes = 4 * sizeof(float);

static_assert(band_rows % tile_height == 0);
std::size_t band_bytes(const GridLevel& picture) {
    const int rows = std::min(band_rows, picture.height);
    return static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(rows) * node_bytes;
}

// As in shaders/gather.cl: the ray of a pixel, not normalised.
struct alignas(16) Rays {
    std::array<float, 4> constant{};
    std::array<float, 4> per_x{};
    std::array<float, 4> per_y{};
};

Rays rays_of(const ScreenGeometry& g) {
    Rays rays;
    const auto& m = g.ray_from_ndc;
    for (std::size_t i = 0; i < 3; ++i) {
        rays.constant[i] = static_cast<float>(m[6 + i] - m[i] - m[3 + i]);
        rays.per_x[i] = static_cast<float>(2 * m[i] / g.width_px);
        rays.per_y[i] = static_cast<float>(2 * m[3 + i] / g.height_px);
    }
    return rays;
}

// A band that is on its way to the CPU, or there: until it is destroyed, also by an exception.
class MappedBand {
  public:
    MappedBand(cl_command_queue queue, cl_mem memory, RowRange band, std::size_t bytes)
        : queue_(queue), memory_(memory), band_(band), floats_(bytes / sizeof(float)) {
        cl_int code = CL_SUCCESS;
        pixels_ =
            clEnqueueMapBuffer(queue, memory, CL_FALSE, CL_MAP_READ, 0, bytes, 0, nullptr, &there_, &code);
        check_cl(code, "clEnqueueMapBuffer(HDR sum)");
        check_cl(clFlush(queue), "clFlush");
    }
    ~MappedBand() {
        if (there_ != nullptr) clReleaseEvent(there_);
        if (pixels_ != nullptr) clEnqueueUnmapMemObject(queue_, memory_, pixels_, 0, nullptr, nullptr);
    }
    MappedBand(const MappedBand&) = delete;
    MappedBand& operator=(const MappedBand&) = delete;
    RowRange band() const { return band_; }
    std::span<const float> wait() const {
        check_cl(clWaitForEvents(1, &there_), "clWaitForEvents(HDR sum)");
        return {static_cast<const float*>(pixels_), floats_};
    }

  private:
    cl_command_queue queue_;
    cl_mem memory_;
    RowRange band_;
    std::size_t floats_;
    cl_event there_ = nullptr;
    void* pixels_ = nullptr;
};

}  // namespace

ClGather::ClGather(ClDevice device)
    : device_(std::move(device)),
      rows_(device_.is_cpu() ? gather_rows_on_cpu : gather_rows),
      mean_(device_.program(KernelSet::gather), "gather_mean"),
      structure_(device_.program(KernelSet::gather), "gather_structure"),
      writer_(device_) {
    static_assert(gather_rows_on_cpu == tile_height);
}

void ClGather::warm_up() {
    Frame frame;
    frame.viewport_px = {0, 0, 128, 128};
    auto& m = frame.clip_from_view;
    m[0] = m[5] = 1;
    m[10] = m[11] = -1;
    m[14] = -0.2;
    const ScreenGeometry g = screen_geometry(frame);
    Pattern pattern;
    pattern.pitch = g.pitch;
    pattern.tail_scale = 1;
    pattern.window_inner = 2.5 * g.pitch;
    pattern.window_outer = 3 * g.pitch;
    LightInstance light;
    light.direction = {0, 0, -1};
    light.illuminance = {1, 1, 1, 1};
    const std::array<LightInstance, 1> lights = {light};
    ReachSettings reach;
    reach.threshold_cd_m2 = 1e-3;
    prepare({g, pattern, reach, lights, {}});
    sum({0, g.height_px}, [](RowRange, std::span<const float>) {});
}

// Commands read memory of ours.
ClGather::~ClGather() {
    if (under_way_) clFinish(device_.queue());
}

void ClGather::settle() {
    if (!under_way_) return;
    device_.finish();
    under_way_ = false;
}

std::uint32_t ClGather::prepare(const AccumulationInput& input) {
    settle();
    under_way_ = true;
    const Pattern& pattern = input.pattern;
    const bool given =
        input.copies != nullptr && pattern.generation != 0 && input.copies->generation == pattern.generation;
    if (given)
        own_copies_ = {};
    else
        writer_.write(pattern, own_copies_);
    copies_ = given ? input.copies : &own_copies_;
    geometry_ = input.geometry;
    const bool has_tail = pattern.tail_scale > 0 && pattern.pitch > 0;
    tail_from_nodes_ = static_cast<float>(has_tail ? pattern.window_inner / pattern.pitch : 1e9);
    radius_nodes_ = pattern.radius_nodes;
    lists_.build(input.geometry, input.pattern, copies_->profile,
                 {input.reach.threshold_cd_m2, input.reach.tail_threshold_cd_m2, input.structure},
                 input.lights, input.visible);
    cl_context context = device_.context();
    cl_command_queue queue = device_.queue();
    const auto put = [&](ClBuffer& buffer, auto values, const char* what) {
        buffer.reserve(context, queue, std::max(values.size_bytes(), node_bytes), what);
        buffer.write(queue, values.size_bytes(), values.data());
    };
    put(lights_, lists_.lights(), "lights");
    put(entries_, lists_.entries(), "lights by grid");
    put(tile_begin_, lists_.tile_begin(), "tiles");
    put(tile_entries_, lists_.tile_entries(), "lights by tile");
    put(departing_begin_, lists_.departures().tile_begin(), "tiles");
    put(departing_, lists_.departures().entries(), "departures by tile");
    reserve_sums();
    return sum_grids();
}

void ClGather::reserve_sums() {
    cl_context context = device_.context();
    cl_command_queue queue = device_.queue();
    for (ClBuffer& band : bands_)
        band.reserve(context, queue, band_bytes(lists_.levels()[0]), "HDR sum");
    for (std::size_t l = 1; l < lists_.levels().size(); ++l) {
        const GridLevel& grid = lists_.levels()[l];
        sums_[l].reserve(
            context, queue,
            static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height) * node_bytes,
            "HDR sum");
    }
}

std::uint32_t ClGather::sum_grids() {
    const Rays rays = rays_of(geometry_);
    const std::span<const GridLevel> levels = lists_.levels();
    const int used = lists_.levels_used();
    const auto group_rows = static_cast<std::size_t>(tile_height / rows_);
    for (int l = used - 1; l > 0; --l) {
        const auto at = static_cast<std::size_t>(l);
        const GridLevel& grid = levels[at];
        const bool coarsest = l == used - 1;
        // OpenCL has no null for a buffer that is not read: any will do.
        cl_mem above = coarsest ? copies_->tables.get() : sums_[at + 1].get();
        const cl_int above_width = coarsest ? 0 : levels[at + 1].width;
        mean_.set(rays, static_cast<cl_float>(grid.cell_px), static_cast<cl_int>(grid.pad),
                  static_cast<cl_int>(grid.width), static_cast<cl_int>(grid.height), lights_.get(),
                  entries_.get(), tile_begin_.get(), static_cast<cl_int>(grid.first_tile),
                  tile_entries_.get(), static_cast<cl_int>(grid.tiles_across), copies_->tables.get(),
                  static_cast<cl_int>(RadialTable::entries), above, above_width, sums_[at].get());
        mean_.launch(device_.queue(), static_cast<std::size_t>(grid.tiles_across) * group_columns,
                     static_cast<std::size_t>(grid.tiles_down) * group_rows, group_columns, group_rows);
    }
    return static_cast<std::uint32_t>(used - 1);
}

void ClGather::launch_band(RowRange band, cl_mem out) {
    const GridLevel& picture = lists_.levels()[0];
    const bool alone = lists_.levels_used() == 1;
    const int first_tile_row = band.first / tile_height;
    const int tiles_down = (band.count + tile_height - 1) / tile_height;
    structure_.set(rays_of(geometry_), static_cast<cl_int>(band.first), static_cast<cl_int>(picture.width),
                   static_cast<cl_int>(picture.height), lights_.get(), entries_.get(), tile_begin_.get(),
                   static_cast<cl_int>(first_tile_row * picture.tiles_across), tile_entries_.get(),
                   static_cast<cl_int>(picture.tiles_across), copies_->tables.get(),
                   static_cast<cl_int>(RadialTable::entries),
                   static_cast<cl_int>(copies_->profile.tail_table()), tail_from_nodes_, copies_->skirt.get(),
                   static_cast<cl_float>(copies_->skirt_scale), static_cast<cl_int>(radius_nodes_),
                   copies_->departures.get(), static_cast<cl_float>(copies_->departures_scale),
                   departing_begin_.get(), static_cast<cl_int>(first_tile_row * picture.tiles_across),
                   departing_.get(), alone ? copies_->tables.get() : sums_[1].get(),
                   static_cast<cl_int>(alone ? 0 : lists_.levels()[1].width), out);
    const auto group_rows = static_cast<std::size_t>(tile_height / rows_);
    structure_.launch(device_.queue(), static_cast<std::size_t>(picture.tiles_across) * group_columns,
                      static_cast<std::size_t>(tiles_down) * group_rows, group_columns, group_rows);
    check_cl(clFlush(device_.queue()), "clFlush");
}

std::uint32_t ClGather::sum(RowRange rows, const TakeRows& take) {
    under_way_ = true;
    const GridLevel& picture = lists_.levels()[0];
    const int end = std::min(rows.end(), picture.height);
    const int bands = (std::max(end - rows.first, 0) + band_rows - 1) / band_rows;
    std::array<std::optional<MappedBand>, 2> under_way;
    const auto start = [&](int i) {
        const auto at = static_cast<std::size_t>(i) % 2;
        const int first = rows.first + i * band_rows;
        const RowRange band{first, std::min(band_rows, end - first)};
        launch_band(band, bands_[at].get());
        under_way[at].emplace(
            device_.queue(), bands_[at].get(), band,
            static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(band.count) * node_bytes);
    };
    const auto finish = [&](int i) {
        std::optional<MappedBand>& band = under_way[static_cast<std::size_t>(i) % 2];
        take(band->band(), band->wait());
        band.reset();
    };
    // While a band is taken, the next is summed.
    for (int i = 0; i < bands; ++i) {
        start(i);
        if (i > 0) finish(i - 1);
    }
    if (bands > 0) finish(bands - 1);
    return static_cast<std::uint32_t>(bands);
}

// Two are known at most. Which of them a frame begins with changes.
const ClGlTexture& ClGather::texture_of(unsigned name) {
    const auto known = std::find_if(textures_.begin(), textures_.end(),
                                    [name](const ClGlTexture& texture) { return texture.texture() == name; });
    if (known != textures_.end()) return *known;
    ClGlTexture& oldest = textures_[next_texture_];
    next_texture_ = 1 - next_texture_;
    oldest = ClGlTexture(device_.context(), name);
    return oldest;
}

std::uint32_t ClGather::sum_into(RowRange rows, const std::array<unsigned, 2>& textures,
                                 const std::function<void(RowRange)>& use) {
    under_way_ = true;
    const GridLevel& picture = lists_.levels()[0];
    const int end = std::min(rows.end(), picture.height);
    const int bands = (std::max(end - rows.first, 0) + band_rows - 1) / band_rows;
    const auto band_of = [&](int i) {
        const int first = rows.first + i * band_rows;
        return RowRange{first, std::min(band_rows, end - first)};
    };
    const auto start = [&](int i) {
        const auto at = static_cast<std::size_t>(i) % 2;
        const ClGlTexture& texture = texture_of(textures[at]);
        const RowRange band = band_of(i);
        launch_band(band, bands_[at].get());
        texture.fill(device_.queue(), bands_[at].get(), static_cast<std::size_t>(picture.width),
                     static_cast<std::size_t>(band.count));
    };
    // Nothing waits on this thread: the queue is in order, and so is GL.
    for (int i = 0; i < bands; ++i) {
        start(i);
        if (i > 0) use(band_of(i - 1));
    }
    if (bands > 0) use(band_of(bands - 1));
    return static_cast<std::uint32_t>(bands);
}

double ClGather::memory_bytes() const {
    std::size_t total = own_copies_.bytes() + lights_.bytes() + entries_.bytes() + tile_begin_.bytes() +
                        tile_entries_.bytes() + departing_begin_.bytes() + departing_.bytes();
    for (const ClBuffer& buffer : bands_)
        total += buffer.bytes();
    for (const ClBuffer& buffer : sums_)
        total += buffer.bytes();
    return static_cast<double>(total);
}

}  // namespace seaglare::glare
