#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <utility>

#include "glare/psf/cie_calibration.h"
#include "glare/psf/cie_curve.h"
#include "glare/psf/cpu_aperture.h"
#include "glare/psf/fine_nodes.h"
#include "glare/psf/pattern_cache.h"
#include "glare/psf/pattern_mix.h"
#include "glare/psf/pattern_sources.h"
#include "glare/psf/veiled_pattern.h"

namespace seaglare::glare {

namespace {

constexpr int largest_transform = 1024;

PatternSettings limited(PatternSettings settings) {
    settings.transform_size = std::min(field_transform_size(settings), largest_transform);
    settings.wide_field_size = 0;
    return settings;
}

class CpuPatternSource final : public PatternSource {
  public:
    CpuPatternSource(const EyeModel& eye, const PatternSettings& settings, std::uint64_t seed,
                     LampSamples samples)
        : eye_(eye),
          settings_(limited(settings)),
          samples_(std::move(samples), settings.wavelengths),
          veil_(eye, seed),
          parts_(
              draw_eye_parts(ApertureParts(eye, seed), settings_.transform_size, settings_.plane_width_mm)) {}

    const Pattern& make(const PatternRequest& request) override {
        const Pattern& open = make_open(request);
        const double share = share_in_blink(request, open.pupil_mm);
        if (share == 1) return open;
        make_dim(open, share, dim_);
        return dim_;
    }
    void make_into(const PatternRequest& request, Pattern& pattern) override {
        const Pattern& open = make_open(request);
        const double share = share_in_blink(request, open.pupil_mm);
        if (share != 1) {
            make_dim(open, share, pattern);
        } else if (pattern.generation != open.generation) {
            pattern = open;
        }
    }

    void prepare(const LampList& lamps) override {
        samples_.follow(lamps, [](std::size_t) {});
    }

    void warm_up(double pitch, double pupil_mm) override {
        PatternRequest request;
        request.pupil_mm = pupil_mm;
        request.pitch = pitch;
        make(request);
    }
    DeviceMemory device_memory() const override { return {}; }
    std::string device_name() const override { return "CPU, without OpenCL"; }

  private:
    // A blink passes in a third of a second, and a pattern of its own takes as long: it dims the open eye's, as it does the
    // pages of a flip book. Light that is left keeps its place; what the lid's edge would diffract is missing.
    double share_in_blink(const PatternRequest& request, double pupil_mm) {
        if (!(request.lids.blink > 0)) return 1;
        PatternRequest open = request;
        open.pupil_mm = pupil_mm;
        const EyeInstant instant = standing(open);
        EyeInstant now = instant;
        now.lid_closure = 1 - (1 - instant.lid_closure) * (1 - std::min(request.lids.blink, 1.0));
        veil_.place(instant, quads_);
        const double without = transmitted_fraction(eye_, instant, quads_);
        veil_.place(now, quads_);
        const double with = transmitted_fraction(eye_, now, quads_);
        return without > 0 ? std::clamp(with / without, 0.0, 1.0) : 0;
    }
    static void make_dim(const Pattern& open, double share, Pattern& pattern) {
        pattern.generation = 0;  // what follows may throw half way
        pattern = open;
        dim_pattern(share, pattern);
    }

