// The aperture as geometry on a square grid of samples, before anyone draws it. Shared by the OpenCL and the CPU
// source: what they draw is the same, how they draw it is not.
//
// Sample units: the plane is n samples wide, sample j covers [j, j + 1], the optical axis is at n/2.
// Amplitude: P = pupil coverage * (1 - 2 c) * (1 - depth * G), c the coverage by particles of transmission -1, G the
// coverage by grating lines; times the share that lids and lashes (veil.h) leave open. All real: a focused eye cancels the
// quadratic phase, and |FFT|^2 is point-symmetric.
#pragma once

#include <cstdint>
#include <vector>

#include "glare/eye/eye_instant.h"
#include "glare/eye/eye_model.h"
#include "glare/eye/veil.h"

namespace seaglare::glare {

struct Disc {
    float x = 0;
    float y = 0;
    float radius = 0;
    float padding = 0;  // uploaded as float4
};

// Gratings in sample units: line k covers the azimuths (k ... k + duty) / count of a turn.
struct GratingShape {
    float count = 0;  // 0: none
    float inner_radius = 0;
    float outer_radius = 0;
    float duty = 0;
    float depth = 0;
};

// The parts that never change, in millimetres around the optical axis.
class ApertureParts {
  public:
    // Draws every particle's place from the seed. How many of which size there are is the eye's and no seed's, and each
    // part of the field has its share of every size: drawn freely, the few large ones before a 3 mm pupil scatter by a
    // sixth from seed to seed at 0.1 degrees, and their glare with them. Negative counts and sizes count as none.
    ApertureParts(const EyeModel& eye, std::uint64_t seed);

    // The particles at an instant, in sample units, replacing `discs`: families drift in closed form, those of the lens
    // are strained with it, those of the vitreous body turn about the sight.
    void place(const EyeInstant& instant, int n, double plane_width_mm, std::vector<Disc>& discs) const;
    // At rest but for the drift.
    void place(double time_s, int n, double plane_width_mm, std::vector<Disc>& discs) const;
    GratingShape gratings(int n, double plane_width_mm, double lens_scale = 1) const;
    std::size_t particle_count() const { return x_mm_.size(); }

  private:
    struct Family {
        std::size_t end = 0;
        double drift_mm = 0;
        double drift_period_s = 1;
        ParticleSite site = ParticleSite::cornea;
    };
    std::vector<Family> families_;
    std::vector<double> x_mm_;
    std::vector<double> y_mm_;
    std::vector<double> radius_mm_;
    LensGratings gratings_;
    std::uint64_t seed_ = 0;
};

// Shapes sorted into square tiles of `tile_side` samples: those of tile t (row-major) are
// shapes[begin[t]] ... shapes[begin[t + 1] - 1], in the order they came. A shape is listed with every tile that its
// bounding box touches.
template <typename Shape>
class TileListsOf {
  public:
    static constexpr int tile_side = 64;
    void sort(const std::vector<Shape>& shapes, int n);
    const std::vector<std::int32_t>& begin() const { return begin_; }
    const std::vector<Shape>& shapes() const { return sorted_; }
    const std::vector<Shape>& discs() const { return sorted_; }
    // No position of the shapes needs more entries than this.
    static std::size_t worst_case(const std::vector<Shape>& shapes);

  private:
    std::vector<std::int32_t> begin_;
    std::vector<std::int32_t> next_;
    std::vector<Shape> sorted_;
};
using TileLists = TileListsOf<Disc>;
using QuadTileLists = TileListsOf<Quad>;

}  // namespace seaglare::glare
