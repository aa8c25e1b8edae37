# Writes what a page holds into a source file: hashes as content security policies name them, and the
# files' places for the assembler, which copies them.
#   STYLE, OVERVIEW, WATCH, LICENCE, SCRIPTS (a list), THREE, THREE_VERSION: what goes in; FOLDER: where it goes
file(MAKE_DIRECTORY "${FOLDER}")
set(script "")
foreach(file IN LISTS SCRIPTS)
  file(READ "${file}" part)
  string(APPEND script "${part}")
endforeach()
file(WRITE "${FOLDER}/viewer.js" "${script}")
execute_process(COMMAND gzip -9nc "${THREE}" OUTPUT_FILE "${FOLDER}/three.js.gz"
  COMMAND_ERROR_IS_FATAL ANY)

# Hexadecimal digits -> base64 (RFC 4648), six bits for three quarters of two digits.
function(hash_of file result)
  set(digits "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")
  file(SHA256 "${file}" hex)
  string(LENGTH "${hex}" length)
  set(text "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${hex}000" ${at} 3 three)
    math(EXPR bits "0x${three}")
    math(EXPR high "${bits} >> 6")
    math(EXPR low "${bits} & 63")
    string(SUBSTRING "${digits}" ${high} 1 first)
    string(SUBSTRING "${digits}" ${low} 1 second)
    string(APPEND text "${first}${second}")
    math(EXPR at "${at} + 3")
  endwhile()
  # 32 bytes are 42 2/3 digits: 43, and one to fill up.
  string(SUBSTRING "${text}" 0 43 text)
  set(${result} "sha256-${text}=" PARENT_SCOPE)
endfunction()

hash_of("${STYLE}" style_hash)
hash_of("${FOLDER}/viewer.js" script_hash)
hash_of("${OVERVIEW}" overview_hash)
hash_of("${WATCH}" watch_hash)
hash_of("${THREE}" three_hash)
# A file's place in the program, and the function that gives it.
function(add_part name function path)
  string(APPEND text "asm(\".pushsection .rodata\\ncarom_page_${name}:\\n.incbin \\\"${path}\\\"\\n\"\n"
    "    \"carom_page_${name}_end:\\n.popsection\\n\");\n"
    "extern \"C\" {\n"
    "__attribute__((visibility(\"hidden\"))) extern const char carom_page_${name}[];\n"
    "__attribute__((visibility(\"hidden\"))) extern const char carom_page_${name}_end[];\n}\n"
    "namespace carom {\nEmbeddedFile ${function}() {\n"
    "    return {{carom_page_${name}, carom_page_${name}_end}, \"${${name}_hash}\"};\n}\n}\n\n")
  set(text "${text}" PARENT_SCOPE)
endfunction()
file(READ "${LICENCE}" licence)
set(text "#include \"page/embedded_files.h\"\n\n")
add_part(style page_style "${STYLE}")
add_part(script viewer_script "${FOLDER}/viewer.js")
add_part(overview overview_script "${OVERVIEW}")
add_part(watch watch_script "${WATCH}")
add_part(three three_script "${FOLDER}/three.js.gz")
string(APPEND text "namespace carom {\nstd::string_view three_version() { return \"${THREE_VERSION}\"; }\n"
  "std::string_view three_licence() {\n    return R\"TEXT(${licence})TEXT\";\n}\n}\n")
file(WRITE "${FOLDER}/embedded_files.cpp" "${text}")
