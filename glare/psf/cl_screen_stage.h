// The screen's half of the pattern on the device: spread the energy over wavelengths and onto the nodes, split core
// from skirt, average discs. Its buffers serve every pitch in turn.
#pragma once

#include <vector>

#include "glare/colour/navigation_colours.h"
#include "glare/device/cl_device.h"
#include "glare/psf/cl_eye_stage.h"
#include "glare/psf/pattern_cache.h"
#include "glare/psf/pattern_grid.h"

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
    // `pattern`, whose lamps and layer radii are set.
    // `pupil_mm` only tells the eye's table apart. Returns the launches.
    int make(const ClEyeStage& eye, const PatternGrid& grid, double structure_energy, Pattern& pattern);

    // The steps of make(), for those who measure them.
    void spread(const ClEyeStage& eye, const PatternGrid& grid, std::size_t lamp = 0);
    void split(const PatternGrid& grid, double structure_energy);
    int average_discs(const PatternGrid& grid, const std::vector<float>& radii);
    void read_back(const PatternGrid& grid, Pattern& pattern, std::size_t slot = 0);

    std::size_t device_bytes() const;

  private:
    struct Stencil {
        float radius = 0;
        cl_int span_begin = 0;
        cl_int span_end = 0;
        cl_float span_weight = 0;
        cl_int tap_begin = 0;
        cl_int tap_end = 0;
    };
    const Stencil& stencil(float radius) const;
    void upload_wavelengths(std::size_t lamp);

    const ClDevice& device_;
    double core_radius_nodes_;
    double plane_width_mm_;
    double angular_scale_;
    LampWavelengths samples_;
    std::vector<Stencil> stencils_;
    ClOwned<cl_program> program_;
    ClKernel spread_;
    ClKernel split_;
    ClKernel balance_;
    ClKernel average_;
    std::array<ClBuffer, most_lamps> wavelengths_;
    ClBuffer spans_;
    ClBuffer taps_;
    ClBuffer corners_;
    ClBuffer skirt_;
    ClBuffer prefix_;
    ClBuffer row_energy_;
    ClBuffer result_;
    std::vector<ClBuffer> layers_;
};

}  // namespace seaglare::glare
