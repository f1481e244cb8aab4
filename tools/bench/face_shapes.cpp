#include "bench/face_shapes.h"

#include <algorithm>
#include <cmath>

#include "agvd/mesh/surface.h"

namespace bench {

FaceShapes face_shapes(const agvd::Surface& surface) {
    FaceShapes shapes;
    const double num_faces = surface.num_faces();
    for (agvd::Index f = 0; f < surface.num_faces(); ++f) {
        const agvd::Index h = 3 * f;
        const double a = surface.length_of(h), b = surface.length_of(h + 1);
        const double c = surface.length_of(h + 2);
        const double area = agvd::face_area(surface, f);
        const double tau = (a + b + c) / 2 * std::max({a, b, c}) / (2 * std::sqrt(3) * area);
        shapes.mean_lo += 4 * std::sqrt(3) * area / (a * a + b * b + c * c) / num_faces;
        shapes.mean_tau += tau / num_faces;
        shapes.max_tau = std::max(shapes.max_tau, tau);
    }
    return shapes;
}

}  // namespace bench
