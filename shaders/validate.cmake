# Checks one entry shader with glslangValidator: once for each of its lines
#     // variant: NAME NAME=VALUE ...
# with these symbols defined, once for each line "PATH NAME=VALUE ..." of the file LISTED that names it, and once plain
# where it has a line `// variant:` alone or nothing at all.
# Run by the build: cmake -DVALIDATOR= -DROOT= -DSHADER= -DSTAMP= -DLISTED= -P validate.cmake

# The validator reads includes only when it links (-l), and then wants an extension that drivers do not know: a copy
# gets it.
get_filename_component(extension "${SHADER}" LAST_EXT)
set(copy "${STAMP}${extension}")
file(READ "${ROOT}/${SHADER}" text)
string(REGEX REPLACE "^(#version[^\n]*\n)"
                     "\\1#extension GL_GOOGLE_include_directive : require\n#line 2 \"shaders/${SHADER}\"\n" text "${text}")
file(WRITE "${copy}" "${text}")

file(STRINGS "${ROOT}/${SHADER}" variants REGEX "^// variant:")
file(STRINGS "${LISTED}" listed)
foreach(line IN LISTS listed)
  if(line MATCHES "^${SHADER}( .*)?$")
    list(APPEND variants "// variant:${CMAKE_MATCH_1}")
  endif()
endforeach()
if(NOT variants)
  set(variants "// variant:")
endif()
foreach(variant IN LISTS variants)
  string(REGEX REPLACE "^// variant: *" "" words "${variant}")
  separate_arguments(words)
  set(defines "")
  foreach(word IN LISTS words)
    if(NOT word MATCHES "=")
      string(APPEND word "=1")
    endif()
    list(APPEND defines "-D${word}")
  endforeach()
  execute_process(
    COMMAND "${VALIDATOR}" -l "-I${ROOT}" ${defines} "${copy}"
    RESULT_VARIABLE status
    OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "shaders/${SHADER}, variant [${words}]:\n${output}")
  endif()
endforeach()
file(TOUCH "${STAMP}")
