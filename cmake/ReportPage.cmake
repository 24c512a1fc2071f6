# The page that reports carry, built from viewer/ by npm, as a source of the library: report_page().
# Everything happens in the build folder. Without KEENLINE_REPORT there is no page, and no npm is needed.
set(keenline_page_source "${CMAKE_BINARY_DIR}/report_page.cpp")
set(write_page_source "${CMAKE_CURRENT_LIST_DIR}/WriteReportPage.cmake")
if(NOT KEENLINE_REPORT)
  add_custom_command(OUTPUT "${keenline_page_source}"
    COMMAND "${CMAKE_COMMAND}" -D "SOURCE=${keenline_page_source}" -P "${write_page_source}"
    DEPENDS "${write_page_source}" VERBATIM)
  return()
endif()

find_program(KEENLINE_NPM npm)
if(NOT KEENLINE_NPM)
  message(FATAL_ERROR "the page of reports is built with npm (Node 18 or newer): install it, or configure with -DKEENLINE_REPORT=OFF")
endif()
set(viewer "${PROJECT_SOURCE_DIR}/viewer")
set(viewer_build "${CMAKE_BINARY_DIR}/viewer")
file(MAKE_DIRECTORY "${viewer_build}")
set(page "${viewer_build}/dist/report.html")

# Packages only when their list changes. None of them needs scripts of its own.
add_custom_command(OUTPUT "${viewer_build}/packages.stamp"
  COMMAND "${CMAKE_COMMAND}" -E copy "${viewer}/package.json" "${viewer}/package-lock.json" "${viewer_build}"
  COMMAND "${KEENLINE_NPM}" ci --ignore-scripts --no-audit --no-fund --loglevel=error
  COMMAND "${CMAKE_COMMAND}" -E touch "${viewer_build}/packages.stamp"
  DEPENDS "${viewer}/package.json" "${viewer}/package-lock.json"
  WORKING_DIRECTORY "${viewer_build}"
  COMMENT "Installing what the page of reports is built with" VERBATIM)

file(GLOB_RECURSE viewer_sources CONFIGURE_DEPENDS "${viewer}/src/*")
add_custom_command(OUTPUT "${page}"
  COMMAND "${CMAKE_COMMAND}" -E rm -rf "${viewer_build}/src"
  COMMAND "${CMAKE_COMMAND}" -E copy_directory "${viewer}/src" "${viewer_build}/src"
  COMMAND "${CMAKE_COMMAND}" -E copy "${viewer}/build.mjs" "${viewer}/tsconfig.json" "${viewer_build}"
  COMMAND "${KEENLINE_NPM}" --silent run build
  DEPENDS "${viewer_build}/packages.stamp" "${viewer}/build.mjs" "${viewer}/tsconfig.json" ${viewer_sources}
  WORKING_DIRECTORY "${viewer_build}"
  COMMENT "Building the page of reports" VERBATIM)
add_custom_command(OUTPUT "${keenline_page_source}"
  COMMAND "${CMAKE_COMMAND}" -D "PAGE=${page}" -D "SOURCE=${keenline_page_source}" -P "${write_page_source}"
  DEPENDS "${page}" "${write_page_source}" VERBATIM)
