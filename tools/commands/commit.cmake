# Writes OUTPUT, a source with the commit that SOURCE is at; leaves it alone where it says so already.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git describe --always --dirty --abbrev=12 WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT
  "#include \"tools/commands/commit.hpp\"\n\nconst char* const bladefit::kCommit = \"commit @commit@\";\n" @ONLY)