    // The pattern of an eye that does not blink.
    const Pattern& make_open(const PatternRequest& request) {
        PatternRequest wanted = request;
        wanted.pupil_mm = drawable_pupil_mm(request.pupil_mm, settings_.plane_width_mm);
        for (float radius : settings_.layer_radii_px)
            wanted.largest_disc_nodes = std::max(wanted.largest_disc_nodes, radius);
        PatternCache::Entry& entry = cache_.find(settings_, wanted.pitch);
        Pattern& pattern = entry.pattern;
        take_up(lamp_list_of(request), entry);
        // Of many lamps not all have a pattern of their own: which, must not depend on who asked before.
        const bool has_lamps =
            (wanted.lamps & ~entry.lamps) == 0 && std::popcount(entry.lamps) <= settings_.max_lamps_in_view;
        const bool same_lamps = has_lamps || wanted.lamps == entry.lamps;
        const EyeInstant instant = standing(wanted);
        if (entry.made && same_lamps && instant.lid_closure == entry.lid_closure &&
            wanted.pupil_mm == pattern.pupil_mm)
            return pattern;
        entry.made = false;  // what follows may throw half way
        // Lamps seen once stay, while there is room: a flashing light must not cost a new pattern with every flash.
        if (std::popcount(wanted.lamps | entry.lamps) <= settings_.max_lamps_in_view)
            wanted.lamps |= entry.lamps;
        entry.lamps = wanted.lamps;
        entry.lid_closure = instant.lid_closure;
        veil_.place(instant, quads_);
        double structure = describe_pattern(eye_, settings_, entry.grid, wanted, pattern);
        structure *=
            describe_veil(eye_, wanted.pupil_mm, transmitted_fraction(eye_, instant, quads_), pattern);
        update_energy(instant);
        for (std::size_t slot = 0; slot < pattern.lamps.size(); ++slot)
            fill(entry.grid, structure, slot, pattern);
        pattern.kernel_launches = 0;
        pattern.generation = new_generation();
        entry.made = true;
        return pattern;
    }

    // A pattern keeps only lamps that are still what they were.
    void take_up(const LampList& lamps, PatternCache::Entry& entry) {
        samples_.follow(lamps, [](std::size_t) {});
        if (entry.lamp_list == lamps.version) return;
        constexpr std::uint32_t navigation = (1U << static_cast<unsigned>(lamp_count)) - 1;
        if ((entry.lamps & ~navigation) != 0) entry.made = false;
        entry.lamps &= navigation;
        entry.lamp_list = lamps.version;
    }

    // The eye with all that moves at rest: it squints, and no more.
    EyeInstant standing(const PatternRequest& request) const {
        EyeInstant instant = eye_instant(eye_, request.pupil_mm, 0, {request.lids.squint, 0}, 0, 0);
        instant.lens_scale = 1;
        instant.defocus_dioptre = std::isfinite(eye_.defocus_dioptre) ? eye_.defocus_dioptre : 0;
        return instant;
    }

    // Of lids and lashes in quads_.
    void update_energy(const EyeInstant& instant) {
        if (energy_ && energy_instant_ == instant) return;
        energy_.reset();
        const int n = settings_.transform_size;
        const double radius = instant.pupil_mm / 2 / settings_.plane_width_mm * n;
        std::vector<float> amplitude = draw_pupil(n, radius);
        to_samples(quads_, n, settings_.plane_width_mm);
        cover(amplitude, n, quads_);
        for (std::size_t i = 0; i < amplitude.size(); ++i)
            amplitude[i] *= parts_[i];
        if (instant.defocus_dioptre == 0) {
            energy_ = std::make_unique<EnergySums>(amplitude, n, radius);
        } else {
            const double phase = defocus_phase(instant.defocus_dioptre, n, settings_.plane_width_mm);
            energy_ = std::make_unique<EnergySums>(amplitude, n, radius, phase);
        }
        energy_instant_ = instant;
    }

    std::array<double, 4> node_energy(const PatternGrid& grid, std::size_t lamp, int a, int b) const {
        std::array<double, 4> sum{};
        for (const SpectralSample& sample : samples_[lamp]) {
            const double samples = grid.pitch * settings_.plane_width_mm /
                                   (sample.wavelength_nm * 1e-6 * settings_.angular_scale);
            const auto box = [&](int x, int y) {
                return energy_->box((x - 0.5) * samples, (x + 0.5) * samples, (y - 0.5) * samples,
                                    (y + 0.5) * samples);
            };
            // Out of focus the energy at k and at -k differ. A pattern is point-symmetric: each node has their mean.
            const double energy =
                energy_instant_.defocus_dioptre == 0 ? box(a, b) : (box(a, b) + box(-a, -b)) / 2;
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += sample.weight[c] * energy;
        }
        return sum;
    }

