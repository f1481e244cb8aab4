// For a build without node.
#include "page/viewer.h"

namespace page {

Viewer viewer() { return {}; }

}  // namespace page
