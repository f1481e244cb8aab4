# Compiles through ccache where it is installed; -D AGVD_CCACHE=OFF does without.
option(AGVD_CCACHE "Use ccache if there is one" ON)
if(PROJECT_IS_TOP_LEVEL AND AGVD_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    find_program(AGVD_CCACHE_PROGRAM ccache)
    mark_as_advanced(AGVD_CCACHE_PROGRAM)
    if(AGVD_CCACHE_PROGRAM)
        set(CMAKE_CXX_COMPILER_LAUNCHER ${AGVD_CCACHE_PROGRAM})
    endif()
endif()
