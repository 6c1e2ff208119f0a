# Writes build_info.cpp when the commit, the version or the flags have changed.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE FAILED)
if(FAILED)
  set(COMMIT "unknown")
endif()
set(CONTENT "#include \"work/build_info.h\"

namespace vericone::build_info {

const char* version() { return \"${VERSION}\"; }
const char* commit() { return \"${COMMIT}\"; }
const char* flags() { return \"${FLAGS}\"; }

}  // namespace vericone::build_info
")
set(OLD "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} OLD)
endif()
if(NOT OLD STREQUAL CONTENT)
  file(WRITE ${OUTPUT} "${CONTENT}")
endif()
