# Installs a build tree, builds a project against it, moves the installed folder and does so again.
# -DBUILD_DIR -DSOURCE_DIR -DWORK_DIR -DCONFIG -DGENERATOR -DCXX_COMPILER -DCXX_FLAGS
cmake_minimum_required(VERSION 3.18)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
set(consumer "${CMAKE_CURRENT_LIST_DIR}/consumer")

function(use prefix build)
  run(${CMAKE_COMMAND} -S "${consumer}" -B "${build}" -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
      "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" "-DCMAKE_BUILD_TYPE=${CONFIG}" "-DCMAKE_PREFIX_PATH=${prefix}")
  run(${CMAKE_COMMAND} --build "${build}" --config "${CONFIG}")
  run("${build}/consumer")
  if(NOT output MATCHES "ff-lookat: Servoing")
    message(FATAL_ERROR "the consumer said: ${output}")
  endif()
  message(STATUS "from ${prefix}: ${output}")
  run("${build}/own-law" WORKING_DIRECTORY "${build}")
endfunction()

file(REMOVE_RECURSE "${WORK_DIR}")
set(first "${WORK_DIR}/first")
set(moved "${WORK_DIR}/moved to here")
run(${CMAKE_COMMAND} --install "${BUILD_DIR}" --prefix "${first}" --config "${CONFIG}")
forbid_folders("${first}" "${SOURCE_DIR}" "${BUILD_DIR}" "${WORK_DIR}")

use("${first}" "${WORK_DIR}/consumer-of-first")
file(RENAME "${first}" "${moved}")
use("${moved}" "${WORK_DIR}/consumer-of-moved")

# The same without CMake.
by_pkg_config("${moved}" "${consumer}/main.cpp" "${WORK_DIR}/consumer-of-pc")
if(built)
  run("${WORK_DIR}/consumer-of-pc")
  message(STATUS "by pkg-config: ${output}")
  unset(ENV{LD_LIBRARY_PATH})
endif()

# Programs must run from the moved folder as well: they find their libraries and data relative to themselves. The files that
# --help names are there, and none is named as it lies in the source tree.
set(data "${moved}/share/visp-direct")
file(GLOB programs "${moved}/bin/*")
set(named 0)
foreach(program ${programs})
  run("${program}" --help WORKING_DIRECTORY "${moved}/bin")
  string(REGEX REPLACE "( [\\])?[ \n]+" " " output "${output}") # long commands go on behind a backslash
  string(REPLACE "${data}/" "DATA:" output "${output}")
  if(output MATCHES "(^|[^A-Za-z0-9_-])((data|doc|apps|lab|modules|test|tutorial)/[A-Za-z0-9_./-]*)")
    message(FATAL_ERROR "${program} --help names ${CMAKE_MATCH_2}, which is not installed")
  endif()
  string(REGEX MATCHALL "DATA:[A-Za-z0-9_./-]*[A-Za-z0-9]" files "${output}")
  foreach(file ${files})
    string(REPLACE "DATA:" "${data}/" file "${file}")
    if(NOT EXISTS "${file}")
      message(FATAL_ERROR "${program} --help names ${file}, which is not installed")
    endif()
  endforeach()
  list(LENGTH files count)
  math(EXPR named "${named} + ${count}")
  message(STATUS "runs: ${program}, whose help names ${count} installed files")
endforeach()
if(programs AND named LESS 10)
  message(FATAL_ERROR "the helps name ${named} files only")
endif()

# The data are those of this installation, not of the source tree, also where the program is called by a link.
set(plan "${moved}/bin/visp-plan-trajectory")
if(EXISTS "${plan}")
  file(CREATE_LINK "${plan}" "${WORK_DIR}/plan" SYMBOLIC)
  run("${WORK_DIR}/plan" --csv sample.csv --out planned WORKING_DIRECTORY "${WORK_DIR}")
  string(FIND "${output}" "${data}/trajectory/figure-6.3.jsonl" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "not planned from the installed data: ${output}")
  endif()
endif()
