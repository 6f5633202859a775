#include "glare/psf/cl_screen_stage.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "glare/psf/cie_calibration.h"

namespace seaglare::glare {

namespace {

constexpr std::size_t node_group = 64;
constexpr std::size_t row_group = 4;
constexpr std::size_t node_bytes = 4 * sizeof(float);
constexpr std::size_t most_wide_corners = 48;

std::size_t square(int side) {
    return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
}
int corner_count(const PatternGrid& grid) {
    return grid.structure_radius + 2;
}
int border_radius(const PatternGrid& grid) {
    return grid.radius + grid.margin;
}
int border_side(const PatternGrid& grid) {
    return 2 * border_radius(grid) + 1;
}

}  // namespace

ClScreenStage::ClScreenStage(const ClDevice& device, const PatternSettings& settings, LampSamples samples)
    : device_(device),
      core_radius_nodes_(settings.core_radius_nodes),
      plane_width_mm_(settings.plane_width_mm),
      angular_scale_(settings.angular_scale),
      samples_(std::move(samples), settings.wavelengths),
      program_(device.build("pattern.cl")),
      spread_(program_.get(), "spread_corners"),
      join_(program_.get(), "join_corners"),
      calibrate_rings_(program_.get(), "calibrate_rings"),
      split_(program_.get(), "split_rows"),
      balance_(program_.get(), "balance"),
      average_(program_.get(), "average_disc") {
    cl_context context = device.context();
    cl_command_queue queue = device.queue();
    for (std::size_t lamp = 0; lamp < lamp_count; ++lamp)
        upload_wavelengths(lamp);

    std::vector<std::array<std::int32_t, 2>> spans;
    std::vector<std::array<float, 4>> taps;
    std::vector<float> radii = {0.0F};
    radii.insert(radii.end(), settings.layer_radii_px.begin(), settings.layer_radii_px.end());
    for (float radius : radii) {
        const DiscStencil disc = make_disc_stencil(static_cast<double>(radius));
        Stencil s;
        s.radius = radius;
        s.span_begin = static_cast<cl_int>(spans.size());
        s.tap_begin = static_cast<cl_int>(taps.size());
        s.span_weight = static_cast<cl_float>(disc.span_weight);
        for (const DiscSpan& span : disc.spans)
            spans.push_back({span.dy, span.half_width});
        for (const DiscTap& tap : disc.taps)
            taps.push_back(
                {static_cast<float>(tap.dx), static_cast<float>(tap.dy), static_cast<float>(tap.weight), 0});
        s.span_end = static_cast<cl_int>(spans.size());
        s.tap_end = static_cast<cl_int>(taps.size());
        stencils_.push_back(s);
    }
    spans.push_back({0, 0});  // no buffer is empty
    spans_.reserve(context, queue, spans.size() * sizeof(spans[0]), "spans of discs");
    spans_.write(queue, spans.size() * sizeof(spans[0]), spans.data());
    taps_.reserve(context, queue, taps.size() * node_bytes, "rims of discs");
    taps_.write(queue, taps.size() * node_bytes, taps.data());
    result_.reserve(context, queue, 3 * node_bytes, "energy balance");
    gains_.reserve(context, queue, sizeof(float), "gains of rings");  // no buffer is empty
    device.finish();
}

void ClScreenStage::upload_wavelengths(std::size_t lamp) {
    if (samples_[lamp].empty()) return;
    std::vector<std::array<float, 4>> wavelengths;
    for (const SpectralSample& sample : samples_[lamp]) {
        const auto& w = sample.weight;
        wavelengths.push_back({static_cast<float>(w[0]), static_cast<float>(w[1]), static_cast<float>(w[2]),
                               static_cast<float>(w[3])});
        const double samples_per_unit = plane_width_mm_ / (sample.wavelength_nm * 1e-6 * angular_scale_);
        wavelengths.push_back({static_cast<float>(samples_per_unit), 0, 0, 0});
    }
    cl_command_queue queue = device_.queue();
    wavelengths_[lamp].reserve(device_.context(), queue, wavelengths.size() * node_bytes, "spectrum");
    wavelengths_[lamp].write(queue, wavelengths.size() * node_bytes, wavelengths.data());
    device_.finish();  // the vector ends here
    for (const auto& spread : wide_corners_)
        if (spread->lamp == lamp) spread->table = 0;
}

void ClScreenStage::follow(const LampList& lamps) {
    samples_.follow(lamps, [this](std::size_t lamp) { upload_wavelengths(lamp); });
}

const ClScreenStage::Stencil& ClScreenStage::stencil(float radius) const {
    const auto found = std::find_if(stencils_.begin(), stencils_.end(),
                                    [radius](const Stencil& s) { return s.radius == radius; });
    if (found == stencils_.end())
        throw std::logic_error("glare pattern: a layer that the settings do not name");
    return *found;
}

void ClScreenStage::reserve(const PatternGrid& grid, std::size_t layers) {
    cl_context context = device_.context();
    cl_command_queue queue = device_.queue();
    corners_.reserve(context, queue, 2 * square(corner_count(grid)) * node_bytes, "corners");
    skirt_.reserve(context, queue, square(border_side(grid)) * node_bytes, "skirt");
    const auto side = static_cast<std::size_t>(border_side(grid));
    prefix_.reserve(context, queue, side * (side + 1) * node_bytes, "prefix sums");
    row_energy_.reserve(context, queue, 2 * side * node_bytes, "row energies");
    if (layers_.size() < layers) layers_.resize(layers);
    for (std::size_t l = 0; l < layers; ++l)
        layers_[l].reserve(context, queue, square(grid.side()) * node_bytes, "disc layer");
}

int ClScreenStage::spread(const ClEyeStage& eye, const PatternGrid& grid, std::size_t lamp) {
    const cl_int corners = corner_count(grid);
    const cl_int edges = eye.n() / 2 + 2;
    spread_.set(eye.table(), edges, static_cast<cl_int>(eye.stride()), 1.0F, wavelengths_[lamp].get(),
                static_cast<cl_int>(samples_[lamp].size()), static_cast<cl_float>(grid.pitch), corners,
                corners_.get());
    spread_.launch(device_.queue(), 2 * square(corners), node_group);
    return 1;
}

ClScreenStage::WideCorners& ClScreenStage::claim(const WideField& wide) {
    const auto shown = [&](const WideCorners& spread) {
        const auto tables = wide.tables();
        return std::any_of(tables.begin(), tables.end(),
                           [&](const WideTable* table) { return table->id == spread.table; });
    };
    const auto stale = std::find_if(wide_corners_.begin(), wide_corners_.end(),
                                    [&](const auto& spread) { return !shown(*spread); });
    if (stale != wide_corners_.end()) return **stale;
    if (wide_corners_.size() < most_wide_corners)
        return *wide_corners_.emplace_back(std::make_unique<WideCorners>());
    return **std::min_element(wide_corners_.begin(), wide_corners_.end(),
                              [](const auto& a, const auto& b) { return a->used < b->used; });
}

cl_mem ClScreenStage::wide_corners(const WideField& wide, const WideTable& table, const PatternGrid& grid,
                                   std::size_t lamp, int& launches) {
    ++clock_;
    for (const auto& spread : wide_corners_) {
        if (spread->table != table.id || spread->pitch != grid.pitch || spread->lamp != lamp) continue;
        spread->used = clock_;
        return spread->corners.get();
    }
    WideCorners& spread = claim(wide);
    spread.table = 0;  // what follows may throw half way
    const cl_int corners = corner_count(grid);
    spread.corners.reserve(device_.context(), device_.queue(), 2 * square(corners) * node_bytes,
                           "corners of the wide field");
    spread_.set(table.energy.get(), static_cast<cl_int>(wide.edges()), static_cast<cl_int>(wide.stride()),
                1.0F / static_cast<float>(wide.step()), wavelengths_[lamp].get(),
                static_cast<cl_int>(samples_[lamp].size()), static_cast<cl_float>(grid.pitch), corners,
                spread.corners.get());
    spread_.launch(device_.queue(), 2 * square(corners), node_group);
    ++launches;
    spread.table = table.id;
    spread.pitch = grid.pitch;
    spread.lamp = lamp;
    spread.used = clock_;
    return spread.corners.get();
}

int ClScreenStage::join(const ClEyeStage& core, const WideField& wide, const PatternGrid& grid,
                        std::size_t lamp) {
    int launches = 1;
    const auto tables = wide.tables();
    std::array<cl_mem, 4> parts{};
    cl_float4 weights{};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i] = i < tables.size() ? wide_corners(wide, *tables[i], grid, lamp, launches) : parts[0];
        weights.s[i] = i < tables.size() ? static_cast<cl_float>(tables[i]->weight) : 0;
    }
    const cl_int corners = corner_count(grid);
    const cl_int edges = core.n() / 2 + 2;
    // The edge beyond the last cell that has energy.
    const cl_float reach = wide.join().outer + 1;
    join_.set(core.table(), edges, static_cast<cl_int>(core.stride()), wavelengths_[lamp].get(),
              static_cast<cl_int>(samples_[lamp].size()), static_cast<cl_float>(grid.pitch), corners, reach,
              parts[0], parts[1], parts[2], parts[3], weights, corners_.get());
    join_.launch(device_.queue(), 2 * square(corners), node_group);
    return launches;
}

