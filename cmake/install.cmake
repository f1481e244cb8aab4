# Install rules of the libraries. Components: libraries (shared ones, for running), development
# (headers, static libraries, packages of CMake and pkg-config), programs.
include(CMakePackageConfigHelpers)
set(agvd_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake)

# agvd_install_library(target package name headers...), called by agvd_library.
function(agvd_install_library target package name)
    install(TARGETS ${target} EXPORT ${target}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
            COMPONENT libraries NAMELINK_COMPONENT development
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
    install(EXPORT ${target} NAMESPACE ${package}:: FILE ${name}Targets.cmake
        DESTINATION ${agvd_cmake_dir}/${package} COMPONENT development)
    foreach(header IN LISTS ARGN)
        get_filename_component(folder ${header} DIRECTORY)
        install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder}
            COMPONENT development)
    endforeach()
endfunction()

# agvd_install_package(name): NAMEConfig.cmake, which reads the NAMETargets.cmake that are there.
function(agvd_install_package name)
    set(folder ${agvd_cmake_dir}/${name})
    configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/${name}Config.cmake.in
        ${PROJECT_BINARY_DIR}/${name}Config.cmake INSTALL_DESTINATION ${folder})
    write_basic_package_version_file(${PROJECT_BINARY_DIR}/${name}ConfigVersion.cmake
        COMPATIBILITY SameMinorVersion)
    install(FILES ${PROJECT_BINARY_DIR}/${name}Config.cmake
        ${PROJECT_BINARY_DIR}/${name}ConfigVersion.cmake
        DESTINATION ${folder} COMPONENT development)
endfunction()

# agvd_install_pkg_config(target name text REQUIRES packages... [PRIVATE packages...] [LIBS flags...]):
# NAME.pc. PRIVATE and LIBS are what a shared library loads itself; with a static one the program links them.
function(agvd_install_pkg_config target name description)
    cmake_parse_arguments(ARG "" "" "REQUIRES;PRIVATE;LIBS" ${ARGN})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL INTERFACE_LIBRARY)
        set(libs ${ARG_LIBS})
    else()
        set(libs -L\${prefix}/${CMAKE_INSTALL_LIBDIR} -l${target})
        if(type STREQUAL STATIC_LIBRARY)
            list(APPEND ARG_REQUIRES ${ARG_PRIVATE})
            list(APPEND libs ${ARG_LIBS})
        endif()
    endif()
    list(JOIN libs " " libs)
    list(JOIN ARG_REQUIRES ", " requires)
    set(folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
    file(RELATIVE_PATH to_prefix /prefix/${folder} /prefix)
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${name}.pc @ONLY CONTENT
"prefix=\${pcfiledir}/@to_prefix@
Name: @name@
Description: @description@
Version: @PROJECT_VERSION@
Requires: @requires@
Cflags: -I\${prefix}/@CMAKE_INSTALL_INCLUDEDIR@
Libs: @libs@
")
    install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${folder} COMPONENT development)
endfunction()
