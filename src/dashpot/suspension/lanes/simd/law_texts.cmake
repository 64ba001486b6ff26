# Writes law_texts.h and control_texts.h: the C texts of the laws, of dampers and of control, that ride in lanes, with the
# type Lane, a number per lane, for each double. Each stands behind those whose functions it calls.
set(laws bingham normalised_bouc_wen bouc_wen modified_bouc_wen)
set(controls frequency_range control_add control_groundhook control_mix1 control_sh_add control_skyhook)

if(CMAKE_SCRIPT_MODE_FILE)  # cmake -DKIND=laws|controls -DFOLDER=<of the texts> -DOUTPUT=<file> -P law_texts.cmake
  set(code "// Written by law_texts.cmake from ${FOLDER}: edit those.\n\n#define DASHPOT_LAW_IN_LANES\n")
  foreach(name ${${KIND}})
    file(READ ${FOLDER}/${name}.h text)
    string(REGEX REPLACE "#include [^\n]*\n" "" text "${text}")
    string(REGEX REPLACE "([^A-Za-z0-9_])double([^A-Za-z0-9_])" "\\1Lane\\2" text "${text}")
    string(APPEND code "\n${text}")
  endforeach()
  file(WRITE ${OUTPUT} "${code}\n#undef DASHPOT_LAW_IN_LANES\n")
  return()
endif()

function(dashpot_lane_texts kind file folder)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/lanes/${file})
  set(from ${CMAKE_CURRENT_SOURCE_DIR}/dashpot/${folder})
  list(TRANSFORM ${kind} REPLACE "(.+)" "${from}/\\1.h" OUTPUT_VARIABLE texts)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DKIND=${kind} -DFOLDER=${from} -DOUTPUT=${output} -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    DEPENDS ${texts} ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    COMMENT "Writing the ${kind}' texts for lanes" VERBATIM)
  set(DASHPOT_LANE_LAWS ${DASHPOT_LANE_LAWS} ${output} PARENT_SCOPE)
endfunction()
dashpot_lane_texts(laws law_texts.h damper/laws)
dashpot_lane_texts(controls control_texts.h suspension/control/c_text)
