#include "agvd/core/version.h"

namespace agvd {

const char* library_version() { return version; }

}  // namespace agvd
