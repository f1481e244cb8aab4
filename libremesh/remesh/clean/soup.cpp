#include "remesh/clean/soup.h"

#include <algorithm>

namespace remesh::detail {

void erase_faces(Soup& soup, const std::vector<bool>& is_dead, std::vector<Index>& twin) {
    std::vector<Index> new_face(soup.triangles.size(), no_index);
    Index count = 0;
    for (Index f = 0; f < new_face.size(); ++f) {
        soup.ticker.tick();
        if (is_dead[f]) continue;
        new_face[f] = count;
        soup.triangles[count] = soup.triangles[f];
        soup.face_origin[count] = soup.face_origin[f];
        ++count;
    }
    soup.triangles.resize(count);
    soup.face_origin.resize(count);
    if (twin.empty()) return;
    for (Index f = 0; f < new_face.size(); ++f) {
        soup.ticker.tick();
        if (new_face[f] == no_index) continue;
        for (Index k = 0; k < 3; ++k) {
            const Index across = twin[3 * f + k];
            const bool is_open = across == no_index || new_face[across / 3] == no_index;
            twin[3 * new_face[f] + k] = is_open ? no_index : 3 * new_face[across / 3] + across % 3;
        }
    }
    twin.resize(3 * std::size_t{count});
}

Index drop_faces(Soup& soup, const std::vector<bool>& is_dead) {
    const auto dropped = static_cast<Index>(std::count(is_dead.begin(), is_dead.end(), true));
    std::vector<Index> no_twins;
    if (dropped > 0) erase_faces(soup, is_dead, no_twins);
    return dropped;
}

}  // namespace remesh::detail
