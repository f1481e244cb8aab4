# agvd_flags(target): the language level, warnings and sanitizers of all our targets; never global.
function(agvd_flags target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES
        UNITY_BUILD ${AGVD_UNITY} UNITY_BUILD_BATCH_SIZE 8)
    # Roots without errno or traps keep their values and are half as long. Where sizes have 32 bits, more conversions
    # change something than are worth a cast.
    target_compile_options(${target} PRIVATE
        -ffp-contract=off -fno-math-errno -fno-trapping-math -Wall -Wextra -Wshadow
        $<$<NOT:$<PLATFORM_ID:Emscripten>>:-Wconversion> $<$<BOOL:${AGVD_WERROR}>:-Werror>)
    # Vectorised, sums of three have another order. What users compile with is aligned to 16 bytes.
    target_compile_definitions(${target} PRIVATE EIGEN_DONT_VECTORIZE EIGEN_MAX_STATIC_ALIGN_BYTES=16)
    # Despite -ffp-contract=off, gcc's vectorizer fuses products and sums where the processor can.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-vectorize>)
    # Some hot loops have & and | in place of branches that could not be predicted.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>)
    # The programs and the Python module share what is compiled. In a shared library, too, calls of its own functions
    # are direct and may be inlined.
    if(NOT EMSCRIPTEN)
        set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON VISIBILITY_INLINES_HIDDEN ON)
        target_compile_options(${target} PRIVATE -fno-semantic-interposition)
    endif()
    # Files above 2 GB, and windows.h without the names that others use.
    if(WIN32)
        target_compile_definitions(${target} PRIVATE _FILE_OFFSET_BITS=64 NOMINMAX WIN32_LEAN_AND_MEAN)
    endif()
    if(AGVD_SANITIZE)
        # gcc sees uninitialised temporaries in instrumented code of the standard library. With gcc checks of null
        # pointers, alignment and object sizes double the size of the code and take a third of its compile time;
        # AddressSanitizer finds what they find but for misaligned reads, which the fuzz targets (clang) look for.
        target_compile_options(${target} PRIVATE
            $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
            -fsanitize=${AGVD_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
            $<$<CXX_COMPILER_ID:GNU>:-fno-sanitize=null,alignment,object-size>)
        target_link_options(${target} PUBLIC -fsanitize=${AGVD_SANITIZE})
    endif()
endfunction()

# agvd_less_optimized(target): for sources without hot loops. They compile in two thirds of the time. With emscripten,
# which inlines nothing with -Os before it links, they are smaller so.
function(agvd_less_optimized target)
    target_compile_options(${target} PRIVATE
        $<$<CONFIG:Release>:$<IF:$<PLATFORM_ID:Emscripten>,-Os,-O1>>)
endfunction()
