// Faces are compared by their vertices in ascending order: equal ones follow each other once
// sorted. Programs disagree on which way round a cell is numbered: the sign of its volume tells.
#include "remesh/meshfile/polygon_soup.h"

#include <algorithm>
#include <utility>

#include "agvd/core/bucket_sort.h"

namespace remesh {
namespace {

constexpr const char* export_again = "; correct the face, or export the file again";

[[noreturn]] void fail_index(std::int64_t vertex, const char* kind, std::size_t number,
                             std::size_t offset, const SourceFile& file) {
    file.fail_unusable(offset, kind, " ", number, " names vertex ", vertex, ", which is ",
                       vertex < 0 ? "negative" : "too large", "; correct the ", kind,
                       ", or export the file again");
}

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

// Two quads with a corner that no other polygon has share two edges. Cut along the diagonal between
// the ends of these, both would get the same triangle, a flap.
// \return by polygon: the corner, among all corners, from which it is to be cut; or no_index.
std::vector<Index> find_doublets(std::span<const Index> corners, std::span<const std::size_t> ends,
                                 std::size_t num_vertices, Ticker& ticker) {
    struct Use {
        Index count = 0, corner = 0, polygon = 0;
    };
    std::vector<Use> uses(num_vertices);
    std::vector<Index> cut_at(ends.size(), no_index);
    const auto beside = [&](Index corner, Index polygon, Index steps) {
        const auto begin = static_cast<Index>(ends[polygon] - 4);
        return corners[begin + (corner - begin + steps) % 4];
    };
    for (const bool is_counted : {false, true}) {
        Index c = 0;
        for (Index p = 0; p < ends.size(); ++p) {
            ticker.tick();
            const bool is_quad = ends[p] - c == 4;
            for (; c < ends[p]; ++c) {
                Use& use = uses[corners[c]];
                if (!is_counted) {
                    use = {use.count + 1, c, is_quad ? p : no_index};
                } else if (use.count == 2 && is_quad && use.polygon != no_index &&
                           use.corner != c &&
                           beside(c, p, 1) == beside(use.corner, use.polygon, 3) &&
                           beside(c, p, 3) == beside(use.corner, use.polygon, 1)) {
                    cut_at[p] = c;
                    cut_at[use.polygon] = use.corner;
                }
            }
        }
    }
    return cut_at;
}

using FaceCorners = std::array<Index, 4>;  // Of a triangle the last one is no_index.

struct KindOfCell {
    std::size_t num_faces;
    std::array<std::array<int, 4>, 6> faces;  // Counter-clockwise from outside; -1: a triangle.
};

constexpr std::array kinds_of_cells = {
    KindOfCell{4, {{{0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}, {0, 2, 1, -1}}}},
    KindOfCell{
        6, {{{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}}},
    KindOfCell{5, {{{0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}}},
    KindOfCell{5, {{{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}}}};

struct CellFace {
    FaceCorners sorted;   // Its vertices; behind them no_index.
    std::uint64_t place;  // 8 cell + face.
};

// The vertices of a face in order, each once: corners of a cell may coincide.
FaceCorners face_corners(std::span<const Index> cell, const std::array<int, 4>& face) {
    FaceCorners result;
    result.fill(no_index);
    auto end = result.begin();
    for (const int k : face) {
        if (k < 0) break;
        const Index vertex = cell[static_cast<std::size_t>(k)];
        if (std::find(result.begin(), end, vertex) == end) *end++ = vertex;
    }
    return result;
}

std::size_t num_corners(const FaceCorners& corners) {
    return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), no_index) -
                                    corners.begin());
}

bool is_inside_out(std::span<const Index> cell, const KindOfCell& kind,
                   const std::vector<Vec3>& positions) {
    double volume = 0;
    const auto at = [&](Index v) { return Vec3(positions[v] - positions[cell[0]]); };
    for (std::size_t f = 0; f < kind.num_faces; ++f) {
        const FaceCorners corners = face_corners(cell, kind.faces[f]);
        for (std::size_t k = 2; k < num_corners(corners); ++k) {
            volume += at(corners[0]).cross(at(corners[k - 1])).dot(at(corners[k]));
        }
    }
    return volume < 0;
}

// Where each face of the surface is, in the order of the cells.
std::vector<std::uint64_t> faces_of_one_cell(const std::vector<CellFace>& faces,
                                             std::size_t num_points, const Ticker& ticker) {
    if (faces.size() >= no_index) {
        throw InvalidInput("the cells have more than 2^32 - 2 faces; extract their surface");
    }
    const std::vector<CellFace> sorted = sort_in_buckets(
        faces, static_cast<Index>(num_points), [](const CellFace& face) { return face.sorted[0]; },
        [](const CellFace& a, const CellFace& b) { return a.sorted < b.sorted; }, ticker);
    std::vector<std::uint64_t> single;
    for (std::size_t i = 0, end = 0; i < sorted.size(); i = end) {
        for (end = i + 1; end < sorted.size() && sorted[end].sorted == sorted[i].sorted;) ++end;
        if (end == i + 1) single.push_back(sorted[i].place);
    }
    std::sort(single.begin(), single.end());
    return single;
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
        fail_index(vertex, "face", num_polygons(), offset, file_);
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
        file_.fail_unusable(highest_offset_, "face ", highest_polygon_, " names vertex ",
                            std::int64_t{highest_} + first_index_, ", but the file has only ",
                            positions.size(), " vertices, counted from ", first_index_,
                            export_again);
    }

