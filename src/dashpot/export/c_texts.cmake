# Embeds the C99 texts that the C export ships into the library as c_texts.cpp: laws, what they
# include, how they are integrated, controllers, inverses, and the exporter's own.
file(GLOB DASHPOT_C_TEXTS CONFIGURE_DEPENDS
  ${CMAKE_CURRENT_LIST_DIR}/c/texts/*.h ${CMAKE_CURRENT_LIST_DIR}/c/texts/*.c
  ${CMAKE_CURRENT_LIST_DIR}/fmu/texts/*.h ${CMAKE_CURRENT_LIST_DIR}/fmu/texts/*.c
  ${CMAKE_CURRENT_SOURCE_DIR}/dashpot/damper/c_text/*.h
  ${CMAKE_CURRENT_SOURCE_DIR}/dashpot/suspension/control/c_text/*.h
  ${CMAKE_CURRENT_SOURCE_DIR}/dashpot/suspension/observe/c_text/*.h
  ${CMAKE_CURRENT_SOURCE_DIR}/dashpot/damper/laws/*.h)
foreach(name fluid_curves magnetic_circuit plate_flow)
  list(APPEND DASHPOT_C_TEXTS ${CMAKE_CURRENT_SOURCE_DIR}/dashpot/physics/${name}.h)
endforeach()
set(DASHPOT_C_TEXTS_SOURCE ${CMAKE_CURRENT_BINARY_DIR}/c_texts.cpp)
set(DASHPOT_C_TEXTS_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_c_texts.cmake)
string(REPLACE ";" "," texts "${DASHPOT_C_TEXTS}")
add_custom_command(OUTPUT ${DASHPOT_C_TEXTS_SOURCE}
  COMMAND ${CMAKE_COMMAND} -DTEXTS=${texts} -DOUTPUT=${DASHPOT_C_TEXTS_SOURCE}
    -P ${DASHPOT_C_TEXTS_SCRIPT}
  DEPENDS ${DASHPOT_C_TEXTS} ${DASHPOT_C_TEXTS_SCRIPT}
  COMMENT "Embedding the C texts" VERBATIM)
