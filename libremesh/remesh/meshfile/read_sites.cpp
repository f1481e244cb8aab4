
#include "remesh/meshfile/diagram_file.h"

#include <algorithm>
#include <cmath>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/meshfile/text_scanner.h"

namespace remesh {
namespace {

constexpr double sum_tolerance = 1e-6;  // Seven decimals in a text file are enough.
constexpr double told_distance = 0.01;  // Of a point from the mesh, in spacings.

// The vertices that a point lies between, ascending, with their shares; the same for each face at
// its edge or vertex.
using Place = std::array<std::pair<Index, double>, 3>;

Place place_of(const MeshView& mesh, const SurfacePoint& point) {
    Place place;
    for (std::size_t k = 0; k < 3; ++k) {
        const double share = point.barycentric[k];
        place[k] = {share == 0 ? no_index : mesh.triangles[point.face.value()][k], share};
    }
    std::sort(place.begin(), place.end());
    return place;
}

// #V: the lowest corner, 3 f + k, at each vertex; no_index: it is in no face.
std::vector<Index> lowest_corners(const MeshView& mesh) {
    std::vector<Index> corners(mesh.positions.size(), no_index);
    for (auto corner = static_cast<Index>(3 * mesh.triangles.size()); corner-- > 0;) {
        corners[mesh.triangles[corner / 3][corner % 3]] = corner;
    }
    return corners;
}

// The lowest corner at a vertex.
Index require_corner(const SourceFile& file, std::size_t start,
                     const std::vector<Index>& lowest_corner, Index vertex) {
    if (lowest_corner[vertex] != no_index) return lowest_corner[vertex];
    file.fail_unusable(start, "vertex ", vertex, " is in no face; use a vertex of a face");
}

// Calls `read` at each line that holds something; it reads all of the line.
// \throw IoError  there is none: `empty` says so.
template <typename Read>
void read_lines(const SourceFile& file, const char* empty, const Read& read) {
    TextScanner scan(file, 0, {.comment = '#'});
    Ticker ticker = file.ticker;
    bool is_empty = true;
    for (; scan.find_word(); is_empty = false) {
        ticker.tick(16);
        read(scan);
        if (scan.has_word()) scan.fail_expecting("the end of the line");
    }
    if (is_empty) scan.fail_malformed(empty);
}

class SiteReader {
public:
    SiteReader(const SourceFile& file, const MeshView& mesh, std::span<const Index> face_polygon,
               const Progress& progress)
        : file_(file), mesh_(mesh), polygon_(face_polygon), progress_(progress) {}

    SitesFile read(Repeats repeats) {
        SitesFile result;
        read_lines(
            file_,
            "the file holds no site; write lines \"v INDEX\", \"f FACE B0 B1 B2\", \"p X Y Z\", "
            "\"l "
            "INDEX INDEX ...\" or \"r FACE ...\"",
            [&](TextScanner& scan) {
                start_ = scan.offset();
                const std::string_view kind = scan.word();
                if (kind == "l" || kind == "r") {
                    result.shapes.push_back(kind == "l" ? read_line(scan) : read_region(scan));
                    const Role role = read_role(scan);
                    result.shapes.back().site = role.site;
                    result.shapes.back().start = role.start;
                    return;
                }
                starts_.push_back(start_);
                result.sites.push_back(read_site(kind, scan));
                const Role role = read_role(scan);
                result.points.site.push_back(role.site);
                result.points.start.push_back(role.start);
            });
        finish_roles(result);
        judge_distances(result);
        if (repeats == Repeats::Told) judge_repeats(result);
        return result;
    }

private:
    // A point of the file beside the mesh.
    struct Shift {
        double distance = 0;
        std::size_t start = 0;  // Of its line.
    };

    void judge_distances(SitesFile& result) const {
        if (shifts_.empty()) return;
        double area = 0;
        for (const Triangle& t : mesh_.triangles) {
            area += doubled_normal(mesh_.positions, t).norm() / 2;
        }
        const double spacing = std::sqrt(area / static_cast<double>(result.sites.size()));
        const auto is_nearer = [](const Shift& a, const Shift& b) {
            return a.distance < b.distance;
        };
        const Shift& farthest = *std::max_element(shifts_.begin(), shifts_.end(), is_nearer);
        const std::string text =
            "the point is " + detail::significant(farthest.distance) + " off the mesh";
        if (farthest.distance > spacing) {
            file_.fail_unusable(farthest.start, text, ", more than the sites' spacing, ",
                                detail::significant(spacing),
                                "; correct it, or give all points in the units of the mesh");
        }
        const auto is_told = [&](const Shift& s) { return s.distance > told_distance * spacing; };
        const auto count =
            static_cast<std::size_t>(std::count_if(shifts_.begin(), shifts_.end(), is_told));
        if (count == 0) return;
        result.warnings.push_back(file_.place(farthest.start) + text + ", the farthest of " +
                                  detail::counted(count, "such point") +
                                  "; the nearest point of the mesh is taken");
    }

