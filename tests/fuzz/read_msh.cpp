// The reader of Gmsh's .msh.
#include "check_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::check_reader(".msh", data, size);
}
