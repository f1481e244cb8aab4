// a, b: ends of an edge; c, d: corners opposite; up: unit normal; cotangent: of the angle opposite
// an edge; mass: area times density. For the energy each triangle is divided at its circumcentre
// into six right triangles, two for each edge.
#include "remesh/sites/cvt_energy.h"

#include <algorithm>
#include <cmath>

#include "agvd/core/types.h"
#include "agvd/mesh/any_mesh.h"

namespace remesh::detail {
namespace {

// Sum of two cotangents below which an edge is flipped: below 0, so that the diagonals of a square
// do not alternate.
constexpr double flip_tolerance = -1e-9;
// Least cosine between the normals of the triangles before and after a flip.
constexpr double least_flip_cosine = 0.2;

double cotangent_between(const Vec3& a, const Vec3& b) {
    const double sine = a.cross(b).norm();
    return a.dot(b) / std::max(sine, 1e-300);
}

struct Flipper {
    SiteMesh& mesh;
    std::span<const Vec3> positions;

    [[nodiscard]] const Vec3& at(Index site) const { return positions[site]; }
    [[nodiscard]] Index apex(Index h) const { return mesh.tail(SiteMesh::previous(h)); }

    [[nodiscard]] bool is_delaunay(Index h, Index twin) const {
        const Vec3 &a = at(mesh.tail(h)), &b = at(mesh.head(h));
        const Vec3 &c = at(apex(h)), &d = at(apex(twin));
        return cotangent_between(a - c, b - c) + cotangent_between(a - d, b - d) >= flip_tolerance;
    }

    [[nodiscard]] bool can_flip(Index h, Index twin) const {
        const Index a = mesh.tail(h), b = mesh.head(h), c = apex(h), d = apex(twin);
        if (c == d || are_joined(mesh.triangles, mesh.twin, SiteMesh::previous(h), d)) return false;
        const Vec3 before = (at(b) - at(a)).cross(at(c) - at(a)).normalized() +
                            (at(a) - at(b)).cross(at(d) - at(b)).normalized();
        const Vec3 left = (at(d) - at(c)).cross(at(b) - at(c));
        const Vec3 right = (at(c) - at(d)).cross(at(a) - at(d));
        const double least = least_flip_cosine * before.norm();
        return before.dot(left) > least * left.norm() && before.dot(right) > least * right.norm();
    }

    // Triangles (a, b, c) and (b, a, d) become (c, d, b) and (d, c, a), in place.
    void flip(Index h, Index twin) {
        const Index a = mesh.tail(h), b = mesh.head(h), c = apex(h), d = apex(twin);
        const Index outer[4] = {mesh.twin[SiteMesh::next(h)], mesh.twin[SiteMesh::previous(h)],
                                mesh.twin[SiteMesh::next(twin)],
                                mesh.twin[SiteMesh::previous(twin)]};
        const Index left = 3 * (h / 3), right = 3 * (twin / 3);
        mesh.triangles[h / 3] = {c, d, b};
        mesh.triangles[twin / 3] = {d, c, a};
        join(left, right);
        join(left + 1, outer[3]);   // d b
        join(left + 2, outer[0]);   // b c
        join(right + 1, outer[1]);  // c a
        join(right + 2, outer[2]);  // a d
    }
    void join(Index h, Index other) {
        mesh.twin[h] = other;
        if (other != no_index) mesh.twin[other] = h;
    }
};

// Beyond these a triangle is nearly degenerate and left out of the energy, which would be
// unbounded. At the rim no neighbours compensate, so 11 or 169 degrees are enough.
constexpr double flat_cotangent = 50;
constexpr double flat_cotangent_at_rim = 5;

// The right triangle between an end of an edge, its midpoint and the circumcentre: half of the part
// that the edge has of a triangle.
struct RightTriangle {
    double area = 0, mass = 0;
    double spread = 0;  // Mean squared distance from the site; not for sums.
    Vec3 slope = Vec3::Zero();

