#include "glare/psf/cl_screen_stage.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "glare/psf/cie_calibration.h"
#include "glare/psf/fine_nodes.h"
#include "glare/psf/wavelength_steps.h"

namespace seaglare::glare {

namespace {

constexpr std::size_t tile_columns = 32;  // of cells, spread.cl
constexpr std::size_t tile_rows = 16;
constexpr std::size_t ring_group = 4;
constexpr std::size_t split_nodes = 32;
constexpr std::size_t split_group = 8;
constexpr std::size_t balance_items = 16;
constexpr double brightest_mm = 555e-6;
constexpr std::size_t most_wavelengths = 401;  // of a quality file
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
std::size_t split_items(const PatternGrid& grid) {
    const auto border = static_cast<std::size_t>(SkirtLayout(grid).border);
    return (border / split_nodes + 1) * (border + 1);
}

}  // namespace

ClScreenStage::ClScreenStage(const ClDevice& device, const PatternSettings& settings, LampSamples samples)
    : device_(device),
      core_radius_nodes_(settings.core_radius_nodes),
      plane_width_mm_(settings.plane_width_mm),
      angular_scale_(settings.angular_scale),
      wavelength_step_nodes_(settings.wavelength_step_px),
      samples_(std::move(samples), settings.wavelengths),
      spread_cells_(device.program(KernelSet::pattern), "spread_cells"),
      spread_tiles_(device.program(KernelSet::pattern), "spread_tiles"),
      in_tiles_(device.is_cpu()),
      calibrate_rings_(device.program(KernelSet::pattern), "calibrate_rings"),
      split_(device.program(KernelSet::pattern), "split_core"),
      balance_(device.program(KernelSet::pattern), "balance"),
      discs_(device, device.program(KernelSet::pattern), settings.layer_radii_px) {
    cl_context context = device.context();
    cl_command_queue queue = device.queue();
    result_.reserve(context, queue, 3 * node_bytes, "energy balance");
    gains_.reserve(context, queue, sizeof(float), "gains of rings");  // no buffer is empty
    device.finish();
}

const ClScreenStage::Wavelengths& ClScreenStage::wavelengths(std::size_t lamp, int parts) {
    const auto found = std::find_if(wavelengths_.begin(), wavelengths_.end(),
                                    [&](const auto& w) { return w->lamp == lamp && w->parts == parts; });
    const bool present = found != wavelengths_.end();
    Wavelengths& w = present ? **found : *wavelengths_.emplace_back(std::make_unique<Wavelengths>());
    if (w.count > 0) return w;
    w.lamp = lamp;
    w.parts = parts;
    std::vector<std::array<float, 4>> packed;
    std::vector<SpectralSample> finer = divided(samples_[lamp], parts);
    // More than a quality file may ask for are a measurement's, and each of them has its own colour.
    if (samples_[lamp].size() <= most_wavelengths) finer = shared_colours(std::move(finer));
    for (const SpectralSample& sample : finer) {
        const auto& weight = sample.weight;
        packed.push_back({static_cast<float>(weight[0]), static_cast<float>(weight[1]),
                          static_cast<float>(weight[2]), static_cast<float>(weight[3])});
        const double samples_per_unit = plane_width_mm_ / (sample.wavelength_nm * 1e-6 * angular_scale_);
        packed.push_back({static_cast<float>(samples_per_unit), 0, 0, 0});
    }
    if (packed.empty()) packed.resize(2);  // no buffer is empty
    cl_command_queue queue = device_.queue();
    w.samples.reserve(device_.context(), queue, packed.size() * node_bytes, "spectrum");
    w.samples.write(queue, packed.size() * node_bytes, packed.data());
    device_.finish();  // the vector ends here
    w.count = static_cast<int>(packed.size() / 2);
    return w;
}

void ClScreenStage::follow(const LampList& lamps) {
    samples_.follow(lamps, [this](std::size_t lamp) {
        for (const auto& w : wavelengths_)
            if (w->lamp == lamp) w->count = 0;
        for (const auto& spread : wide_cells_)
            if (spread->lamp == lamp) spread->table = 0;
    });
}

void ClScreenStage::reserve(const PatternGrid& grid, std::size_t layers) {
    cl_context context = device_.context();
    cl_command_queue queue = device_.queue();
    cells_.reserve(context, queue, cell_bytes(grid), "cells");
    fine_cells_.reserve(context, queue, cell_bytes(fine_grid(grid)), "fine cells");
    skirt_.reserve(context, queue, SkirtLayout(grid).bytes(), "skirt");
    energies_.reserve(context, queue, 2 * split_items(grid) * node_bytes, "energies");
    discs_.reserve(grid, layers);
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
    const double samples_per_node = grid.pitch * plane_width_mm_ / (brightest_mm * angular_scale_);
    const double lit = std::min<double>(grid.structure_radius, table.reach_samples / samples_per_node);
    const Wavelengths& spectrum =
        wavelengths(lamp, wavelength_parts(samples_[lamp], lit, wavelength_step_nodes_));
    ClKernel& kernel = in_tiles_ ? spread_tiles_ : spread_cells_;
    kernel.set(table.energy, table.edges, table.stride, static_cast<cl_float>(table.entries_per_sample),
               spectrum.samples.get(), spectrum.count, static_cast<cl_float>(grid.pitch), cell_count(grid),
               static_cast<cl_int>(stride), radius, static_cast<cl_float>(table.reach_samples), wide.count,
               parts[0], parts[1], parts[2], parts[3], wide.weights, out);
    if (in_tiles_)
        kernel.launch(device_.queue(), groups_of(stride, tile_columns), 2 * groups_of(count, tile_rows), 1,
                      1);
    else
        kernel.launch(device_.queue(), stride, 2 * count, 16, 4);
}

int ClScreenStage::spread(const ClEyeStage& eye, const PatternGrid& grid, std::size_t lamp) {
    const Table energy{eye.table(), eye.n() / 2 + 2, eye.stride(), 1, eye.n() / 2.0 + 1};
    spread_cells(energy, {}, grid, lamp, cells_.get());
    spread_cells(energy, {}, fine_grid(grid), lamp, fine_cells_.get());
    return 2;
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

ClScreenStage::WideCells& ClScreenStage::wide_cells(const WideField& wide, const WideTable& table,
                                                    const PatternGrid& grid, std::size_t lamp,
                                                    int& launches) {
    ++clock_;
    for (const auto& spread : wide_cells_) {
        if (spread->table != table.id || spread->pitch != grid.pitch || spread->lamp != lamp) continue;
        spread->used = clock_;
        return *spread;
    }
    WideCells& spread = claim(wide);
    spread.table = 0;  // what follows may throw half way
    const PatternGrid fine = fine_grid(grid);
    spread.cells.reserve(device_.context(), device_.queue(), cell_bytes(grid), "cells of the wide field");
    spread.fine_cells.reserve(device_.context(), device_.queue(), cell_bytes(fine),
                              "fine cells of the wide field");
    const Table energy{table.energy.get(), wide.edges(), wide.stride(), 1.0 / wide.step(), wide.reach()};
    spread_cells(energy, {}, grid, lamp, spread.cells.get());
    spread_cells(energy, {}, fine, lamp, spread.fine_cells.get());
    launches += 2;
    spread.table = table.id;
    spread.pitch = grid.pitch;
    spread.lamp = lamp;
    spread.used = clock_;
    return spread;
}

int ClScreenStage::join(const ClEyeStage& core, const WideField& wide, const PatternGrid& grid,
                        std::size_t lamp) {
    int launches = 2;
    WideParts parts;
    WideParts fine_parts;
    for (const WideTable* const table : wide.tables()) {
        const auto i = static_cast<std::size_t>(parts.count++);
        const WideCells& spread = wide_cells(wide, *table, grid, lamp, launches);
        parts.cells[i] = spread.cells.get();
        fine_parts.cells[i] = spread.fine_cells.get();
        parts.weights.s[i] = static_cast<cl_float>(table->weight);
    }
    fine_parts.weights = parts.weights;
    fine_parts.count = parts.count;
    // The core ends at the edge beyond the last cell that has energy.
    const Table energy{core.table(), core.n() / 2 + 2, core.stride(), 1, wide.join().outer + 1.0};
    spread_cells(energy, parts, grid, lamp, cells_.get());
    spread_cells(energy, fine_parts, fine_grid(grid), lamp, fine_cells_.get());
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
    split_.set(cells_.get(), cell_count(grid), static_cast<cl_int>(cell_stride(grid)),
               SkirtLayout(grid).border, grid.margin, static_cast<cl_float>(grid.pitch),
               static_cast<cl_float>(grid.window_inner), static_cast<cl_float>(grid.window_outer),
               static_cast<cl_float>(core_radius_nodes_),
               static_cast<cl_int>(calibrated ? calibration_rings(grid) : 0), gains_.get(), skirt_.get(),
               energies_.get());
    split_.launch(device_.queue(), split_items(grid), split_group);
    balance_.set(energies_.get(), static_cast<cl_int>(split_items(grid)),
                 static_cast<cl_float>(structure_energy), static_cast<cl_int>(calibrated), result_.get());
    balance_.launch(device_.queue(), balance_items, balance_items);
}

int ClScreenStage::average_discs(const PatternGrid& grid, const std::vector<float>& radii) {
    return discs_.average(grid, radii, skirt_.get(), result_.get());
}

void ClScreenStage::read_back(const PatternGrid& grid, Pattern& pattern, std::size_t slot, bool calibrated) {
    cl_command_queue queue = device_.queue();
    const std::size_t floats = pattern.layer_radius_nodes.size() * square(grid.side()) * 4;
    pattern.skirt.resize(pattern.lamps.size() * floats);
    discs_.read(grid, pattern.layer_radius_nodes.size(), pattern.skirt.data() + slot * floats);
    std::array<Rgbv, 3> balance{};
    check_cl(clEnqueueReadBuffer(queue, result_.get(), CL_TRUE, 0, sizeof(balance), balance.data(), 0,
                                 nullptr, nullptr),
             "clEnqueueReadBuffer(energy balance)");
    pattern.structure_scale = static_cast<double>(balance[0][1]);
    pattern.core_energy[slot] = balance[1];
    read_fine_nodes(grid, balance[0], calibrated, slot, pattern);
}

void ClScreenStage::read_fine_nodes(const PatternGrid& grid, const Rgbv& scale, bool calibrated,
                                    std::size_t slot, Pattern& pattern) {
    cl_command_queue queue = device_.queue();
    const PatternGrid fine = fine_grid(grid);
    const auto read = [queue](const ClBuffer& from, std::size_t bytes, void* to) {
        check_cl(clEnqueueReadBuffer(queue, from.get(), CL_TRUE, 0, bytes, to, 0, nullptr, nullptr),
                 "clEnqueueReadBuffer(fine cells)");
    };
    FineSplit split{core_radius_nodes_, {}, {}};
    std::copy(scale.begin(), scale.end(), split.scale.begin());
    if (calibrated) {
        // Those of the rings that finer nodes reach, and one beyond.
        constexpr std::size_t most_rings = fine_radius_nodes + 3;
        fine_gains_.resize(std::min(static_cast<std::size_t>(calibration_rings(grid)), most_rings));
        read(gains_, fine_gains_.size() * sizeof(float), fine_gains_.data());
        split.gains = fine_gains_;
    }
    // Quadrants as spread.cl leaves them; the others are their mirror images, and what lies on an axis has a half in each.
    quadrants_.resize(cell_bytes(fine) / node_bytes);
    read(fine_cells_, cell_bytes(fine), quadrants_.data());
    const std::size_t stride = cell_stride(fine);
    const std::size_t second = static_cast<std::size_t>(cell_count(fine)) * stride;
    whole_.resize(square(fine.side()));
    for (int b = -fine.radius; b <= fine.radius; ++b) {
        for (int a = -fine.radius; a <= fine.radius; ++a) {
            const std::size_t at =
                static_cast<std::size_t>(std::abs(b)) * stride + static_cast<std::size_t>(std::abs(a));
            const Rgbv& right = quadrants_[at];
            const Rgbv& left = quadrants_[second + at];
            Rgbv& cell = whole_[static_cast<std::size_t>(b + fine.radius) * fine_cells_side +
                                static_cast<std::size_t>(a + fine.radius)];
            const bool on_axis = a == 0 || b == 0;
            const float copies = a == 0 && b == 0 ? 2.0F : 1.0F;
            for (std::size_t c = 0; c < cell.size(); ++c) {
                if (on_axis)
                    cell[c] = copies * (right[c] + left[c]);
                else
                    cell[c] = (a > 0) == (b > 0) ? right[c] : left[c];
            }
        }
    }
    fill_fine_nodes(whole_, split, grid, slot, pattern);
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
        read_back(grid, pattern, slot, calibrated);
    }
    return launches;
}

std::size_t ClScreenStage::device_bytes() const {
    std::size_t total = discs_.device_bytes() + cells_.bytes() + fine_cells_.bytes() + skirt_.bytes() +
                        energies_.bytes() + result_.bytes() + targets_.bytes() + gains_.bytes();
    for (const auto& spread : wide_cells_)
        total += spread->cells.bytes() + spread->fine_cells.bytes();
    for (const auto& spectrum : wavelengths_)
        total += spectrum->samples.bytes();
    return total;
}

}  // namespace seaglare::glare
