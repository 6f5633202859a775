// The disc layers of a pattern on the device: its skirt averaged over discs, whose cost grows with their radius and not with
// their area.
#pragma once

#include <cstddef>
#include <vector>

#include "glare/device/cl_device.h"
#include "glare/psf/pattern_grid.h"

namespace seaglare::glare {

// The skirt's buffer (shaders/pattern.cl): rows -margin ... border of nodes, and on either side what vectors reach over.
struct SkirtLayout {
    explicit SkirtLayout(const PatternGrid& grid);
    int border = 0;  // what the discs of nodes at the rim reach
    std::size_t columns = 0;
    std::size_t rows = 0;
    // With what the last vectors of the last row read beyond it.
    std::size_t bytes() const { return (rows * columns + 16) * 4 * sizeof(float); }
};

class ClDiscLayers {
  public:
    // `program` is pattern.cl, `radii_nodes` all radii that layers will be asked for. Throws as ClDevice does.
    ClDiscLayers(const ClDevice& device, cl_program program, const std::vector<float>& radii_nodes);

    void reserve(const PatternGrid& grid, std::size_t layers);

    // Averages the skirt over discs of these radii, times the balance's factors. Returns the launches. Throws
    // std::logic_error for a radius that the constructor was not told of.
    int average(const PatternGrid& grid, const std::vector<float>& radii_nodes, cl_mem skirt, cl_mem balance);

    // Waits, and fills layers x side x side nodes of rgb + scotopic: the device makes half of the rows, the other half are
    // their mirror images.
    void read(const PatternGrid& grid, std::size_t layers, float* nodes) const;

    // Which of the two ways of pattern.cl; the constructor chooses by the kind of device.
    void in_rows(bool on) { in_rows_ = on; }

    std::size_t device_bytes() const;

  private:
    struct Stencil {
        float radius = 0;
        // average_disc
        cl_int span_begin = 0;
        cl_int span_end = 0;
        cl_float span_weight = 0;
        cl_int tap_begin = 0;
        cl_int tap_end = 0;
        // average_rows; reach < 0 where the disc is too large for it
        cl_int reach = -1;
        ClBuffer first_of;
    };
    const Stencil& stencil(float radius) const;
    void average_any(const PatternGrid& grid, const Stencil& s, cl_mem skirt, cl_mem balance, cl_int at);
    void average_rows(const PatternGrid& grid, const Stencil& s, cl_mem skirt, cl_mem balance, cl_int at);

    const ClDevice& device_;
    ClKernel sum_skirt_;
    ClKernel average_disc_;
    ClKernel average_rows_;
    bool in_rows_;
    std::vector<Stencil> stencils_;
    ClBuffer spans_;
    ClBuffer taps_;
    ClBuffer steps_;
    ClBuffer beyond_;
    ClBuffer layers_;
};

}  // namespace seaglare::glare
