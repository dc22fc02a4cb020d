# Optional libraries. Each is searched in every configuration, unless WITH_<NAME>=OFF (VISP_DIRECT_WITH_<NAME>=OFF), and sets VISP_DIRECT_HAVE_<NAME>,
# VISP_DIRECT_<NAME>_INCLUDES and VISP_DIRECT_<NAME>_LIBRARIES, once for all components.
# Without one, code that needs it throws vpException::notImplementedError and names it (sources *Missing.cpp).
# Found by path where a package's own target or variable cannot be used inside a ViSP tree.

# vispdirect_optional(NAME PURPOSE INCLUDES LIBRARIES): from the results of find_path() and find_library().
function(vispdirect_optional name purpose includes libraries)
  option(VISP_DIRECT_WITH_${name} "Use ${name}: ${purpose}" ON)
  if(DEFINED WITH_${name}) # the short form, on the command line
    set(VISP_DIRECT_WITH_${name} ${WITH_${name}} CACHE BOOL "Use ${name}: ${purpose}" FORCE)
  endif()
  set(have ${VISP_DIRECT_WITH_${name}})
  foreach(path ${includes} ${libraries})
    if(NOT path)
      set(have OFF)
    endif()
  endforeach()
  if(NOT have)
    set(includes "")
    set(libraries "")
    get_property(said GLOBAL PROPERTY VISP_DIRECT_SAID_${name})
    if(NOT said) # once, not for every component
      set(why "is missing")
      if(NOT VISP_DIRECT_WITH_${name})
        set(why "is switched off")
      endif()
      message(STATUS "visp-direct: ${name} ${why}: no ${purpose}")
      set_property(GLOBAL PROPERTY VISP_DIRECT_SAID_${name} TRUE)
    endif()
  endif()
  list(REMOVE_ITEM includes /usr/include) # as a system folder it would hide the compiler's <stdlib.h>
  set(VISP_DIRECT_HAVE_${name} ${have} CACHE INTERNAL "")
  set(VISP_DIRECT_${name}_INCLUDES "${includes}" CACHE INTERNAL "")
  set(VISP_DIRECT_${name}_LIBRARIES "${libraries}" CACHE INTERNAL "")
endfunction()

find_path(VISP_DIRECT_KDL_INCLUDE_DIR kdl/chain.hpp)
find_library(VISP_DIRECT_KDL_LIBRARY orocos-kdl)
vispdirect_optional(KDL "tests of kinematics and dynamics against KDL" "${VISP_DIRECT_KDL_INCLUDE_DIR}" "${VISP_DIRECT_KDL_LIBRARY}")

find_path(VISP_DIRECT_URDF_MODEL_INCLUDE_DIR urdf_model/model.h PATH_SUFFIXES urdfdom_headers)
find_path(VISP_DIRECT_URDF_PARSER_INCLUDE_DIR urdf_parser/urdf_parser.h PATH_SUFFIXES urdfdom)
find_library(VISP_DIRECT_URDF_MODEL_LIBRARY urdfdom_model)
find_library(VISP_DIRECT_CONSOLE_BRIDGE_LIBRARY console_bridge)
vispdirect_optional(URDFDOM "arms from URDF (vpLoadArmUrdf)"
  "${VISP_DIRECT_URDF_MODEL_INCLUDE_DIR};${VISP_DIRECT_URDF_PARSER_INCLUDE_DIR}"
  "${VISP_DIRECT_URDF_MODEL_LIBRARY};${VISP_DIRECT_CONSOLE_BRIDGE_LIBRARY}")

find_path(VISP_DIRECT_OCTOMAP_INCLUDE_DIR octomap/octomap.h)
find_library(VISP_DIRECT_OCTOMAP_LIBRARY octomap)
find_library(VISP_DIRECT_OCTOMATH_LIBRARY octomath)
vispdirect_optional(OCTOMAP "octrees from files and depth images (vpDepthOctomap)" "${VISP_DIRECT_OCTOMAP_INCLUDE_DIR}"
  "${VISP_DIRECT_OCTOMAP_LIBRARY};${VISP_DIRECT_OCTOMATH_LIBRARY}")

