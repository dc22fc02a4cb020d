# Several tests as one source: cmake -DOUTPUT=FILE "-DSOURCES=a.cpp;b.cpp" -P uniteTests.cmake
# First the headers of all, then each source in a namespace of its own, so that names of two tests never meet.
cmake_minimum_required(VERSION 3.18)
set(headers "")
set(tests "")
foreach(source ${SOURCES})
  file(STRINGS "${source}" lines REGEX "^#include ")
  list(APPEND headers ${lines})
  get_filename_component(name "${source}" NAME_WE)
  string(APPEND tests "\nnamespace ${name}\n{\n#include \"${source}\"\n}\n")
endforeach()
list(REMOVE_DUPLICATES headers)
list(JOIN headers "\n" headers)
file(WRITE "${OUTPUT}" "${headers}\n${tests}")
