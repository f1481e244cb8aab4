// The reader of VTK's XML PolyData.
#include "check_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::check_reader(".vtp", data, size);
}
