// Triangles without order, as two meshes of the same vertices are compared.
#pragma once

#include <algorithm>
#include <set>
#include <span>

#include "agvd/mesh/mesh.h"

// Each triangle from its least corner on, in order.
[[nodiscard]] inline std::set<agvd::Triangle> triangle_set(
    std::span<const agvd::Triangle> triangles) {
    std::set<agvd::Triangle> result;
    for (agvd::Triangle t : triangles) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        result.insert(t);
    }
    return result;
}