    void judge_repeats(SitesFile& result) const {
        std::vector<std::pair<Place, std::size_t>> places;
        places.reserve(starts_.size());
        for (const SurfacePoint& site : result.sites) {
            places.emplace_back(place_of(mesh_, site), places.size());
        }
        std::sort(places.begin(), places.end());
        std::size_t count = 0, first = starts_.size();
        for (std::size_t i = 1; i < places.size(); ++i) {
            if (places[i].first != places[i - 1].first) continue;
            ++count;
            first = std::min(first, places[i].second);
        }
        if (count == 0) return;
        result.warnings.push_back(file_.place(starts_[first]) +
                                  "the site lies exactly where an earlier one does, the first of " +
                                  detail::counted(count, "such site") + "; give each place once");
    }

    // Numbers up to the next word.
    std::vector<Index> read_indices(TextScanner& scan, const char* what, const char* plural,
                                    std::size_t count) {
        std::vector<Index> indices;
        while (scan.has_word()) {
            const std::size_t at = scan.offset();
            const bool is_number = as_whole<std::int64_t>(scan.word()).has_value();
            scan.go_to(at);
            if (!is_number) break;
            indices.push_back(index(scan, what, plural, count));
        }
        return indices;
    }

    GivenShape read_line(TextScanner& scan) {
        const std::vector<Index> vertices =
            read_indices(scan, "vertex", "vertices", mesh_.positions.size());
        if (vertices.size() < 2) {
            file_.fail_malformed(start_,
                                 "a line has two vertices or more; correct it, or write "
                                 "\"v INDEX\" for one");
        }
        GivenShape line;
        for (std::size_t i = 1; i < vertices.size(); ++i) {
            line.edges.push_back({vertices[i - 1], vertices[i]});
        }
        return line;
    }

    GivenShape read_region(TextScanner& scan) {
        GivenShape region;
        for (const Index face : read_indices(scan, "face", "faces", num_faces())) {
            const auto [begin, end] = triangles_of(face);
            for (Index t = begin; t < end; ++t) region.faces.push_back(t);
        }
        if (region.faces.empty()) {
            file_.fail_malformed(start_, "a region has one face or more; add its faces");
        }
        return region;
    }

    SurfacePoint read_site(std::string_view kind, TextScanner& scan) {
        if (kind == "v") return vertex_site(scan);
        if (kind == "f") return face_site(scan);
        if (kind == "p") {
            const Vec3 point = scan.point();
            if (!tree_) tree_.emplace(mesh_, progress_);
            const ClosestPoint nearest = tree_->query(point);
            shifts_.push_back({std::sqrt(nearest.distance_sq), start_});
            return nearest.point;
        }
        file_.fail_malformed(start_, "a site begins with v, f, p, l or r, not with ",
                             in_quotes(kind), "; correct the line or begin it with #");
    }

    struct Role {
        Index site;
        double start;
    };

    // The site that a line of the file belongs to, and its start.
    Role read_role(TextScanner& scan) {
        std::optional<Index> site;
        double start = 0;
        while (scan.has_word()) {
            const std::size_t at = scan.offset();
            const std::string_view key = scan.word();
            if (key == "site" && !site) {
                const std::int64_t value = scan.integer("the number of a site");
                if (value < 0 || value >= no_index) {
                    file_.fail_malformed(at, "there is no site ", value,
                                         "; number the sites from 0");
                }
                site = static_cast<Index>(value);
            } else if (key == "start") {
                start = scan.number("a distance");
                if (!(start >= 0 && std::isfinite(start))) {
                    file_.fail_unusable(at,
                                        "the site starts at a distance that is not finite or "
                                        "below 0; adding one number to all changes no cell");
                }
            } else {
                scan.go_to(at);  // No end of the line, as will be told.
                break;
            }
        }
        if (num_roles_ > 0 && has_numbers_ != site.has_value()) {
            file_.fail_malformed(start_,
                                 "only some lines say which site their point belongs to; add "
                                 "`site N` to all, or to none");
        }
        has_numbers_ = site.has_value();
        const Index number = num_roles_++;
        return {site.value_or(number), start};
    }

    // Each site must have a point. What all lines leave out stays empty.
    void finish_roles(SitesFile& result) const {
        SitePoints& points = result.points;
        if (!has_numbers_ && result.shapes.empty()) points.site.clear();
        if (std::all_of(points.start.begin(), points.start.end(),
                        [](double start) { return start == 0; })) {
            points.start.clear();
        }
        if (!has_numbers_) return;
        std::vector<Index> sites = points.site;
        for (const GivenShape& shape : result.shapes) sites.push_back(shape.site);
        std::sort(sites.begin(), sites.end());
        Index next = 0;
        for (const Index site : sites) {
            if (site > next) {
                file_.fail_unusable(0, "no point belongs to site ", next, ", but one to site ",
                                    site, "; number the sites from 0 without gaps");
            }
            next = site + 1;
        }
    }