find_path(VISP_DIRECT_ASSIMP_INCLUDE_DIR assimp/Importer.hpp)
find_library(VISP_DIRECT_ASSIMP_LIBRARY assimp)
vispdirect_optional(ASSIMP "mesh files of arms and obstacles (vpTriangleMesh::load)" "${VISP_DIRECT_ASSIMP_INCLUDE_DIR}"
  "${VISP_DIRECT_ASSIMP_LIBRARY}")

find_path(VISP_DIRECT_FCL_INCLUDE_DIR fcl/fcl.h)
find_path(VISP_DIRECT_CCD_INCLUDE_DIR ccd/ccd.h)
find_library(VISP_DIRECT_FCL_LIBRARY fcl)
vispdirect_optional(FCL "exact shapes of arms, and a second opinion on collisions (vpExactShapes, vpFclChecker)"
  "${VISP_DIRECT_FCL_INCLUDE_DIR};${VISP_DIRECT_CCD_INCLUDE_DIR}" "${VISP_DIRECT_FCL_LIBRARY}")
if(VISP_DIRECT_HAVE_FCL AND NOT VISP_DIRECT_HAVE_OCTOMAP) # FCL's headers include octomap
  message(STATUS "visp-direct: FCL is left out, for it needs OCTOMAP")
  set(VISP_DIRECT_HAVE_FCL OFF CACHE INTERNAL "")
  set(VISP_DIRECT_FCL_LIBRARIES "" CACHE INTERNAL "")
endif()

file(GLOB vispdirect_ompl_folders "/usr/include/ompl-*" "/usr/local/include/ompl-*")
find_path(VISP_DIRECT_OMPL_INCLUDE_DIR ompl/geometric/SimpleSetup.h HINTS ${vispdirect_ompl_folders})
find_library(VISP_DIRECT_OMPL_LIBRARY ompl)
vispdirect_optional(OMPL "planners of vpPathPlanner besides BiRRT" "${VISP_DIRECT_OMPL_INCLUDE_DIR}" "${VISP_DIRECT_OMPL_LIBRARY}")

find_path(VISP_DIRECT_DLIB_INCLUDE_DIR dlib/image_keypoint.h)
find_library(VISP_DIRECT_DLIB_LIBRARY dlib)
find_library(VISP_DIRECT_BLAS_LIBRARY NAMES blas openblas) # dlib's headers use BLAS
vispdirect_optional(DLIB "SURF keypoints" "${VISP_DIRECT_DLIB_INCLUDE_DIR}" "${VISP_DIRECT_DLIB_LIBRARY};${VISP_DIRECT_BLAS_LIBRARY}")

find_path(VISP_DIRECT_ARAVIS_INCLUDE_DIR arv.h PATH_SUFFIXES aravis-0.8)
find_library(VISP_DIRECT_ARAVIS_LIBRARY aravis-0.8)
find_path(VISP_DIRECT_GLIB_INCLUDE_DIR glib.h PATH_SUFFIXES glib-2.0)
find_library(VISP_DIRECT_GLIB_LIBRARY glib-2.0)
find_library(VISP_DIRECT_GOBJECT_LIBRARY gobject-2.0)
get_filename_component(vispdirect_glib_folder "${VISP_DIRECT_GLIB_LIBRARY}" DIRECTORY)
find_path(VISP_DIRECT_GLIBCONFIG_INCLUDE_DIR glibconfig.h HINTS "${vispdirect_glib_folder}/glib-2.0/include")
vispdirect_optional(ARAVIS "GigE and USB3 cameras (visp-servo)"
  "${VISP_DIRECT_ARAVIS_INCLUDE_DIR};${VISP_DIRECT_GLIB_INCLUDE_DIR};${VISP_DIRECT_GLIBCONFIG_INCLUDE_DIR}"
  "${VISP_DIRECT_ARAVIS_LIBRARY};${VISP_DIRECT_GOBJECT_LIBRARY};${VISP_DIRECT_GLIB_LIBRARY}")

