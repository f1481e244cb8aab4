#include "remesh/io/polygon_soup.h"

#include <algorithm>
#include <utility>

#include "agvd/core/error.h"
#include "remesh/io/triangulate.h"

namespace remesh {

using agvd::Index;

namespace {
constexpr const char* export_again = "; correct the face, or export the file again";
}

void PolygonSoup::reserve(std::uint64_t vertices, std::uint64_t polygons) {
    // No vertex takes less than three bytes, no corner less than one.
    const std::uint64_t size = file_.bytes.size();
    positions.reserve(std::min(vertices, size / 3));
    corners_.reserve(std::min(polygons, size / 3) * 3);
    polygon_end_.reserve(std::min(polygons, size / 3));
}

void PolygonSoup::add_corner(std::int64_t vertex, std::size_t offset) {
    if (vertex < 0 || vertex >= agvd::no_index) {
        file_.fail_unusable(offset, "face " + std::to_string(num_polygons()) + " names vertex " +
                                        std::to_string(vertex) + ", which is " +
                                        (vertex < 0 ? "negative" : "too large") + export_again);
    }
    const auto index = static_cast<Index>(vertex);
    if (index > highest_) {
        highest_ = index;
        highest_offset_ = offset;
        highest_polygon_ = num_polygons();
    }
    corners_.push_back(index);
}

MeshFile PolygonSoup::finish() && {
    if (polygon_end_.empty()) {
        throw agvd::InvalidInput(
            file_.path.string() +
            (positions.empty()
                 ? ": the file has neither a vertex nor a face; check that its extension "
                   "names its format"
                 : ": the file has " + std::to_string(positions.size()) +
                       " vertices but no face; make a surface of the points first"));
    }
    if (positions.size() >= agvd::no_index || corners_.size() >= agvd::no_index) {
        throw agvd::InvalidInput(
            file_.path.string() +
            ": the mesh has more than 2^32 - 2 vertices or corners; split it into parts");
    }
    if (highest_ >= positions.size()) {
        file_.fail_unusable(highest_offset_,
                            "face " + std::to_string(highest_polygon_) + " names vertex " +
                                std::to_string(std::int64_t{highest_} + first_index_) +
                                ", but the file has only " + std::to_string(positions.size()) +
                                " vertices, counted from " + std::to_string(first_index_) +
                                export_again);
    }

    MeshFile result;
    result.mesh.positions = std::move(positions);
    result.mesh.triangles.reserve(polygon_end_.size());
    result.face_polygon.reserve(polygon_end_.size());
    std::size_t begin = 0;
    for (Index p = 0; p < polygon_end_.size(); begin = polygon_end_[p++]) {
        ticker.tick();
        const auto polygon = std::span(corners_).subspan(begin, polygon_end_[p] - begin);
        if (polygon.size() < 3) {
            ++result.dropped_polygons;
            continue;
        }
        if (polygon.size() > 3) ++result.polygons;
        append_triangles(polygon, result.mesh.positions, ticker, result.mesh.triangles);
        result.face_polygon.resize(result.mesh.triangles.size(), p);
    }
    if (result.mesh.triangles.empty()) {
        throw agvd::InvalidInput(
            file_.path.string() +
            ": no face of the file has three corners; export a surface, not lines");
    }
    return result;
}

}  // namespace remesh
