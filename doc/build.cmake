# Builds the documentation and adds checks that doxygen lacks:
# cmake -DDOXYGEN=... -DSOURCE_DIR=... -DDOC_DIR=... -P build.cmake
cmake_minimum_required(VERSION 3.18)
set(faults "")

file(REMOVE_RECURSE "${DOC_DIR}/html" "${DOC_DIR}/visp-direct.tag")
set(ENV{BSTINPUTS} .) # search path of bibtex, which is not set without the rest of TeX
set(ENV{BIBINPUTS} .)
execute_process(COMMAND "${DOXYGEN}" "${DOC_DIR}/Doxyfile" WORKING_DIRECTORY "${SOURCE_DIR}" OUTPUT_VARIABLE said ERROR_VARIABLE said
                RESULT_VARIABLE status)
if(NOT status EQUAL 0 OR said MATCHES "(warning|error): ")
  list(APPEND faults "doxygen ended with status ${status} and said:\n${said}")
endif()

# The 3D views of the gallery, where there are any.
file(GLOB views "${SOURCE_DIR}/out/gallery/live/*.html")
foreach(view ${views})
  get_filename_component(name "${view}" NAME)
  configure_file("${view}" "${DOC_DIR}/html/live-${name}" COPYONLY)
endforeach()

# Classes and namespaces that belong to no module. Doxygen silently omits a namespace without a docstring.
if(EXISTS "${DOC_DIR}/visp-direct.tag")
  file(READ "${DOC_DIR}/visp-direct.tag" tags)
  string(REGEX REPLACE "[][;]" "," tags "${tags}")
  string(REPLACE "</compound>" ";" groups "${tags}")
  list(FILTER groups INCLUDE REGEX "<compound kind=\"group\">")
  file(GLOB headers "${SOURCE_DIR}/modules/*/include/visp3/*/*.h")
  set(names "")
  foreach(header ${headers})
    file(STRINGS "${header}" found REGEX "^(template <.*> )?(class|struct|namespace) ([A-Z_]+ )?vp[A-Za-z0-9]+( final)?( : .*| {)?$")
    list(TRANSFORM found REPLACE "^.*(class|struct|namespace) ([A-Z_]+ )?(vp[A-Za-z0-9]+).*$" "\\3")
    list(APPEND names ${found})
  endforeach()
  list(REMOVE_DUPLICATES names)
  foreach(name ${names})
    if(NOT groups MATCHES "<(class kind=\"class\"|class kind=\"struct\"|namespace)>${name}</")
      list(APPEND faults "${name} has no docstring with \\ingroup group_<module>")
    endif()
  endforeach()
  list(LENGTH names count)
endif()

if(faults)
  list(JOIN faults "\n" faults)
  message("${faults}")
  message(FATAL_ERROR "The documentation has faults.")
endif()
message(STATUS "${DOC_DIR}/html/index.html: ${count} classes and namespaces, no warnings")
