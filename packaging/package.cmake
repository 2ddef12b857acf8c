# The Debian packages: flytri, the programs; libflytri-dev, core as a library. What is in them, and
# how CPack makes them.
find_program(RSVG_CONVERT rsvg-convert REQUIRED)
find_program(GZIP gzip REQUIRED)
find_program(HELP2MAN help2man REQUIRED)

# Revision and date of the package stand in the changelog alone.
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

# add_made_file(FILE COMMAND... DEPENDS FILE...): writes the output of COMMAND to a file in the build folder.
set(made ${CMAKE_CURRENT_BINARY_DIR}/made)
file(MAKE_DIRECTORY ${made})
set(made_files)
function(add_made_file file)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "COMMAND;DEPENDS")
  add_custom_command(OUTPUT ${made}/${file} COMMAND ${arg_COMMAND} > ${made}/${file}
                     DEPENDS ${arg_DEPENDS} WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} VERBATIM)
  set(made_files ${made_files} ${made}/${file} PARENT_SCOPE)
endfunction()

# add_compressed(FILE SOURCE): compresses without name and time, so that the same source gives the same bytes.
function(add_compressed file source)
  add_made_file(${file} COMMAND ${GZIP} -9nc ${source} DEPENDS ${source})
  set(made_files ${made_files} PARENT_SCOPE)
endfunction()

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)

# add_manual_page(PROGRAM): makes it from the program's help and what manual/ adds to it. In a cross build
# an emulator runs the program.
list(JOIN CMAKE_CROSSCOMPILING_EMULATOR " " emulator)
function(add_manual_page program)
  string(STRIP "${emulator} $<TARGET_FILE:${program}>" command)
  add_made_file(${program}.help2man
    COMMAND ${CMAKE_COMMAND} -E env SOURCE_DATE_EPOCH=${FLYTRI_RELEASE_EPOCH} TZ=UTC LC_ALL=C.UTF-8
            ${HELP2MAN} --no-info --locale=C.UTF-8 --help-option=--help-all "--source=flytri ${PROJECT_VERSION}"
            --include=manual/exit_status.man --opt-include=manual/${program}.man "${command}"
    DEPENDS ${program} manual/${program}.man manual/exit_status.man)
  add_made_file(${program}.1 COMMAND sed -f manual/option_names.sed ${made}/${program}.help2man
                DEPENDS manual/option_names.sed ${made}/${program}.help2man)
  add_compressed(${program}.1.gz ${made}/${program}.1)
  set(made_files ${made_files} PARENT_SCOPE)
  install(FILES ${made}/${program}.1.gz DESTINATION share/man/man1)
endfunction()

add_manual_page(flytri)
add_manual_page(flytri-lab)
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
# With it, the first scan with the virtual sensor begins sooner.
add_made_file(calibrations.log
  COMMAND ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:flytri> simulate calibration --force -o ${made}/calibrations
  DEPENDS flytri)
add_custom_target(package_files ALL DEPENDS ${made_files})
add_dependencies(package_files flytri flytri-lab flytri_core)
configure_file(desktop/org.flytri.Flytri.metainfo.xml.in ${made}/org.flytri.Flytri.metainfo.xml @ONLY)

install(TARGETS flytri flytri-lab DESTINATION bin)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/assets/shaders ${made}/calibrations DESTINATION share/flytri)
install(FILES ${made}/formats.md.gz ${made}/hardware.md.gz DESTINATION share/doc/flytri)
install(FILES icon/flytri.svg DESTINATION ${icons}/scalable/apps)
install(FILES desktop/org.flytri.Flytri.desktop DESTINATION share/applications)
install(FILES ${made}/org.flytri.Flytri.metainfo.xml DESTINATION share/metainfo)
install(FILES udev/70-flytri.rules DESTINATION lib/udev/rules.d)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)
set(documents share/doc/libflytri-dev)
install(FILES ${PROJECT_SOURCE_DIR}/docs/using-core.md DESTINATION ${documents})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/example/ DESTINATION ${documents}/examples/reconstruct_recording)

# What Debian asks of each package.
foreach(component program dev)
  set(name_of_program flytri)
  set(name_of_dev libflytri-dev)
  set(name ${name_of_${component}})
  set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME ${component})
  install(FILES ${made}/changelog.gz ${made}/changelog.Debian.gz debian/copyright DESTINATION share/doc/${name})
  configure_file(debian/lintian-overrides.in ${made}/lintian-overrides-${name} @ONLY)
  install(FILES ${made}/lintian-overrides-${name} DESTINATION share/lintian/overrides RENAME ${name})
  string(TOUPPER ${component} COMPONENT)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${name})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME flytri)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Of the machine that the package is for; CPack would take the machine that builds it.
execute_process(COMMAND dpkg-architecture -t ${CMAKE_LIBRARY_ARCHITECTURE} -q DEB_HOST_ARCH
                OUTPUT_VARIABLE CPACK_DEBIAN_PACKAGE_ARCHITECTURE OUTPUT_STRIP_TRAILING_WHITESPACE
                ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${revision})
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${maintainer}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

if(FLYTRI_MARCH STREQUAL x86-64-v3)
  set(processor " The processor must have AVX2.")
endif()
# Else it would stand above each description.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program dev)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# The window reads them at run time, so no library names them.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "fonts-font-awesome, fonts-inter")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libgl1-mesa-dri, udev")
# Its file dialog is that of the desktop.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "xdg-desktop-portal")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_SOURCE_DIR}/debian/postinst)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "hand-guided 3D scanner for dentistry
Two crossed line patterns are projected onto the teeth in turn, 30 times a
second. Each camera frame gives a sparse but exact view. flytri registers
the views while the hand moves, and optimizes them all together. It then
thins the points, makes a textured mesh, and writes models for dental CAD.

It scans with USB cameras and projectors on USB GPIO chips, or with a
virtual sensor to try it.${processor}
")

set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
# What the headers include, and what a program that uses the library is linked with.
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libdeflate-dev, libeigen3-dev, libexpected-dev, libfmt-dev, \
libopencv-calib3d-dev, libopencv-core-dev, libopencv-imgcodecs-dev, libopencv-imgproc-dev, libsqlcipher-dev, libtbb-dev, \
libtinygltf-dev, nlohmann-json3-dev, zlib1g-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION "hand-guided 3D scanner for dentistry (library)
Reconstruction of surfaces from the camera frames of a scanner that
projects line patterns: calibration, measurement, registration, joint
optimization, meshing and texturing. The library reads recordings and
writes models as glTF, PLY, STL and OBJ.

This package has the static library, its C++ headers, a CMake package
and an example.${processor}
")
configure_file(cpack_project.cmake.in ${CMAKE_BINARY_DIR}/cpack_project.cmake @ONLY)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_BINARY_DIR}/cpack_project.cmake)
include(CPack)
