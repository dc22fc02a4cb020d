# Targets that check the style of the sources without building anything, by scripts/lint.sh.
foreach(check format tidy)
  add_custom_target(${check}-check COMMAND "${PROJECT_SOURCE_DIR}/scripts/lint.sh" ${check} USES_TERMINAL VERBATIM)
endforeach()
