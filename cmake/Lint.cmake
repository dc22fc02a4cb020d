# Targets that look at the style of the sources without building anything; scripts/lint.sh does the work.
foreach(check format tidy)
  add_custom_target(${check}-check COMMAND "${PROJECT_SOURCE_DIR}/scripts/lint.sh" ${check} USES_TERMINAL VERBATIM)
endforeach()
