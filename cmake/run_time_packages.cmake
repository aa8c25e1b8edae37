# carom_packages_of(<variable> <-dev package without "lib">...): the Debian packages of libraries that
# are loaded when they are needed, which no tool finds in the program: "libosmesa6, libavformat59 ...".
# NOTFOUND where one is not installed. A -dev package depends on that of its library, whose name has the release's version in it.
function(carom_packages_of result)
  set(packages)
  foreach(development IN LISTS ARGN)
    string(REGEX REPLACE "[0-9]*-dev" "" library ${development})
    execute_process(COMMAND dpkg-query -W "-f=\${Depends}" lib${development}
      OUTPUT_VARIABLE depends RESULT_VARIABLE failed ERROR_QUIET)
    if(failed OR NOT depends MATCHES "(lib${library}-?[0-9][^ ,]*)")
      set(${result} NOTFOUND PARENT_SCOPE)
      return()
    endif()
    list(APPEND packages ${CMAKE_MATCH_1})
  endforeach()
  list(JOIN packages ", " text)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# What pictures and films need, and what layers do besides.
set(CAROM_LOADED osmesa6-dev avformat-dev avcodec-dev avutil-dev swscale-dev)
set(CAROM_LOADED_FOR_LAYERS openexr-dev deflate-dev)

# cmake [-DWHAT=layers] -P: prints them.
if(CMAKE_SCRIPT_MODE_FILE)
  if(WHAT STREQUAL layers)
    carom_packages_of(found ${CAROM_LOADED_FOR_LAYERS})
  else()
    carom_packages_of(found ${CAROM_LOADED})
  endif()
  if(NOT found)
    message(FATAL_ERROR "one of ${CAROM_LOADED} ${CAROM_LOADED_FOR_LAYERS} is not installed")
  endif()
  execute_process(COMMAND ${CMAKE_COMMAND} -E echo "${found}")
endif()
