#include "bench/face_shapes.h"

#include <algorithm>
#include <cmath>

namespace bench {

FaceShapes face_shapes(const agvd::Surface& surface) {
    FaceShapes shapes;
    const double num_faces = surface.num_faces();
    for (agvd::Index h = 0; h < surface.twin.size(); h += 3) {
        const double a = surface.length_of(h), b = surface.length_of(h + 1);
        const double c = surface.length_of(h + 2);
        const double area = a * surface.apex[h].y() / 2;
        const double tau = (a + b + c) / 2 * std::max({a, b, c}) / (2 * std::sqrt(3) * area);
        shapes.mean_lo += 4 * std::sqrt(3) * area / (a * a + b * b + c * c) / num_faces;
        shapes.mean_tau += tau / num_faces;
        shapes.max_tau = std::max(shapes.max_tau, tau);
    }
    return shapes;
}

}  // namespace bench
