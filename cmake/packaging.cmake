# What is installed besides libraries and programs, and the Debian packages (cpack -G DEB).
agvd_install_package(agvd)
agvd_install_pkg_config(agvd agvd "Geodesic Voronoi diagrams of triangle meshes"
    REQUIRES "eigen3 >= 3.4" PRIVATE tbb)
if(AGVD_WITH_CGAL)
    set(gmp -lgmp)
endif()
if(AGVD_BUILD_REMESH AND AGVD_WITH_ZLIB)
    set(zlib -lz)
endif()
if(AGVD_BUILD_REMESH AND AGVD_WITH_EXPAT)
    set(expat -lexpat)
endif()
if(AGVD_BUILD_REMESH)
    agvd_install_package(remesh)
    agvd_install_pkg_config(remesh_meshfile remesh-meshfile "Files of triangle meshes"
        REQUIRES agvd LIBS ${zlib} ${expat})
    agvd_install_pkg_config(remesh remesh "Remeshing of triangle surfaces by geodesic Voronoi diagrams"
        REQUIRES remesh-meshfile LIBS ${gmp})
endif()
if(AGVD_WITH_OPENMESH)
    agvd_install_pkg_config(remesh_openmesh remesh-openmesh "Exchange of meshes with OpenMesh"
        REQUIRES remesh LIBS -lOpenMeshCore)
endif()

# The documents go with both components, as one may be installed without the other; the C++ reference,
# if scripts/check-docs has made it, with the libraries.
function(agvd_install_documents folder component)
    set(target ${CMAKE_INSTALL_DATAROOTDIR}/doc/${folder})
    install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${target} COMPONENT ${component})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${target} COMPONENT ${component}
        FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg" PATTERN "*.bib")
endfunction()
agvd_install_documents(libremesh-dev development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/reference/html OPTIONAL COMPONENT development
    DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/libremesh-dev)
if(AGVD_BUILD_TOOLS)
    agvd_install_documents(remesh programs)
endif()

# The licence goes with each component, as each may be a package of its own.
set(copyright ${PROJECT_BINARY_DIR}/copyright)
file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
if(AGVD_WITH_CGAL)
    string(APPEND licence "
The libraries and programs of this build contain parts of CGAL, which are under the GNU General Public
License, version 3 or later, and so are they as a whole. See https://www.gnu.org/licenses/gpl-3.0.html.
")
endif()
file(CONFIGURE OUTPUT ${copyright} CONTENT "${licence}" @ONLY)
install(FILES ${copyright} DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/libremesh-dev
    COMPONENT development)
if(AGVD_BUILD_TOOLS)
    install(FILES ${copyright} DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/remesh
        COMPONENT programs)
endif()
if(AGVD_BUILD_PYTHON)
    install(FILES ${copyright} DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/python3-remesh
        COMPONENT python)
endif()
if(BUILD_SHARED_LIBS)
    install(FILES ${copyright} DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/libremesh
        COMPONENT libraries)
endif()

# Debian packages of a static build: the programs, and what developers need.
if(top_level AND NOT BUILD_SHARED_LIBS)
    set(CPACK_GENERATOR DEB)
    set(CPACK_PACKAGE_CONTACT "the remesh authors <remesh@localhost>")
    set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
    set(CPACK_STRIP_FILES ON)
    set(CPACK_DEB_COMPONENT_INSTALL ON)
    set(CPACK_COMPONENTS_ALL development)
    set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
    set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libremesh-dev)
    set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
    set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4), libtbb-dev")
    set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Remeshing by geodesic Voronoi diagrams: libraries and headers")
    if(AGVD_WITH_CGAL)
        string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libgmp-dev")
    endif()
    if(AGVD_WITH_ZLIB)
        string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", zlib1g-dev")
    endif()
    if(AGVD_WITH_EXPAT)
        string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libexpat1-dev")
    endif()
    if(AGVD_WITH_OPENMESH)
        set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS libopenmesh-dev)
    endif()
    if(AGVD_BUILD_TOOLS)
        list(APPEND CPACK_COMPONENTS_ALL programs)
        set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME remesh)
        set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION graphics)
        set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
        set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "Remeshing by geodesic Voronoi diagrams: programs")
    endif()
    if(AGVD_BUILD_PYTHON)
        list(APPEND CPACK_COMPONENTS_ALL python)
        math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
        set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-remesh)
        set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
        set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
        set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), python3-numpy")
        set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Remeshing by geodesic Voronoi diagrams: Python module")
    endif()
    include(CPack)
endif()
