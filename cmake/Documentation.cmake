# The documentation: target `doc`, into doc/html of the build folder, and the test `documentation`, which builds it and fails
# on any warning and any class without a group. Links are the matter of the test `pages`.
find_package(Doxygen QUIET)
find_program(VISP_DIRECT_BIBTEX bibtex)
find_program(VISP_DIRECT_DOC_PYTHON python3)
mark_as_advanced(VISP_DIRECT_BIBTEX VISP_DIRECT_DOC_PYTHON)
if(NOT DOXYGEN_FOUND OR NOT VISP_DIRECT_BIBTEX OR NOT VISP_DIRECT_DOC_PYTHON)
  message(STATUS "visp-direct: the documentation is not built, doxygen, bibtex (texlive-binaries) or python3 is missing")
  return()
endif()

# vispdirect_quoted(OUT FILE...): a list in Doxyfile syntax.
function(vispdirect_quoted out)
  list(TRANSFORM ARGN REPLACE "(.+)" "\"\\1\"")
  list(JOIN ARGN " " quoted)
  set(${out} "${quoted}" PARENT_SCOPE)
endfunction()

# Debian's doxygen-awesome-css makes the pages readable on a phone; without it they are in doxygen's own style.
set(styles "${PROJECT_SOURCE_DIR}/doc/style.css")
find_file(VISP_DIRECT_DOC_THEME doxygen-awesome.css PATH_SUFFIXES doxygen-awesome-css PATHS /usr/share)
mark_as_advanced(VISP_DIRECT_DOC_THEME)
if(VISP_DIRECT_DOC_THEME)
  list(PREPEND styles "${VISP_DIRECT_DOC_THEME}")
endif()
vispdirect_quoted(DOC_STYLES ${styles})
set(PROJECT_NAME_SHOWN visp-direct)
set(DOC_OUTPUT "${PROJECT_BINARY_DIR}/doc")
file(GLOB folders CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/modules/*/include")
vispdirect_quoted(DOC_INCLUDE_FOLDERS ${folders})
configure_file("${PROJECT_SOURCE_DIR}/doc/Doxyfile.in" "${DOC_OUTPUT}/Doxyfile" @ONLY)

set(command ${CMAKE_COMMAND} "-DDOXYGEN=${DOXYGEN_EXECUTABLE}" "-DSOURCE_DIR=${PROJECT_SOURCE_DIR}" "-DDOC_DIR=${DOC_OUTPUT}"
            -P "${PROJECT_SOURCE_DIR}/doc/build.cmake")
add_custom_target(doc COMMAND ${command} USES_TERMINAL VERBATIM)
if(BUILD_TESTS)
  add_test(NAME documentation COMMAND ${command})
  set_tests_properties(documentation PROPERTIES LABELS doc)
endif()
