//! \file
//! A picture drawn by a z-buffer: shaded triangles, lines on top of them, PNG out.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "agvd/core/types.h"

namespace render {

using Color = Eigen::Vector3f;  //!< Linear red, green, blue in [0, 1].

//! Coordinates are pixels of the finished picture: x right, y down, z towards the viewer.
class Canvas {
public:
    Canvas(int width, int height);

    [[nodiscard]] int width() const;   //!< Of the finished picture.
    [[nodiscard]] int height() const;  //!< Of the finished picture.
    //! Fills pixels that are in front of everything drawn before; edges get a thin dark line of
    //! this opacity.
    void draw_triangle(const std::array<agvd::Vec3, 3>& corners, const Color& color,
                       float edge_opacity);
    //! Draws a line of `width` pixels, hidden where the surface is more than `bias` in front of its
    //! axis.
    void draw_line(const agvd::Vec3& a, const agvd::Vec3& b, const Color& color, double width,
                   double bias);
    //! Whether no surface is more than `bias` in front of a point.
    [[nodiscard]] bool is_visible(const agvd::Vec3& point, double bias) const;
    //! Darkens hollows up to `radius` pixels wide; call after the triangles.
    void shade_hollows(double radius);
    //! The picture as a file in the format PNG.
    //! \throw std::bad_alloc
    [[nodiscard]] std::string png() const;

private:
    [[nodiscard]] std::size_t index(int x, int y) const;

    int width_, height_;         // of the sample grid
    std::vector<float> depth_;   // per sample, in samples; nothing drawn: lowest
    std::vector<Color> colors_;  // per sample
};

}  // namespace render
