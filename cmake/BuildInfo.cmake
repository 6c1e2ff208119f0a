# Writes build_info.h when the commit, the version or the flags have changed.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE FAILED)
if(FAILED)
  set(COMMIT "unknown")
endif()
set(CONTENT "#pragma once\n#define VERICONE_COMMIT \"${COMMIT}\"\n#define VERICONE_VERSION \"${VERSION}\"\n#define VERICONE_FLAGS \"${FLAGS}\"\n")
set(OLD "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} OLD)
endif()
if(NOT OLD STREQUAL CONTENT)
  file(WRITE ${OUTPUT} "${CONTENT}")
endif()
