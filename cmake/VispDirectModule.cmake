# Included at the top of every module's CMakeLists.txt, in a standalone build and inside a ViSP source tree.
# It may run many times (ViSP processes contrib modules in two passes), so every action here is idempotent.

get_filename_component(VISP_DIRECT_ROOT "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)

# Eigen is a hard requirement of every module: it is the only matrix type inside the real-time step functions.
if(NOT VISP_DIRECT_EIGEN3_INCLUDE_DIR)
  find_package(Eigen3 3.3 REQUIRED NO_MODULE)
  get_target_property(_vispdirect_eigen_dirs Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  set(VISP_DIRECT_EIGEN3_INCLUDE_DIR "${_vispdirect_eigen_dirs}" CACHE INTERNAL "Eigen include folders")
  unset(_vispdirect_eigen_dirs)
endif()

include("${CMAKE_CURRENT_LIST_DIR}/VispDirectDependencies.cmake")

# The standalone build sets C++17 once; a ViSP tree may still default to C++11. Call after vp_create_module().
macro(vispdirect_module_settings)
  target_compile_features(${the_module} PUBLIC cxx_std_17)
  set_target_properties(${the_module} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${the_module} PRIVATE "$<$<CXX_COMPILER_ID:GNU,Clang>:-Wall;-Wextra;-Wshadow;-Wnon-virtual-dtor>")
  # ViSP's flags switch OpenMP on, and Eigen's products would start threads that wait for each other by spinning.
  target_compile_definitions(${the_module} PRIVATE EIGEN_DONT_PARALLELIZE)
  target_include_directories(${the_module} PRIVATE "${VISP_DIRECT_ROOT}/support")
  vispdirect_precompile(${the_module} support/vpModuleHeaders.h visp_direct_core)
  get_target_property(_vispdirect_type ${the_module} TYPE)
  if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND _vispdirect_type STREQUAL "SHARED_LIBRARY")
    target_link_options(${the_module} PRIVATE "LINKER:--version-script,${VISP_DIRECT_ROOT}/cmake/exports.map")
    set_property(TARGET ${the_module} APPEND PROPERTY LINK_DEPENDS "${VISP_DIRECT_ROOT}/cmake/exports.map")
  endif()
  unset(_vispdirect_type)
  # A library with an undefined symbol must fail here and not in the first program that uses it.
  if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    target_link_options(${the_module} PRIVATE LINKER:-z,defs)
  endif()
endmacro()

# vispdirect_precompile(TARGET HEADER [OWNER]): precompiles the headers that nearly every source of a target includes; not again where
# the target OWNER has done it, which must have the same options and none but macros of TARGET, and be built before it anyway. Not with
# ccache, which is even faster and accepts precompiled headers only with special settings.
function(vispdirect_precompile target header)
  if(NOT VISP_DIRECT_STANDALONE OR CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
    return()
  endif()
  if(ARGN AND NOT target STREQUAL ARGN)
    target_precompile_headers(${target} REUSE_FROM ${ARGN})
  else()
    target_precompile_headers(${target} PRIVATE "${VISP_DIRECT_ROOT}/${header}")
  endif()
endfunction()

# vispdirect_tests_need(NAME test...): these tests of the module are not compiled without the library NAME. A test that compiles but
# cannot pass without it has the tag [needs-NAME], and is then not run (test/support/vpTestMain.cpp).
macro(vispdirect_tests_need name)
  if(NOT VISP_DIRECT_HAVE_${name})
    list(APPEND vispdirect_not_compiled ${ARGN})
  endif()
endmacro()

# vispdirect_add_tests([DEPENDS_ON library...] [ALONE test...]): every test/*.cpp of the module is a test of Catch2 with the shared
# main of test/support. In a ViSP tree each is a program; standalone, see vispdirect_unite_tests. ALONE are tests with libraries,
# options or macros of their own. Benchmarks are never tests: see vispdirect_add_benchmarks.
macro(vispdirect_add_tests)
  if(BUILD_TESTS)
    vispdirect_test_support()
    cmake_parse_arguments(vispdirect "" "" "DEPENDS_ON;ALONE" ${ARGN})
    file(GLOB_RECURSE vispdirect_tests CONFIGURE_DEPENDS "${CMAKE_CURRENT_LIST_DIR}/test/*.cpp")
    list(TRANSFORM vispdirect_tests REPLACE ".*/(.+)[.]cpp$" "\\1")
    if(VISP_DIRECT_STANDALONE)
      list(REMOVE_ITEM vispdirect_ALONE ${vispdirect_not_compiled} "") # the latter because a list of nothing is an error
      list(REMOVE_ITEM vispdirect_tests ${vispdirect_ALONE} ${vispdirect_not_compiled} "")
      foreach(vispdirect_test ${vispdirect_ALONE})
        vispdirect_add_test(${vispdirect_test} SOURCE "test/${vispdirect_test}.cpp" LINK ${the_module} ${vispdirect_DEPENDS_ON})
      endforeach()
      vispdirect_unite_tests(vispdirect_tests_${name} FOLDER test TESTS ${vispdirect_tests} LINK ${the_module} ${vispdirect_DEPENDS_ON})
    elseif(NOT vispdirect_not_compiled) # ViSP's macro takes all files of a folder
      vp_add_tests(DEPENDS_ON vispdirect_test_support ${vispdirect_DEPENDS_ON})
      foreach(vispdirect_test ${vispdirect_tests})
        if(TARGET ${vispdirect_test})
          target_compile_features(${vispdirect_test} PRIVATE cxx_std_17)
          set_tests_properties(${vispdirect_test} PROPERTIES SKIP_RETURN_CODE 77)
        endif()
      endforeach()
    endif()
  endif()
endmacro()

# One static library with Catch2's main, the allocation counter and seeded randomness, shared by all test programs.
function(vispdirect_test_support)
  if(TARGET vispdirect_test_support)
    return()
  endif()
  # Catch2 3 is a library, 2 is a header; both are also part of ViSP's sources. test/support/vpCatch.h supports all of them.
  find_package(Catch2 QUIET)
  if(TARGET visp_catch2) # since ViSP 3.7, version 3 in one header
    set(VISP_DIRECT_CATCH2_INCLUDE_DIR "${VISP_SOURCE_DIR}/3rdparty/catch2" "${CMAKE_BINARY_DIR}/vispdirect-catch2")
    file(WRITE "${CMAKE_BINARY_DIR}/vispdirect-catch2/catch2/catch_all.hpp" "#include <catch_amalgamated.hpp>\n")
    set(vispdirect_catch visp_catch2)
  elseif(TARGET Catch2::Catch2 AND Catch2_VERSION VERSION_GREATER_EQUAL 3)
    set(vispdirect_catch Catch2::Catch2)
    get_target_property(VISP_DIRECT_CATCH2_INCLUDE_DIR Catch2::Catch2 INTERFACE_INCLUDE_DIRECTORIES)
  else()
    set(vispdirect_catch "")
    find_path(VISP_DIRECT_CATCH2_INCLUDE_DIR NAMES catch2/catch.hpp catch.hpp
              HINTS ${CATCH2_INCLUDE_DIRS} "${VISP_SOURCE_DIR}/3rdparty/catch2" PATH_SUFFIXES include)
  endif()
  if(NOT VISP_DIRECT_CATCH2_INCLUDE_DIR)
    message(FATAL_ERROR "visp-direct: Catch2 not found; install it (Debian: catch2) or configure with VISP_DIRECT_BUILD_TESTS=OFF")
  endif()
  file(GLOB support_sources CONFIGURE_DEPENDS "${VISP_DIRECT_ROOT}/test/support/*.cpp")
  add_library(vispdirect_test_support STATIC ${support_sources})
  target_include_directories(vispdirect_test_support PUBLIC "${VISP_DIRECT_ROOT}/test/support")
  target_include_directories(vispdirect_test_support SYSTEM PUBLIC
                             ${VISP_DIRECT_CATCH2_INCLUDE_DIR} ${VISP_DIRECT_EIGEN3_INCLUDE_DIR} ${VISP_INCLUDE_DIRS})
  target_link_libraries(vispdirect_test_support PUBLIC ${vispdirect_catch})
  target_compile_features(vispdirect_test_support PUBLIC cxx_std_17)
  target_compile_definitions(vispdirect_test_support PUBLIC VISP_DIRECT_DATA_DIR="${VISP_DIRECT_ROOT}/data")
  set(without "")
  foreach(name KDL OCTOMAP ASSIMP FCL OMPL DLIB)
    if(NOT VISP_DIRECT_HAVE_${name})
      string(APPEND without "~[needs-${name}]")
    endif()
  endforeach()
  set_source_files_properties("${VISP_DIRECT_ROOT}/test/support/vpTestMain.cpp" PROPERTIES COMPILE_DEFINITIONS
                              VISP_DIRECT_WITHOUT="${without}")
  # What takes time in a test is in the modules: -O1 saves a quarter of the tests' own compile time.
  target_compile_options(vispdirect_test_support PUBLIC "$<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang>>:-O1>")
  # Precompile the headers of every test: a quarter to a third of its compile time.
  if(VISP_DIRECT_STANDALONE AND NOT CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
    file(WRITE "${PROJECT_BINARY_DIR}/vispdirect_test_pch.cpp" "int main() { return 0; }\n")
    add_executable(vispdirect_test_pch "${PROJECT_BINARY_DIR}/vispdirect_test_pch.cpp")
    target_link_libraries(vispdirect_test_pch PRIVATE vispdirect_test_support)
    vispdirect_precompile(vispdirect_test_pch test/support/vpTestHeaders.h)
  endif()
endfunction()

# vispdirect_add_test(TEST [SOURCES file...] LINK library...): TEST.cpp of this folder is a program of Catch2 with the shared main.
function(vispdirect_add_test test)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "SOURCE" "SOURCES;LINK")
  if(NOT test_SOURCE)
    set(test_SOURCE ${test}.cpp)
  endif()
  vispdirect_add_test_program(${test} SOURCES ${test_SOURCE} ${test_SOURCES} LINK ${test_LINK})
  add_test(NAME ${test} COMMAND ${test})
  set_tests_properties(${test} PROPERTIES SKIP_RETURN_CODE 77)
endfunction()

function(vispdirect_add_test_program program)
  vispdirect_test_support()
  cmake_parse_arguments(PARSE_ARGV 1 program "" "" "SOURCES;LINK")
  add_executable(${program} ${program_SOURCES})
  target_link_libraries(${program} PRIVATE ${program_LINK} vispdirect_test_support)
  if(TARGET vispdirect_test_pch)
    target_precompile_headers(${program} REUSE_FROM vispdirect_test_pch)
  endif()
endfunction()

# vispdirect_link_test(TEST library...): more libraries for a test of a module. CMake wants one form for a target, and ViSP's has no
# keyword.
function(vispdirect_link_test test)
  if(VISP_DIRECT_STANDALONE)
    target_link_libraries(${test} PRIVATE ${ARGN})
  else()
    target_link_libraries(${test} ${ARGN})
  endif()
endfunction()

# vispdirect_unite_tests(PROGRAM [FOLDER folder] TESTS test... LINK library...): tests of a folder that need the same libraries become
# one program, compiled a few at a time: half the processor time of a program for each. bin/TEST remains, a link to the program, which
# runs the tests of the file whose name it is called by; so does the target TEST.
function(vispdirect_unite_tests program)
  cmake_parse_arguments(PARSE_ARGV 1 unite "" "FOLDER" "TESTS;LINK")
  get_filename_component(folder "${unite_FOLDER}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  set(sources "")
  set(tests "")
  while(unite_TESTS)
    list(LENGTH sources number)
    list(SUBLIST unite_TESTS 0 5 some) # more take too much memory
    list(REMOVE_ITEM unite_TESTS ${some})
    list(APPEND tests ${some})
    list(TRANSFORM some REPLACE "(.+)" "${folder}/\\1.cpp")
    set(source "${CMAKE_CURRENT_BINARY_DIR}/${program}_${number}.cpp")
    add_custom_command(OUTPUT "${source}" DEPENDS ${some} "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/uniteTests.cmake" VERBATIM
                       COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${source}" "-DSOURCES=${some}" -P "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/uniteTests.cmake")
    list(APPEND sources "${source}")
  endwhile()
  vispdirect_add_test_program(${program} SOURCES ${sources} LINK ${unite_LINK})
  target_include_directories(${program} PRIVATE "${folder}")
  foreach(test ${tests})
    add_custom_command(TARGET ${program} POST_BUILD COMMAND ${CMAKE_COMMAND} -E create_symlink
                       "$<TARGET_FILE_NAME:${program}>" "$<TARGET_FILE_DIR:${program}>/${test}")
    add_custom_target(${test} DEPENDS ${program})
    add_test(NAME ${test} COMMAND "$<TARGET_FILE_DIR:${program}>/${test}")
    set_tests_properties(${test} PROPERTIES SKIP_RETURN_CODE 77)
  endforeach()
endfunction()

# vispdirect_add_benchmarks([libraries]): every benchmark/*.cpp of the module is one Google Benchmark program.
# Standalone only; never part of ctest.
macro(vispdirect_add_benchmarks)
  if(VISP_DIRECT_STANDALONE AND BUILD_BENCHMARKS)
    file(GLOB _vispdirect_benchmarks CONFIGURE_DEPENDS "${CMAKE_CURRENT_LIST_DIR}/benchmark/*.cpp")
    foreach(_vispdirect_source ${_vispdirect_benchmarks})
      get_filename_component(_vispdirect_target ${_vispdirect_source} NAME_WE)
      add_executable(${_vispdirect_target} ${_vispdirect_source})
      target_include_directories(${_vispdirect_target} PRIVATE "${VISP_DIRECT_ROOT}/test/support")
      target_link_libraries(${_vispdirect_target} PRIVATE ${the_module} benchmark::benchmark ${ARGN})
      target_compile_definitions(${_vispdirect_target} PRIVATE VISP_DIRECT_DATA_DIR="${VISP_DIRECT_ROOT}/data")
    endforeach()
    unset(_vispdirect_benchmarks)
    unset(_vispdirect_source)
    unset(_vispdirect_target)
  endif()
endmacro()

# vispdirect_benchmark_peer(BENCHMARK NAME SOURCE FILE...): adds to a benchmark the peer that no Debian package has, where
# VISP_DIRECT_PEER_<NAME> is a folder with its source (include/ and the FILEs, which may be patterns). benchmark/peer/SOURCE
# registers what is measured. Peers may need C++20.
function(vispdirect_benchmark_peer benchmark name source)
  if(NOT TARGET ${benchmark})
    return()
  endif()
  set(VISP_DIRECT_PEER_${name} "" CACHE PATH "Folder with the source of ${name}, measured by ${benchmark}")
  set(folder "${VISP_DIRECT_PEER_${name}}")
  if(NOT folder)
    return()
  endif()
  list(TRANSFORM ARGN PREPEND "${folder}/")
  file(GLOB files ${ARGN})
  list(FILTER files EXCLUDE REGEX "cloud_client")
  if(NOT files)
    message(FATAL_ERROR "VISP_DIRECT_PEER_${name} is ${folder}, which has none of ${ARGN}")
  endif()
  add_library(${benchmark}_peer OBJECT "${CMAKE_CURRENT_LIST_DIR}/benchmark/peer/${source}" ${files})
  target_compile_features(${benchmark}_peer PRIVATE cxx_std_20)
  target_include_directories(${benchmark}_peer SYSTEM PRIVATE "${folder}/include")
  get_target_property(libraries ${benchmark} LINK_LIBRARIES)
  target_link_libraries(${benchmark}_peer PRIVATE ${libraries})
  target_sources(${benchmark} PRIVATE $<TARGET_OBJECTS:${benchmark}_peer>)
endfunction()

# Sets VISP_INCLUDE_DIRS for programs, which unlike modules get no include folders from vp_create_module. In a ViSP tree
# the targets have none and ViSP's build tree config provides them; standalone the root has found ViSP, once.
macro(vispdirect_find_visp)
  if(NOT VISP_DIRECT_STANDALONE)
    find_package(VISP REQUIRED)
  endif()
endmacro()

# vispdirect_add_test_plugin(TARGET SOURCE LIBRARY...): a plug-in as a user builds one, for tests of --plugin.
function(vispdirect_add_test_plugin target source)
  add_library(${target} MODULE ${source})
  target_compile_features(${target} PRIVATE cxx_std_17)
  target_link_libraries(${target} PRIVATE ${ARGN})
  target_include_directories(${target} SYSTEM PRIVATE ${VISP_INCLUDE_DIRS} ${VISP_DIRECT_EIGEN3_INCLUDE_DIR})
  set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
endfunction()
