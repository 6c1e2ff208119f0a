# Equal answers with other compiler options: the same program twice, with the library's own predicates in one, with their
# sources compiled again in the other: little optimised, for this machine, whose fused operations are then at hand. Two
# units (one would take more than 30 s). What the
# predicates need besides comes from the libraries, whose matrices the option of the alignment makes the same: with
# -march=native Eigen would align them otherwise.
add_executable(options_probe corpus/options_probe.cpp corpus/corpus_answers.cpp corpus/random_answers.cpp)
target_link_libraries(options_probe PRIVATE vericone::verify vericone::cones)
vericone_precompile(options_probe exact)
vericone_unity(options_probe 2)
set(options_probes options_probe)

set(probe_geometry exact/algebraic quadric_side)
set(probe_cones ellipsoids/contact_frame ellipsoids/contact_polynomial ellipsoids/relation ellipsoids/cone_oracle planar/sector_oracle
  ellipsoids/containment ellipsoids/position opening/orifice hulls/oracle hulls/certificates hulls/exact hulls/scene)
set(probe_sources corpus/options_probe.cpp corpus/corpus_answers.cpp corpus/random_answers.cpp)
foreach(library geometry cones)
  foreach(source IN LISTS probe_${library})
    list(APPEND probe_sources ${PROJECT_SOURCE_DIR}/${library}/src/${source}.cpp)
  endforeach()
endforeach()
function(vericone_options_probe name)
  add_executable(${name} ${probe_sources})
  set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/cones/src)
  target_compile_definitions(${name} PRIVATE EIGEN_MAX_STATIC_ALIGN_BYTES=16)
  # g++ says so of types of a file that is included, which every file of a unit is.
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage> ${ARGN})
  target_link_libraries(${name} PRIVATE vericone::verify vericone::cones)
  # A unit of the libraries may hold a predicate beside what is needed of it: the program's own comes first.
  target_link_options(${name} PRIVATE LINKER:--allow-multiple-definition)
  set(options_probes ${options_probes} ${name} PARENT_SCOPE)
endfunction()
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-march=native VERICONE_HAVE_MARCH_NATIVE)
if(VERICONE_HAVE_MARCH_NATIVE)
  vericone_options_probe(options_probe_native -O1 -march=native)
else()
  vericone_options_probe(options_probe_O0 -O0)
endif()
target_include_directories(options_probe PRIVATE ${PROJECT_SOURCE_DIR}/tests)
list(TRANSFORM options_probes REPLACE "(.+)" "\"$<TARGET_FILE:\\1>\"" OUTPUT_VARIABLE probe_files)
list(GET probe_files 0 probe_first)
list(JOIN probe_files "," probe_files)
target_sources(test_verify PRIVATE corpus/options_test.cpp)
add_dependencies(vericone_tests ${options_probes})
target_compile_definitions(test_verify PRIVATE VERICONE_OPTIONS_PROBE=${probe_first}
  "VERICONE_OPTIONS_PROBES=${probe_files}")
