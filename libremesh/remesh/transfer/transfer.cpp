// Texture coordinates: each face looks for its corners from a point of its side, in steps, on the
// input cut at its seams.
#include "remesh/transfer/transfer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <compare>
#include <optional>
#include <string>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/core/groups.h"
#include "agvd/core/parallel.h"
#include "remesh/transfer/nearest_on_sheet.h"

namespace remesh {
namespace {

using detail::NearestOnSheet;
using detail::SearchEnd;

constexpr Index vertex_grain = 256, face_grain = 64;

// Barycentric coordinates of the centres of the parts that a triangle falls into when its sides are
// cut in four, row by row, to and fro: each is next to the one before.
std::array<std::array<double, 3>, 16> part_centers() {
    constexpr int n = 4;
    std::array<std::array<double, 3>, 16> centers{};
    std::size_t count = 0;
    for (int row = 0; row < n; ++row) {
        const int parts = 2 * (n - row) - 1;
        for (int i = 0; i < parts; ++i) {
            const int part = row % 2 == 0 ? i : parts - 1 - i;
            const double third = part % 2 == 0 ? 1.0 / 3 : 2.0 / 3;  // Upright, upside down.
            const int column = part / 2;
            const double v = (row + third) / n, u = (column + third) / n;
            centers[count++] = {1 - u - v, u, v};
        }
    }
    return centers;
}

using Centers = std::array<std::array<double, 3>, 16>;

// Where searches from the vertices of a result end. Those on junctions belong to several sheets,
// and tell nothing of the sheet of a face.
class ResultSheets {
public:
    ResultSheets(const MeshView& result, std::vector<SearchEnd> ends)
        : triangles_(result.triangles), ends_(std::move(ends)) {
        if (std::ranges::find(ends_, SearchEnd::Ball) == ends_.end()) return;
        faces_.emplace(triangles_by_vertex(triangles_, ends_.size()));
    }

    [[nodiscard]] SearchEnd end_at(Index vertex) const { return ends_[vertex]; }

    // Vertices of the sheet of a face: its corners that are on no junction; else one of the faces
    // beside it; else all its corners.
    [[nodiscard]] std::vector<Index> vertices_of(Index face) const {
        const Triangle& corners = triangles_[face];
        std::vector<Index> found;
        const auto is_own = [&](Index v) { return ends_[v] == SearchEnd::Junction; };
        for (const Index v : corners) {
            if (is_own(v)) found.push_back(v);
        }
        std::vector<Index> reached{face};
        for (std::size_t i = 0; found.empty() && i < reached.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Index next = across(reached[i], k);
                if (next == no_index || reached.size() == most_reached) continue;
                if (std::ranges::find(reached, next) == reached.end()) reached.push_back(next);
            }
            const Triangle& t = triangles_[reached[i]];
            const auto own = std::ranges::find_if(t, is_own);
            if (own != t.end()) found = {*own};
        }
        return found.empty() ? std::vector<Index>(corners.begin(), corners.end()) : found;
    }

private:
    static constexpr std::size_t most_reached = 64;

    // The other face at an edge of two.
    [[nodiscard]] Index across(Index face, std::size_t k) const {
        const Index a = triangles_[face][k], b = triangles_[face][(k + 1) % 3];
        Index other = no_index;
        for (const Index f : faces_->of(a)) {
            if (f == face || std::ranges::find(triangles_[f], b) == triangles_[f].end()) continue;
            if (other != no_index) return no_index;
            other = f;
        }
        return other;
    }

