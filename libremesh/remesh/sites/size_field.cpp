#include "remesh/sites/size_field.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"

namespace remesh {
namespace {

double face_in_lengths(const Surface& surface, Index face, std::span<const double> length) {
    double density = 0;
    for (const Index v : surface.mesh.triangles[face]) density += 1 / (length[v] * length[v]);
    return face_area(surface, face) * density / 3;
}

}  // namespace

Index face_of_input(const IntrinsicTriangulation& base, Index face) {
    if (!base.is_changed(face)) return face;
    const Surface& input = base.input();
    const Index corner = base.surface().mesh.triangles[face][0];
    return corner < input.num_vertices() ? Surface::face(input.outgoing[corner])
                                         : base.added_point(corner).face.value();
}

SizeField::SizeField(std::shared_ptr<const IntrinsicTriangulation> base, std::vector<double> length)
    : base_(std::move(base)),
      length_(std::move(length)),
      area_(base_->input().num_faces(), 0),
      least_(base_->input().num_faces(), infinity),
      least_of_all_(*std::min_element(length_.begin(), length_.end())) {
    const Surface& input = base_->input();
    const Surface& surface = base_->surface();
    for (Index f = 0; f < surface.num_faces(); ++f) {
        const double area = face_in_lengths(surface, f, length_);
        area_[face_of_input(*base_, f)] += area;
        sum_ += area;
    }
    for (Index f = 0; f < input.num_faces(); ++f) {
        for (const Index v : input.mesh.triangles[f]) {
            // Vertices that the base has removed have no length of their own.
            const bool is_removed = surface.outgoing[v] == no_index;
            const double here = is_removed ? at(point_at(input, v)) : length_[v];
            least_[f] = std::min(least_[f], here);
        }
    }
    for (Index v = input.num_vertices(); v < surface.num_vertices(); ++v) {
        double& least = least_[base_->added_point(v).face.value()];
        least = std::min(least, length_[v]);
    }
}

double SizeField::at(const SurfacePoint& point) const {
    const SurfacePoint on_base = base_->to_intrinsic(point);
    const Triangle& t = base_->surface().mesh.triangles[on_base.face.value()];
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += on_base.barycentric[k] * length_[t[k]];
    return std::max(sum, least_of_all_);
}

std::vector<double> lengths_at(const SizeField* sizes, std::span<const SurfacePoint> points) {
    std::vector<double> result;
    if (sizes == nullptr) return result;
    result.reserve(points.size());
    for (const SurfacePoint& point : points) result.push_back(sizes->at(point));
    return result;
}

std::function<double(const SurfacePoint&)> length_function(const SizeField* sizes) {
    if (sizes == nullptr) return {};
    return [sizes](const SurfacePoint& point) { return sizes->at(point); };
}

double area_in_lengths(const Surface& surface, std::span<const double> length) {
    double sum = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) sum += face_in_lengths(surface, f, length);
    return sum;
}

}  // namespace remesh
