# Embeds the page (template, styles, scripts, and uPlot from node_modules) into the library as page_assets.cpp.
set(DASHPOT_PAGE_DIR ${CMAKE_CURRENT_LIST_DIR})
set(DASHPOT_UPLOT_DIR ${PROJECT_SOURCE_DIR}/node_modules/uplot)

# htm and Preact are the studio's (apps/CMakeLists.txt).
if(NOT EXISTS ${DASHPOT_UPLOT_DIR}/dist/uPlot.iife.min.js OR NOT EXISTS ${PROJECT_SOURCE_DIR}/node_modules/htm)
  find_program(NPM npm)
  if(NOT NPM)
    message(FATAL_ERROR "uPlot or htm is not in node_modules and npm is missing; install npm, or run 'npm ci --ignore-scripts --omit=dev' elsewhere")
  endif()
  message(STATUS "Getting uPlot and htm: npm ci --ignore-scripts --omit=dev")
  execute_process(COMMAND ${NPM} ci --ignore-scripts --omit=dev WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    RESULT_VARIABLE npm_status OUTPUT_QUIET ERROR_VARIABLE npm_error)
  if(NOT npm_status EQUAL 0)
    message(FATAL_ERROR "'npm ci' failed: ${npm_error}")
  endif()
endif()

file(GLOB DASHPOT_PAGE_FILES CONFIGURE_DEPENDS ${DASHPOT_PAGE_DIR}/*.js ${DASHPOT_PAGE_DIR}/*.css ${DASHPOT_PAGE_DIR}/*.html)
set(DASHPOT_PAGE_ASSETS ${CMAKE_CURRENT_BINARY_DIR}/page_assets.cpp)
add_custom_command(OUTPUT ${DASHPOT_PAGE_ASSETS}
  COMMAND ${CMAKE_COMMAND} -DPAGE_DIR=${DASHPOT_PAGE_DIR} -DUPLOT_DIR=${DASHPOT_UPLOT_DIR} -DOUTPUT=${DASHPOT_PAGE_ASSETS}
    -P ${DASHPOT_PAGE_DIR}/embed.cmake
  DEPENDS ${DASHPOT_PAGE_FILES} ${DASHPOT_PAGE_DIR}/embed.cmake ${DASHPOT_UPLOT_DIR}/dist/uPlot.iife.min.js
  COMMENT "Embedding the report page" VERBATIM)