    std::span<const Triangle> triangles_;
    std::vector<SearchEnd> ends_;  // By vertex.
    std::optional<Groups> faces_;  // At each vertex; none: no vertex is on a junction.
};

// Starts each search at the nearest vertex of the face's sheet or the point of the sample before.
FaceSamples sample_face(const MeshView& result, Index face, std::span<const SurfacePoint> points,
                        const ResultSheets& sheets, const Centers& centers,
                        const NearestOnSheet& nearest) {
    const std::vector<Index> known = sheets.vertices_of(face);
    std::vector<ClosestPoint> starts(1);  // That of the sample before, then of the vertices.
    for (const Index v : known) starts.push_back({points[v], position(nearest.mesh(), points[v])});
    starts[0] = starts[1];
    FaceSamples faces{};
    for (std::size_t i = 0; i < faces.size(); ++i) {
        Vec3 point = Vec3::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            point += centers[i][k] * result.positions[result.triangles[face][k]];
        }
        const auto first = std::ranges::min_element(starts, {}, [&](const ClosestPoint& start) {
            return (start.position - point).squaredNorm();
        });
        starts[0] = nearest.query(point, first->point, sheets.end_at(known[0]));
        faces[i] = starts[0].point.face.value();
    }
    return faces;
}

// The value at a point of a face. Sums of the same value stay that value, bit for bit; a corner of
// weight 0 does not count.
// \param value_at  value_at(k): at corner k of the face.
template <typename ValueAt>
auto interpolated(const SurfacePoint& point, const ValueAt& value_at) {
    const auto& b = point.barycentric;
    const auto k = static_cast<std::size_t>(std::max_element(b.begin(), b.end()) - b.begin());
    const auto largest = value_at(k);
    auto value = largest;
    for (const std::size_t i : {(k + 1) % 3, (k + 2) % 3}) {
        if (b[i] != 0 && value_at(i) != largest) value += b[i] * (value_at(i) - largest);
    }
    return value;
}

Index nearest_corner(const MeshView& input, const SurfacePoint& point) {
    const Vec3 at = position(input, point);
    const Triangle& t = input.triangles[point.face.value()];
    const auto key = [&](Index v) { return std::pair((input.positions[v] - at).squaredNorm(), v); };
    return *std::min_element(t.begin(), t.end(), [&](Index a, Index b) { return key(a) < key(b); });
}

double mean(std::span<const double> values, const FaceSamples& faces) {
    double sum = 0;  // Of differences from the first value: equal values stay bit for bit.
    const double first = values[faces[0]];
    for (const Index f : faces) sum += values[f] == first ? 0 : values[f] - first;
    return first + sum / static_cast<double>(faces.size());
}

double most_frequent(std::span<const double> values, const FaceSamples& faces) {
    std::array<double, std::tuple_size_v<FaceSamples>> found;
    std::transform(faces.begin(), faces.end(), found.begin(), [&](Index f) { return values[f]; });
    const auto less = [](double a, double b) { return std::weak_order(a, b) < 0; };  // NaN too.
    std::sort(found.begin(), found.end(), less);
    double best = found[0];
    std::ptrdiff_t most = 0;
    for (auto begin = found.begin(); begin != found.end();) {
        const auto end = std::upper_bound(begin, found.end(), *begin, less);
        if (end - begin > most) {
            most = end - begin;
            best = *begin;
        }
        begin = end;
    }
    return best;
}

constexpr Index corner_grain = 64;
constexpr int steps_to_corner = 4;  // From a face's centroid to a corner.
// As a share of an edge of the result: points of a vertex are compared within a ball that is never
// smaller than this.
constexpr double least_radius = 1e-6;
// In distances of a vertex from its point: the radius of that ball.
constexpr double radius_factor = 2;

using FacePoints = std::array<ClosestPoint, 3>;

class CornerFinder {
public:
    CornerFinder(const MeshView& result, std::span<const SurfacePoint> points,
                 const NearestOnSheet& sheet, const NearestOnSheet& cut)
        : result_(result), points_(points), sheet_(sheet), cut_(cut) {}

    // The points of a face's corners on its side of the seams.
    FacePoints find(Index face) const {
        const Triangle& t = result_.triangles[face];
        FacePoints best = find_from(home(t), t);
        if (are_nearest(best, t)) return best;
        for (const Index v : t) {
            const FacePoints found = find_from(at(points_[v], result_.positions[v]), t);
            if (offset(found) < offset(best)) best = found;
        }
        return best;
    }

