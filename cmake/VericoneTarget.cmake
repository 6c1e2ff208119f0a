# One place for what every target of the project shares.

# A double that silently became an integer has made an enclosure wrong once: that does not compile.
# Three are off: g++ 12 sees them in every chain of string additions (GCC bug 105651).
set(VERICONE_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror=float-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND VERICONE_WARNINGS -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds)
endif()

# ccache and mold are used where they are installed; neither is needed. ccache keeps what is compiled with a
# precompiled header only when told that the macros it was made with do not change behind its back.
set(begun OFF)
if(NOT DEFINED CACHE{VERICONE_CCACHE})
  set(begun ON)
endif()
find_program(VERICONE_CCACHE ccache)
set(launcher "")
if(VERICONE_CCACHE)
  list(APPEND launcher CCACHE_SLOPPINESS=pch_defines,time_macros ${VERICONE_CCACHE})
endif()
# On huge pages g++ takes a seventh less time; many kernels give them only to those who ask. Precompiled headers, of which
# each process maps 150 to 280 MB, take a third of the time when they are read into such pages (docs/howto/building.md).
# A folder keeps what it was begun with, since another launcher makes all of it anew.
if(NOT DEFINED CACHE{VERICONE_HUGE_PAGES})
  set(policy "")
  if(EXISTS /sys/kernel/mm/transparent_hugepage/enabled)
    file(READ /sys/kernel/mm/transparent_hugepage/enabled policy)
  endif()
  set(ask OFF)
  if((policy MATCHES "\\[madvise\\]" OR (policy MATCHES "\\[always\\]" AND begun)) AND CMAKE_SIZEOF_VOID_P EQUAL 8
     AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_CROSSCOMPILING)
    set(ask ON)
  endif()
  set(VERICONE_HUGE_PAGES ${ask} CACHE BOOL "The compiler asks for huge pages (cmake/huge_pages.c)")
endif()
if(VERICONE_HUGE_PAGES)
  set(pages ${PROJECT_BINARY_DIR}/huge_pages.so)
  execute_process(COMMAND ${CMAKE_C_COMPILER} -O2 -shared -fPIC -o ${pages} ${CMAKE_CURRENT_LIST_DIR}/huge_pages.c
    RESULT_VARIABLE unmade ERROR_QUIET)
  if(NOT unmade)
    list(PREPEND launcher LD_PRELOAD=${pages} GLIBC_TUNABLES=glibc.malloc.hugetlb=1)
  endif()
endif()
if(launcher AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env ${launcher})
endif()
find_program(VERICONE_MOLD mold)
if(VERICONE_MOLD AND NOT CMAKE_CROSSCOMPILING)
  add_link_options(-fuse-ld=mold)
endif()

if(VERICONE_SANITIZE)
  add_compile_options(-fsanitize=${VERICONE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_compile_definitions(_GLIBCXX_ASSERTIONS)  # what no sanitizer sees: an empty optional read, an index past a span
  add_link_options(-fsanitize=${VERICONE_SANITIZE})
endif()

# One position-independent code for libraries and programs, so that they share precompiled headers.
set(CMAKE_POSITION_INDEPENDENT_CODE OFF)
if(NOT EMSCRIPTEN)
  add_compile_options(-fPIC)
endif()

# g++ collects garbage whenever its heap has doubled; from 400 MB on is early enough, and saves 9 % of its time.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options("SHELL:--param ggc-min-heapsize=400000")
endif()
if(VERICONE_PCH AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(-fpch-preprocess)  # for ccache
endif()
if(VERICONE_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # A type of an unnamed namespace in a source is no danger when that source is included into another.
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
endif()

# vericone_precompile(TARGET SET): the target's sources start with the precompiled header cmake/precompiled/SET.h, which is
# made once for all targets that ask for it (docs/howto/building.md has what each set brings): exact for libraries, json for
# programs, tests.
function(vericone_precompile target set)
  if(NOT VERICONE_PCH)
    return()
  endif()
  if(NOT TARGET vericone_precompiled_${set})
    file(WRITE ${PROJECT_BINARY_DIR}/precompiled/${set}.cpp "")
    add_library(vericone_precompiled_${set} OBJECT ${PROJECT_BINARY_DIR}/precompiled/${set}.cpp)
    target_compile_features(vericone_precompiled_${set} PRIVATE cxx_std_20)
    # The warnings too: -Wpedantic takes away a macro that the header would remember.
    target_compile_options(vericone_precompiled_${set} PRIVATE -ffp-contract=off ${VERICONE_WARNINGS})
    target_link_libraries(vericone_precompiled_${set} PRIVATE Eigen3::Eigen Boost::boost)
    if(ARGN)
      target_link_libraries(vericone_precompiled_${set} PRIVATE ${ARGN})
    endif()
    target_precompile_headers(vericone_precompiled_${set} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled/${set}.h)
  endif()
  target_precompile_headers(${target} REUSE_FROM vericone_precompiled_${set})
endfunction()

# vericone_small_heap(TARGET): g++ collects its garbage often. CGAL's mesh sections take 1.0 GB instead of 1.5, at no cost in
# time; small units gain from the opposite.
function(vericone_small_heap target)
  target_compile_options(${target} PRIVATE
    "$<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=60000;--param=ggc-min-expand=15>")
endfunction()

# vericone_unity(TARGET N): compiles N sources at once. A source of large cost, or with macros or flags of its own, stays
# apart by its property SKIP_UNITY_BUILD_INCLUSION.
function(vericone_unity target batch)
  if(VERICONE_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch})
  endif()
endfunction()

# Adds the library vericone::NAME from SOURCES, with its headers under include/vericone/.
# Contraction of a*b+c to a fused operation is off for the library and for all who use its headers:
# the error bounds of the predicates count every rounding.
function(vericone_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(vericone_${name} STATIC ${ARG_SOURCES})
  add_library(vericone::${name} ALIAS vericone_${name})
  set_target_properties(vericone_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(vericone_${name} PUBLIC cxx_std_20)
  target_compile_options(vericone_${name} PUBLIC -ffp-contract=off PRIVATE ${VERICONE_WARNINGS})
  if(VERICONE_COUNT_RUNGS)
    target_compile_definitions(vericone_${name} PUBLIC VERICONE_COUNT_RUNGS)
  endif()
  target_include_directories(vericone_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(vericone_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  install(TARGETS vericone_${name} EXPORT vericone-${name}-targets)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  set_property(GLOBAL APPEND PROPERTY VERICONE_COMPONENTS ${name})
endfunction()

function(vericone_install_package)
  get_property(VERICONE_COMPONENTS GLOBAL PROPERTY VERICONE_COMPONENTS)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/vericone-config.cmake.in
    ${PROJECT_BINARY_DIR}/vericone-config.cmake
    INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vericone)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/vericone-config-version.cmake
    COMPATIBILITY SameMinorVersion)
  foreach(name IN LISTS VERICONE_COMPONENTS)
    install(EXPORT vericone-${name}-targets NAMESPACE vericone::
      DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vericone)
  endforeach()
  install(FILES ${PROJECT_BINARY_DIR}/vericone-config.cmake
    ${PROJECT_BINARY_DIR}/vericone-config-version.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vericone)
endfunction()
