#include "picture.h"

#include "render/mesh_picture.h"

namespace cli {

void require_pictures() {}

std::string picture_of(const agvd::MeshView& original, const agvd::MeshView& result) {
    return render::picture_of_pair(original, result);
}

}  // namespace cli
