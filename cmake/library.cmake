# agvd_library(target package name HEADERS files... SOURCES files...): a library of ours, which others
# link as package::name. HEADERS are the public ones; paths start at the library's folder. Without
# sources it is an interface.
function(agvd_library target package name)
    cmake_parse_arguments(ARG "" "" "HEADERS;SOURCES" ${ARGN})
    if(ARG_SOURCES)
        set(scope PUBLIC)
        add_library(${target} ${ARG_SOURCES})
        agvd_flags(${target})
    else()
        set(scope INTERFACE)
        add_library(${target} INTERFACE)
    endif()
    add_library(${package}::${name} ALIAS ${target})
    target_include_directories(${target} ${scope}
        $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}>
        $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    if(BUILD_SHARED_LIBS AND ARG_SOURCES)
        agvd_shared_library(${target})
    endif()
    if(AGVD_INSTALL)
        agvd_install_library(${target} ${package} ${name} ${ARG_HEADERS})
    endif()
    if(AGVD_BUILD_TESTS)
        agvd_check_headers(${target} ${ARG_HEADERS})
    endif()
endfunction()

# A shared library exports the names of our namespaces and no others, and finds its neighbours.
function(agvd_shared_library target)
    set(exports ${PROJECT_SOURCE_DIR}/cmake/exports.map)
    set_target_properties(${target} PROPERTIES
        VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
        LINK_DEPENDS ${exports} INSTALL_RPATH $ORIGIN)
    target_link_options(${target} PRIVATE LINKER:--version-script=${exports})
endfunction()

# The target check_headers compiles each public header alone.
function(agvd_check_headers target)
    if(NOT TARGET check_headers)
        add_custom_target(check_headers)
    endif()
    set(sources "")
    foreach(header IN LISTS ARGN)
        set(source ${CMAKE_CURRENT_BINARY_DIR}/headers/${header}.cpp)
        file(CONFIGURE OUTPUT ${source} CONTENT "#include <${header}>\n" @ONLY)
        list(APPEND sources ${source})
    endforeach()
    add_library(${target}_headers OBJECT EXCLUDE_FROM_ALL ${sources})
    agvd_flags(${target}_headers)
    set_target_properties(${target}_headers PROPERTIES UNITY_BUILD OFF)
    target_link_libraries(${target}_headers PRIVATE ${target})
    add_dependencies(check_headers ${target}_headers)
endfunction()
