# Writes law_texts.h: the C texts of the laws that ride in lanes, with the type Lane, a number per lane, for each double.
# Each law stands behind those whose functions it calls.
set(names bingham normalised_bouc_wen bouc_wen modified_bouc_wen)

if(CMAKE_SCRIPT_MODE_FILE)  # cmake -DLAWS=<folder> -DOUTPUT=<file> -P law_texts.cmake
  set(code "// Written by law_texts.cmake from damper/laws/: edit those.\n\n#define DASHPOT_LAW_IN_LANES\n")
  foreach(name ${names})
    file(READ ${LAWS}/${name}.h text)
    string(REGEX REPLACE "#include [^\n]*\n" "" text "${text}")
    string(REGEX REPLACE "([^A-Za-z0-9_])double([^A-Za-z0-9_])" "\\1Lane\\2" text "${text}")
    string(APPEND code "\n${text}")
  endforeach()
  file(WRITE ${OUTPUT} "${code}\n#undef DASHPOT_LAW_IN_LANES\n")
  return()
endif()

set(DASHPOT_LANE_LAWS ${CMAKE_CURRENT_BINARY_DIR}/lanes/law_texts.h)
list(TRANSFORM names REPLACE "(.+)" "${CMAKE_CURRENT_SOURCE_DIR}/dashpot/damper/laws/\\1.h" OUTPUT_VARIABLE laws)
add_custom_command(OUTPUT ${DASHPOT_LANE_LAWS}
  COMMAND ${CMAKE_COMMAND} -DLAWS=${CMAKE_CURRENT_SOURCE_DIR}/dashpot/damper/laws -DOUTPUT=${DASHPOT_LANE_LAWS}
    -P ${CMAKE_CURRENT_LIST_FILE}
  DEPENDS ${laws} ${CMAKE_CURRENT_LIST_FILE}
  COMMENT "Writing the laws' texts for lanes" VERBATIM)
