// Faces with two labels are cut at points of their edges where both distances are equal.
#include "remesh/sites/cell_measures.h"

#include <algorithm>
#include <array>

#include "agvd/core/parallel.h"
#include "agvd/propagation/distance_bounds.h"
#include "remesh/sites/prepared_surface.h"

namespace remesh::detail {
namespace {

// Adds what the sites of one part hold, face by face.
void add_part(const PreparedSurface& prepared, const DistanceBounds& labels, const FaceParts& parts,
              Index part, Ticker ticker, CellMeasures& result, std::vector<Vec3>& shadow) {
    const Surface& surface = prepared.base.surface();
    parts.for_each_face(part, [&](Index f) {
        ticker.tick();
        const Triangle& t = surface.mesh.triangles[f];
        const std::array<Index, 3> site{labels.site[t[0]], labels.site[t[1]], labels.site[t[2]]};
        const auto add = [&](Index s, double share) {
            if (!parts.has(part, s)) return;
            prepared.pieces->for_each(f, [&](const SurfacePiece& piece) {
                const double area = piece.vector.norm();
                result.area[s] += share * area;
                shadow[s] += share * piece.vector;
                if (!(share * area > 0)) return;
                result.planes[s].add(share * piece.vector, share * area, piece.position);
            });
        };
        if (site[0] == site[1] && site[1] == site[2]) {
            add(site[0], 1);
            return;
        }
        // If two corners have one label, the third corner is cut off; three labels get equal
        // shares.
        std::size_t k = 0;
        while (k < 3 && site[(k + 1) % 3] != site[(k + 2) % 3]) ++k;
        if (k == 3) {
            for (const Index s : site) add(s, 1.0 / 3);
            return;
        }
        const std::size_t next = (k + 1) % 3, previous = (k + 2) % 3;
        const auto h = 3 * f + static_cast<Index>(k);
        const double cut =
            meeting_share(labels, t[k], t[next], surface.length_of(h)) *
            meeting_share(labels, t[k], t[previous], surface.length_of(Surface::previous(h)));
        add(site[k], cut);
        add(site[next], 1 - cut);
    });
}

}  // namespace

double meeting_share(const DistanceBounds& labels, Index u, Index v, double length) {
    const double ahead = static_cast<double>(labels.distance[v]) - labels.distance[u];
    return std::clamp((length + ahead) / (2 * length), 0.0, 1.0);
}

CellMeasures measure_cells(const PreparedSurface& surface, const DistanceBounds& labels,
                           Index num_sites, int num_threads, const Progress& progress) {
    Poller poller(progress);
    CellMeasures result{std::vector<double>(num_sites, 0), std::vector<double>(num_sites, 0),
                        std::vector<CellPlanes>(num_sites)};
    std::vector<Vec3> shadow(num_sites, Vec3::Zero());  // Norm: largest projection.
    const FaceParts parts(surface.base.surface(), labels.site, num_threads);
    const auto body = [&](Index part, Index, Index) {
        add_part(surface, labels, parts, part, Ticker(poller), result, shadow);
    };
    parallel_chunks(parts.count(), 1, num_threads, body, poller);
    for (Index i = 0; i < num_sites; ++i) {
        if (result.area[i] > 0) {
            result.bending[i] = std::max(0.0, 1 - shadow[i].norm() / result.area[i]);
        }
    }
    return result;
}

}  // namespace remesh::detail
