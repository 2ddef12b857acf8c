# The Debian package: what lies in it beside the program, and how CPack puts it together.
find_program(RSVG_CONVERT rsvg-convert REQUIRED)
find_program(GZIP gzip REQUIRED)

# The changelog is the one place of the package's revision and date.
file(STRINGS debian/changelog changelog)
list(GET changelog 0 newest_entry)
if(NOT newest_entry MATCHES "^flytri \\(${PROJECT_VERSION}-([0-9]+)\\) ")
  message(FATAL_ERROR "packaging/debian/changelog must begin with an entry of version ${PROJECT_VERSION}")
endif()
set(revision ${CMAKE_MATCH_1})
list(FILTER changelog INCLUDE REGEX "^ -- ")
list(GET changelog 0 trailer)
string(REGEX REPLACE "^ -- (.*)  (.*)$" "\\2" date "${trailer}")
set(maintainer "${CMAKE_MATCH_1}")
execute_process(COMMAND date -u -d ${date} +%F OUTPUT_VARIABLE FLYTRI_RELEASE_DATE
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND date -u -d ${date} +%s OUTPUT_VARIABLE FLYTRI_RELEASE_EPOCH
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)

# add_made_file(FILE COMMAND... DEPENDS FILE...): of the build folder, made by the output of COMMAND.
set(made ${CMAKE_CURRENT_BINARY_DIR}/made)
file(MAKE_DIRECTORY ${made})
set(made_files)
function(add_made_file file)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "COMMAND;DEPENDS")
  add_custom_command(OUTPUT ${made}/${file} COMMAND ${arg_COMMAND} > ${made}/${file}
                     DEPENDS ${arg_DEPENDS} WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} VERBATIM)
  set(made_files ${made_files} ${made}/${file} PARENT_SCOPE)
endfunction()

# add_compressed(FILE SOURCE): without name and time, so that the same source gives the same bytes.
function(add_compressed file source)
  add_made_file(${file} COMMAND ${GZIP} -9nc ${source} DEPENDS ${source})
  set(made_files ${made_files} PARENT_SCOPE)
endfunction()

add_made_file(flytri.1 COMMAND flytri_manual ${PROJECT_VERSION} ${FLYTRI_RELEASE_DATE} manual/sections.man
              DEPENDS flytri_manual manual/sections.man)
add_compressed(flytri.1.gz ${made}/flytri.1)
add_compressed(changelog.gz ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
add_compressed(changelog.Debian.gz ${CMAKE_CURRENT_SOURCE_DIR}/debian/changelog)
add_compressed(formats.md.gz ${PROJECT_SOURCE_DIR}/docs/formats.md)
add_compressed(hardware.md.gz ${PROJECT_SOURCE_DIR}/docs/hardware.md)
set(icons share/icons/hicolor)
foreach(size 16 22 24 32 48 64 128 256 512)
  add_made_file(${size}.png COMMAND ${RSVG_CONVERT} -w ${size} -h ${size} icon/flytri.svg
                DEPENDS icon/flytri.svg)
  install(FILES ${made}/${size}.png DESTINATION ${icons}/${size}x${size}/apps RENAME flytri.png)
endforeach()
add_custom_target(package_files ALL DEPENDS ${made_files})
configure_file(desktop/org.flytri.Flytri.metainfo.xml.in ${made}/org.flytri.Flytri.metainfo.xml @ONLY)

install(TARGETS flytri DESTINATION bin)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/assets/shaders DESTINATION share/flytri)
install(FILES ${made}/flytri.1.gz DESTINATION share/man/man1)
install(FILES ${made}/changelog.gz ${made}/changelog.Debian.gz ${made}/formats.md.gz ${made}/hardware.md.gz
              debian/copyright DESTINATION share/doc/flytri)
install(FILES debian/lintian-overrides DESTINATION share/lintian/overrides RENAME flytri)
install(FILES icon/flytri.svg DESTINATION ${icons}/scalable/apps)
install(FILES desktop/org.flytri.Flytri.desktop DESTINATION share/applications)
install(FILES ${made}/org.flytri.Flytri.metainfo.xml DESTINATION share/metainfo)
install(FILES udev/70-flytri.rules DESTINATION lib/udev/rules.d)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME flytri)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Of the machine that the package is built for; CPack takes the one that it is built on.
execute_process(COMMAND dpkg-architecture -t ${CMAKE_LIBRARY_ARCHITECTURE} -q DEB_HOST_ARCH
                OUTPUT_VARIABLE CPACK_DEBIAN_PACKAGE_ARCHITECTURE OUTPUT_STRIP_TRAILING_WHITESPACE
                ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${revision})
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${maintainer}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Read by the window at run time: no library names them.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-font-awesome, fonts-inter")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libgl1-mesa-dri, udev")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_SOURCE_DIR}/debian/postinst)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "hand-guided 3D scanner for dentistry")
set(CPACK_PACKAGE_DESCRIPTION
    "Two crossed line patterns are projected onto the teeth in turn, 30 times a\n\
second; each camera frame gives a sparse but exact view. flytri registers\n\
the views while the hand moves, optimizes them all together, thins the\n\
points, meshes and textures them, and writes models for dental CAD.\n\
\n\
It scans with USB cameras and projectors that hang on USB GPIO chips, or\n\
with a virtual sensor to try it.")
if(FLYTRI_MARCH STREQUAL x86-64-v3)
  string(APPEND CPACK_PACKAGE_DESCRIPTION " The processor must know AVX2.")
endif()
configure_file(cpack_project.cmake.in ${CMAKE_BINARY_DIR}/cpack_project.cmake @ONLY)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_BINARY_DIR}/cpack_project.cmake)
include(CPack)