    // Whether the points of two faces at their common vertex are on the same side of the seams.
    bool is_same(Index face, Index vertex, const ClosestPoint& a, const ClosestPoint& b) const {
        if (a.point.face == b.point.face) return true;
        const Triangle& t = result_.triangles[face];
        const double size = (result_.positions[t[1]] - result_.positions[t[0]]).norm();
        const double radius = std::max(
            radius_factor * std::sqrt(std::max(a.distance_sq, b.distance_sq)), least_radius * size);
        return cut_.are_connected(result_.positions[vertex], radius, a.point.face.value(),
                                  b.point.face.value());
    }

    [[nodiscard]] ClosestPoint at(const SurfacePoint& on_input, const Vec3& point) const {
        const Vec3 found = position(sheet_.mesh(), on_input);
        return {on_input, found, (found - point).squaredNorm()};
    }

private:
    // Where the centroid lies.
    ClosestPoint home(const Triangle& t) const {
        const Vec3 center =
            (result_.positions[t[0]] + result_.positions[t[1]] + result_.positions[t[2]]) / 3;
        const Index nearest = *std::ranges::min_element(
            t, {}, [&](Index v) { return at(points_[v], center).distance_sq; });
        return sheet_.query(center, points_[nearest]);
    }

    FacePoints find_from(const ClosestPoint& start, const Triangle& t) const {
        FacePoints found;
        for (std::size_t k = 0; k < 3; ++k) {
            found[k] = start;
            for (int step = 1; step <= steps_to_corner; ++step) {
                const Vec3& target = result_.positions[t[k]];
                const Vec3 point =
                    step == steps_to_corner
                        ? target
                        : Vec3(start.position + (target - start.position) * step / steps_to_corner);
                found[k] = cut_.query(point, found[k].point);
            }
        }
        return found;
    }

    // Whether no corner is nearer to another side.
    [[nodiscard]] bool are_nearest(const FacePoints& found, const Triangle& t) const {
        const double tolerance =
            least_radius * (result_.positions[t[1]] - result_.positions[t[0]]).norm();
        for (std::size_t k = 0; k < 3; ++k) {
            const double least = at(points_[t[k]], result_.positions[t[k]]).distance_sq;
            if (std::sqrt(found[k].distance_sq) > std::sqrt(least) + tolerance) return false;
        }
        return true;
    }
    static double offset(const FacePoints& found) {
        return found[0].distance_sq + found[1].distance_sq + found[2].distance_sq;
    }

    const MeshView& result_;
    std::span<const SurfacePoint> points_;
    const NearestOnSheet &sheet_, &cut_;
};

void check(std::span<const SurfacePoint> points, const std::string& name, const MeshView& result) {
    if (points.size() == result.positions.size()) return;
    throw InvalidOption("there are " + std::to_string(points.size()) + " " + name + " for " +
                        std::to_string(result.positions.size()) + " vertices; give one for each");
}

ValueKind kind_of(const Attribute& attribute) {
    return is_label(attribute) ? ValueKind::Label : ValueKind::Number;
}

Attribute with_values(const Attribute& given, std::vector<double> values) {
    if (is_integer(given.type)) {
        for (double& value : values) value = std::round(value);
    }
    return {given.name, given.type, std::move(values), given.names, given.is_intensity};
}

template <typename Number>
void append_number(std::string& text, Number value) {
    char digits[32];  // The longest double takes 24.
    const auto [last, error] = std::to_chars(std::begin(digits), std::end(digits), value);
    text.append(digits, last);
    text += ' ';
}

// Whether the triangle is a part of a larger polygon, whose triangles follow each other.
bool is_part(const std::vector<Index>& face_polygon, Index face) {
    const Index polygon = face_polygon[face];
    return (face > 0 && face_polygon[face - 1] == polygon) ||
           (face + 1 < face_polygon.size() && face_polygon[face + 1] == polygon);
}

}  // namespace