    Index index(TextScanner& scan, const char* what, const char* plural, std::size_t count) {
        const std::int64_t value = scan.integer(("a " + std::string(what) + " index").c_str());
        if (value < 0 || static_cast<std::uint64_t>(value) >= count) {
            file_.fail_unusable(start_, "the site names ", what, " ", value,
                                ", but the mesh has only ", count, " ", plural,
                                ", counted from 0; correct the line");
        }
        return static_cast<Index>(value);
    }

    SurfacePoint vertex_site(TextScanner& scan) {
        const Index vertex = index(scan, "vertex", "vertices", mesh_.positions.size());
        if (lowest_corner_.empty()) lowest_corner_ = lowest_corners(mesh_);
        return point_on(require_corner(file_, start_, lowest_corner_, vertex), 0);
    }

    [[nodiscard]] std::size_t num_faces() const {
        return polygon_.empty() ? mesh_.triangles.size() : polygon_.back() + std::size_t{1};
    }
    // Of a face of the file, one behind the other.
    [[nodiscard]] std::pair<Index, Index> triangles_of(Index face) const {
        if (polygon_.empty()) return {face, face + 1};
        const auto [first, last] = std::equal_range(polygon_.begin(), polygon_.end(), face);
        return {static_cast<Index>(first - polygon_.begin()),
                static_cast<Index>(last - polygon_.begin())};
    }

    // Finds the triangle of a polygon with these vertices, and puts the coordinates in its order.
    void choose_triangle(TextScanner& scan, std::pair<Index, Index> triangles, SurfacePoint& site) {
        const auto given = read_indices(scan, "vertex", "vertices", mesh_.positions.size());
        const std::array<double, 3> b = site.barycentric;
        for (Index t = triangles.first; given.size() == 3 && t < triangles.second; ++t) {
            const Triangle& corners = mesh_.triangles[t];
            if (!std::is_permutation(corners.begin(), corners.end(), given.begin())) continue;
            site.face = FaceId(t);
            for (std::size_t k = 0; k < 3; ++k) {
                const auto at = std::find(corners.begin(), corners.end(), given[k]);
                site.barycentric[static_cast<std::size_t>(at - corners.begin())] = b[k];
            }
            return;
        }
        file_.fail_unusable(start_,
                            "the face has more than three corners; add the three vertices to which "
                            "the coordinates belong, as --map writes them, or write \"p X Y Z\"");
    }

    SurfacePoint face_site(TextScanner& scan) {
        const auto triangles = triangles_of(index(scan, "face", "faces", num_faces()));
        SurfacePoint site{FaceId(triangles.first), {}};
        auto& b = site.barycentric;
        for (double& x : b) x = scan.number("a barycentric coordinate");
        const double sum = b[0] + b[1] + b[2];
        const bool is_inside = b[0] >= 0 && b[1] >= 0 && b[2] >= 0;
        if (!is_inside || !(std::abs(sum - 1) <= sum_tolerance)) {
            file_.fail_unusable(start_,
                                "the barycentric coordinates are negative or do not sum to 1 "
                                "within 1e-6; correct them, or write the point as \"p X Y Z\"");
        }
        for (double& x : b) x /= sum;
        if (triangles.second - triangles.first != 1) choose_triangle(scan, triangles, site);
        return site;
    }

