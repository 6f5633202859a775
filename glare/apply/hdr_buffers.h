// The textures that lights are drawn to: bands of the HDR sum, the grid of their tails, their visibility.
#pragma once

#include <span>
#include <vector>

#include "glare/device/gl_object.h"

namespace seaglare::glare {

// A float texture one can draw to.
class FloatBuffer {
  public:
    explicit FloatBuffer(const Gl& gl) : gl_(gl) {}
    // Allocates when it is larger than any before; uses texture unit 0. Throws GlError naming `what` when it cannot be drawn to.
    void resize(GLenum internal_format, int width_px, int height_px, const char* what) {
        resize(internal_format, width_px, height_px, height_px, what);
    }
    // Has room for so many rows of its picture, and holds the first of them.
    void resize(GLenum internal_format, int width_px, int height_px, int rows, const char* what);
    // Holds other rows of the picture from now on, no more than it has room for. What is drawn elsewhere is lost.
    void move_to(int first_row, int rows) {
        first_row_ = first_row;
        rows_ = rows;
    }
    // Sets the viewport, too: coordinates are the picture's, gl_FragCoord the texture's.
    void bind_for_drawing() const;
    void clear() const;  // while bound; to zero
    // Both of its rows, width_px() x rows() x 4 floats at least. Reading waits for the GPU; writing uses texture unit 0.
    void read(std::span<float> rgba) const;
    void write(std::span<const float> rgba) const;
    GLuint texture() const { return texture_.name(); }
    int width_px() const { return width_px_; }
    int height_px() const { return height_px_; }  // of the picture
    int first_row() const { return first_row_; }
    int rows() const { return rows_; }
    double memory_bytes() const;
    void forget();

  private:
    const Gl& gl_;
    GlObject texture_;
    GlObject framebuffer_;
    GLenum format_ = 0;
    int width_px_ = 0;
    int height_px_ = 0;
    int first_row_ = 0;
    int rows_ = 0;
    int allocated_width_ = 0;
    int allocated_rows_ = 0;
};

// Adds a coarse grid, whose node (i, j) stands at pixel (i, j) cell_px, bilinearly to an image: what the composite does.
void add_coarse_grid(std::span<const float> grid, int grid_width, int cell_px, std::span<float> rgba,
                     int width_px);

}  // namespace seaglare::glare
