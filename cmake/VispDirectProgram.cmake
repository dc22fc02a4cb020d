# A program of visp-direct, in its own build and as an app of a ViSP source tree with this folder among its contrib
# modules. Included at the top of every program's CMakeLists.txt.
include("${CMAKE_CURRENT_LIST_DIR}/VispDirectModule.cmake")

# vispdirect_add_program(visp-NAME TARGET...): the program of this folder, with its required modules and libraries;
# if one is missing the program is not built, with a one-line notice. All sources but main.cpp form the library
# vispdirect_NAME, so that the tests of test/ can link it.
macro(vispdirect_add_program vispdirect_program)
  vispdirect_find_visp()
  find_package(nlohmann_json QUIET)
  find_package(CLI11 QUIET)
  find_package(OpenCV 4 QUIET COMPONENTS core imgproc imgcodecs videoio)
  add_subdirectory("${CMAKE_CURRENT_LIST_DIR}/../common" "${CMAKE_CURRENT_BINARY_DIR}/common")
  if(NOT TARGET vispdirect_apps_common)
    return()
  endif()
  foreach(vispdirect_need ${ARGN})
    if(NOT TARGET ${vispdirect_need})
      message(STATUS "visp-direct: program ${vispdirect_program} is not built, ${vispdirect_need} is missing")
      return()
    endif()
  endforeach()

  string(REGEX REPLACE "^visp-" "" vispdirect_library "${vispdirect_program}")
  string(REPLACE "-" "_" vispdirect_library "vispdirect_${vispdirect_library}")
  file(GLOB vispdirect_sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_LIST_DIR}/*.cpp" "${CMAKE_CURRENT_LIST_DIR}/*.h")
  list(REMOVE_ITEM vispdirect_sources "${CMAKE_CURRENT_LIST_DIR}/main.cpp")
  add_library(${vispdirect_library} STATIC ${vispdirect_sources})
  target_include_directories(${vispdirect_library} PUBLIC "${CMAKE_CURRENT_LIST_DIR}")
  target_include_directories(${vispdirect_library} SYSTEM PUBLIC ${VISP_INCLUDE_DIRS} ${VISP_DIRECT_EIGEN3_INCLUDE_DIR})
  target_link_libraries(${vispdirect_library} PUBLIC vispdirect_apps_common ${ARGN})
  target_compile_options(${vispdirect_library} PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang>:-Wall;-Wextra;-Wshadow>)
  vispdirect_precompile(${vispdirect_library} support/vpModuleHeaders.h vispdirect_apps_common)

  add_executable(${vispdirect_program} main.cpp)
  target_link_libraries(${vispdirect_program} PRIVATE ${vispdirect_library})

  if(VISP_DIRECT_STANDALONE)
    set_property(GLOBAL APPEND PROPERTY VISP_DIRECT_PROGRAMS ${vispdirect_program}) # see Install.cmake
    if(BUILD_TESTS)
      add_subdirectory(test)
    endif()
  endif()
endmacro()

# vispdirect_add_part_test(TEST visp-NAME): TEST.cpp tests the parts of a program.
function(vispdirect_add_part_test test program)
  string(REGEX REPLACE "^visp-" "" library "${program}")
  string(REPLACE "-" "_" library "vispdirect_${library}")
  vispdirect_add_app_test(${test} ${library})
endfunction()

# vispdirect_add_program_test(TEST visp-NAME...): TEST.cpp runs programs.
function(vispdirect_add_program_test test)
  vispdirect_add_app_test(${test} vispdirect_apps_common)
  vispdirect_use_programs(${test} ${ARGN})
endfunction()

# vispdirect_unite_program_tests(visp-NAME TESTS test... [PROGRAMS visp-NAME...]): tests of the parts of a program, and others that run
# it and further programs, as one program vispdirect_tests_NAME.
function(vispdirect_unite_program_tests program)
  cmake_parse_arguments(PARSE_ARGV 1 unite "" "" "TESTS;PROGRAMS")
  string(REGEX REPLACE "^visp-" "" name "${program}")
  string(REPLACE "-" "_" name "${name}")
  vispdirect_unite_tests(vispdirect_tests_${name} TESTS ${unite_TESTS} LINK vispdirect_${name})
  vispdirect_use_program_run(vispdirect_tests_${name})
  vispdirect_use_programs(vispdirect_tests_${name} ${program} ${unite_PROGRAMS})
endfunction()

# vispdirect_use_programs(TEST visp-NAME...): the paths of programs as macros NAME, in upper case with underscores.
function(vispdirect_use_programs test)
  foreach(program ${ARGN})
    string(REGEX REPLACE "^visp-" "" variable "${program}")
    string(REPLACE "-" "_" variable "${variable}")
    string(TOUPPER "${variable}" variable)
    target_compile_definitions(${test} PRIVATE ${variable}="$<TARGET_FILE:${program}>")
    add_dependencies(${test} ${program})
  endforeach()
endfunction()

# Common to both kinds: the shared main, the support code of apps/common/test, the data folder, skipping.
function(vispdirect_add_app_test test)
  vispdirect_add_test(${test} LINK ${ARGN})
  vispdirect_use_program_run(${test})
endfunction()

# vispdirect_use_program_run(TEST): apps/common/test/programRun.h for a test. What is preloaded does not go with sanitizers.
function(vispdirect_use_program_run test)
  target_include_directories(${test} PRIVATE "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../apps/common/test")
  if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    if(NOT TARGET vispdirect_program_server)
      add_library(vispdirect_program_server MODULE "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../apps/common/test/programServer.cpp")
      target_link_libraries(vispdirect_program_server PRIVATE ${CMAKE_DL_LIBS})
    endif()
    target_compile_definitions(${test} PRIVATE VISP_DIRECT_PROGRAM_SERVER="$<TARGET_FILE:vispdirect_program_server>")
    add_dependencies(${test} vispdirect_program_server)
  endif()
endfunction()