    void add(const RightTriangle& more) {
        area += more.area;
        mass += more.mass;
        slope += more.slope;
    }
};

// The right triangles of the two ends of an edge. They are alike but for their slopes.
struct EdgePart {
    double area = 0, mass = 0, spread = 0;  // Of each.
    Vec3 along, across;  // Slopes: their sum at the tail, across - along at the head.

    [[nodiscard]] RightTriangle at_tail() const { return {area, mass, spread, across + along}; }
    [[nodiscard]] RightTriangle at_head() const { return {area, mass, spread, across - along}; }
};

// \param edge       the triangle lies on its left.
// \param up         unit normal of the triangle.
// \param cotangent  of the angle opposite the edge.
inline EdgePart edge_part(const Vec3& edge, const Vec3& up, double cotangent, double density) {
    const double squared_length = edge.squaredNorm();
    const double area = cotangent * squared_length / 8;
    const double mass = density * area;
    const Vec3 along = (-2.0 / 3 * mass) * edge;
    return {area, mass, squared_length * (3 + cotangent * cotangent) / 24, along,
            0.5 * cotangent * up.cross(along)};
}

// A triangle with an obtuse angle opposite its rim edge (tail, head). The apex and its mirror image
// across the rim count as neighbours, whose cells meet at the rim.
class ClippedTriangle {
public:
    ClippedTriangle(const Vec3& tail, const Vec3& head, const Vec3& apex, const Vec3& up,
                    double density) {
        const Vec3 rim = head - tail;
        const double share = std::clamp((apex - tail).dot(rim) / rim.squaredNorm(), 0.0, 1.0);
        const Vec3 foot = tail + share * rim;
        const double height = (apex - foot).norm();
        const double before = (foot - tail).norm(), after = (head - foot).norm();
        const Vec3 down = 2 * (foot - apex);
        add(0, tail, apex, height / before, up, density);
        add(1, head, apex, height / after, up, density);
        add_apex(down, before / height, up, density);
        add_apex(down, after / height, -up, density);
    }

