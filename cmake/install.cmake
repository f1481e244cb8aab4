# Installs include/{agvd,remesh}, the libraries, lib/cmake/{agvd,remesh} and the programs.
include(CMakePackageConfigHelpers)

# agvd_package(name targets...): NAMESPACE and package name are the same.
function(agvd_package name)
    set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/${name})
    install(TARGETS ${ARGN} EXPORT ${name}Targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    install(EXPORT ${name}Targets NAMESPACE ${name}:: DESTINATION ${folder})
    configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/${name}Config.cmake.in
        ${PROJECT_BINARY_DIR}/${name}Config.cmake INSTALL_DESTINATION ${folder})
    write_basic_package_version_file(${PROJECT_BINARY_DIR}/${name}ConfigVersion.cmake
        COMPATIBILITY SameMinorVersion)
    install(FILES ${PROJECT_BINARY_DIR}/${name}Config.cmake
        ${PROJECT_BINARY_DIR}/${name}ConfigVersion.cmake DESTINATION ${folder})
endfunction()

set(oracle "")
if(TARGET agvd_oracle)
    set(oracle agvd_oracle)
endif()
agvd_package(agvd agvd ${oracle})
agvd_package(remesh remesh remesh_openmesh)
