# What `cmake --install` puts where: the program with its manual and completions, the library with
# its headers, CMake package and pkg-config file, the Python module.
include(CMakePackageConfigHelpers)

# ---- The program -----------------------------------------------------------------------------------
# Its manual and completions are made from its own tables.
set(made ${CMAKE_CURRENT_BINARY_DIR}/made)
add_custom_command(OUTPUT ${made}/carom.1 ${made}/carom.bash ${made}/_carom ${made}/carom.fish
  COMMAND ${CMAKE_COMMAND} -E make_directory ${made}
  COMMAND carom help --man > ${made}/carom.1
  COMMAND carom completion bash > ${made}/carom.bash
  COMMAND carom completion zsh > ${made}/_carom
  COMMAND carom completion fish > ${made}/carom.fish
  DEPENDS carom VERBATIM)
add_custom_command(OUTPUT ${made}/carom.1.gz COMMAND gzip -9nkf ${made}/carom.1
  DEPENDS ${made}/carom.1 VERBATIM)
add_custom_target(carom_manual ALL DEPENDS ${made}/carom.1.gz)

install(TARGETS carom EXPORT caromTargets RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  COMPONENT program)
set_target_properties(carom PROPERTIES EXPORT_NAME program)
install(FILES ${made}/carom.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${made}/carom.bash RENAME carom COMPONENT program
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${made}/_carom COMPONENT program
  DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${made}/carom.fish COMPONENT program
  DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# ---- The library -----------------------------------------------------------------------------------
if(CAROM_BUILD_LIBRARY)
  foreach(kind static shared)
    string(TOUPPER ${kind} upper)
    add_library(carom_${kind} ${upper})
    foreach(folder core geometry scene motion sim render media report api)
      target_sources(carom_${kind} PRIVATE $<TARGET_OBJECTS:carom_${folder}>)
    endforeach()
    # Debug and Release stand in one prefix: libcarom and libcaromd.
    set_target_properties(carom_${kind} PROPERTIES OUTPUT_NAME carom EXPORT_NAME ${kind}
      DEBUG_POSTFIX d LINKER_LANGUAGE CXX VERSION ${PROJECT_VERSION}
      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
    target_compile_features(carom_${kind} INTERFACE cxx_std_20)
    target_include_directories(carom_${kind} INTERFACE
      $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
      $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_libraries(carom_${kind} PRIVATE yaml-cpp fmt::fmt PNG::PNG Threads::Threads
      PkgConfig::ODE PkgConfig::CAIRO PkgConfig::XXHASH ${CMAKE_DL_LIBS})
    install(TARGETS carom_${kind} EXPORT caromTargets
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
        NAMELINK_COMPONENT development
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  endforeach()
  target_compile_definitions(carom_static INTERFACE CAROM_STATIC)

  install(DIRECTORY include/carom DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
  set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/carom)
  configure_package_config_file(cmake/caromConfig.cmake.in
    ${CMAKE_CURRENT_BINARY_DIR}/caromConfig.cmake INSTALL_DESTINATION ${package_folder})
  write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/caromConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(EXPORT caromTargets NAMESPACE carom:: DESTINATION ${package_folder}
    COMPONENT development)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/caromConfig.cmake
    ${CMAKE_CURRENT_BINARY_DIR}/caromConfigVersion.cmake cmake/caromGoldenTest.cmake
    DESTINATION ${package_folder} COMPONENT development)
  # Found from where it stands, so that the prefix can be moved.
  file(RELATIVE_PATH pc_to_prefix /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
  configure_file(cmake/carom.pc.in ${CMAKE_CURRENT_BINARY_DIR}/carom.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/carom.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endif()

# ---- The Python module -----------------------------------------------------------------------------
if(CAROM_BUILD_PYTHON)
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
  add_subdirectory(python)
endif()

# ---- Packages --------------------------------------------------------------------------------------
include(cmake/packages.cmake)
