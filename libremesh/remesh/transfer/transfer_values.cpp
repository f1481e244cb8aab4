#include "remesh/transfer/transfer_values.h"

#include <algorithm>
#include <compare>
#include <string>
#include <utility>

#include "agvd/core/error.h"

namespace remesh {
namespace {

// Sums of the same value stay that value, bit for bit.
double interpolated(std::span<const double> values, const Triangle& t, const SurfacePoint& place) {
    const auto& b = place.barycentric;
    const auto k = static_cast<std::size_t>(std::max_element(b.begin(), b.end()) - b.begin());
    double value = values[t[k]];
    for (const std::size_t i : {(k + 1) % 3, (k + 2) % 3}) {
        if (b[i] != 0 && values[t[i]] != values[t[k]]) {
            value += b[i] * (values[t[i]] - values[t[k]]);
        }
    }
    return value;
}

Index nearest_corner(const MeshView& input, const SurfacePoint& place) {
    const Vec3 at = position(input, place);
    const Triangle& t = input.triangles[place.face.value()];
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

}  // namespace

std::vector<double> transfer_vertex_values(std::span<const double> values, const MeshView& input,
                                           std::span<const SurfacePoint> places, ValueKind kind) {
    if (values.size() != input.positions.size()) {
        throw InvalidOption("there are " + std::to_string(values.size()) + " values for the " +
                            std::to_string(input.positions.size()) +
                            " vertices of the input; give one for each");
    }
    std::vector<double> result;
    result.reserve(places.size());
    for (const SurfacePoint& place : places) {
        result.push_back(kind == ValueKind::Label
                             ? values[nearest_corner(input, place)]
                             : interpolated(values, input.triangles[place.face.value()], place));
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

}  // namespace remesh
