# The viewer of report pages: TypeScript, bundled by node when the programs are built. Where node or
# npm is missing, or the parts from npm cannot be fetched, the programs are built without it.
#
# agvd_add_viewer(target): adds the viewer of pages to a target, or what stands for it.
# agvd_find_viewer(variable): true if tools/viewer can be built. Fetches its parts once: npm ci.
function(agvd_find_viewer variable)
    set(${variable} OFF PARENT_SCOPE)
    find_program(AGVD_NODE NAMES node nodejs)
    find_program(AGVD_NPM npm)
    set(without "the programs are built without --html; see docs/contributing.md")
    if(NOT AGVD_NODE OR NOT AGVD_NPM)
        message(STATUS "node and npm (Debian: nodejs npm) were not found: ${without}")
        return()
    endif()
    set(viewer ${PROJECT_SOURCE_DIR}/tools/viewer)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${viewer}/package-lock.json)
    set(fetched ${viewer}/node_modules/.package-lock.json)
    if(NOT ${viewer}/package-lock.json IS_NEWER_THAN ${fetched})
        set(${variable} ON PARENT_SCOPE)
        return()
    endif()
    message(STATUS "Fetching the parts of the viewer: npm ci in tools/viewer")
    execute_process(COMMAND ${AGVD_NPM} ci WORKING_DIRECTORY ${viewer}
        RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output TIMEOUT 300)
    if(NOT code EQUAL 0)
        message(WARNING "npm ci failed in tools/viewer, so ${without}\n${output}")
        return()
    endif()
    file(TOUCH ${fetched})
    set(${variable} ON PARENT_SCOPE)
endfunction()

function(agvd_add_viewer target)
    set(folder ${PROJECT_SOURCE_DIR}/tools)
    if(NOT has_viewer)
        target_sources(${target} PRIVATE ${folder}/page/without_viewer.cpp)
        return()
    endif()
    set(viewer ${folder}/viewer)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/viewer_parts.cpp)
    file(GLOB files CONFIGURE_DEPENDS ${viewer}/src/*)
    add_custom_command(OUTPUT ${source}
        COMMAND ${AGVD_NODE} ${viewer}/build.mjs ${source}
        DEPENDS ${viewer}/build.mjs ${viewer}/package-lock.json ${files})
    target_sources(${target} PRIVATE ${source})
endfunction()
