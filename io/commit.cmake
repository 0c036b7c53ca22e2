# Writes the commit that the program is made of into HEADER, where it has changed: the last one that changed its sources,
# with "-dirty" where they differ from it; "unknown" outside git. Commits that change something else leave the program,
# and so every report, up to date.
set(git git -C ${SOURCE} -c safe.directory=* --no-optional-locks)
set(sources core scene CMakeLists.txt ":(glob)studies/**/*.cpp" ":(glob)studies/**/*.hpp" ":(glob)studies/**/CMakeLists.txt")
set(commit unknown)
execute_process(COMMAND ${git} log -1 --format=%H -- ${sources}
                RESULT_VARIABLE failed OUTPUT_VARIABLE last OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT failed AND last)
  set(commit ${last})
  execute_process(COMMAND ${git} status --porcelain --untracked-files=no -- ${sources}
                  OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    string(APPEND commit -dirty)
  endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define VLBEAM_COMMIT \"${commit}\"\n")
