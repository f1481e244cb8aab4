//! \file
//! Meshes as they stand in pictures: a view in perspective, shading, edges.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "agvd/mesh/mesh.h"
#include "render/canvas.h"

namespace render {

inline const Color front_color{0.84F, 0.40F, 0.24F};  //!< Of faces seen from the front.

//! How meshes are turned in pictures: degrees about x, y and z, y first.
inline constexpr std::array<double, 3> default_degrees{15, -30, 0};

//! Turned about y, then x, then z (degrees); seen from a few radii away; fitted to a part of a
//! picture. All lengths of the picture in pixels.
class View {
public:
    //! \param left  where the part begins.
    View(const agvd::MeshView& mesh, const std::array<double, 3>& degrees, int width, int height,
         int left = 0);

    //! z points towards the viewer.
    [[nodiscard]] agvd::Vec3 to_pixels(const agvd::Vec3& point) const;
    //! \param direction  of the mesh. \return the same as it is seen.
    [[nodiscard]] agvd::Vec3 turn(const agvd::Vec3& direction) const {
        return rotation_ * direction;
    }
    //! The same view in a part of the picture that begins farther to the right.
    [[nodiscard]] View moved_right(int pixels) const;

private:
    // The perspective is a projective map, so planes stay planes and depth stays linear in x, y.
    [[nodiscard]] agvd::Vec3 project(const agvd::Vec3& point) const;

    Eigen::Matrix3d rotation_;
    agvd::Vec3 center_, shift_ = agvd::Vec3::Zero();
    double distance_ = 1, scale_ = 1;
};

//! Of a face.
using FaceColor = std::function<Color(agvd::Index face, bool is_front)>;

//! Draws all faces. \param is_wire  with their edges.
void draw_mesh(const agvd::MeshView& mesh, const View& view, const FaceColor& color, bool is_wire,
               Canvas& canvas);

//! The same; back faces are blue.
void draw_mesh(const agvd::MeshView& mesh, const View& view, const Color& front, bool is_wire,
               Canvas& canvas);

//! Two meshes beside each other from the same side, with their edges, as PNG.
//! \param left   the view is fitted to this one.
[[nodiscard]] std::string picture_of_pair(const agvd::MeshView& left, const agvd::MeshView& right);

}  // namespace render
