# Debian packages, one for each component of Install.cmake; scripts/packages.sh builds and checks them.
set(soname ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(runtime_package libvisp-direct${soname})
set(development_package libvisp-direct-dev)
set(programs_package visp-direct)
set(data_package visp-direct-data)
set(documentation_package visp-direct-doc)

# Debian wants licence and changelog with every package.
find_program(VISP_DIRECT_GZIP gzip)
set(changelog "${PROJECT_BINARY_DIR}/packages/changelog.gz")
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
if(VISP_DIRECT_GZIP)
  execute_process(COMMAND "${VISP_DIRECT_GZIP}" -9nc "${PROJECT_SOURCE_DIR}/CHANGELOG.md" OUTPUT_FILE "${changelog}")
endif()
foreach(component runtime development programs data documentation)
  set(folder ${CMAKE_INSTALL_DATAROOTDIR}/doc/${${component}_package})
  install(FILES "${PROJECT_SOURCE_DIR}/cmake/debian-copyright" RENAME copyright DESTINATION ${folder} COMPONENT ${component}
          EXCLUDE_FROM_ALL)
  install(FILES "${changelog}" DESTINATION ${folder} COMPONENT ${component} EXCLUDE_FROM_ALL OPTIONAL)
endforeach()
install(FILES "${PROJECT_SOURCE_DIR}/README.md" DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${documentation_package}
        COMPONENT documentation EXCLUDE_FROM_ALL)
install(DIRECTORY "${PROJECT_BINARY_DIR}/doc/html" DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${documentation_package}
        COMPONENT documentation EXCLUDE_FROM_ALL OPTIONAL)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME visp-direct)
if(NOT CPACK_PACKAGE_CONTACT)
  set(CPACK_PACKAGE_CONTACT "nobody <nobody@localhost>") # -DCPACK_PACKAGE_CONTACT="Name <address>"
endif()
set(CPACK_PACKAGING_INSTALL_PREFIX "${CMAKE_INSTALL_PREFIX}")
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development programs data documentation)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
file(WRITE "${PROJECT_BINARY_DIR}/packages/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${PROJECT_BINARY_DIR}/packages/triggers")
set(same "${runtime_package} (= ${PROJECT_VERSION})")
set(same_data "${data_package} (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DATA_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DATA_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${same}, ${same_data}, libvisp-dev, libeigen3-dev")
set(python python3) # reports need no compiled part; that is of one version of Python
if(TARGET visp_direct_python AND VISP_DIRECT_PYTHON_INCLUDE_DIR MATCHES "python3[.]([0-9]+)$")
  math(EXPR next "${CMAKE_MATCH_1} + 1")
  set(python "python3 (>= 3.${CMAKE_MATCH_1}~), python3 (<< 3.${next}~), python3-numpy")
endif()
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "${same}, ${same_data}, ${python}")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "python3-jinja2, python3-matplotlib, libjs-three")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Direct methods for vision-based robot control - libraries
 Servo laws with feedforward, direct trajectory generation, tracking of planar
 targets and of repetitive products, redundant arms, certified avoidance: modules
 in the form of ViSP's.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Direct methods for vision-based robot control - headers
 Headers, the CMake package VispDirect and visp-direct.pc for pkg-config.")
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "Direct methods for vision-based robot control - programs
 Programs that compare servo laws, plan and follow trajectories, track products and
 avoid obstacles.")
set(CPACK_COMPONENT_DATA_DESCRIPTION "Direct methods for vision-based robot control - data
 Example targets, products, arms, scenes and tasks, which the programs use.")
set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION "Direct methods for vision-based robot control - documentation
 Tutorials, guides and the reference of all classes.")
foreach(component runtime development programs data documentation)
  string(TOUPPER ${component} name)
  set(CPACK_DEBIAN_${name}_PACKAGE_NAME ${${component}_package})
endforeach()
include(CPack)
