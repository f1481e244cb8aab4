// Faces, places and fans go to a journal before they change, so that edits can be undone in reverse
// order. The edits are in mesh_edits.cpp.
#include "remesh/placement/edited_mesh.h"

#include <algorithm>

#include "remesh/placement/shape_quality.h"

namespace remesh::detail {

EditedMesh::EditedMesh(const Surface& surface, const PlacedMesh& mesh,
                       std::span<const Mobility> mobility, std::span<const DirectedEdge> hard)
    : surface_(surface),
      faces_(mesh.triangles.size()),
      places_(mesh.points.size()),
      fans_(mesh.points.size()) {
    for (Index v = 0; v < places_.size(); ++v) {
        places_[v] = {mesh.points[v], mesh.offsets[v], Vec3::Zero(), Vec3::Zero(), mobility[v]};
        locate(places_[v]);
    }
    for (const Triangle& t : mesh.triangles) {
        for (Index k = 0; k < 3; ++k) mean_length_ += (at(t[k]) - at(t[(k + 1) % 3])).norm();
    }
    mean_length_ /= 3 * static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1));
    std::vector<DirectedEdge> edges(hard.begin(), hard.end());
    for (const auto& [from, to] : hard) edges.emplace_back(to, from);
    std::sort(edges.begin(), edges.end());
    for (Index f = 0; f < faces_.size(); ++f) {
        const Triangle& t = mesh.triangles[f];
        std::array<bool, 3> is_found{};
        for (Index k = 0; k < 3; ++k) {
            fans_[t[k]].push_back(f);
            is_found[k] =
                std::binary_search(edges.begin(), edges.end(), DirectedEdge(t[k], t[(k + 1) % 3]));
        }
        faces_[f] = {t, Face::hard_bits(is_found[0], is_found[1], is_found[2]), true,
                     quality_of(t)};
    }
}

void EditedMesh::locate(Place& place) const {
    const auto& p = surface_.mesh.positions;
    const Triangle& t = surface_.mesh.triangles[place.point.face.value()];
    place.facing = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).normalized();
    place.at = position(surface_.mesh.view(), place.point) + place.offset;
}

Vec3 EditedMesh::normal_of(const Triangle& t) const {
    return (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
}

double EditedMesh::quality_of(const Triangle& t) const {
    const auto& [a, b, c] = t;
    const Vec3 facing = places_[a].facing + places_[b].facing + places_[c].facing;
    const bool is_turned = !(normal_of(t).dot(facing) > 0);
    return shape_quality(at(a), at(b), at(c)) - (is_turned ? 1 : 0);
}

double EditedMesh::worst_at(Index v) const {
    double worst = 1;
    for (const Index f : fans_[v]) worst = std::min(worst, faces_[f].quality);
    return worst;
}

void EditedMesh::put_face(Index f, const Triangle& corner, std::uint8_t hard) {
    old_faces_.emplace_back(f, faces_[f]);
    faces_[f] = {corner, hard, true, quality_of(corner)};
}

void EditedMesh::drop_face(Index f) {
    old_faces_.emplace_back(f, faces_[f]);
    faces_[f].is_there = false;
}

void EditedMesh::put_place(Index v, const Place& place) {
    old_places_.emplace_back(v, places_[v]);
    places_[v] = place;
}

void EditedMesh::measure_around(Index v) {
    for (const Index f : fans_[v]) put_face(f, faces_[f].corner, faces_[f].hard);
}

bool EditedMesh::has_corner(Index f, Index v) const {
    const Triangle& t = faces_[f].corner;
    return t[0] == v || t[1] == v || t[2] == v;
}

std::optional<EditedMesh::Half> EditedMesh::half_edge(Index from, Index to) const {
    for (const Index f : fans_[from]) {
        const Triangle& t = faces_[f].corner;
        for (Index k = 0; k < 3; ++k) {
            if (t[k] == from && t[(k + 1) % 3] == to) return Half{f, k};
        }
    }
    return std::nullopt;
}

bool EditedMesh::are_joined(Index a, Index b) const {
    return std::any_of(fans_[a].begin(), fans_[a].end(), [&](Index f) { return has_corner(f, b); });
}

std::array<Index, 2> EditedMesh::hard_neighbours(Index v) const {
    std::array<Index, 2> found{no_index, no_index};
    for (const Index f : fans_[v]) {
        const Face& face = faces_[f];
        for (Index k = 0; k < 3; ++k) {
            if (!face.is_hard(k)) continue;
            if (face.corner[k] == v) found[1] = face.corner[(k + 1) % 3];
            if (face.corner[(k + 1) % 3] == v) found[0] = face.corner[k];
        }
    }
    return found;
}

EditedMesh::Mark EditedMesh::mark() const {
    return {old_faces_.size(), old_places_.size(), old_fans_.size(), num_faces(), num_vertices()};
}

void EditedMesh::take_back(const Mark& mark) {
    const auto restore = [](auto& journal, std::size_t size, auto& values) {
        while (journal.size() > size) {
            values[journal.back().first] = std::move(journal.back().second);
            journal.pop_back();
        }
    };
    restore(old_faces_, mark.faces, faces_);
    restore(old_places_, mark.places, places_);
    restore(old_fans_, mark.fans, fans_);
    faces_.resize(mark.num_faces);
    places_.resize(mark.num_vertices);
    fans_.resize(mark.num_vertices);
}

void EditedMesh::changed_since(const Mark& mark, std::vector<Index>& now,
                               std::vector<double>& before) const {
    now.clear();
    before.clear();
    std::vector<std::pair<Index, std::size_t>> first;
    for (std::size_t i = mark.faces; i < old_faces_.size(); ++i) {
        first.emplace_back(old_faces_[i].first, i);
    }
    std::sort(first.begin(), first.end());
    for (std::size_t i = 0; i < first.size(); ++i) {
        if (i > 0 && first[i].first == first[i - 1].first) continue;
        const Face& old = old_faces_[first[i].second].second;
        if (old.is_there) before.push_back(old.quality);
        if (faces_[first[i].first].is_there) now.push_back(first[i].first);
    }
}

PlacedMesh EditedMesh::result(std::vector<Index>& numbers) const {
    PlacedMesh mesh;
    numbers.clear();
    std::vector<Index> number(places_.size(), no_index);
    for (Index v = 0; v < places_.size(); ++v) {
        if (fans_[v].empty()) continue;
        number[v] = static_cast<Index>(mesh.points.size());
        numbers.push_back(v);
        mesh.points.push_back(places_[v].point);
        mesh.offsets.push_back(places_[v].offset);
    }
    for (const Face& f : faces_) {
        if (!f.is_there) continue;
        mesh.triangles.push_back({number[f.corner[0]], number[f.corner[1]], number[f.corner[2]]});
    }
    return mesh;
}

}  // namespace remesh::detail
