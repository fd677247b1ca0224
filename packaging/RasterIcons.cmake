# The icon in the raster sizes of the hicolor theme, for desktops that do not draw SVG. Without
# rsvg-convert only the SVG is installed.
find_program(RSVG_CONVERT_PROGRAM rsvg-convert)
if(NOT RSVG_CONVERT_PROGRAM)
  message(STATUS "rsvg-convert not found: the icon is installed only as SVG")
  return()
endif()
set(icon "${PROJECT_SOURCE_DIR}/resources/icons/org.marsview.MarsView.svg")
set(raster_icons)
foreach(size 16 22 24 32 48 64 128 256 512)
  set(folder "icons/hicolor/${size}x${size}/apps")
  set(picture "${CMAKE_CURRENT_BINARY_DIR}/${folder}/org.marsview.MarsView.png")
  file(MAKE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/${folder}")
  add_custom_command(OUTPUT "${picture}"
    COMMAND "${RSVG_CONVERT_PROGRAM}" -w ${size} -h ${size} -o "${picture}" "${icon}"
    DEPENDS "${icon}" VERBATIM)
  list(APPEND raster_icons "${picture}")
  install(FILES "${picture}" DESTINATION "${CMAKE_INSTALL_DATADIR}/${folder}")
endforeach()
add_custom_target(marsview_raster_icons ALL DEPENDS ${raster_icons})
