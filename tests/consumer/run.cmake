# cmake -D BUILD_DIR=... -D SOURCE_DIR=... -D WORK_DIR=... -D COMPONENTS=... [-D CGAL=ON] [-D CXX=...] -P run.cmake
# Installs the build to a fresh prefix, builds the examples of the documents against it, runs them.
function(run)
    execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE output)
    set(output "${output}" PARENT_SCOPE)
endfunction()

# The documents show the sources as they are.
function(check_document document source)
    file(READ ${CMAKE_CURRENT_LIST_DIR}/${source} example)
    file(READ ${SOURCE_DIR}/${document} text)
    string(FIND "${text}" "```cpp\n${example}```" position)
    if(position EQUAL -1)
        message(FATAL_ERROR "${document} does not show tests/consumer/${source} as it is")
    endif()
endfunction()
check_document(README.md main.cpp)
foreach(name IN ITEMS convert eigen spans openmesh cgal diagram stopping_rule files)
    check_document(docs/library.md ${name}.cpp)
endforeach()
check_document(docs/switching.md from_cgal.cpp)

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)

# Every installed header must compile with nothing but what is installed.
file(GLOB_RECURSE headers RELATIVE ${WORK_DIR}/prefix/include ${WORK_DIR}/prefix/include/*.h)
list(TRANSFORM headers REPLACE "(.+)" "#include <\\1>")
list(JOIN headers "\n" includes)
file(WRITE ${WORK_DIR}/headers.cpp "${includes}\n")

run(${CMAKE_COMMAND} -G Ninja -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK_DIR}/build
    -D CMAKE_PREFIX_PATH=${WORK_DIR}/prefix -D CMAKE_CXX_COMPILER=${CXX}
    -D CONSUMER_COMPONENTS=${COMPONENTS} -D CONSUMER_CGAL=${CGAL} -D EXTRA_SOURCES=${WORK_DIR}/headers.cpp)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/consumer)
if(NOT output MATCHES "v [^\n]+\nf [0-9]+ [0-9]+ [0-9]+\n")
    message(FATAL_ERROR "no mesh came out:\n${output}")
endif()
set(examples eigen spans diagram stopping_rule)
if(COMPONENTS MATCHES openmesh)
    list(APPEND examples openmesh)
endif()
if(CGAL)
    run(${CMAKE_COMMAND} --build ${WORK_DIR}/build --target from_cgal)
    list(APPEND examples cgal from_cgal)
endif()
foreach(name IN LISTS examples)
    run(${WORK_DIR}/build/${name})
endforeach()

set(files ${WORK_DIR}/out.ply ${WORK_DIR}/plain.obj)
run(${WORK_DIR}/build/files ${SOURCE_DIR}/data/ring.obj ${files})
file(STRINGS ${WORK_DIR}/out.ply texture REGEX "texcoord")
if(NOT texture OR NOT EXISTS ${WORK_DIR}/plain.obj)
    message(FATAL_ERROR "the example files wrote no texture coordinates, or no plain.obj")
endif()

run(${WORK_DIR}/build/convert ${WORK_DIR}/plain.obj ${WORK_DIR}/plain.stl)
if(NOT EXISTS ${WORK_DIR}/plain.stl)
    message(FATAL_ERROR "the example convert wrote no plain.stl")
endif()

# The documents, with the pictures that they show.
foreach(folder IN ITEMS remesh libremesh-dev)
    foreach(document IN ITEMS README.md docs/library.md docs/cells.png)
        if(NOT EXISTS ${WORK_DIR}/prefix/share/doc/${folder}/${document})
            message(FATAL_ERROR "share/doc/${folder}/${document} is not installed")
        endif()
    endforeach()
endforeach()

# The same project with the sources inside it; that it configures is enough. scripts/check-install
# builds it. That there is no build type is told, and the sources are compiled in batches.
execute_process(COMMAND ${CMAKE_COMMAND} -G Ninja -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK_DIR}/embedded
    -D CMAKE_CXX_COMPILER=${CXX} -D REMESH_SOURCE_DIR=${SOURCE_DIR}
    COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET ERROR_VARIABLE told)
if(NOT told MATCHES "there is no build type")
    message(FATAL_ERROR "a missing build type is not told:\n${told}")
endif()
run(${CMAKE_COMMAND} --build ${WORK_DIR}/embedded -- -n)
string(REGEX MATCHALL "Building CXX object remesh" steps "${output}")
list(LENGTH steps num_steps)
if(num_steps EQUAL 0 OR num_steps GREATER 50)
    message(FATAL_ERROR "${num_steps} sources of the libraries are compiled, not in batches")
endif()
