#include "agvd/intrinsic/simplicial.h"

#include <algorithm>
#include <array>
#include <utility>

namespace agvd::detail {
namespace {

// Visits the neighbours of a vertex one by one.
class Neighbours {
public:
    Neighbours(const Surface& surface, Index vertex)
        : surface_(surface), first_(surface.outgoing[vertex]), next_(first_) {}

    // \return no_index after the last.
    Index advance() {
        if (next_ == no_index) return no_index;
        if (is_open_end_) {
            next_ = no_index;
            return last_;
        }
        const Index neighbour = surface_.head(next_);
        const Index back = Surface::previous(next_);
        next_ = surface_.twin[back];
        if (next_ == no_index) {  // On the boundary there is one more.
            last_ = surface_.tail(back);
            is_open_end_ = true;
            next_ = first_;
        } else if (next_ == first_) {
            next_ = no_index;
        }
        return neighbour;
    }

private:
    const Surface& surface_;
    Index first_, next_;
    Index last_ = no_index;
    bool is_open_end_ = false;
};

// A key that equal edges or faces share. Of equal ones, that with the lowest number comes first.
template <typename Key>
void append_repeated(std::vector<std::pair<Key, Index>>& things, std::vector<Index>& repeated) {
    std::sort(things.begin(), things.end());
    for (std::size_t i = 1; i < things.size(); ++i) {
        if (things[i].first == things[i - 1].first) repeated.push_back(things[i].second);
    }
}

}  // namespace

bool has_edge(const Surface& surface, Index a, Index b) {
    Neighbours of_a(surface, a), of_b(surface, b);
    while (true) {
        const Index next_a = of_a.advance(), next_b = of_b.advance();
        if (next_a == b || next_b == a) return true;
        if (next_a == no_index || next_b == no_index) return false;
    }
}

std::vector<Index> edges_to_cut(const Surface& surface) {
    std::vector<Index> found;
    std::vector<std::pair<std::array<Index, 2>, Index>> edges;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        const Index a = surface.tail(h), b = surface.head(h);
        if (a == b) {
            found.push_back(e);
        } else {
            edges.push_back({{std::min(a, b), std::max(a, b)}, e});
        }
    }
    append_repeated(edges, found);
    std::sort(found.begin(), found.end());
    if (!found.empty()) return found;
    std::vector<std::pair<Triangle, Index>> faces;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        Triangle corners = surface.mesh.triangles[f];
        std::sort(corners.begin(), corners.end());
        faces.emplace_back(corners, surface.edge[3 * f]);
    }
    append_repeated(faces, found);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

}  // namespace agvd::detail
