// Gives each patch one orientation. A patch is a set of faces connected through edges of exactly
// two faces.
#include <string>

#include "agvd/core/error.h"
#include "remesh/clean/soup.h"

namespace remesh::detail {
namespace {

// If this share of a closed patch agrees, its orientation is kept; otherwise the patch is turned
// outward. The first keeps the inner wall of a hollow body, the second serves files without any
// orientation.
constexpr double clear_majority = 0.75;

struct Patch {
    std::vector<Index> faces;  // In the order in which they were reached.
    Index turned = 0;          // Number of faces oriented against the first one.
    bool is_closed = true;
};

// Collects the patch of `seed`; `is_turned` is relative to it.
Patch spread(const Soup& soup, const std::vector<Index>& across, Index seed,
             std::vector<bool>& is_seen, std::vector<bool>& is_turned, Ticker& ticker) {
    Patch patch;
    patch.faces.push_back(seed);
    is_seen[seed] = true;
    for (std::size_t i = 0; i < patch.faces.size(); ++i) {
        ticker.tick();
        const Index face = patch.faces[i];
        if (is_turned[face]) ++patch.turned;
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (across[h] == no_index) {
                patch.is_closed = false;
                continue;
            }
            const Index other = across[h] / 3;
            const bool turned = is_turned[face] != (soup.runs_up(h) == soup.runs_up(across[h]));
            if (!is_seen[other]) {
                is_seen[other] = true;
                is_turned[other] = turned;
                patch.faces.push_back(other);
            } else if (is_turned[other] != turned) {
                throw InvalidInput(
                    "the surface is not orientable (one-sided like a Moebius strip) at face " +
                    std::to_string(soup.face_origin[other]) +
                    "; cut it open along a line that crosses this face");
            }
        }
    }
    return patch;
}

// Six times the volume that the patch would enclose if its turned faces were turned back.
double enclosed_volume(const Soup& soup, const Patch& patch, const std::vector<bool>& is_turned) {
    const Vec3& origin = soup.positions[soup.triangles[patch.faces[0]][0]];
    double volume = 0;
    for (const Index face : patch.faces) {
        const auto& [a, b, c] = soup.triangles[face];
        const double part =
            (soup.positions[a] - origin)
                .dot((soup.positions[b] - origin).cross(soup.positions[c] - origin));
        volume += is_turned[face] ? -part : part;
    }
    return volume;
}

// Whether the first face, and those oriented like it, are to be turned.
bool first_side_yields(const Soup& soup, const Patch& patch, const std::vector<bool>& is_turned) {
    const auto total = static_cast<double>(patch.faces.size());
    const bool is_minority = 2 * static_cast<double>(patch.turned) > total;
    const double majority = (is_minority ? patch.turned : total - patch.turned) / total;
    if (!patch.is_closed || majority >= clear_majority) return is_minority;
    return enclosed_volume(soup, patch, is_turned) < 0;
}

}  // namespace

bool orient_faces(Soup& soup, std::span<const EdgeSide> sides) {
    std::vector<Index> across(soup.num_half_edges(), no_index);
    bool is_consistent = true;
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        soup.ticker.tick();
        if (edge.size() != 2) return;
        const Index a = edge[0].half_edge, b = edge[1].half_edge;
        across[a] = b;
        across[b] = a;
        if (soup.runs_up(a) == soup.runs_up(b)) is_consistent = false;
    });
    if (is_consistent) return false;

    const auto num_faces = static_cast<Index>(soup.triangles.size());
    std::vector<bool> is_seen(num_faces, false), is_turned(num_faces, false);
    std::vector<Index> to_turn;
    for (Index seed = 0; seed < num_faces; ++seed) {
        if (is_seen[seed]) continue;
        const Patch patch = spread(soup, across, seed, is_seen, is_turned, soup.ticker);
        if (patch.turned == 0) continue;
        const bool first_yields = first_side_yields(soup, patch, is_turned);
        for (const Index face : patch.faces) {
            if (is_turned[face] != first_yields) to_turn.push_back(face);
        }
    }
    for (const Index face : to_turn) std::swap(soup.triangles[face][1], soup.triangles[face][2]);
    soup.counts.flipped_faces += static_cast<Index>(to_turn.size());
    return true;
}

}  // namespace remesh::detail
