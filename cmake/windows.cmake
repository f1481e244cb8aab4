# Programs for Windows, made by Debian's mingw-w64, which need no DLLs but those of Windows. Debian has zlib for it; the
# other packages that we can use there are headers only, so that those of this machine serve.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)  # This variant has std::thread.
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
foreach(kind LIBRARY INCLUDE PACKAGE)
    set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(ZLIB_LIBRARY /usr/x86_64-w64-mingw32/lib/libz.a CACHE FILEPATH "")  # Not the DLL beside it.
set(CGAL_DISABLE_GMP ON)  # It takes numbers of Boost in place of those of GMP and MPFR.

# A prefix of their own: in /usr/include the headers of this machine's C library stand beside them.
get_property(is_trial GLOBAL PROPERTY IN_TRY_COMPILE)
if(NOT is_trial)
    set(prefix ${CMAKE_BINARY_DIR}/prefix)
    list(APPEND CMAKE_FIND_ROOT_PATH ${prefix})
    file(MAKE_DIRECTORY ${prefix}/include)
    foreach(folder boost CGAL CLI eigen3 fast_float nlohmann)
        file(CREATE_LINK /usr/include/${folder} ${prefix}/include/${folder} SYMBOLIC)
    endforeach()
    foreach(folder lib/x86_64-linux-gnu/cmake/CGAL share/cmake/CLI11 share/eigen3/cmake lib/cmake/FastFloat
            share/cmake/nlohmann_json)
        file(COPY /usr/${folder}/ DESTINATION ${prefix}/${folder})
    endforeach()
    set(CGAL_DIR ${prefix}/lib/x86_64-linux-gnu/cmake/CGAL CACHE PATH "")
    set(CLI11_DIR ${prefix}/share/cmake/CLI11 CACHE PATH "")
    set(Eigen3_DIR ${prefix}/share/eigen3/cmake CACHE PATH "")
    set(FastFloat_DIR ${prefix}/lib/cmake/FastFloat CACHE PATH "")
    set(nlohmann_json_DIR ${prefix}/share/cmake/nlohmann_json CACHE PATH "")
endif()
