# Finds the packages that the options ask for. If some are missing, one message names them all, with
# their Debian packages and the options that do without.
set(missing "")

# agvd_need(package debian_package reason [arguments of find_package...])
macro(agvd_need package debian_package reason)
    find_package(${package} ${ARGN} QUIET)
    if(NOT ${package}_FOUND)
        list(APPEND missing "${package} (Debian: ${debian_package}), for ${reason}")
    endif()
endmacro()

agvd_need(Eigen3 libeigen3-dev "all of it" 3.4 NO_MODULE)
if(AGVD_WITH_TBB)
    agvd_need(TBB libtbb-dev "its threads (with those of the standard library: -DAGVD_WITH_TBB=OFF)")
endif()
if(AGVD_BUILD_REMESH)
    set(otherwise "libremesh and the programs (without them: -DAGVD_BUILD_REMESH=OFF)")
    agvd_need(FastFloat libfast-float-dev "${otherwise}")
    agvd_need(nlohmann_json nlohmann-json3-dev "${otherwise}")
endif()
if(AGVD_BUILD_REMESH AND AGVD_WITH_ZLIB)
    agvd_need(ZLIB zlib1g-dev "compressed files and .3mf (without them: -DAGVD_WITH_ZLIB=OFF)")
endif()
if(AGVD_BUILD_REMESH AND AGVD_WITH_EXPAT)
    agvd_need(EXPAT libexpat1-dev "reading .vtp and .3mf (without that: -DAGVD_WITH_EXPAT=OFF)")
endif()
if(AGVD_WITH_OPENMESH)
    # CGAL brings a find module of that name.
    agvd_need(OpenMesh libopenmesh-dev
        "remesh::openmesh (without it: -DAGVD_WITH_OPENMESH=OFF)" CONFIG)
endif()
if(AGVD_WITH_CGAL)
    agvd_need(CGAL libcgal-dev
        "the exact diagrams of the paper's reproduction, and some measures (without them: -DAGVD_WITH_CGAL=OFF)" 5.5)
endif()
if(AGVD_BUILD_TOOLS)
    agvd_need(CLI11 libcli11-dev "the programs (without them: -DAGVD_BUILD_TOOLS=OFF)")
endif()
if(AGVD_BUILD_TESTS OR AGVD_BUILD_FUZZERS)
    agvd_need(GTest libgtest-dev "the tests (without them: -DAGVD_BUILD_TESTS=OFF)")
endif()

if(missing)
    list(JOIN missing "\n  " missing)
    message(FATAL_ERROR "These packages are missing:\n  ${missing}\n"
        "Install them, by hand or with scripts/setup, and configure again.")
endif()
