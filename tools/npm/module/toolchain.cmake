# Debian's emscripten 3.1.6, with what its libc++ lacks, and exceptions of the engine's own.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
# As quick as -O3, and a quarter smaller.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -fno-unroll-loops -DNDEBUG" CACHE STRING "Of release builds")
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -include ${CMAKE_CURRENT_LIST_DIR}/libcxx13.h")