    std::array<RightTriangle, 3> part;  // Sums for tail, head and apex.
    double energy = 0, weighted = 0;
    double steepest = 0;

private:
    // Adds the edge between an end of the rim and the apex.
    void add(std::size_t end, const Vec3& at, const Vec3& apex, double cotangent, const Vec3& up,
             double density) {
        const Vec3 side = end == 0 ? up : Vec3(-up);
        const EdgePart part_of_edge = edge_part(apex - at, -side, cotangent, density);
        take(end, part_of_edge.at_tail());
        take(2, part_of_edge.at_head());
        steepest = std::max(steepest, cotangent);
    }
    // Adds the apex's half of the edge to its mirror image. The angle opposite that edge, at an end
    // of the rim, is twice the given one.
    void add_apex(const Vec3& down, double cotangent_of_half, const Vec3& up, double density) {
        const double cotangent = (cotangent_of_half - 1 / cotangent_of_half) / 2;
        take(2, edge_part(down, -up, cotangent, density).at_tail());
    }
    void take(std::size_t i, const RightTriangle& more) {
        part[i].add(more);
        energy += more.area * more.spread;
        weighted += more.mass * more.spread;
    }
};

// Normals become unit vectors, slopes tangential.
void project_slopes(std::vector<CvtEnergy::Cell>& cells) {
    for (CvtEnergy::Cell& cell : cells) {
        cell.normal.normalize();
        cell.slope -= cell.normal.dot(cell.slope) * cell.normal;
    }
}

}  // namespace

Index flip_towards_delaunay(SiteMesh& mesh, std::span<const Vec3> positions,
                            std::span<const double> cotangent, Ticker ticker) {
    Flipper flipper{mesh, positions};
    Index flips = 0;
    for (Index h = 0; h < mesh.twin.size(); ++h) {
        ticker.tick();
        const Index twin = mesh.twin[h];
        if (twin == no_index || twin < h) continue;
        if (cotangent[h] + cotangent[twin] >= flip_tolerance) continue;
        // Another flip may have changed the triangles since.
        if (flipper.is_delaunay(h, twin) || !flipper.can_flip(h, twin)) continue;
        flipper.flip(h, twin);
        ++flips;
    }
    return flips;
}

void measure_energy(const SiteMesh& mesh, std::span<const Vec3> positions,
                    std::span<const double> weight, Ticker& ticker, CvtEnergy& result) {
    result.energy = 0;
    result.weighted = 0;
    result.cells.assign(positions.size(), {Vec3::Zero(), Vec3::Zero(), 0, 0});
    result.cotangent.assign(3 * mesh.triangles.size(), 0);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        ticker.tick();
        const Triangle& t = mesh.triangles[i];
        const std::array<Vec3, 3> edge{positions[t[1]] - positions[t[0]],
                                       positions[t[2]] - positions[t[1]],
                                       positions[t[0]] - positions[t[2]]};
        const Vec3 normal = edge[0].cross(edge[1]);
        const double doubled_area = normal.norm();
        if (!(doubled_area > 0)) continue;
        const Vec3 up = normal / doubled_area;
        const double density = (weight[t[0]] + weight[t[1]] + weight[t[2]]) / 3;
        // The circumcentre lies above the midpoint of each edge by half the edge times the
        // cotangent: two right triangles, one in the cell of either end.
        std::array<EdgePart, 3> half;
        double energy = 0, weighted = 0;
        double flat = flat_cotangent, steepest = 0;
        std::size_t obtuse_at_rim = 3;
        for (std::size_t k = 0; k < 3; ++k) {
            const double cotangent = -edge[(k + 1) % 3].dot(edge[(k + 2) % 3]) / doubled_area;
            half[k] = edge_part(edge[k], up, cotangent, density);
            energy += 2 * half[k].area * half[k].spread;
            weighted += 2 * half[k].mass * half[k].spread;
            const bool is_rim = mesh.twin[3 * i + k] == no_index;
            if (is_rim) flat = flat_cotangent_at_rim;
            if (is_rim && cotangent < 0) obtuse_at_rim = k;
            steepest = std::max(steepest, std::abs(cotangent));
            result.cotangent[3 * i + k] = cotangent;
        }
        std::array<RightTriangle, 3> part;
        for (std::size_t k = 0; k < 3; ++k) {
            part[k] = half[k].at_tail();
            part[k].add(half[(k + 2) % 3].at_head());
        }
        if (obtuse_at_rim < 3) {
            const std::size_t k = obtuse_at_rim;
            const ClippedTriangle clipped(positions[t[k]], positions[t[(k + 1) % 3]],
                                          positions[t[(k + 2) % 3]], up, density);
            for (std::size_t j = 0; j < 3; ++j) part[(k + j) % 3] = clipped.part[j];
            energy = clipped.energy;
            weighted = clipped.weighted;
            steepest = clipped.steepest;
        }
        // With all corners on the rim's line there is no height to divide by.
        if (steepest <= flat && std::isfinite(energy)) {
            result.energy += energy;
            result.weighted += weighted;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (!part[k].slope.allFinite()) continue;  // The triangle has no width.
            CvtEnergy::Cell& cell = result.cells[t[k]];
            cell.slope += part[k].slope;
            cell.normal += normal;
            cell.mass += part[k].mass;
            cell.area += part[k].area;
        }
    }
    project_slopes(result.cells);
}

void find_turned(const SiteMesh& mesh, std::span<const Vec3> positions,
                 std::span<const Vec3> facing, std::vector<Index>& turned) {
    turned.clear();
    for (Index i = 0; i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        const Vec3 normal = (positions[b] - positions[a]).cross(positions[c] - positions[b]);
        if (!(normal.dot(facing[a] + facing[b] + facing[c]) > 0)) turned.push_back(i);
    }
}

}  // namespace remesh::detail