void ClScreenStage::calibrate_rings(const PatternGrid& grid, const Pattern& pattern) {
    cl_command_queue queue = device_.queue();
    const cl_int rings = calibration_rings(grid);
    if (targets_pitch_ != grid.pitch) {
        targets_pitch_ = 0;
        const std::vector<float> targets =
            calibration_targets(grid, pattern.tail_age_years, pattern.tail_pigmentation);
        targets_.reserve(device_.context(), queue, targets.size() * sizeof(float), "CIE curve");
        gains_.reserve(device_.context(), queue, targets.size() * sizeof(float), "gains of rings");
        targets_.write(queue, targets.size() * sizeof(float), targets.data());
        device_.finish();  // the vector ends here
        targets_pitch_ = grid.pitch;
    }
    calibrate_rings_.set(corners_.get(), static_cast<cl_int>(corner_count(grid)),
                         static_cast<cl_int>(grid.structure_radius), rings, targets_.get(),
                         static_cast<cl_float>(pattern.tail_scale), gains_.get());
    calibrate_rings_.launch(queue, static_cast<std::size_t>(rings), row_group);
}

void ClScreenStage::split(const PatternGrid& grid, double structure_energy, bool calibrated) {
    const auto side = static_cast<std::size_t>(border_side(grid));
    split_.set(corners_.get(), static_cast<cl_int>(corner_count(grid)),
               static_cast<cl_int>(grid.structure_radius), static_cast<cl_int>(border_radius(grid)),
               static_cast<cl_float>(grid.pitch), static_cast<cl_float>(grid.window_inner),
               static_cast<cl_float>(grid.window_outer), static_cast<cl_float>(core_radius_nodes_),
               static_cast<cl_int>(calibrated), gains_.get(), skirt_.get(), prefix_.get(), row_energy_.get());
    split_.launch(device_.queue(), side, row_group);
    balance_.set(row_energy_.get(), static_cast<cl_int>(side), static_cast<cl_float>(structure_energy),
                 static_cast<cl_int>(calibrated), result_.get());
    balance_.launch(device_.queue(), 1, 1);
}

