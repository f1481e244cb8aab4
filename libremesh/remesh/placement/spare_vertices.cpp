#include "remesh/placement/spare_vertices.h"

#include <algorithm>

#include "remesh/placement/shape_quality.h"

namespace remesh::detail {

void SpareVertices::restart(double elsewhere) {
    count_ = 0;
    elsewhere_ = elsewhere;
    has_collapses_ = has_edges_ = false;
    collapses_.clear();
    edges_ = {};
}

bool SpareVertices::balance() {
    if (count_ < 0) prune();
    while (count_ > 0 && split_one()) {
    }
    while (count_ < 0 && collapse_one()) {
    }
    return count_ == 0;
}

// Removes boundary vertices whose worst triangle lies between the wanted quality and that of
// elsewhere_, if all triangles keep the wanted one.
void SpareVertices::prune() {
    for (Index v = 0; v < mesh_.num_vertices() && count_ < 0; ++v) {
        if (mesh_.mobility(v) != Mobility::Boundary || mesh_.faces_at(v).empty()) continue;
        const double worst = mesh_.worst_at(v);
        if (worst < wanted_ || worst >= elsewhere_) continue;
        for (const Index into : mesh_.hard_neighbours(v)) {
            if (into == no_index) continue;
            const EditedMesh::Mark before = mesh_.mark();
            if (mesh_.collapse(v, into)) {
                steps_.relax(before);
                if (steps_.worst_since(before) >= wanted_) {
                    ++count_;
                    break;
                }
            }
            mesh_.take_back(before);
        }
    }
}

bool SpareVertices::collapse_one() {
    if (!has_collapses_) list_collapses();
    while (!collapses_.empty()) {
        const auto [quality, gone, into] = collapses_.back();
        collapses_.pop_back();
        if (mesh_.faces_at(gone).empty() || mesh_.faces_at(into).empty()) continue;
        const EditedMesh::Mark before = mesh_.mark();
        if (mesh_.worst_at(gone) >= elsewhere_ && mesh_.collapse(gone, into)) {
            (void)steps_.move_to_mean(into);
            steps_.relax(before);
            if (steps_.worst_since(before) >= elsewhere_) {
                ++count_;
                return true;
            }
        }
        mesh_.take_back(before);
    }
    return false;
}

// Lists collapses by the quality that triangles have with the edge's middle in place of its ends.
void SpareVertices::list_collapses() {
    has_collapses_ = true;
    for (Index f = 0; f < mesh_.num_faces(); ++f) {
        if (!mesh_.face(f).is_there) continue;
        ticker_.tick(30);
        const Triangle& t = mesh_.face(f).corner;
        for (Index k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            if (a > b) continue;  // Each edge once.
            if (mesh_.mobility(a) != Mobility::Free || mesh_.mobility(b) != Mobility::Free) {
                continue;
            }
            const double quality = quality_of_middle(a, b);
            if (quality >= wanted_) collapses_.push_back({quality, a, b});
        }
    }
    std::sort(collapses_.begin(), collapses_.end());
}

double SpareVertices::quality_of_middle(Index a, Index b) const {
    const Vec3 middle = (mesh_.at(a) + mesh_.at(b)) / 2;
    double worst = 1;
    for (const Index v : {a, b}) {
        for (const Index f : mesh_.faces_at(v)) {
            const Triangle& t = mesh_.face(f).corner;
            std::array<Vec3, 3> at;
            int num_moved = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const bool is_moved = t[k] == a || t[k] == b;
                num_moved += is_moved ? 1 : 0;
                at[k] = is_moved ? middle : mesh_.at(t[k]);
            }
            if (num_moved == 1) {
                worst = std::min(worst, shape_quality(at[0], at[1], at[2]));
            }
        }
    }
    return worst;
}

// Lists the edges whose half-edge from the lower vertex lies in a face.
void SpareVertices::push_edges(Index face) {
    const Triangle& t = mesh_.face(face).corner;
    for (Index k = 0; k < 3; ++k) {
        const Index a = t[k], b = t[(k + 1) % 3];
        if (a < b) edges_.push({(mesh_.at(a) - mesh_.at(b)).squaredNorm(), face, k});
    }
}

// Splits the longest edge that can be split well.
bool SpareVertices::split_one() {
    if (!has_edges_) {
        has_edges_ = true;
        for (Index f = 0; f < mesh_.num_faces(); ++f) {
            if (mesh_.face(f).is_there) push_edges(f);
        }
    }
    while (!edges_.empty()) {
        const auto [square, face, k] = edges_.top();
        edges_.pop();
        if (!mesh_.face(face).is_there) continue;
        const Triangle& t = mesh_.face(face).corner;
        const Index a = t[k], b = t[(k + 1) % 3];
        if (a > b || (mesh_.at(a) - mesh_.at(b)).squaredNorm() != square) continue;
        const EditedMesh::Mark before = mesh_.mark();
        if (steps_.edit({face, k, true, false}) && steps_.worst_since(before) >= wanted_) {
            mesh_.changed_since(before, changed_, before_);
            for (const Index changed : changed_) push_edges(changed);
            --count_;
            return true;
        }
        mesh_.take_back(before);
    }
    return false;
}

}  // namespace remesh::detail
