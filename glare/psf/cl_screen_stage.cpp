#include "glare/psf/cl_screen_stage.h"

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>
#include <utility>

#include "glare/psf/cie_calibration.h"

namespace seaglare::glare {

namespace {

constexpr std::size_t tile_columns = 32;  // of cells, spread.cl
constexpr std::size_t tile_rows = 16;
constexpr std::size_t ring_group = 4;
constexpr std::size_t split_nodes = 32;
constexpr std::size_t split_group = 8;
constexpr std::size_t balance_items = 16;
constexpr std::size_t strip_group = 4;
constexpr std::size_t disc_nodes = 16;
constexpr std::size_t node_bytes = 4 * sizeof(float);
constexpr std::size_t most_wide_cells = 48;

std::size_t square(int side) {
    return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
}
std::size_t groups_of(std::size_t count, std::size_t size) {
    return (count + size - 1) / size;
}
int cell_count(const PatternGrid& grid) {
    return grid.structure_radius + 1;
}
std::size_t cell_stride(const PatternGrid& grid) {
    return groups_of(static_cast<std::size_t>(cell_count(grid)), tile_rows) * tile_rows;
}
std::size_t cell_bytes(const PatternGrid& grid) {
    return 2 * static_cast<std::size_t>(cell_count(grid)) * cell_stride(grid) * node_bytes;
}
// What the discs reach over, and the rows and columns of the skirt that they need (pattern.cl has the layout).
int border_radius(const PatternGrid& grid) {
    return grid.radius + grid.margin;
}
std::size_t skirt_columns(const PatternGrid& grid) {
    return 2 * static_cast<std::size_t>(border_radius(grid)) + 20;
}
std::size_t skirt_rows(const PatternGrid& grid) {
    return static_cast<std::size_t>(border_radius(grid)) + static_cast<std::size_t>(grid.margin) + 1;
}
std::size_t split_items(const PatternGrid& grid) {
    const auto border = static_cast<std::size_t>(border_radius(grid));
    return (border / split_nodes + 1) * (border + 1);
}

}  // namespace

ClScreenStage::ClScreenStage(const ClDevice& device, const PatternSettings& settings, LampSamples samples)
    : device_(device),
      core_radius_nodes_(settings.core_radius_nodes),
      plane_width_mm_(settings.plane_width_mm),
      angular_scale_(settings.angular_scale),
      samples_(std::move(samples), settings.wavelengths),
      spread_cells_(device.program(KernelSet::pattern), "spread_cells"),
      spread_tiles_(device.program(KernelSet::pattern), "spread_tiles"),
      in_tiles_(device.is_cpu()),
      calibrate_rings_(device.program(KernelSet::pattern), "calibrate_rings"),
      split_(device.program(KernelSet::pattern), "split_core"),
      balance_(device.program(KernelSet::pattern), "balance"),
      sum_skirt_(device.program(KernelSet::pattern), "sum_skirt"),
      average_(device.program(KernelSet::pattern), "average_disc") {
    cl_context context = device.context();
    cl_command_queue queue = device.queue();
    for (std::size_t lamp = 0; lamp < lamp_count; ++lamp)
        upload_wavelengths(lamp);

    std::vector<std::array<std::int32_t, 2>> spans;
    std::vector<std::array<std::int32_t, 4>> taps;
    std::vector<float> radii = {0.0F};
    radii.insert(radii.end(), settings.layer_radii_px.begin(), settings.layer_radii_px.end());
    for (float radius : radii) {
        const DiscStencil disc = make_disc_stencil(static_cast<double>(radius));
        Stencil s;
        s.radius = radius;
        s.span_begin = static_cast<cl_int>(spans.size());
        s.tap_begin = static_cast<cl_int>(taps.size());
        s.span_weight = static_cast<cl_float>(disc.span_weight);
        // Transposed, and still a disc: pattern.cl sums the skirt by columns.
        for (const DiscSpan& span : disc.spans)
            spans.push_back({span.dy, span.half_width});
        for (const DiscTap& tap : disc.taps)
            taps.push_back({tap.dy, tap.dx, std::bit_cast<std::int32_t>(static_cast<float>(tap.weight)), 0});
        s.span_end = static_cast<cl_int>(spans.size());
        s.tap_end = static_cast<cl_int>(taps.size());
        stencils_.push_back(s);
    }
    spans.push_back({0, 0});  // no buffer is empty
    spans_.reserve(context, queue, spans.size() * sizeof(spans[0]), "spans of discs");
    spans_.write(queue, spans.size() * sizeof(spans[0]), spans.data());
    taps_.reserve(context, queue, taps.size() * sizeof(taps[0]), "rims of discs");
    taps_.write(queue, taps.size() * sizeof(taps[0]), taps.data());
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
    for (const auto& spread : wide_cells_)
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
    cells_.reserve(context, queue, cell_bytes(grid), "cells");
    skirt_.reserve(context, queue, skirt_rows(grid) * skirt_columns(grid) * node_bytes, "skirt");
    beyond_.reserve(context, queue, (skirt_rows(grid) + 1) * skirt_columns(grid) * node_bytes,
                    "sums of the skirt");
    energies_.reserve(context, queue, 2 * split_items(grid) * node_bytes, "energies");
    layers_.reserve(context, queue, layers * square(grid.side()) * node_bytes, "disc layers");
}

void ClScreenStage::spread_cells(const Table& table, const WideParts& wide, const PatternGrid& grid,
                                 std::size_t lamp, cl_mem out) {
    // One node more than has structure: boxes of calibrated rings reach over the rim.
    const auto radius = static_cast<cl_float>(grid.structure_radius + 2);
    std::array<cl_mem, 4> parts = wide.cells;
    for (cl_mem& part : parts)
        if (part == nullptr) part = table.energy;  // not read
    const auto count = static_cast<std::size_t>(cell_count(grid));
    const std::size_t stride = cell_stride(grid);
    ClKernel& kernel = in_tiles_ ? spread_tiles_ : spread_cells_;
    kernel.set(table.energy, table.edges, table.stride, static_cast<cl_float>(table.entries_per_sample),
               wavelengths_[lamp].get(), static_cast<cl_int>(samples_[lamp].size()),
               static_cast<cl_float>(grid.pitch), cell_count(grid), static_cast<cl_int>(stride), radius,
               static_cast<cl_float>(table.reach_samples), wide.count, parts[0], parts[1], parts[2], parts[3],
               wide.weights, out);
    if (in_tiles_)
        kernel.launch(device_.queue(), groups_of(stride, tile_columns), 2 * groups_of(count, tile_rows), 1,
                      1);
    else
        kernel.launch(device_.queue(), stride, 2 * count, 16, 4);
}

int ClScreenStage::spread(const ClEyeStage& eye, const PatternGrid& grid, std::size_t lamp) {
    spread_cells({eye.table(), eye.n() / 2 + 2, eye.stride(), 1, eye.n() / 2.0 + 1}, {}, grid, lamp,
                 cells_.get());
    return 1;
}

ClScreenStage::WideCells& ClScreenStage::claim(const WideField& wide) {
    const auto shown = [&](const WideCells& spread) {
        const auto tables = wide.tables();
        return std::any_of(tables.begin(), tables.end(),
                           [&](const WideTable* table) { return table->id == spread.table; });
    };
    const auto stale = std::find_if(wide_cells_.begin(), wide_cells_.end(),
                                    [&](const auto& spread) { return !shown(*spread); });
    if (stale != wide_cells_.end()) return **stale;
    if (wide_cells_.size() < most_wide_cells) return *wide_cells_.emplace_back(std::make_unique<WideCells>());
    return **std::min_element(wide_cells_.begin(), wide_cells_.end(),
                              [](const auto& a, const auto& b) { return a->used < b->used; });
}

cl_mem ClScreenStage::wide_cells(const WideField& wide, const WideTable& table, const PatternGrid& grid,
                                 std::size_t lamp, int& launches) {
    ++clock_;
    for (const auto& spread : wide_cells_) {
        if (spread->table != table.id || spread->pitch != grid.pitch || spread->lamp != lamp) continue;
        spread->used = clock_;
        return spread->cells.get();
    }
    WideCells& spread = claim(wide);
    spread.table = 0;  // what follows may throw half way
    spread.cells.reserve(device_.context(), device_.queue(), cell_bytes(grid), "cells of the wide field");
    spread_cells({table.energy.get(), wide.edges(), wide.stride(), 1.0 / wide.step(), wide.reach()}, {}, grid,
                 lamp, spread.cells.get());
    ++launches;
    spread.table = table.id;
    spread.pitch = grid.pitch;
    spread.lamp = lamp;
    spread.used = clock_;
    return spread.cells.get();
}

int ClScreenStage::join(const ClEyeStage& core, const WideField& wide, const PatternGrid& grid,
                        std::size_t lamp) {
    int launches = 1;
    WideParts parts;
    for (const WideTable* const table : wide.tables()) {
        const auto i = static_cast<std::size_t>(parts.count++);
        parts.cells[i] = wide_cells(wide, *table, grid, lamp, launches);
        parts.weights.s[i] = static_cast<cl_float>(table->weight);
    }
    // The core ends at the edge beyond the last cell that has energy.
    spread_cells({core.table(), core.n() / 2 + 2, core.stride(), 1, wide.join().outer + 1.0}, parts, grid,
                 lamp, cells_.get());
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
    calibrate_rings_.set(cells_.get(), cell_count(grid), static_cast<cl_int>(cell_stride(grid)),
                         grid.structure_radius, rings, targets_.get(),
                         static_cast<cl_float>(pattern.tail_scale), gains_.get());
    calibrate_rings_.launch(queue, static_cast<std::size_t>(rings), ring_group);
}

void ClScreenStage::split(const PatternGrid& grid, double structure_energy, bool calibrated) {
    split_.set(cells_.get(), cell_count(grid), static_cast<cl_int>(cell_stride(grid)), border_radius(grid),
               grid.margin, static_cast<cl_float>(grid.pitch), static_cast<cl_float>(grid.window_inner),
               static_cast<cl_float>(grid.window_outer), static_cast<cl_float>(core_radius_nodes_),
               static_cast<cl_int>(calibrated ? calibration_rings(grid) : 0), gains_.get(), skirt_.get(),
               energies_.get());
    split_.launch(device_.queue(), split_items(grid), split_group);
    balance_.set(energies_.get(), static_cast<cl_int>(split_items(grid)),
                 static_cast<cl_float>(structure_energy), static_cast<cl_int>(calibrated), result_.get());
    balance_.launch(device_.queue(), balance_items, balance_items);
}

int ClScreenStage::average_discs(const PatternGrid& grid, const std::vector<float>& radii) {
    cl_command_queue queue = device_.queue();
    int launches = 0;
    if (radii.size() > 1) {
        sum_skirt_.set(skirt_.get(), border_radius(grid), grid.margin, beyond_.get());
        sum_skirt_.launch(queue, skirt_columns(grid) / 4, strip_group);
        ++launches;
    }
    for (std::size_t l = 0; l < radii.size(); ++l) {
        const Stencil& s = stencil(radii[l]);
        average_.set(skirt_.get(), beyond_.get(), border_radius(grid), grid.margin, grid.radius, spans_.get(),
                     s.span_begin, s.span_end, s.span_weight, taps_.get(), s.tap_begin, s.tap_end,
                     result_.get(), layers_.get(), static_cast<cl_int>(l * square(grid.side())));
        average_.launch(queue, groups_of(static_cast<std::size_t>(grid.side()), disc_nodes),
                        static_cast<std::size_t>(grid.radius) + 1, 4, 2);
        ++launches;
    }
    return launches;
}

void ClScreenStage::read_back(const PatternGrid& grid, Pattern& pattern, std::size_t slot) {
    cl_command_queue queue = device_.queue();
    const std::size_t floats = pattern.layer_radius_nodes.size() * square(grid.side()) * 4;
    pattern.skirt.resize(pattern.lamps.size() * floats);
    // Blocking: a read under way must not outlive the memory it writes to when a later call fails.
    check_cl(clEnqueueReadBuffer(queue, layers_.get(), CL_TRUE, 0, floats * sizeof(float),
                                 pattern.skirt.data() + slot * floats, 0, nullptr, nullptr),
             "clEnqueueReadBuffer(disc layers)");
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
    std::size_t total = spans_.bytes() + taps_.bytes() + cells_.bytes() + skirt_.bytes() + beyond_.bytes() +
                        energies_.bytes() + result_.bytes() + targets_.bytes() + gains_.bytes() +
                        layers_.bytes();
    for (const auto& spread : wide_cells_)
        total += spread->cells.bytes();
    for (const ClBuffer& spectrum : wavelengths_)
        total += spectrum.bytes();
    return total;
}

}  // namespace seaglare::glare