    // Gains of the rings, from the mean luminance of their nodes.
    std::vector<float> ring_gains(const PatternGrid& grid, const Pattern& pattern, std::size_t lamp) const {
        const auto rings = static_cast<std::size_t>(calibration_rings(grid));
        std::vector<double> mean(rings);
        std::vector<double> count(rings);
        for (int b = 0; b <= grid.structure_radius; ++b) {
            for (int a = -grid.structure_radius; a <= grid.structure_radius; ++a) {
                const auto ring = static_cast<std::size_t>(std::lround(std::hypot(a, b)));
                const auto energy = node_energy(grid, lamp, a, b);
                const double copies = b > 0 ? 2 : 1;
                mean[ring] += copies * (0.2126 * energy[0] + 0.7152 * energy[1] + 0.0722 * energy[2]);
                count[ring] += copies;
            }
        }
        for (std::size_t r = 0; r < rings; ++r)
            if (count[r] > 0) mean[r] /= count[r];
        return calibration_gains(calibration_targets(grid, pattern.tail_age_years, pattern.tail_pigmentation),
                                 mean, pattern.tail_scale);
    }

    // Energy per node of core + skirt, then both scaled to what they should have, then the layers.
    void fill(const PatternGrid& grid, double structure_energy, std::size_t slot, Pattern& pattern) const {
        const int reach = grid.structure_radius;
        const int side = 2 * reach + 1;
        std::vector<std::array<double, 4>> skirt(static_cast<std::size_t>(side) *
                                                 static_cast<std::size_t>(side));
        std::array<double, 4> core{};
        std::array<double, 4> total{};
        const bool calibrated = is_calibrated(eye_, pattern);
        const std::vector<float> gains =
            calibrated ? ring_gains(grid, pattern, pattern.lamps[slot]) : std::vector<float>{};
        for (int b = 0; b <= reach; ++b) {
            for (int a = -reach; a <= reach; ++a) {
                if (b == 0 && a > 0) break;  // mirrored, as is everything below
                const double distance = std::hypot(a, b);
                const double window =
                    fade_window(distance * grid.pitch, grid.window_inner, grid.window_outer) *
                    (calibrated ? calibration_gain(gains, distance) : 1);
                if (window <= 0) continue;
                const double in_core = core_window(distance, settings_.core_radius_nodes);
                const auto energy = node_energy(grid, pattern.lamps[slot], a, b);
                const double copies = a == 0 && b == 0 ? 1 : 2;
                auto& upper = skirt[static_cast<std::size_t>(b + reach) * static_cast<std::size_t>(side) +
                                    static_cast<std::size_t>(a + reach)];
                for (std::size_t c = 0; c < 4; ++c) {
                    const double value = energy[c] * window;
                    core[c] += copies * value * in_core;
                    total[c] += copies * value;
                    upper[c] = value * (1 - in_core);
                }
                skirt[static_cast<std::size_t>(reach - b) * static_cast<std::size_t>(side) +
                      static_cast<std::size_t>(reach - a)] = upper;
            }
        }
        std::array<double, 4> scale{};
        FineSplit fine{settings_.core_radius_nodes, gains, {}};
        for (std::size_t c = 0; c < 4; ++c) {
            scale[c] = total[c] > 0 ? structure_energy / total[c] : 0;
            double core_energy = core[c] * scale[c];
            if (calibrated) {
                // The skirt stays, and the core has what is left.
                scale[c] = 1;
                core_energy = std::max(structure_energy - (total[c] - core[c]), 0.0);
            }
            pattern.core_energy[slot][c] = static_cast<float>(core_energy);
            fine.scale[c] = scale[c];
            scale[c] /= grid.pitch * grid.pitch;
        }
        pattern.structure_scale = scale[1] * grid.pitch * grid.pitch;
        const std::size_t layer_floats =
            static_cast<std::size_t>(grid.side()) * static_cast<std::size_t>(grid.side()) * 4;
        const std::size_t layers = pattern.layer_radius_nodes.size();
        pattern.skirt.resize(layer_floats * layers * pattern.lamps.size());
        for (std::size_t l = 0; l < layers; ++l)
            average_disc(skirt, scale, grid, pattern.layer_radius_nodes[l],
                         pattern.skirt.data() + (slot * layers + l) * layer_floats);
        std::vector<Rgbv> cells = fine_cells(grid, pattern.lamps[slot]);
        fill_fine_nodes(cells, fine, grid, slot, pattern);
    }