int ClScreenStage::average_discs(const PatternGrid& grid, const std::vector<float>& radii) {
    for (std::size_t l = 0; l < radii.size(); ++l) {
        const Stencil& s = stencil(radii[l]);
        average_.set(skirt_.get(), prefix_.get(), static_cast<cl_int>(border_radius(grid)),
                     static_cast<cl_int>(grid.radius), spans_.get(), s.span_begin, s.span_end, s.span_weight,
                     taps_.get(), s.tap_begin, s.tap_end, result_.get(), layers_[l].get());
        average_.launch(device_.queue(), static_cast<std::size_t>(grid.side()),
                        static_cast<std::size_t>(grid.radius) + 1, 16, 4);
    }
    return static_cast<int>(radii.size());
}

void ClScreenStage::read_back(const PatternGrid& grid, Pattern& pattern, std::size_t slot) {
    cl_command_queue queue = device_.queue();
    const std::size_t floats = square(grid.side()) * 4;
    const std::size_t layers = pattern.layer_radius_nodes.size();
    pattern.skirt.resize(pattern.lamps.size() * layers * floats);
    // Blocking: a read under way must not outlive the memory it writes to when a later call fails.
    for (std::size_t l = 0; l < layers; ++l)
        check_cl(
            clEnqueueReadBuffer(queue, layers_[l].get(), CL_TRUE, 0, floats * sizeof(float),
                                pattern.skirt.data() + (slot * layers + l) * floats, 0, nullptr, nullptr),
            "clEnqueueReadBuffer(disc layer)");
    std::array<Rgbv, 3> balance{};
    check_cl(clEnqueueReadBuffer(queue, result_.get(), CL_TRUE, 0, sizeof(balance), balance.data(), 0,
                                 nullptr, nullptr),
             "clEnqueueReadBuffer(energy balance)");
    pattern.structure_scale = static_cast<double>(balance[0][1]);
    pattern.core_energy[slot] = balance[1];
}

int ClScreenStage::make(const ClEyeStage& eye, const WideField* wide, const PatternGrid& grid,
                        double structure_energy, Pattern& pattern) {
    reserve(grid, pattern.layer_radius_nodes.size());
    int launches = 0;
    for (std::size_t slot = 0; slot < pattern.lamps.size(); ++slot) {
        const std::size_t lamp = pattern.lamps[slot];
        launches += wide != nullptr ? join(eye, *wide, grid, lamp) : spread(eye, grid, lamp);
        const bool calibrated = calibrate_ && pattern.tail_scale > 0;
        if (calibrated) calibrate_rings(grid, pattern);
        launches += calibrated ? 1 : 0;
        split(grid, structure_energy, calibrated);
        launches += 2 + average_discs(grid, pattern.layer_radius_nodes);
        read_back(grid, pattern, slot);
    }
    return launches;
}

std::size_t ClScreenStage::device_bytes() const {
    std::size_t total = spans_.bytes() + taps_.bytes() + corners_.bytes() + skirt_.bytes() + prefix_.bytes() +
                        row_energy_.bytes() + result_.bytes() + targets_.bytes() + gains_.bytes();
    for (const ClBuffer& layer : layers_)
        total += layer.bytes();
    for (const auto& spread : wide_corners_)
        total += spread->corners.bytes();
    for (const ClBuffer& spectrum : wavelengths_)
        total += spectrum.bytes();
    return total;
}

}  // namespace seaglare::glare
