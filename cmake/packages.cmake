# `cpack -G DEB` in the build folder: a package for each component that is built.
include(cmake/run_time_packages.cmake)
find_program(DPKG_QUERY dpkg-query)
if(NOT DPKG_QUERY)
  return()
endif()
carom_packages_of(run_time_packages ${CAROM_LOADED})
carom_packages_of(layer_packages ${CAROM_LOADED_FOR_LAYERS})
if(NOT run_time_packages OR NOT layer_packages)
  return()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "carom developers <maintainers@users.noreply.h-seed-f1017d48.example>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# A changelog has to be there, compressed.
set(changelog ${CMAKE_CURRENT_BINARY_DIR}/made/changelog.gz)
add_custom_command(OUTPUT ${changelog}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/made
  COMMAND gzip -9nc ${CMAKE_CURRENT_SOURCE_DIR}/debian/changelog > ${changelog}
  DEPENDS debian/changelog VERBATIM)
add_custom_target(carom_changelog ALL DEPENDS ${changelog})

# The first line of each description is the project's; `text` has lines of at most 79 characters.
function(carom_package component package section text)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${text}" PARENT_SCOPE)
  install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/debian/copyright ${changelog}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endfunction()

set(CPACK_COMPONENTS_ALL program)
carom_package(program carom science
  "A text file goes in; films, pictures, golden images and numbers come out,\nwith no display.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS ${run_time_packages})
# gnuplot brings 70 packages where apt takes what is recommended; films and pictures never call it.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "${layer_packages}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "fonts-inter, gnuplot-nox, libegl1, libgl1-mesa-dri")
if(CAROM_BUILD_LIBRARY)
  set(soname ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  list(APPEND CPACK_COMPONENTS_ALL library development)
  carom_package(library libcarom${soname} libs
    "The shared library: scenes, their motions as functions of time, pictures\nand films, for other programs.")
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS ${run_time_packages})
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_BINARY_DIR}/triggers)
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
  carom_package(development libcarom-dev libdevel
    "Headers, the static library, a CMake package with a function for tests of\npictures, a pkg-config file.")
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libcarom${soname} (= ${PROJECT_VERSION}), carom (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS
    "libode-dev, libyaml-cpp-dev, libfmt-dev, libcairo2-dev, libfreetype-dev, libpng-dev, libxxhash-dev")
endif()
if(CAROM_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  carom_package(python python3-carom python
    "The Python module: motions as NumPy arrays, pictures and films.")
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy, ${run_time_packages}")
endif()
include(CPack)
