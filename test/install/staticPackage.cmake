# Static libraries: an installation before the build says what to build; the exported targets of all modules name only what the
# package config finds; the installed and moved package links a program. With VISP_DIRECT_LONG_TESTS set this is also done
# with planar_target, which needs OpenCV, dlib and BLAS (minutes of compilation).
# -DSOURCE_DIR -DWORK_DIR -DGENERATOR -DCXX_COMPILER -DCXX_FLAGS -DLAUNCHER
cmake_minimum_required(VERSION 3.18)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

file(REMOVE_RECURSE "${WORK_DIR}")
set(settings -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}" "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}"
             "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" -DCMAKE_BUILD_TYPE=Debug)
set(libraries_only -DVISP_DIRECT_BUILD_TESTS=OFF -DVISP_DIRECT_BUILD_APPS=OFF -DVISP_DIRECT_BUILD_TUTORIALS=OFF
                   -DVISP_DIRECT_BUILD_BENCHMARKS=OFF)
set(build "${WORK_DIR}/build")
set(first "${WORK_DIR}/first")
set(moved "${WORK_DIR}/moved to here")

# All modules, not built.
run(${CMAKE_COMMAND} -S "${SOURCE_DIR}" -B "${build}" ${settings} ${libraries_only} -DBUILD_SHARED_LIBS=OFF)
execute_process(COMMAND ${CMAKE_COMMAND} --install "${build}" --prefix "${first}" RESULT_VARIABLE status OUTPUT_VARIABLE said
                ERROR_VARIABLE said)
string(REGEX REPLACE "[ \n]+" " " said "${said}")
set(sentence "of its libraries and programs [0-9]+ are not built, libvisp_direct_core.a is the first; first: cmake --build .* --target vispdirect_installable")
if(status EQUAL 0 OR EXISTS "${first}" OR NOT said MATCHES "${sentence}")
  message(FATAL_ERROR "an installation before the build ended with ${status} and said: ${said}")
endif()
file(READ "${build}/VispDirectConfig.cmake" config)
file(GLOB_RECURSE export "${build}/CMakeFiles/Export/*/VispDirectTargets.cmake")
file(READ "${export}" text)
string(REGEX MATCHALL "INTERFACE_LINK_LIBRARIES \"[^\"]*\"" lines "${text}")
string(REGEX REPLACE "INTERFACE_LINK_LIBRARIES|LINK_ONLY:|[\\$<>\"]" " " names "${lines}")
string(REGEX MATCHALL "[^; ]+" names "${names}")
list(REMOVE_DUPLICATES names)
list(LENGTH names count)
if(count LESS 10)
  message(FATAL_ERROR "only ${names} in ${export}")
endif()
foreach(name ${names})
  string(REGEX REPLACE "^VispDirect::(external_)?" "" inner "${name}")
  if(NOT name MATCHES "^(visp_|opencv_)[a-z0-9_]+$|^Eigen3::Eigen$"
     AND NOT (name MATCHES "^VispDirect::" AND config MATCHES "[\" ;]${inner}[;\") ]"))
    message(FATAL_ERROR "the exported static libraries need ${name}, which the package config does not find")
  endif()
endforeach()
message(STATUS "${count} libraries are found by the package config")

function(install_and_use modules consumer)
  file(WRITE "${WORK_DIR}/modules.cmake" "set(VISP_DIRECT_MODULES ${modules} CACHE STRING \"\" FORCE)\n")
  run(${CMAKE_COMMAND} -C "${WORK_DIR}/modules.cmake" "${build}")
  run(${CMAKE_COMMAND} --build "${build}" --target vispdirect_installable)
  run(${CMAKE_COMMAND} --install "${build}" --prefix "${first}")
  forbid_folders("${first}" "${SOURCE_DIR}" "${WORK_DIR}")
  file(REMOVE_RECURSE "${moved}")
  file(RENAME "${first}" "${moved}")
  run(${CMAKE_COMMAND} -S "${CMAKE_CURRENT_LIST_DIR}/static" -B "${WORK_DIR}/${consumer}" ${settings} "-DCMAKE_PREFIX_PATH=${moved}"
      "-DCONSUMER=${consumer}")
  run(${CMAKE_COMMAND} --build "${WORK_DIR}/${consumer}")
  run("${WORK_DIR}/${consumer}/${consumer}" "${moved}/share/visp-direct")
  message(STATUS "by CMake: ${output}")
  by_pkg_config("${moved}" "${CMAKE_CURRENT_LIST_DIR}/static/${consumer}.cpp" "${WORK_DIR}/${consumer}-of-pc")
  if(built)
    run("${WORK_DIR}/${consumer}-of-pc" "${moved}/share/visp-direct")
    message(STATUS "by pkg-config: ${output}")
  endif()
endfunction()

install_and_use("direct_core" core)
if(DEFINED ENV{VISP_DIRECT_LONG_TESTS})
  install_and_use("direct_core planar_target" targets)
endif()