InputMap map_to_input(const MeshView& input, const MeshView& result,
                      std::span<const SurfacePoint> sites, const MapOptions& options) {
    check_num_threads(options.num_threads);
    check(sites, "sites", result);
    Poller poller(options.progress);
    const NearestOnSheet nearest(input, Ticker(poller));
    InputMap map;
    map.vertices.resize(sites.size());
    std::vector<SearchEnd> ends(sites.size(), SearchEnd::Junction);
    const auto map_vertex = [&](Index v) {
        if (nearest.is_on_junction(sites[v])) ends[v] = SearchEnd::Ball;
        map.vertices[v] = nearest.query(result.positions[v], sites[v], ends[v]).point;
    };
    parallel_each(static_cast<Index>(sites.size()), vertex_grain, options.num_threads, map_vertex,
                  poller);
    if (!options.with_faces) return map;
    const Centers centers = part_centers();
    const ResultSheets sheets(result, std::move(ends));
    map.faces.resize(result.triangles.size());
    const auto map_face = [&](Index f) {
        map.faces[f] = sample_face(result, f, map.vertices, sheets, centers, nearest);
    };
    parallel_each(static_cast<Index>(map.faces.size()), face_grain, options.num_threads, map_face,
                  poller);
    return map;
}

std::vector<double> transfer_vertex_values(std::span<const double> values, const MeshView& input,
                                           std::span<const SurfacePoint> points, ValueKind kind) {
    if (values.size() != input.positions.size()) {
        throw InvalidOption("there are " + std::to_string(values.size()) + " values for the " +
                            std::to_string(input.positions.size()) +
                            " vertices of the input; give one for each");
    }
    std::vector<double> result;
    result.reserve(points.size());
    for (const SurfacePoint& point : points) {
        const Triangle& t = input.triangles[point.face.value()];
        result.push_back(kind == ValueKind::Label
                             ? values[nearest_corner(input, point)]
                             : interpolated(point, [&](std::size_t k) { return values[t[k]]; }));
    }
    return result;
}

std::vector<double> transfer_face_values(std::span<const double> values,
                                         std::span<const FaceSamples> samples, ValueKind kind) {
    std::vector<double> result;
    result.reserve(samples.size());
    for (const FaceSamples& faces : samples) {
        const Index last = *std::max_element(faces.begin(), faces.end());
        if (last >= values.size()) {
            throw InvalidOption("face " + std::to_string(last) + " of the input has none of " +
                                std::to_string(values.size()) + " values; give one for each face");
        }
        result.push_back(kind == ValueKind::Label ? most_frequent(values, faces)
                                                  : mean(values, faces));
    }
    return result;
}

std::vector<CornerCoordinates> transfer_corner_values(std::span<const CornerCoordinates> values,
                                                      const MeshView& input, const MeshView& result,
                                                      std::span<const SurfacePoint> points,
                                                      const CornerOptions& options) {
    check_num_threads(options.num_threads);
    check(points, "points", result);
    Poller poller(options.progress);
    const auto num_faces = static_cast<Index>(result.triangles.size());
    std::vector<CornerCoordinates> carried(num_faces, no_coordinates());
    const auto value_at = [&](const SurfacePoint& point) {
        const CornerCoordinates& corners = values[point.face.value()];
        return interpolated(point, [&](std::size_t k) { return corners[k]; });
    };
    if (find_texture_seams(input, values, Ticker(poller)).empty()) {
        for (Index f = 0; f < num_faces; ++f) {
            for (std::size_t k = 0; k < 3; ++k) {
                carried[f][k] = value_at(points[result.triangles[f][k]]);
            }
        }
        return carried;
    }
    const CornerAgreement agree(values);
    const NearestOnSheet sheet(input, Ticker(poller)), cut = sheet.cut_at_seams(agree);
    const CornerFinder finder(result, points, sheet, cut);
    std::vector<FacePoints> found(num_faces);
    parallel_each(
        num_faces, corner_grain, options.num_threads, [&](Index f) { found[f] = finder.find(f); },
        poller);
    // Corner k of face f of the result is number 3 f + k.
    const Groups corners(result.positions.size(), [&](const auto& add) {
        for (Index corner = 0; corner < 3 * num_faces; ++corner) {
            add(result.triangles[corner / 3][corner % 3], corner);
        }
    });
    const auto carry = [&](Index v) {
        std::vector<ClosestPoint> sides{finder.at(points[v], result.positions[v])};
        for (const Index corner : corners.of(v)) {
            const Index f = corner / 3;
            const ClosestPoint& point = found[f][corner % 3];
            const auto side = std::find_if(sides.begin(), sides.end(), [&](const auto& s) {
                return finder.is_same(f, v, s, point);
            });
            const ClosestPoint counted = side == sides.end() ? point : *side;
            if (side == sides.end()) sides.push_back(point);
            carried[f][corner % 3] = value_at(counted.point);
        }
    };
    parallel_each(static_cast<Index>(result.positions.size()), corner_grain, options.num_threads,
                  carry, poller);
    return carried;
}

