# core as a library for other programs: one archive, the headers, a CMake package. docs/using-core.md
# says how to use it.
include(CMakePackageConfigHelpers)

# The objects of all folders of core, in one archive.
get_property(folders DIRECTORY ${PROJECT_SOURCE_DIR}/core PROPERTY BUILDSYSTEM_TARGETS)
set(objects)
foreach(folder ${folders})
  get_target_property(type ${folder} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    list(APPEND objects $<TARGET_OBJECTS:${folder}>)
  endif()
endforeach()
add_library(flytri_core STATIC ${objects})
set_target_properties(flytri_core PROPERTIES LINKER_LANGUAGE CXX OUTPUT_NAME flytri EXPORT_NAME core)

# What a program that uses it is compiled with. The instruction set decides how Eigen aligns its types,
# so both sides must have the same one; and both compile the functions in headers, which must compute
# the same bits.
target_compile_features(flytri_core INTERFACE cxx_std_20)
target_compile_options(flytri_core INTERFACE -ffp-contract=off)
if(FLYTRI_MARCH)
  target_compile_options(flytri_core INTERFACE -march=${FLYTRI_MARCH})
endif()
target_include_directories(flytri_core INTERFACE $<INSTALL_INTERFACE:include>)
# flytri-config.cmake finds these. tests/package/check_library links all of core: it fails if one is missing.
foreach(library Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json TBB::tbb ZLIB::ZLIB
        flytri::deflate flytri::opencv_calib3d flytri::opencv_core flytri::opencv_imgcodecs flytri::opencv_imgproc
        flytri::sqlcipher flytri::tinygltf)
  target_link_libraries(flytri_core INTERFACE $<INSTALL_INTERFACE:${library}>)
endforeach()

set(package lib/cmake/flytri)
write_basic_package_version_file(flytri-config-version.cmake COMPATIBILITY SameMinorVersion)
install(TARGETS flytri_core EXPORT flytri-targets DESTINATION lib COMPONENT dev)
install(EXPORT flytri-targets NAMESPACE flytri:: DESTINATION ${package} COMPONENT dev)
install(FILES library/flytri-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/flytri-config-version.cmake
        DESTINATION ${package} COMPONENT dev)

# The headers include each other from the top of the source tree. Installed, they lie in a folder named
# flytri: a program says #include <flytri/core/...>, and no folder named core is in its way.
set(headers ${CMAKE_CURRENT_BINARY_DIR}/headers)
configure_file(library/copy_headers.cmake.in copy_headers.cmake @ONLY)
install(SCRIPT ${CMAKE_CURRENT_BINARY_DIR}/copy_headers.cmake COMPONENT dev)
install(DIRECTORY ${headers}/flytri DESTINATION include COMPONENT dev)
