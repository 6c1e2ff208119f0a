# One place for what every target of the project shares.

# -Wrestrict is off: g++ 12 sees it in every chain of string additions (GCC bug 105651).
set(VERICONE_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND VERICONE_WARNINGS -Wno-restrict)
endif()

# ccache and mold are used where they are installed; neither is needed.
find_program(VERICONE_CCACHE ccache)
if(VERICONE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${VERICONE_CCACHE})
endif()
find_program(VERICONE_MOLD mold)
if(VERICONE_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

if(VERICONE_SANITIZE)
  add_compile_options(-fsanitize=${VERICONE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${VERICONE_SANITIZE})
endif()

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
