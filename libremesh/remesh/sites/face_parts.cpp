#include "remesh/sites/face_parts.h"

#include <array>

#include "agvd/core/parallel.h"

namespace remesh::detail {
namespace {

// For several threads. With more, faces of two or three labels are in more parts.
constexpr Index most_parts = 8;

using PerPart = std::array<Index, most_parts>;

// Calls each(part) once for each part that a face has a corner of.
template <typename Each>
void for_each_part(const Triangle& face, std::span<const Index> label, const Each& each) {
    unsigned parts = 0;
    for (const Index v : face) {
        if (label[v] != no_index) parts |= 1u << (label[v] & (most_parts - 1));
    }
    for (Index part = 0; parts != 0; ++part, parts >>= 1) {
        if ((parts & 1) != 0) each(part);
    }
}

}  // namespace

FaceParts::FaceParts(const Surface& surface, std::span<const Index> label, int num_threads,
                     Poller& poller)
    : count_(num_threads == 1 ? 1 : most_parts), num_faces_(surface.num_faces()) {
    if (count_ == 1) return;
    const std::vector<Triangle>& triangles = surface.mesh.triangles;
    std::vector<PerPart> next(num_chunks(num_faces_, pass_grain), PerPart{});
    const auto count = [&](Index chunk, Index begin, Index end) {
        PerPart number{};
        for (Index f = begin; f < end; ++f) {
            for_each_part(triangles[f], label, [&](Index part) { ++number[part]; });
        }
        next[chunk] = number;
    };
    parallel_chunks(num_faces_, pass_grain, num_threads, count, poller);
    Index sum = 0;
    for (Index part = 0; part < most_parts; ++part) {
        begin_.push_back(sum);
        for (PerPart& chunk : next) {
            const Index number = chunk[part];
            chunk[part] = sum;
            sum += number;
        }
    }
    begin_.push_back(sum);
    faces_.resize(sum);
    const auto fill = [&](Index chunk, Index begin, Index end) {
        PerPart at = next[chunk];
        for (Index f = begin; f < end; ++f) {
            for_each_part(triangles[f], label, [&](Index part) { faces_[at[part]++] = f; });
        }
    };
    parallel_chunks(num_faces_, pass_grain, num_threads, fill, poller);
}

}  // namespace remesh::detail
