//! \file
//! Builds meshes from patches.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <tuple>

#include "agvd/mesh/mesh.h"

namespace parts {

//! Patches of quads, welded where their points agree to 1e-9.
class Patchwork {
public:
    //! at(u, v) for u, v in [0, 1]; the normal points along du x dv. Sides of no length are points.
    void add(agvd::Index n, agvd::Index m, const std::function<agvd::Vec3(double, double)>& at) {
        const auto vertex = [&](agvd::Index i, agvd::Index j) {
            return index_of(at(static_cast<double>(i) / n, static_cast<double>(j) / m));
        };
        for (agvd::Index i = 0; i < n; ++i) {
            for (agvd::Index j = 0; j < m; ++j) {
                const agvd::Index a = vertex(i, j), b = vertex(i + 1, j);
                const agvd::Index c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
                add_triangle({a, b, c});
                add_triangle({a, c, d});
            }
        }
    }
    void add_square(agvd::Index n, const agvd::Vec3& corner, const agvd::Vec3& along,
                    const agvd::Vec3& up) {
        add(n, n, [&](double u, double v) -> agvd::Vec3 { return corner + u * along + v * up; });
    }
    [[nodiscard]] agvd::TriangleMesh take() { return std::move(mesh_); }

private:
    agvd::Index index_of(const agvd::Vec3& p) {
        const auto key = [](double x) { return std::llround(x * 1e9); };
        const auto [it, is_new] = indices_.try_emplace(
            {key(p.x()), key(p.y()), key(p.z())}, static_cast<agvd::Index>(mesh_.positions.size()));
        if (is_new) mesh_.positions.push_back(p);
        return it->second;
    }
    void add_triangle(const agvd::Triangle& t) {
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh_.triangles.push_back(t);
    }

    agvd::TriangleMesh mesh_;
    std::map<std::tuple<long long, long long, long long>, agvd::Index> indices_;
};

}  // namespace parts
