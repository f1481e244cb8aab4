// Triangulates a polygon with holes. Bridges join the holes to the outline, the shortest first;
// then ears are clipped, and Lawson's flips make the triangulation Delaunay as far as the loops
// allow. Simple and slow: the polygons of data/ have some hundred points.
#include "make_data/planar.h"

#include <algorithm>
#include <limits>
#include <map>

namespace make_data {

using agvd::Index;
using agvd::Triangle;
using agvd::Vec2;

namespace {

using Chain = std::vector<Index>;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// Joins the holes to the outline by the shortest bridges, nearest hole first. Those are edges of a
// minimum spanning tree, so they cross neither each other nor the loops.
Chain bridge(const std::vector<Vec2>& points, std::vector<Chain> loops) {
    Chain outline = std::move(loops.front());
    loops.erase(loops.begin());
    while (!loops.empty()) {
        double best = std::numeric_limits<double>::max();
        std::size_t loop = 0, from = 0, to = 0;
        for (std::size_t l = 0; l < loops.size(); ++l) {
            for (std::size_t i = 0; i < outline.size(); ++i) {
                for (std::size_t j = 0; j < loops[l].size(); ++j) {
                    const double d = (points[outline[i]] - points[loops[l][j]]).squaredNorm();
                    if (d >= best) continue;
                    best = d;
                    loop = l;
                    from = i;
                    to = j;
                }
            }
        }
        Chain& hole = loops[loop];
        std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(to), hole.end());
        hole.push_back(hole.front());
        hole.push_back(outline[from]);
        outline.insert(outline.begin() + static_cast<std::ptrdiff_t>(from) + 1, hole.begin(),
                       hole.end());
        loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(loop));
    }
    return outline;
}

bool is_ear(const std::vector<Vec2>& points, const Chain& chain, const Triangle& t) {
    const Vec2 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    if (cross(b - a, c - a) <= 0) return false;
    return std::none_of(chain.begin(), chain.end(), [&](Index i) {
        const Vec2& p = points[i];
        return i != t[0] && i != t[1] && i != t[2] && cross(b - a, p - a) >= 0 &&
               cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
    });
}

std::vector<Triangle> clip_ears(const std::vector<Vec2>& points, Chain chain) {
    std::vector<Triangle> triangles;
    std::size_t k = 0;
    while (chain.size() > 2) {
        const std::size_t n = chain.size();
        const Triangle t{chain[k % n], chain[(k + 1) % n], chain[(k + 2) % n]};
        if (is_ear(points, chain, t)) {
            triangles.push_back(t);
            chain.erase(chain.begin() + static_cast<std::ptrdiff_t>((k + 1) % n));
        }
        ++k;
    }
    return triangles;
}

// Lawson's flips; the loops stay, since their edges have a triangle on one side only.
void flip_to_delaunay(const std::vector<Vec2>& points, std::vector<Triangle>& triangles) {
    // Sum of the angles at c and d over the edge ab beyond a half turn: its sine, if above 0.
    const auto excess = [&](Index a, Index b, Index c, Index d) {
        const Vec2 ca = (points[a] - points[c]).normalized(),
                   cb = (points[b] - points[c]).normalized();
        const Vec2 da = (points[a] - points[d]).normalized(),
                   db = (points[b] - points[d]).normalized();
        return -(ca.dot(cb) * cross(db, da) + cross(ca, cb) * db.dot(da));
    };
    bool has_flipped = true;
    while (has_flipped) {
        has_flipped = false;
        std::map<std::pair<Index, Index>, std::pair<std::size_t, Index>> across;  // face, apex
        for (std::size_t f = 0; f < triangles.size(); ++f) {
            const auto& [a, b, c] = triangles[f];
            across[{a, b}] = {f, c};
            across[{b, c}] = {f, a};
            across[{c, a}] = {f, b};
        }
        std::vector<bool> is_changed(triangles.size(), false);
        for (std::size_t f = 0; f < triangles.size(); ++f) {
            for (std::size_t k = 0; k < 3 && !is_changed[f]; ++k) {
                const Index a = triangles[f][k], b = triangles[f][(k + 1) % 3];
                const Index c = triangles[f][(k + 2) % 3];
                const auto it = across.find({b, a});
                if (it == across.end() || is_changed[it->second.first]) continue;
                const auto [g, d] = it->second;
                constexpr double tie = 1e-9;  // far above rounding
                if (excess(a, b, c, d) < tie) continue;
                triangles[f] = {a, d, c};
                triangles[g] = {d, b, c};
                is_changed[f] = is_changed[g] = has_flipped = true;
            }
        }
    }
}

}  // namespace

std::vector<Triangle> triangulate(const std::vector<std::vector<Vec2>>& loops) {
    std::vector<Vec2> points;
    std::vector<Chain> chains;
    for (const std::vector<Vec2>& loop : loops) {
        chains.emplace_back();
        for (const Vec2& p : loop) {
            chains.back().push_back(static_cast<Index>(points.size()));
            points.push_back(p);
        }
    }
    std::vector<Triangle> triangles = clip_ears(points, bridge(points, std::move(chains)));
    flip_to_delaunay(points, triangles);
    return triangles;
}

}  // namespace make_data
