# carom_add_golden_test(NAME <test> SCENE <scene.yaml>... TIMES <seconds>...
#                       [DIR <folder of goldens>] [SIZE <WxH>] [SET <path=value>...]
#                       [TOLERANCE <0-255>] [MAX_DIFFERING <share>])
#
# A test that draws the scenes at these instants and holds them against DIR (default: goldens),
# with a report <test>.html in the build folder where they differ; and a target <test>_update that
# writes the goldens anew. Without TIMES the instants are those of each scene's film.stills.
function(carom_add_golden_test)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "NAME;DIR;SIZE;TOLERANCE;MAX_DIFFERING"
    "SCENE;TIMES;SET")
  if(NOT ARG_NAME OR NOT ARG_SCENE OR ARG_UNPARSED_ARGUMENTS OR ARG_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "carom_add_golden_test wants NAME and SCENE; not understood: "
      "'${ARG_UNPARSED_ARGUMENTS}', without a value: '${ARG_KEYWORDS_MISSING_VALUES}'")
  endif()
  if(NOT ARG_DIR)
    set(ARG_DIR goldens)
  endif()
  get_filename_component(folder ${ARG_DIR} ABSOLUTE)
  set(scenes)
  foreach(scene IN LISTS ARG_SCENE)
    get_filename_component(path ${scene} ABSOLUTE)
    if(NOT EXISTS ${path})
      message(FATAL_ERROR "carom_add_golden_test(${ARG_NAME}): there is no ${path}")
    endif()
    list(APPEND scenes ${path})
  endforeach()
  set(options --dir ${folder} --progress none)
  foreach(time IN LISTS ARG_TIMES)
    list(APPEND options --time ${time})
  endforeach()
  foreach(setting IN LISTS ARG_SET)
    list(APPEND options --set ${setting})
  endforeach()
  foreach(pair "SIZE;--size" "TOLERANCE;--tolerance" "MAX_DIFFERING;--max-differing")
    list(GET pair 0 key)
    list(GET pair 1 option)
    if(DEFINED ARG_${key})
      list(APPEND options ${option} ${ARG_${key}})
    endif()
  endforeach()
  add_test(NAME ${ARG_NAME} COMMAND carom::program golden check ${scenes} ${options}
    --html ${CMAKE_CURRENT_BINARY_DIR}/${ARG_NAME}.html -y)
  add_custom_target(${ARG_NAME}_update COMMAND carom::program golden update ${scenes} ${options}
    VERBATIM)
endfunction()
