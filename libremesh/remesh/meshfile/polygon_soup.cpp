#include "remesh/meshfile/polygon_soup.h"

#include <algorithm>
#include <utility>

#include "agvd/core/error.h"
#include "remesh/meshfile/triangulate.h"

namespace remesh {

namespace {
constexpr const char* export_again = "; correct the face, or export the file again";

// The places in a polygon of its triangles' corners. Where a vertex comes twice, its first place.
void append_corners(std::span<const Index> polygon, std::size_t begin,
                    std::span<const Triangle> triangles, std::vector<std::size_t>& corner) {
    if (polygon.size() == 3) {
        for (std::size_t k = 0; k < 3; ++k) corner.push_back(begin + k);
        return;
    }
    std::vector<std::pair<Index, std::size_t>> places;
    for (std::size_t k = 0; k < polygon.size(); ++k) places.emplace_back(polygon[k], begin + k);
    std::sort(places.begin(), places.end());
    for (const Triangle& t : triangles) {
        for (const Index v : t) {
            corner.push_back(
                std::lower_bound(places.begin(), places.end(), std::pair(v, std::size_t{0}))
                    ->second);
        }
    }
}

}  // namespace

void PolygonSoup::reserve(std::uint64_t vertices, std::uint64_t polygons) {
    // No vertex takes less than three bytes, no corner less than one.
    const std::uint64_t size = file_.bytes.size();
    positions.reserve(std::min(vertices, size / 3));
    corners_.reserve(std::min(polygons, size / 3) * 3);
    polygon_end_.reserve(std::min(polygons, size / 3));
}

void PolygonSoup::add_corner(std::int64_t vertex, std::size_t offset) {
    if (vertex < 0 || vertex >= no_index) {
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
        throw InvalidInput(
            file_.path.string() +
            (positions.empty()
                 ? ": the file has neither a vertex nor a face; check that its extension "
                   "names its format"
                 : ": the file has " + std::to_string(positions.size()) +
                       " vertices but no face; make a surface of the points first"));
    }
    if (positions.size() >= no_index || corners_.size() >= no_index) {
        throw InvalidInput(
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
    const bool has_texture = !texture.name.empty();
    std::vector<std::size_t> corner;  // Of the triangles: its number among all corners.
    std::size_t begin = 0;
    for (Index p = 0; p < polygon_end_.size(); begin = polygon_end_[p++]) {
        ticker.tick();
        const auto polygon = std::span(corners_).subspan(begin, polygon_end_[p] - begin);
        if (polygon.size() < 3) {
            ++result.dropped_polygons;
            continue;
        }
        if (polygon.size() > 3) ++result.polygons;
        const std::size_t num_before = result.mesh.triangles.size();
        append_triangles(polygon, result.mesh.positions, ticker, result.mesh.triangles);
        if (has_texture) {
            append_corners(polygon, begin, std::span(result.mesh.triangles).subspan(num_before),
                           corner);
        }
        result.face_polygon.resize(result.mesh.triangles.size(), p);
    }
    if (result.mesh.triangles.empty()) {
        throw InvalidInput(file_.path.string() +
                           ": no face of the file has three corners; export a surface, not lines");
    }
    if (has_texture) {
        result.attributes.texture = texture_of(result.mesh, corner);
        if (texture.is_broken) {
            result.attributes.declined.push_back(
                {texture.name, "some texture coordinates are missing, or no finite numbers"});
        }
    }
    return result;
}

// \param corner  of each triangle's corners: its number among those of the polygons.
TextureCoordinates PolygonSoup::texture_of(const TriangleMesh& mesh,
                                           std::span<const std::size_t> corner) {
    TextureCoordinates read{.type = texture.type};
    bool has_any = false;
    for (Index f = 0; f < mesh.triangles.size() && !texture.is_broken; ++f) {
        ticker.tick();
        read.corners.push_back(no_coordinates());
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t c = corner[3 * std::size_t{f} + k];
            Index value = no_index;
            if (texture.is_of_vertices) {
                value = mesh.triangles[f][k];
            } else if (c < texture.of_corner.size()) {
                value = texture.of_corner[c];
            }
            if (value == no_index) continue;
            if (value >= texture.values.size()) {
                texture.is_broken = true;
                break;
            }
            read.corners[f][k] = texture.values[value];
            has_any = has_any || read.corners[f][k].allFinite();
        }
    }
    if (!has_any || texture.is_broken) return {};
    read.seams = find_texture_seams(mesh.view(), read.corners, ticker);
    return read;
}

}  // namespace remesh