# For tests only: no module, program or installed package needs it.
find_path(VISP_DIRECT_MUJOCO_INCLUDE_DIR mujoco/mujoco.h)
find_library(VISP_DIRECT_MUJOCO_LIBRARY mujoco)
vispdirect_optional(MUJOCO "second opinion on arms (test catchMujocoOracle)" "${VISP_DIRECT_MUJOCO_INCLUDE_DIR}"
  "${VISP_DIRECT_MUJOCO_LIBRARY}")

# The Python package: pybind11, and an interpreter that has numpy. Another python3 (pyenv, conda) may stand before the one that
# the system's packages belong to; -DPython3_EXECUTABLE decides.
get_property(vispdirect_python_searched GLOBAL PROPERTY VISP_DIRECT_PYTHON_SEARCHED)
set_property(GLOBAL PROPERTY VISP_DIRECT_PYTHON_SEARCHED TRUE)
if(vispdirect_python_searched) # once, not for every component
  set(vispdirect_candidates "")
elseif(Python3_EXECUTABLE)
  set(vispdirect_candidates "${Python3_EXECUTABLE}")
elseif(NOT VISP_DIRECT_PYTHON_EXECUTABLE)
  find_program(VISP_DIRECT_PYTHON_OF_PATH python3)
  set(vispdirect_candidates "${VISP_DIRECT_PYTHON_OF_PATH}" /usr/bin/python3)
endif()
foreach(candidate ${vispdirect_candidates})
  if(candidate AND NOT candidate STREQUAL VISP_DIRECT_PYTHON_EXECUTABLE)
    execute_process(COMMAND "${candidate}" -c "import numpy, sysconfig; print(sysconfig.get_path('include'))" RESULT_VARIABLE without_numpy
                    OUTPUT_VARIABLE python_include OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(without_numpy)
      message(STATUS "visp-direct: ${candidate} has no numpy, and is not used")
    else()
      message(STATUS "visp-direct: Python is ${candidate}, the first that has numpy; -DPython3_EXECUTABLE chooses another one")
      set(VISP_DIRECT_PYTHON_EXECUTABLE "${candidate}" CACHE INTERNAL "Interpreter of the Python package and of the reports")
      unset(VISP_DIRECT_PYTHON_INCLUDE_DIR CACHE)
      find_path(VISP_DIRECT_PYTHON_INCLUDE_DIR Python.h PATHS "${python_include}" NO_DEFAULT_PATH)
      break()
    endif()
  endif()
endforeach()
unset(vispdirect_candidates)
find_path(VISP_DIRECT_PYBIND11_INCLUDE_DIR pybind11/pybind11.h)
vispdirect_optional(PYTHON "Python package (visp_direct)" "${VISP_DIRECT_PYBIND11_INCLUDE_DIR};${VISP_DIRECT_PYTHON_INCLUDE_DIR}" "")

# vispdirect_without(FILE...): excludes sources from the module. Call after vp_glob_module_sources().
macro(vispdirect_without)
  foreach(vispdirect_file ${ARGN})
    list(FILTER VISP_MODULE_${the_module}_SOURCES EXCLUDE REGEX "/${vispdirect_file}$")
  endforeach()
endmacro()

# vispdirect_choose(NAME FILE...): FILE.cpp with the library NAME, FILEMissing.cpp without it.
macro(vispdirect_choose name)
  foreach(vispdirect_file ${ARGN})
    if(VISP_DIRECT_HAVE_${name})
      vispdirect_without(${vispdirect_file}Missing.cpp)
    else()
      vispdirect_without(${vispdirect_file}.cpp)
    endif()
  endforeach()
endmacro()
