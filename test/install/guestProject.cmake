# Builds a project that adds this repository as a subfolder (with static libraries, CMake's default); the project itself
# checks what the guest changes. -DSOURCE_DIR -DWORK_DIR -DGENERATOR -DCXX_COMPILER -DCXX_FLAGS -DLAUNCHER
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

file(REMOVE_RECURSE "${WORK_DIR}")
set(settings -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}" "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}"
             "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" "-DVISP_DIRECT_SOURCE_DIR=${SOURCE_DIR}")
set(build "${WORK_DIR}/build")
run(${CMAKE_COMMAND} -S "${CMAKE_CURRENT_LIST_DIR}/guest" -B "${build}" ${settings})
file(STRINGS "${build}/CMakeCache.txt" type REGEX "^CMAKE_BUILD_TYPE:")
if(NOT type MATCHES "^CMAKE_BUILD_TYPE:STRING=$")
  message(FATAL_ERROR "the build type of the host is ${type}")
endif()
run(${CMAKE_COMMAND} --build "${build}")
run("${build}/host")
if(NOT output MATCHES "^host: ff-lookat")
  message(FATAL_ERROR "the host said: ${output}")
endif()
message(STATUS "${output}")

# The host installs itself and nothing of the guest.
run(${CMAKE_COMMAND} --install "${build}" --prefix "${WORK_DIR}/prefix")
file(GLOB_RECURSE files RELATIVE "${WORK_DIR}/prefix" "${WORK_DIR}/prefix/*")
if(NOT files STREQUAL "bin/host")
  message(FATAL_ERROR "the host installs ${files}")
endif()
