#include "agvd/diagram/trace.h"

#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/diagram/find_arcs.h"
#include "agvd/diagram/join.h"

namespace agvd {
namespace {

constexpr Index faces_per_task = 128;  // Faces that are traced by one task.

// \param step  faces that are stored together, side by side.
void store(std::span<const Index> faces, std::span<const FaceArcs> chunks, Index step,
           DiagramParts& parts) {
    for (Index i = 0; i < faces.size(); i += step) {
        const auto some = faces.subspan(i, std::min<std::size_t>(step, faces.size() - i));
        parts.arcs.add(some, chunks[i / faces_per_task], i % faces_per_task);
        for (const Index face : some) {
            parts.tally.count_parts(parts.arcs.parts()[parts.arcs.of_face(face).parts], 1);
        }
    }
}

}  // namespace

void trace_faces(const StageInput& input, std::span<const Index> mixed, DiagramParts& parts) {
    // Some chunks at a time, so that arcs are stored while they are in the cache.
    constexpr Index most = 64 * faces_per_task;
    std::vector<FaceArcs> chunks(num_chunks(most, faces_per_task));
    const bool is_first = parts.arcs.is_empty();
    for (std::size_t begin = 0; begin < mixed.size(); begin += most) {
        const auto some = mixed.subspan(begin, std::min<std::size_t>(most, mixed.size() - begin));
        const auto trace_chunk = [&](Index chunk, Index first, Index last) {
            find_arcs(input, parts.labels, some.subspan(first, last - first), chunks[chunk]);
        };
        parallel_chunks(static_cast<Index>(some.size()), faces_per_task, input.num_threads,
                        trace_chunk, input.poller);
        input.poller.poll();
        // Released places are for one face at a time.
        store(faces_at(input.propagation, some), chunks, is_first ? faces_per_task : 1, parts);
        if (begin == 0 && is_first) {
            parts.arcs.reserve_for(static_cast<double>(mixed.size()) / most);
        }
    }
}

void remove_arcs(Index face, DiagramParts& parts) {
    forget_arcs(parts.arcs, face, parts.joined);
    parts.tally.count_parts(parts.arcs.parts()[parts.arcs.of_face(face).parts], -1);
    parts.arcs.remove(face);
}

}  // namespace agvd
