//! \file
//! The triangles around each vertex of a mesh.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh::detail {

class VertexTriangles {
public:
    VertexTriangles(std::span<const Triangle> triangles, std::size_t num_vertices)
        : begin_(num_vertices + 1, 0), around_(3 * triangles.size()) {
        for (const Triangle& t : triangles) {
            for (const Index v : t) ++begin_[v + 1];
        }
        for (std::size_t v = 0; v < num_vertices; ++v) begin_[v + 1] += begin_[v];
        std::vector<Index> next(begin_.begin(), begin_.end() - 1);
        for (Index i = 0; i < triangles.size(); ++i) {
            for (const Index v : triangles[i]) around_[next[v]++] = i;
        }
    }

    //! Ascending.
    [[nodiscard]] std::span<const Index> of(Index vertex) const {
        return std::span(around_).subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
    }

private:
    std::vector<Index> begin_;   // #V + 1
    std::vector<Index> around_;  // Triangles.
};

}  // namespace remesh::detail
