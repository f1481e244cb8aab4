# Debian's emscripten 3.1.6, with what its libc++ lacks. All engines that have WebAssembly's exceptions have the other
# three features.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
# As quick as -O3, and a fourth smaller; 4 % of it come from the threshold of inlining.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -fno-unroll-loops -mllvm -inline-threshold=100 -DNDEBUG" CACHE STRING "Of release builds")
# The names of types, of each lambda as well, are left out: exceptions do not need them.
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -fno-rtti -mnontrapping-fptoint -msign-ext -mbulk-memory -include ${CMAKE_CURRENT_LIST_DIR}/libcxx13.h")
