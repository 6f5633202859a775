// The buffers lights are summed in: HDR at full resolution, the tail on a coarse grid, the lights' visibility.
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
        resize(internal_format, width_px, height_px, 0, height_px, what);
    }
    // Holds only the rows first_row ... first_row + rows - 1 of its picture, or more: what it once had room for it keeps,
    // so that moving rows allocate nothing. What is drawn elsewhere is lost.
    void resize(GLenum internal_format, int width_px, int height_px, int first_row, int rows,
                const char* what);
    void bind_for_drawing()
        const;           // and sets the viewport: coordinates are the picture's, gl_FragCoord the texture's
    void clear() const;  // while bound; to zero
    void read(std::span<float> rgba) const;
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