MeshAttributes transfer_attributes(const MeshFile& input, const MeshView& mesh, const InputMap& map,
                                   const CornerOptions& options) {
    const MeshAttributes& given = input.attributes;
    MeshAttributes result{.normals = given.normals,
                          .material_files = given.material_files,
                          .materials = given.materials,
                          .unit = given.unit,
                          .declined = given.declined};
    for (const Attribute& attribute : given.of_vertices) {
        result.of_vertices.push_back(
            with_values(attribute, transfer_vertex_values(attribute.values, input.mesh.view(),
                                                          map.vertices, kind_of(attribute))));
    }
    for (const Attribute& attribute : given.of_faces) {
        result.of_faces.push_back(with_values(
            attribute, transfer_face_values(attribute.values, map.faces, kind_of(attribute))));
    }
    if (!given.texture.empty()) {
        result.texture = {
            .type = given.texture.type,
            .corners = transfer_corner_values(given.texture.corners, input.mesh.view(), mesh,
                                              map.vertices, options)};
    }
    return result;
}

void keep_attributes(const MeshAttributes& input, std::span<const Index> vertices,
                     std::span<const Index> faces, MeshAttributes& result) {
    const auto keep = [](const std::vector<Attribute>& from, std::span<const Index> elements,
                         std::vector<Attribute>& to) {
        for (std::size_t a = 0; a < from.size(); ++a) {
            for (std::size_t i = 0; i < elements.size(); ++i) {
                to[a].values[i] = from[a].values[elements[i]];
            }
        }
    };
    keep(input.of_vertices, vertices, result.of_vertices);
    keep(input.of_faces, faces, result.of_faces);
    for (std::size_t i = 0; i < faces.size() && !input.texture.empty(); ++i) {
        result.texture.corners[i] = input.texture.corners[faces[i]];
    }
}

const Attribute& require_attribute(const std::vector<Attribute>& attributes, std::string_view name,
                                   const std::string& what) {
    if (const Attribute* const found = find_attribute(attributes, name)) return *found;
    throw InvalidOption(what + " '" + std::string(name) +
                        (attributes.empty() ? "', nor any other; use a file that has it"
                                            : "'; use " + names_of(attributes)));
}

std::vector<Index> face_labels_of(const Attribute& attribute) {
    const std::vector<double> values = distinct(attribute.values);
    std::vector<Index> labels;
    labels.reserve(attribute.values.size());
    for (const double value : attribute.values) {
        const auto found = std::lower_bound(values.begin(), values.end(), value);
        labels.push_back(static_cast<Index>(found - values.begin()));
    }
    return labels;
}

std::string format_map(const MeshFile& input, std::span<const SurfacePoint> points) {
    std::string text;
    for (const SurfacePoint& point : points) {
        const Index face = point.face.value();
        append_number(text, input.face_polygon[face]);
        for (const double b : point.barycentric) append_number(text, b);
        if (is_part(input.face_polygon, face)) {
            for (const Index v : input.mesh.triangles[face]) append_number(text, v);
        }
        text.back() = '\n';
    }
    return text;
}

}  // namespace remesh