    const SourceFile& file_;
    const MeshView& mesh_;
    std::span<const Index> polygon_;  // Of each triangle; empty: its own number.
    const Progress& progress_;
    std::size_t start_ = 0;                 // Of the current line's first word.
    Index num_roles_ = 0;                   // Lines with a site so far.
    bool has_numbers_ = false;              // They say which.
    std::vector<std::size_t> starts_;       // Of all sites' lines.
    std::vector<Shift> shifts_;             // Of all `p`.
    std::vector<Index> lowest_corner_;      // #V, made for the first `v`.
    std::optional<ClosestPointTree> tree_;  // Made for the first `p`.
};

// An edge of a mesh or of a file, the lower vertex first.
struct LengthOfEdge {
    Index low, high;
    double length;
    std::size_t start;  // Of its line.
};

LengthOfEdge read_length(const SourceFile& file, TextScanner& scan) {
    LengthOfEdge edge{0, 0, 0, scan.offset()};
    for (Index* const vertex : {&edge.low, &edge.high}) {
        const std::int64_t value = scan.integer("a vertex index");
        if (value < 0 || value >= no_index) {
            file.fail_malformed(edge.start, "the vertex index ", value,
                                " is out of range; count vertices from 0");
        }
        *vertex = static_cast<Index>(value);
    }
    if (edge.low > edge.high) std::swap(edge.low, edge.high);
    edge.length = scan.number("a length");
    if (!(edge.length > 0 && std::isfinite(edge.length))) {
        file.fail_unusable(edge.start,
                           "the length of an edge is not finite or not above 0; correct the line");
    }
    return edge;
}

}  // namespace

std::vector<double> read_edge_lengths(const std::filesystem::path& path, const MeshView& mesh,
                                      const Progress& progress) {
    Poller poller(progress);
    const SourceFile file = load_file(path, poller);
    std::vector<LengthOfEdge> edges;
    read_lines(file, "the file holds no edge; write lines of two vertex indices and a length",
               [&](TextScanner& scan) { edges.push_back(read_length(file, scan)); });
    const auto ends = [](const LengthOfEdge& e) { return std::pair(e.low, e.high); };
    const auto is_before = [&](const LengthOfEdge& a, const LengthOfEdge& b) {
        return ends(a) < ends(b);
    };
    std::stable_sort(edges.begin(), edges.end(), is_before);
    for (std::size_t i = 1; i < edges.size(); ++i) {
        if (ends(edges[i]) != ends(edges[i - 1]) || edges[i].length == edges[i - 1].length)
            continue;
        file.fail_unusable(edges[i].start, "the edge has another length on an earlier line; ",
                           "give it one");
    }
    std::vector<bool> is_used(edges.size(), false);
    std::vector<double> lengths;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] =
                std::minmax({mesh.triangles[f][k], mesh.triangles[f][(k + 1) % 3]});
            const auto [first, end] = std::equal_range(edges.begin(), edges.end(),
                                                       LengthOfEdge{low, high, 0, 0}, is_before);
            if (first == end) {
                throw InvalidInput(path.string() + ": the edge from vertex " + std::to_string(low) +
                                   " to " + std::to_string(high) +
                                   " of the mesh has no length; add a line");
            }
            lengths.push_back(first->length);
            std::fill(is_used.begin() + (first - edges.begin()),
                      is_used.begin() + (end - edges.begin()), true);
        }
    }
    const auto unused = std::find(is_used.begin(), is_used.end(), false);
    if (unused != is_used.end()) {
        const LengthOfEdge& edge = edges[static_cast<std::size_t>(unused - is_used.begin())];
        file.fail_unusable(edge.start, "the mesh has no edge from vertex ", edge.low, " to ",
                           edge.high, "; correct the line");
    }
    return lengths;
}

SitesFile read_sites(const std::filesystem::path& path, const MeshView& mesh,
                     const Progress& progress, Repeats repeats,
                     std::span<const Index> face_polygon) {
    Poller poller(progress);
    const SourceFile file = load_file(path, poller);
    return SiteReader(file, mesh, face_polygon, progress).read(repeats);
}

std::vector<Index> read_vertices(const std::filesystem::path& path, const MeshView& mesh,
                                 const Progress& progress) {
    Poller poller(progress);
    const SourceFile file = load_file(path, poller);
    const std::vector<Index> lowest_corner = lowest_corners(mesh);
    std::vector<Index> vertices;
    read_lines(file, "the file holds no vertex; write lines of one vertex index",
               [&](TextScanner& scan) {
                   const std::size_t start = scan.offset();
                   const std::int64_t value = scan.integer("a vertex index");
                   if (value < 0 || static_cast<std::uint64_t>(value) >= lowest_corner.size()) {
                       file.fail_unusable(start, "there is no vertex ", value, ": the mesh has ",
                                          lowest_corner.size(),
                                          " vertices, counted from 0; correct the line");
                   }
                   vertices.push_back(static_cast<Index>(value));
                   require_corner(file, start, lowest_corner, vertices.back());
               });
    return vertices;
}

std::vector<std::array<Index, 2>> read_edges(const std::filesystem::path& path,
                                             const Progress& progress) {
    Poller poller(progress);
    const SourceFile file = load_file(path, poller);
    std::vector<std::array<Index, 2>> edges;
    read_lines(file, "the file holds no edge; write lines of two vertex indices",
               [&](TextScanner& scan) {
                   std::array<Index, 2> edge{};
                   for (Index& vertex : edge) {
                       const std::size_t start = scan.offset();
                       const std::int64_t value = scan.integer("a vertex index");
                       if (value < 0 || value >= no_index) {
                           file.fail_malformed(start, "the vertex index ", value,
                                               " is out of range; count vertices from 0");
                       }
                       vertex = static_cast<Index>(value);
                   }
                   edges.push_back(edge);
               });
    return edges;
}

}  // namespace remesh
