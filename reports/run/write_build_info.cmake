# Run at every build: writes build_info.hpp with the commit as it is now, and only when it has changed.
execute_process(COMMAND git -C ${SOURCE_DIR} rev-parse HEAD
  OUTPUT_VARIABLE CBC3D_GIT_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE no_git)
execute_process(COMMAND git -C ${SOURCE_DIR} show --no-patch --format=%cI HEAD
  OUTPUT_VARIABLE CBC3D_GIT_COMMIT_DATE OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
execute_process(COMMAND git -C ${SOURCE_DIR} status --porcelain --untracked-files=no
  OUTPUT_VARIABLE changes ERROR_QUIET)
set(CBC3D_GIT_DIRTY false)
if(changes)
  set(CBC3D_GIT_DIRTY true)
endif()
if(no_git OR NOT CBC3D_GIT_COMMIT)
  set(CBC3D_GIT_COMMIT unknown)
  set(CBC3D_GIT_COMMIT_DATE unknown)
endif()
configure_file(${SOURCE_DIR}/reports/run/build_info.hpp.in ${OUTPUT} @ONLY)
