#include "small_mesh.h"

#include <algorithm>
#include <cmath>

#include "support/dirty_shapes.h"
#include "support/shapes.h"

namespace fuzz {

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;

namespace {

// Triangles between any vertices of a small lattice, of which many coincide or lie on one line.
TriangleMesh soup(Bytes& bytes) {
    TriangleMesh mesh;
    const Index num_vertices = 3 + bytes.below(18), num_faces = 4 + bytes.below(77);
    for (Index v = 0; v < num_vertices; ++v) {
        const double x = bytes.below(9), y = bytes.below(9);
        mesh.positions.emplace_back(x, y, bytes.below(9));
    }
    for (Index f = 0; f < num_faces && !bytes.is_empty(); ++f) {
        const Index a = bytes.below(num_vertices), b = bytes.below(num_vertices);
        mesh.triangles.push_back({a, b, bytes.below(num_vertices)});
    }
    return mesh;
}

TriangleMesh shape(Bytes& bytes) {
    const Index kind = bytes.below(16), n = bytes.below(16), m = bytes.below(16);
    switch (kind) {
        case 0:
            return shapes::tetrahedron();
        case 1:
            return shapes::grid(1 + n % 6);
        case 2:
            return shapes::tube(3 + n % 8, 1 + m % 4);
        case 3:
            return shapes::sphere(static_cast<int>(n % 2));
        case 4:
            return shapes::cube();
        case 5:
            return shapes::torus(3 + n % 4, 3 + m % 4);
        case 6:
            return shapes::moebius(3 + n);
        case 7:
            return shapes::book(2 + n);
        case 8:
            return shapes::hourglass();
        case 9:
            return shapes::cubes_on_an_edge();
        case 10:
            return shapes::filled_slit(1 + n);
        case 11:
            return shapes::unweld(shapes::grid(1 + n % 5));
        case 12:
            return shapes::lips(3 + n % 6, 4, 1 + m % 3);
        case 13:
            return shapes::subdivide(shapes::cube());
        default:
            return soup(bytes);
    }
}

// Times a power of two.
double times(double x, int exponent) { return std::ldexp(x, exponent); }

void move_vertex(Bytes& bytes, TriangleMesh& mesh) {
    const auto any = [&]() -> Vec3& { return mesh.positions[bytes.below(mesh.positions.size())]; };
    Vec3& p = any();
    const Index kind = bytes.below(9), axis = bytes.below(3);
    const auto amount = [&] { return int{bytes.take<std::int8_t>()}; };
    switch (kind) {
        case 0:
            p[axis] = bytes.take<float>();
            break;
        case 1:
            p = any();
            break;
        case 2:
            p[axis] = any()[axis];
            break;
        case 3:
            p[axis] += times(amount(), -6);
            break;
        case 4:
            p[axis] = times(p[axis], amount());
            break;
        case 5:
            p = (any() + any()) / 2;
            break;
        case 6:
            p[axis] *= 1 + times(amount(), -52);
            break;
        case 7:
            p[axis] += times(1, amount());
            break;
        default:
            p[axis] = bytes.take<double>();
            break;
    }
}

void change_face(Bytes& bytes, TriangleMesh& mesh) {
    agvd::Triangle& t = mesh.triangles[bytes.below(mesh.triangles.size())];
    switch (bytes.below(6)) {
        case 0:
            std::swap(t[0], t[1]);
            break;
        case 1:
            mesh.triangles.push_back(agvd::Triangle(t));
            break;
        case 2:
            t = mesh.triangles.back();
            mesh.triangles.pop_back();
            break;
        case 3:
            t[bytes.below(3)] = bytes.take<Index>();
            break;
        default:
            t[bytes.below(3)] = bytes.below(mesh.positions.size());
            break;
    }
}

// All of it: far from the origin, of any size, or flat along some axes.
void transform(Bytes& bytes, TriangleMesh& mesh) {
    const Index kind = bytes.below(8);
    if (kind >= 3) return;
    const double size = times(1, 8 * int{bytes.take<std::int8_t>()});
    Vec3 by;
    for (double& x : by) x = times(1, int{bytes.take<std::int8_t>()} / 8);
    for (Vec3& p : mesh.positions) {
        p = kind == 0 ? Vec3(p + size * by) : kind == 1 ? Vec3(size * p) : Vec3(p.cwiseProduct(by));
    }
}

}  // namespace

TriangleMesh small_mesh(Bytes& bytes) {
    TriangleMesh mesh = shape(bytes);
    const Index num_moves = bytes.below(32), num_changes = bytes.below(10);
    for (Index i = 0; i < num_moves && !bytes.is_empty(); ++i) move_vertex(bytes, mesh);
    for (Index i = 0; i < num_changes && !bytes.is_empty(); ++i) {
        if (!mesh.triangles.empty()) change_face(bytes, mesh);
    }
    if (!bytes.is_empty()) transform(bytes, mesh);
    return mesh;
}

agvd::SurfacePoint point_on(Bytes& bytes, std::size_t num_faces) {
    agvd::SurfacePoint point{agvd::FaceId(bytes.below(num_faces)), {}};
    auto& b = point.barycentric;
    const Index kind = bytes.below(5), corner = bytes.below(3);
    for (double& x : b) x = 1 + bytes.below(256);
    const double little = kind >= 3 ? times(1, -2 - static_cast<int>(bytes.below(64))) : 0;
    if (kind != 0) b[corner] *= little;
    if (kind % 2 == 0 && kind != 0) b[(corner + 1) % 3] *= little;
    const double sum = b[0] + b[1] + b[2];
    for (double& x : b) x /= sum;
    return point;
}

}  // namespace fuzz
