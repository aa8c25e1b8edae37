# carom_run_time_packages(<variable>): the Debian packages of what is loaded when it is needed
# (OSMesa, FFmpeg's libraries), which no tool finds in the program: "libosmesa6, libavformat59 ...".
# A -dev package depends on that of its library, whose name has the release's version in it.
function(carom_run_time_packages result)
  set(packages)
  foreach(development osmesa6-dev avformat-dev avcodec-dev avutil-dev swscale-dev)
    string(REGEX REPLACE "[0-9]*-dev" "" library ${development})
    execute_process(COMMAND dpkg-query -W "-f=\${Depends}" lib${development}
      OUTPUT_VARIABLE depends RESULT_VARIABLE failed ERROR_QUIET)
    if(failed OR NOT depends MATCHES "(lib${library}[0-9]+)")
      message(FATAL_ERROR "lib${development} is not installed: packages need the name of its library")
    endif()
    list(APPEND packages ${CMAKE_MATCH_1})
  endforeach()
  list(JOIN packages ", " text)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# cmake -P: prints them.
if(CMAKE_SCRIPT_MODE_FILE)
  carom_run_time_packages(found)
  execute_process(COMMAND ${CMAKE_COMMAND} -E echo "${found}")
endif()
