# `cmake --build build/release --target reference`: the C++ interface and the pages of docs as HTML with search, in
# html/ of the build folder. Only where Doxygen is installed; nothing else needs it.
find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  return()
endif()
set(DOXYGEN_PROJECT_NAME vericone)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_WARN_IF_UNDOCUMENTED NO)
set(DOXYGEN_EXTRACT_ALL YES)
set(DOXYGEN_EXTRACT_ANON_NSPACES NO)
set(DOXYGEN_HIDE_UNDOC_MEMBERS NO)
set(DOXYGEN_BUILTIN_STL_SUPPORT YES)
set(DOXYGEN_GENERATE_TREEVIEW YES)
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE README.md)
set(DOXYGEN_STRIP_FROM_INC_PATH geometry/include cones/include cones/testing/include guidance/include
  guidance/simulation/include guidance/vehicles/include guidance/swarm/include guidance/ships/include geometry/files/include geometry/octomap/include
  geometry/fitting/include geometry/lidar/include scenes/include scenes/work/include scenes/scenarios/include scenes/fit/include scenes/scan/include
  scenes/pursuits/include)
doxygen_add_docs(reference ${DOXYGEN_STRIP_FROM_INC_PATH} README.md docs/reference docs/explanation docs/howto
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} COMMENT "The C++ interface as HTML with search")
