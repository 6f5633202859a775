// The screen's half of the pattern on the device: spread the energy over wavelengths and onto the nodes, split core
// from skirt, average discs. Its buffers serve every pitch in turn.
#pragma once

#include <memory>
#include <vector>

#include "glare/colour/navigation_colours.h"
#include "glare/device/cl_device.h"
#include "glare/psf/cl_disc_layers.h"
#include "glare/psf/cl_eye_stage.h"
#include "glare/psf/pattern_cache.h"
#include "glare/psf/pattern_grid.h"
#include "glare/psf/two_scale.h"

namespace seaglare::glare {

class ClScreenStage {
  public:
    // Throws as ClDevice does.
    ClScreenStage(const ClDevice& device, const PatternSettings& settings, LampSamples samples);

    // Takes up the spectra of a list; nothing to do, and no allocation, while it stays the same.
    void follow(const LampList& lamps);

    // Makes room for this grid and these layers.
    void reserve(const PatternGrid& grid, std::size_t layers);

    // Runs everything for each of the pattern's lamps and waits: fills skirt, core_energy and structure_scale of
    // `pattern`, whose lamps, layer radii and tail are set. With a wide field the eye's table is that of the core.
    // Returns the launches.
    int make(const ClEyeStage& eye, const WideField* wide, const PatternGrid& grid, double structure_energy,
             Pattern& pattern);
    // Whether make() calibrates patterns that have a tail to the CIE curve.
    void calibrate(bool on) { calibrate_ = on; }

    // Which of the two ways of spread.cl; the constructor chooses by the kind of device.
    void spread_in_tiles(bool on) { in_tiles_ = on; }
    // Likewise of pattern.cl.
    void discs_in_rows(bool on) { discs_.in_rows(on); }

    // The steps of make(), for those who measure them.
    int spread(const ClEyeStage& eye, const PatternGrid& grid, std::size_t lamp = 0);
    int join(const ClEyeStage& core, const WideField& wide, const PatternGrid& grid, std::size_t lamp);
    void calibrate_rings(const PatternGrid& grid, const Pattern& pattern);
    void split(const PatternGrid& grid, double structure_energy, bool calibrated = false);
    int average_discs(const PatternGrid& grid, const std::vector<float>& radii);
    // Layers, energies and finer nodes; `calibrated` as it was split.
    void read_back(const PatternGrid& grid, Pattern& pattern, std::size_t slot = 0, bool calibrated = false);

    std::size_t device_bytes() const;

  private:
    // A table of the wide field, spread onto a grid for a lamp: done once, and used as long as the table is shown.
    struct WideCells {
        std::uint64_t table = 0;
        double pitch = 0;
        std::size_t lamp = 0;
        std::uint64_t used = 0;
        ClBuffer cells;
        ClBuffer fine_cells;
    };
    WideCells& wide_cells(const WideField& wide, const WideTable& table, const PatternGrid& grid,
                          std::size_t lamp, int& launches);
    WideCells& claim(const WideField& wide);
    // A lamp's spectrum with each sample in so many parts, on the device.
    struct Wavelengths {
        std::size_t lamp = 0;
        int parts = 1;
        int count = 0;  // 0: to be made anew
        ClBuffer samples;
    };
    const Wavelengths& wavelengths(std::size_t lamp, int parts);
    // A table of cumulative energy: entries per quadrant's side, floats a row, entries per sample, where its energy ends.
    struct Table {
        cl_mem energy = nullptr;
        int edges = 0;
        int stride = 0;
        double entries_per_sample = 1;
        double reach_samples = 0;
    };
    struct WideParts {
        std::array<cl_mem, 4> cells{};
        cl_float4 weights{};
        int count = 0;
    };
    void spread_cells(const Table& table, const WideParts& wide, const PatternGrid& grid, std::size_t lamp,
                      cl_mem out);

    const ClDevice& device_;
    void read_fine_nodes(const PatternGrid& grid, const Rgbv& scale, bool calibrated, std::size_t slot,
                         Pattern& pattern);
    double core_radius_nodes_;
    double plane_width_mm_;
    double angular_scale_;
    double wavelength_step_nodes_;
    LampWavelengths samples_;
    ClKernel spread_cells_;
    ClKernel spread_tiles_;
    bool in_tiles_;
    ClKernel calibrate_rings_;
    ClKernel split_;
    ClKernel balance_;
    ClDiscLayers discs_;
    std::vector<std::unique_ptr<Wavelengths>> wavelengths_;
    ClBuffer cells_;
    ClBuffer fine_cells_;
    std::vector<Rgbv> quadrants_;  // of the fine cells, as they are read
    std::vector<Rgbv> whole_;      // all four
    std::vector<float> fine_gains_;
    ClBuffer skirt_;
    ClBuffer energies_;
    ClBuffer result_;
    ClBuffer targets_;
    ClBuffer gains_;
    double targets_pitch_ = 0;
    bool calibrate_ = false;
    std::vector<std::unique_ptr<WideCells>> wide_cells_;
    std::uint64_t clock_ = 0;
};

}  // namespace seaglare::glare
