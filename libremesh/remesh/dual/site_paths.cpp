// A path from a site into a face of its cell follows vertices: descend() goes down the distances of
// the diagram; search() is an A* search along edges for cells where that fails. StripBuilder makes
// a strip of the vertices.
#include "remesh/dual/site_paths.h"

#include <algorithm>
#include <queue>

namespace remesh {

namespace {

// Factor on a search step to a vertex outside the site's cell, so that the way around a handle is
// not shorter than the one through the cell.
constexpr double outside_penalty = 4;

// Calls visit(half-edge, vertex) for each neighbour of `vertex` until it returns false. The
// half-edge joins both and belongs in turn to each face around.
template <typename Visit>
void for_each_neighbour(const Surface& surface, Index vertex, const Visit& visit) {
    Index h = surface.outgoing[vertex];
    do {
        if (!visit(h, surface.head(h))) return;
        const Index in = Surface::previous(h);
        h = surface.twin[in];
        if (h == no_index) visit(in, surface.tail(in));
    } while (h != no_index && h != surface.outgoing[vertex]);
}

}  // namespace

FaceStrip SitePaths::through(Index from, Index face, Index to) {
    find_way(face, from, back_);
    find_way(face, to, forth_);
    StripBuilder builder(surface_, vertices_.points[from]);
    for (auto v = back_.rbegin(); v != back_.rend(); ++v) builder.to_vertex(*v);
    builder.to_face(face);
    for (const Index v : forth_) builder.to_vertex(v);
    return builder.finish(vertices_.points[to]);
}

FaceStrip SitePaths::between(Index from, Index to) {
    StripBuilder builder(surface_, vertices_.points[from]);
    const Index face = vertices_.points[from].face.value();
    if (!holds_goal(face, to)) {
        search(face, to, forth_);
        for (const Index v : forth_) builder.to_vertex(v);
    }
    return builder.finish(vertices_.points[to]);
}

// Sets `way` to vertices from a corner of the face to one that shares a face with the site; to none
// if the face holds the site.
void SitePaths::find_way(Index face, Index goal, Way& way) {
    way.clear();
    if (holds_goal(face, goal)) return;
    const Index common = common_corner(face, goal);
    if (common != no_index) {
        way.push_back(common);
        return;
    }
    descend(face, goal, way);
    if (way.empty()) search(face, goal, way);
}

// A corner of both the face and the site's face; no_index if there is none.
Index SitePaths::common_corner(Index face, Index goal) const {
    const Triangle& corners = surface_.mesh.triangles[vertices_.points[goal].face.value()];
    for (const Index v : surface_.mesh.triangles[face]) {
        if (v == corners[0] || v == corners[1] || v == corners[2]) return v;
    }
    return no_index;
}

// Goes each time to the neighbour in the cell over which the site is nearest. Leaves `way` empty if
// that ends before the site is reached.
void SitePaths::descend(Index face, Index goal, Way& way) const {
    const std::vector<double>& distance = vertices_.diagram.nearest_distance;
    double nearest = infinity;
    for (const Index v : surface_.mesh.triangles[face]) {
        if (!is_inside(v, goal) || !(distance[v] < nearest)) continue;
        nearest = distance[v];
        way.assign(1, v);
    }
    while (!way.empty()) {
        ticker_.tick();
        const Index here = way.back();
        Index next = no_index;
        double least = infinity;
        bool is_there = false;
        for_each_neighbour(surface_, here, [&](Index h, Index v) {
            is_there = holds_goal(Surface::face(h), goal);
            if (is_there) return false;
            if (!is_inside(v, goal) || !(distance[v] < distance[here])) return true;
            const double length = distance[v] + surface_.length_of(h);
            if (length < least) {
                least = length;
                next = v;
            }
            return true;
        });
        if (is_there) return;
        if (next == no_index) {
            way.clear();
        } else {
            way.push_back(next);
        }
    }
}

// A* search along edges. Ties go to the lower vertex.
void SitePaths::search(Index face, Index goal, Way& way) {
    struct Entry {
        double estimate;
        Index vertex;
        bool operator>(const Entry& other) const {
            return estimate != other.estimate ? estimate > other.estimate : vertex > other.vertex;
        }
    };
    if (reached_.empty()) reached_.resize(surface_.num_vertices());
    for (const Index v : visited_) reached_[v] = {};
    visited_.clear();
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const Vec3& place = vertices_.positions[goal];
    const auto reach = [&](Index v, double length, Index from) {
        Reached& state = reached_[v];
        if (state.is_done || !(length < state.length)) return;
        if (state.length == infinity) visited_.push_back(v);
        state = {length, from, false};
        queue.push({length + (surface_.mesh.positions[v] - place).norm(), v});
    };
    for (const Index v : surface_.mesh.triangles[face]) reach(v, 0, no_index);
    way.clear();
    while (!queue.empty()) {
        ticker_.tick(4);
        const Index here = queue.top().vertex;
        queue.pop();
        Reached& state = reached_[here];
        if (state.is_done) continue;
        state.is_done = true;
        const double length = state.length;
        bool is_there = false;
        for_each_neighbour(surface_, here, [&](Index h, Index v) {
            is_there = holds_goal(Surface::face(h), goal);
            if (is_there) return false;
            const double weight = is_inside(v, goal) ? 1 : outside_penalty;
            reach(v, length + weight * surface_.length_of(h), here);
            return true;
        });
        if (!is_there) continue;
        for (Index v = here; v != no_index; v = reached_[v].from) way.push_back(v);
        break;
    }
    std::reverse(way.begin(), way.end());
}

}  // namespace remesh