    MeshFile result;
    result.mesh.positions = std::move(positions);
    result.mesh.triangles.reserve(polygon_end_.size());
    result.face_polygon.reserve(polygon_end_.size());
    const bool has_texture = !texture.name.empty();
    std::vector<std::size_t> corner;  // Of the triangles: its number among all corners.
    const bool has_triangles_only = corners_.size() == 3 * polygon_end_.size();
    const std::vector<Index> cut_at =
        has_triangles_only
            ? std::vector<Index>()
            : find_doublets(corners_, polygon_end_, result.mesh.positions.size(), ticker);
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
        if (!cut_at.empty() && cut_at[p] != no_index) {
            const auto at = [&](Index k) { return polygon[(cut_at[p] - begin + k) % 4]; };
            result.mesh.triangles.push_back({at(0), at(1), at(2)});
            result.mesh.triangles.push_back({at(0), at(2), at(3)});
        } else {
            append_triangles(polygon, result.mesh.positions, ticker, result.mesh.triangles);
        }
        if (has_texture) {
            append_corners(polygon, begin, std::span(result.mesh.triangles).subspan(num_before),
                           corner);
        }
        result.face_polygon.resize(result.mesh.triangles.size(), p);
    }
    if (result.mesh.triangles.empty()) {
        throw InvalidInput(
            joined(file_.path.string(),
                   ": no face of the file has three corners; export a surface, not lines"));
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

void VolumeSurface::add_corner(std::int64_t vertex, std::size_t offset) {
    if (vertex < 0 || vertex >= no_index) {
        fail_index(vertex, "cell", num_cells(), offset, file_);
    }
    corners_.push_back(static_cast<Index>(vertex));
    if (corners_.back() < highest_) return;
    highest_ = corners_.back();
    highest_offset_ = offset;
}

std::vector<std::size_t> VolumeSurface::add_to(PolygonSoup& soup) const {
    if (kinds_.empty() || soup.num_polygons() > 0) return {};
    if (highest_ >= soup.positions.size()) {
        file_.fail_unusable(highest_offset_, "a cell names a vertex behind the last of the ",
                            soup.positions.size(), "; correct the cell, or export the file again");
    }
    std::vector<std::size_t> begins;  // By cell, of its corners.
    std::vector<CellFace> faces;
    std::size_t begin = 0;
    for (std::size_t c = 0; c < kinds_.size(); ++c) {
        soup.ticker.tick(8);
        begins.push_back(begin);
        const KindOfCell& kind = kinds_of_cells[static_cast<std::size_t>(kinds_[c])];
        for (std::size_t f = 0; f < kind.num_faces; ++f) {
            FaceCorners corners = face_corners(std::span(corners_).subspan(begin), kind.faces[f]);
            if (num_corners(corners) < 3) continue;
            std::sort(corners.begin(), corners.end());
            faces.push_back({corners, 8 * c + f});
        }
        begin += num_corners(kinds_[c]);
    }
    std::vector<std::size_t> cell_of_face;
    for (const std::uint64_t place : faces_of_one_cell(faces, soup.positions.size(), soup.ticker)) {
        const std::size_t c = place / 8;
        const KindOfCell& kind = kinds_of_cells[static_cast<std::size_t>(kinds_[c])];
        const auto cell = std::span(corners_).subspan(begins[c]);
        const FaceCorners corners = face_corners(cell, kind.faces[place % 8]);
        const std::size_t count = num_corners(corners);
        const bool is_turned = is_inside_out(cell, kind, soup.positions);
        for (std::size_t k = 0; k < count; ++k) {
            soup.add_corner(corners[is_turned ? count - 1 - k : k], highest_offset_);
        }
        soup.end_polygon();
        cell_of_face.push_back(c);
    }
    return cell_of_face;
}

std::string VolumeSurface::warning(std::size_t num_added) const {
    if (kinds_.empty()) return {};
    const std::string cells =
        file_.path.string() + ": " + detail::counted(num_cells(), "volume cell");
    return num_added == 0 ? cells + ": skipped, as the file has faces of its own"
                          : cells + ": their surface is read, the " + std::to_string(num_added) +
                                " faces that belong to one of them only";
}

}  // namespace remesh
