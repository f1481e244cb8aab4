// Compares the new run with the old one vertex by vertex and half-edge by half-edge, and tells the
// faces in which they differ. A run records the vertices whose bounds it read, so that a change of
// other bounds does not make the site run again.
#include "agvd/update/site_run.h"

#include <algorithm>
#include <array>

#include "agvd/propagation/window_front.h"
#include "agvd/propagation/window_relays.h"

namespace agvd {
namespace {

bool is_same(const Window& w, const Relay& r) {
    const Relay now = to_relay(w, no_index, r.half_edge);
    return now.x == r.x && now.y == r.y && now.weight == r.weight && now.begin == r.begin &&
           now.end == r.end;
}

bool are_same(std::span<const Window> windows, std::span<const Relay> relays) {
    return std::equal(windows.begin(), windows.end(), relays.begin(), relays.end(), is_same);
}

class RunReplacer {
public:
    RunReplacer(const WindowFront& front, bool is_other_place, SiteRun& run, RunChanges& changes)
        : front_(front), is_other_place_(is_other_place), run_(run), changes_(changes) {}

    void replace() {
        run_.error = front_.relative_error();
        run_.num_windows = front_.num_windows();
        if (compare_vertices()) take_vertices();
        if (compare_half_edges()) {
            hand_over_faces();
            take_half_edges();
        }
    }

private:
    // False if there is no difference, as the others.
    bool compare_vertices() {
        const std::size_t first_change = changes_.vertices.size();
        is_old_.assign(front_.num_vertices(), 0);
        for (const auto& [vertex, distance] : run_.vertices) {
            const Index place = front_.place_of_vertex(vertex);
            if (place == no_index) {
                changes_.vertices.push_back({vertex, infinity, false});
                continue;
            }
            is_old_[place] = 1;
            const double now = front_.vertex_at(place).distance;
            if (now != distance || is_other_place_) {
                changes_.vertices.push_back({vertex, now, true});
            }
        }
        for (Index place = 0; place < front_.num_vertices(); ++place) {
            if (is_old_[place] != 0) continue;
            const auto [vertex, distance] = front_.vertex_at(place);
            changes_.vertices.push_back({vertex, distance, true});
        }
        return changes_.vertices.size() > first_change;
    }

    void take_vertices() {
        run_.vertices.clear();
        for (Index place = 0; place < front_.num_vertices(); ++place) {
            const auto [vertex, distance] = front_.vertex_at(place);
            run_.vertices.push_back({vertex, distance});
        }
    }

    // Where the runs begin to differ: often far behind, since the bounds that did lie at the cell's
    // border.
    void skip_what_is_same() {
        if (is_other_place_) return;
        const Index num_places = front_.num_half_edges();
        while (true) {
            while (first_place_ < num_places && front_.windows_at(first_place_).empty()) {
                ++first_place_;
            }
            if (num_kept_ == run_.half_edges.size() || first_place_ == num_places) return;
            const SiteRun::HalfEdge& old = run_.half_edges[num_kept_];
            if (old.half_edge != front_.half_edge_at(first_place_) ||
                !are_same(front_.windows_at(first_place_),
                          std::span(run_.relays).subspan(old.first, old.count))) {
                return;
            }
            ++num_kept_;
            ++first_place_;
        }
    }

    // Half-edges of one face must keep their order, too: it is enough that none comes before one
    // that it came behind.
    bool compare_half_edges() {
        skip_what_is_same();
        is_old_.assign(front_.num_half_edges(), 0);
        Index last_place = 0;
        for (const auto& [half_edge, first, count] :
             std::span(run_.half_edges).subspan(num_kept_)) {
            const Index place = front_.place_of_half_edge(half_edge);
            const auto before = std::span(run_.relays).subspan(first, count);
            bool is_same = place != no_index && !is_other_place_ && place >= last_place;
            if (place != no_index) {
                is_old_[place] = 1;
                last_place = std::max(last_place, place);
                is_same = is_same && are_same(front_.windows_at(place), before);
            }
            if (!is_same) faces_.push_back(Surface::face(half_edge));
        }
        for (Index place = first_place_; place < front_.num_half_edges(); ++place) {
            if (is_old_[place] != 0 || front_.windows_at(place).empty()) continue;
            faces_.push_back(Surface::face(front_.half_edge_at(place)));
        }
        std::sort(faces_.begin(), faces_.end());
        faces_.erase(std::unique(faces_.begin(), faces_.end()), faces_.end());
        return !faces_.empty();
    }

    void hand_over_faces() {
        for (const Index face : faces_) {
            std::array<Index, 3> places;
            for (Index k = 0; k < 3; ++k) places[k] = front_.place_of_half_edge(3 * face + k);
            std::sort(places.begin(), places.end());
            const auto first = static_cast<Index>(changes_.relays.size());
            for (const Index place : places) {
                if (place != no_index) append(place, changes_.relays);
            }
            const auto count = static_cast<Index>(changes_.relays.size()) - first;
            changes_.faces.push_back({face, first, count});
        }
    }

    void take_half_edges() {
        if (num_kept_ < run_.half_edges.size()) {
            run_.relays.resize(run_.half_edges[num_kept_].first);
            run_.half_edges.resize(num_kept_);
        }
        for (Index place = first_place_; place < front_.num_half_edges(); ++place) {
            const auto first = static_cast<Index>(run_.relays.size());
            append(place, run_.relays);
            const auto count = static_cast<Index>(run_.relays.size()) - first;
            if (count > 0) run_.half_edges.push_back({front_.half_edge_at(place), first, count});
        }
    }

    void append(Index place, std::vector<Relay>& relays) const {
        const Index half_edge = front_.half_edge_at(place);
        for (const Window& w : front_.windows_at(place)) {
            relays.push_back(to_relay(w, no_index, half_edge));
        }
    }

    const WindowFront& front_;
    bool is_other_place_;
    SiteRun& run_;
    RunChanges& changes_;
    std::vector<std::uint8_t> is_old_;  // By place in the front: the run before came there, too.
    std::vector<Index> faces_;          // Those with a difference.
    // Of the half-edges of the run before, and the place of the next one.
    Index num_kept_ = 0, first_place_ = 0;
};

}  // namespace

void forget_run(SiteRun& run, RunChanges& changes) {
    for (const auto& [vertex, distance] : run.vertices) {
        changes.vertices.push_back({vertex, infinity, false});
    }
    const std::size_t first = changes.faces.size();
    for (const auto& [half_edge, begin, count] : run.half_edges) {
        changes.faces.push_back({Surface::face(half_edge), 0, 0});
    }
    const auto begin = changes.faces.begin() + static_cast<std::ptrdiff_t>(first);
    const auto by_face = [](const auto& a, const auto& b) { return a.face < b.face; };
    const auto is_same_face = [](const auto& a, const auto& b) { return a.face == b.face; };
    std::sort(begin, changes.faces.end(), by_face);
    changes.faces.erase(std::unique(begin, changes.faces.end(), is_same_face), changes.faces.end());
    run = {};
}

void replace_run(const WindowFront& front, bool is_other_place, SiteRun& run, RunChanges& changes) {
    RunReplacer(front, is_other_place, run, changes).replace();
}

}  // namespace agvd