    std::vector<Rgbv> fine_cells(const PatternGrid& grid, std::size_t lamp) const {
        const PatternGrid finer = fine_grid(grid);
        std::vector<Rgbv> cells;
        cells.reserve(fine_cells_side * fine_cells_side);
        for (int b = -fine_cells_radius; b <= fine_cells_radius; ++b) {
            for (int a = -fine_cells_radius; a <= fine_cells_radius; ++a) {
                const std::array<double, 4> energy = node_energy(finer, lamp, a, b);
                Rgbv& cell = cells.emplace_back();
                for (std::size_t c = 0; c < 4; ++c)
                    cell[c] = static_cast<float>(energy[c]);
            }
        }
        return cells;
    }

    // Every cell of the disc on its own: no prefix sums, whose rounding the OpenCL source is tested for.
    static void average_disc(const std::vector<std::array<double, 4>>& skirt,
                             const std::array<double, 4>& scale, const PatternGrid& grid, float radius_nodes,
                             float* layer) {
        const DiscStencil stencil = make_disc_stencil(static_cast<double>(radius_nodes));
        std::vector<DiscTap> taps = stencil.taps;
        for (const DiscSpan& span : stencil.spans)
            for (int dx = -span.half_width; dx <= span.half_width; ++dx)
                taps.push_back({dx, span.dy, stencil.span_weight});
        const int reach = grid.structure_radius;
        const int side = 2 * reach + 1;
        const int limit = grid.radius;
        for (int b = 0; b <= limit; ++b) {
            for (int a = -limit; a <= limit; ++a) {
                std::array<double, 4> sum{};
                for (const DiscTap& tap : taps) {
                    const int x = a + tap.dx;
                    const int y = b + tap.dy;
                    if (std::abs(x) > reach || std::abs(y) > reach) continue;
                    const auto& value =
                        skirt[static_cast<std::size_t>(y + reach) * static_cast<std::size_t>(side) +
                              static_cast<std::size_t>(x + reach)];
                    for (std::size_t c = 0; c < 4; ++c)
                        sum[c] += tap.weight * value[c];
                }
                float* const upper =
                    layer + 4 * static_cast<std::ptrdiff_t>((limit + b) * grid.side() + limit + a);
                float* const lower =
                    layer + 4 * static_cast<std::ptrdiff_t>((limit - b) * grid.side() + limit - a);
                for (std::size_t c = 0; c < 4; ++c)
                    upper[c] = lower[c] = static_cast<float>(sum[c] * scale[c]);
            }
        }
    }

    EyeModel eye_;
    PatternSettings settings_;
    LampWavelengths samples_;
    Veil veil_;
    std::vector<Quad> quads_;
    std::vector<float> parts_;
    std::unique_ptr<EnergySums> energy_;
    EyeInstant energy_instant_;
    PatternCache cache_;
    Pattern dim_;  // the last that a blink dimmed
};

}  // namespace

std::unique_ptr<PatternSource> make_cpu_pattern_source(const EyeModel& eye, const PatternSettings& settings,
                                                       std::uint64_t seed, LampSamples samples) {
    validate(settings);
    return std::make_unique<CpuPatternSource>(eye, settings, seed, std::move(samples));
}

std::unique_ptr<PatternSource> make_cpu_pattern_source(const EyeModel& eye, const PatternSettings& settings,
                                                       std::uint64_t seed) {
    return make_cpu_pattern_source(eye, settings, seed, sample_lamps(settings.wavelengths));
}

}  // namespace seaglare::glare
