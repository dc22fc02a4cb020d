# What is installed: libraries, headers, programs, data, the CMake package and the file for pkg-config; cmake --install takes all
# components, Packages.cmake makes a Debian package of each. Programs and the CMake package need the data.
include(CMakePackageConfigHelpers)
set(libraries ${VISP_DIRECT_BUILT_MODULES})
list(TRANSFORM libraries PREPEND visp_)
get_property(programs GLOBAL PROPERTY VISP_DIRECT_PROGRAMS)

# Nothing is copied before all of it is built (demo.sh builds one program): half a package would not be found by anyone.
add_custom_target(vispdirect_installable)
add_dependencies(vispdirect_installable ${libraries} ${programs})
set(files "")
foreach(target ${libraries} ${programs})
  string(APPEND files "\n  \"$<TARGET_FILE:${target}>\"")
endforeach()
install(CODE "
set(missing \"\")
foreach(file ${files})
  if(NOT EXISTS \"\${file}\")
    get_filename_component(file \"\${file}\" NAME)
    list(APPEND missing \"\${file}\")
  endif()
endforeach()
if(missing)
  list(LENGTH missing count)
  list(GET missing 0 first)
  message(FATAL_ERROR \"visp-direct is not installed: of its libraries and programs \${count} are not built, \${first} is the first; \"
    \"first: cmake --build \\\"${CMAKE_BINARY_DIR}\\\" --target vispdirect_installable\")
endif()")

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/VispDirect)
install(TARGETS ${libraries} EXPORT VispDirectTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
foreach(module ${VISP_DIRECT_BUILT_MODULES})
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/modules/${module}/include/visp3" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
          COMPONENT development FILES_MATCHING PATTERN "*.h")
endforeach()
if(programs)
  install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
endif()
set(VISP_DIRECT_DATA_FOLDER ${CMAKE_INSTALL_DATAROOTDIR}/visp-direct)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/data/" DESTINATION ${VISP_DIRECT_DATA_FOLDER} COMPONENT data)
# The reports are a part of the programs; the compiled part of the Python package is a component of its own.
if(VISP_DIRECT_PYTHON_FOLDER)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/python/visp_direct" DESTINATION "${VISP_DIRECT_PYTHON_FOLDER}" COMPONENT programs
          PATTERN "__pycache__" EXCLUDE)
endif()
# Not a part of vispdirect_installable: who builds that alone gets no compiled part.
foreach(target visp_direct_python visp_direct_laws)
  if(TARGET ${target})
    install(TARGETS ${target} LIBRARY DESTINATION "${VISP_DIRECT_PYTHON_FOLDER}/visp_direct" COMPONENT python OPTIONAL)
  endif()
endforeach()
if(TARGET visp_direct_python)
  install(FILES "${PROJECT_BINARY_DIR}/python/visp_direct/_core.pyi" DESTINATION "${VISP_DIRECT_PYTHON_FOLDER}/visp_direct"
          COMPONENT python OPTIONAL)
endif()

# Only static libraries pass on what they are linked with.
set(VISP_DIRECT_EXTERNAL_LIBRARIES "")
get_target_property(type visp_direct_core TYPE)
if(type STREQUAL "STATIC_LIBRARY")
  get_property(VISP_DIRECT_EXTERNAL_LIBRARIES GLOBAL PROPERTY VISP_DIRECT_EXTERNAL_LIBRARIES)
  list(REMOVE_DUPLICATES VISP_DIRECT_EXTERNAL_LIBRARIES)
endif()
install(EXPORT VispDirectTargets NAMESPACE VispDirect:: DESTINATION ${package_folder} COMPONENT development)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/VispDirectConfig.cmake.in" "${PROJECT_BINARY_DIR}/VispDirectConfig.cmake"
                              INSTALL_DESTINATION ${package_folder} PATH_VARS VISP_DIRECT_DATA_FOLDER)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/VispDirectConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/VispDirectConfig.cmake" "${PROJECT_BINARY_DIR}/VispDirectConfigVersion.cmake"
        DESTINATION ${package_folder} COMPONENT development)

# One file for pkg-config with all modules, those that need others first. Its prefix is found from where it lies.
file(RELATIVE_PATH VISP_DIRECT_PC_TO_PREFIX "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" VISP_DIRECT_PC_TO_PREFIX "${VISP_DIRECT_PC_TO_PREFIX}")
file(RELATIVE_PATH VISP_DIRECT_PC_LIBRARIES "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_LIBDIR}")
file(RELATIVE_PATH VISP_DIRECT_PC_HEADERS "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
file(RELATIVE_PATH VISP_DIRECT_PC_DATA "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_DATAROOTDIR}/visp-direct")
list(REVERSE libraries)
list(TRANSFORM libraries PREPEND -l)
set(externals ${VISP_DIRECT_EXTERNAL_LIBRARIES})
list(TRANSFORM externals PREPEND -l)
list(JOIN libraries " " VISP_DIRECT_PC_LIBS)
list(JOIN externals " " VISP_DIRECT_PC_EXTERNALS)
set(VISP_DIRECT_PC_REQUIRES "visp, eigen3")
if(type STREQUAL "STATIC_LIBRARY" AND TARGET visp_planar_target)
  string(APPEND VISP_DIRECT_PC_REQUIRES ", opencv4")
endif()
configure_file("${PROJECT_SOURCE_DIR}/cmake/visp-direct.pc.in" "${PROJECT_BINARY_DIR}/visp-direct.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/visp-direct.pc" DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
