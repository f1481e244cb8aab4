# Debian's emscripten 3.1.6, with what its libc++ lacks, and exceptions of the engine's own.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
# With -Os emscripten inlines nothing, unless it is told to.
set(CMAKE_CXX_FLAGS_RELEASE "-Os -finline-functions -DNDEBUG" CACHE STRING "Of release builds")
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -include ${CMAKE_CURRENT_LIST_DIR}/libcxx13.h")
