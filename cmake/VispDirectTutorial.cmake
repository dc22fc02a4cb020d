# A tutorial of visp-direct, in its own build and inside a ViSP source tree with this folder among its contrib
# modules. Included at the top of every tutorial's CMakeLists.txt.
include("${CMAKE_CURRENT_LIST_DIR}/VispDirectModule.cmake")

# vispdirect_add_tutorial(NAME TARGET...): NAME.cpp with its required modules; if one is missing it is not built.
# ctest runs it without arguments and without a screen; its figures stay in the build folder. Where the page can be compared with what
# is printed, ctest runs the commands of the page instead, see test/pages/checkTutorial.py. Other versions of ViSP print other numbers.
macro(vispdirect_add_tutorial vispdirect_tutorial)
  vispdirect_find_visp()
  foreach(vispdirect_need ${ARGN})
    if(NOT TARGET ${vispdirect_need})
      message(STATUS "visp-direct: ${vispdirect_tutorial} is not built, ${vispdirect_need} is missing")
      return()
    endif()
  endforeach()
  add_executable(${vispdirect_tutorial} ${vispdirect_tutorial}.cpp)
  target_include_directories(${vispdirect_tutorial} SYSTEM PRIVATE ${VISP_INCLUDE_DIRS} ${VISP_DIRECT_EIGEN3_INCLUDE_DIR})
  target_link_libraries(${vispdirect_tutorial} PRIVATE ${ARGN})
  target_compile_features(${vispdirect_tutorial} PRIVATE cxx_std_17)
  target_compile_definitions(${vispdirect_tutorial} PRIVATE VISP_DIRECT_DATA_DIR="${VISP_DIRECT_ROOT}/data")
  if(BUILD_TESTS AND VISP_DIRECT_TOP_LEVEL AND VISP_DIRECT_PYTHON_EXECUTABLE)
    add_test(NAME ${vispdirect_tutorial} WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}"
             COMMAND "${VISP_DIRECT_PYTHON_EXECUTABLE}" "${VISP_DIRECT_ROOT}/test/pages/checkTutorial.py"
                     "${CMAKE_CURRENT_SOURCE_DIR}/README.md" "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}" "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
  elseif(BUILD_TESTS)
    add_test(NAME ${vispdirect_tutorial} COMMAND ${vispdirect_tutorial} WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
  endif()
endmacro()
