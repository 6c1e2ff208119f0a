# options_probe for another machine, without CGAL: the corpus alone of verify/. scripts/machines compares what it prints with
# what this machine's prints.
file(GLOB corpus ${PROJECT_SOURCE_DIR}/verify/src/corpus/*.cpp)
add_executable(options_probe verify/corpus/options_probe.cpp verify/corpus/corpus_answers.cpp
  verify/corpus/random_answers.cpp ${corpus})
target_include_directories(options_probe PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/verify/include
  ${PROJECT_SOURCE_DIR}/verify/src)
target_link_libraries(options_probe PRIVATE vericone::cones)
vericone_precompile(options_probe exact)
add_dependencies(vericone_tests options_probe)
