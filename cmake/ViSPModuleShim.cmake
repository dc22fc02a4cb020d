# The subset of ViSP's module macros that our modules use, for a build on an installed ViSP.
# Same names and arguments as cmake/VISPModule.cmake of ViSP 3.5, so one module CMakeLists.txt serves both builds.

# Installed libraries and programs find each other even if the install folder is moved.
if(VISP_DIRECT_INSTALL)
  file(RELATIVE_PATH _vispdirect_bin_to_lib "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
  set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/${_vispdirect_bin_to_lib}")
  unset(_vispdirect_bin_to_lib)
endif()

# Modules are visited once, in the order of the add_subdirectory() calls in the root CMakeLists.txt.
macro(vp_add_module _name)
  set(name ${_name})
  set(the_module visp_${_name})
  set(_vispdirect_kind REQUIRED)
  set(_vispdirect_deps "")
  foreach(_vispdirect_dep ${ARGN})
    if(_vispdirect_dep MATCHES "^(REQUIRED|OPTIONAL|PRIVATE_REQUIRED|PRIVATE_OPTIONAL)$")
      set(_vispdirect_kind ${_vispdirect_dep})
    elseif(TARGET ${_vispdirect_dep} OR NOT _vispdirect_dep MATCHES "^visp_")
      list(APPEND _vispdirect_deps ${_vispdirect_dep})
    elseif(_vispdirect_kind MATCHES "REQUIRED$")
      message(STATUS "visp-direct: module ${name} is not built, ${_vispdirect_dep} is missing")
      return()
    endif()
  endforeach()
  set(VISP_MODULE_${the_module}_DEPS ${_vispdirect_deps})
endmacro()

macro(vp_module_disable _name)
  message(STATUS "visp-direct: module ${_name} is not built")
  return()
endmacro()

macro(vp_glob_module_sources)
  file(GLOB_RECURSE VISP_MODULE_${the_module}_HEADERS CONFIGURE_DEPENDS "${CMAKE_CURRENT_LIST_DIR}/include/visp3/*.h")
  file(GLOB_RECURSE VISP_MODULE_${the_module}_SOURCES CONFIGURE_DEPENDS "${CMAKE_CURRENT_LIST_DIR}/src/*.cpp"
       "${CMAKE_CURRENT_LIST_DIR}/src/*.h")
endmacro()

macro(vp_module_include_directories)
  set(VISP_MODULE_${the_module}_PRIVATE_INCLUDES ${ARGN})
endmacro()

# vp_create_module([libraries] [LINK_PRIVATE libraries]): as in ViSP; here all libraries are private.
macro(vp_create_module)
  set(_vispdirect_libraries "")
  foreach(_vispdirect_library ${ARGN})
    if(IS_ABSOLUTE "${_vispdirect_library}")
      # An installed static library must not name a file of this machine: the package config searches it again.
      get_filename_component(_vispdirect_file "${_vispdirect_library}" NAME_WE)
      string(REGEX REPLACE "^lib" "" _vispdirect_file "${_vispdirect_file}")
      set_property(GLOBAL APPEND PROPERTY VISP_DIRECT_EXTERNAL_LIBRARIES ${_vispdirect_file})
      list(APPEND _vispdirect_libraries "$<BUILD_INTERFACE:${_vispdirect_library}>"
           "$<INSTALL_INTERFACE:VispDirect::external_${_vispdirect_file}>")
    elseif(NOT _vispdirect_library STREQUAL "LINK_PRIVATE")
      list(APPEND _vispdirect_libraries ${_vispdirect_library})
    endif()
  endforeach()
  add_library(${the_module} ${VISP_MODULE_${the_module}_HEADERS} ${VISP_MODULE_${the_module}_SOURCES})
  add_library(VispDirect::${name} ALIAS ${the_module})
  target_include_directories(${the_module}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_LIST_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE "${CMAKE_CURRENT_LIST_DIR}/src")
  target_include_directories(${the_module} SYSTEM
    PUBLIC "$<BUILD_INTERFACE:${VISP_INCLUDE_DIRS};${VISP_DIRECT_EIGEN3_INCLUDE_DIR}>"
    PRIVATE ${VISP_MODULE_${the_module}_PRIVATE_INCLUDES})
  target_link_libraries(${the_module} PUBLIC ${VISP_MODULE_${the_module}_DEPS} $<INSTALL_INTERFACE:Eigen3::Eigen>
                        PRIVATE ${_vispdirect_libraries})
  unset(_vispdirect_libraries)
  unset(_vispdirect_library)
  unset(_vispdirect_file)
  target_compile_definitions(${the_module} PRIVATE visp_EXPORTS)
  # Without the symbol of its own, which no header reads, all modules can share one precompiled header.
  set_target_properties(${the_module} PROPERTIES DEFINE_SYMBOL "" EXPORT_NAME ${name} VERSION ${PROJECT_VERSION}
                        SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endmacro()
