# Installs a build tree, builds a project against it, moves the installed folder and does so again.
# -DBUILD_DIR -DSOURCE_DIR -DWORK_DIR -DCONFIG -DGENERATOR -DCXX_COMPILER -DCXX_FLAGS
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

# Nothing of this machine may be written into what is installed.
file(GLOB_RECURSE texts "${first}/*.cmake" "${first}/*.h")
foreach(text ${texts})
  file(READ "${text}" content)
  foreach(folder "${SOURCE_DIR}" "${BUILD_DIR}" "${WORK_DIR}")
    string(FIND "${content}" "${folder}" place)
    if(NOT place EQUAL -1)
      message(FATAL_ERROR "${text} names the folder ${folder}")
    endif()
  endforeach()
endforeach()

use("${first}" "${WORK_DIR}/consumer-of-first")
file(RENAME "${first}" "${moved}")
use("${moved}" "${WORK_DIR}/consumer-of-moved")

# Programs must run from the moved folder as well: their libraries are found relative to them.
file(GLOB programs "${moved}/bin/*")
foreach(program ${programs})
  run("${program}" --help)
  message(STATUS "runs: ${program}")
endforeach()
