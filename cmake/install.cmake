# What `cmake --install` puts in place: libraries, headers, the tool, and how other projects find them.
include(CMakePackageConfigHelpers)

# Headers of what converts; a runtime-only install goes without them.
set(converting_headers mesh.hpp io.hpp gltf.hpp layout.hpp fit.hpp measure.hpp drawing.hpp edit.hpp
    picture.hpp report.hpp plot.hpp sweepface_clips.h)

set(installed_libraries sweepface_runtime)
set(installed_archives -lsweepface_runtime)
set(private_archives)
set(SWEEPFACE_NEEDS_HIGHWAY OFF)
if(SWEEPFACE_SIMD AND NOT CMAKE_SYSTEM_NAME STREQUAL "WASI")
  set(SWEEPFACE_NEEDS_HIGHWAY ON)
  list(APPEND installed_archives -lhwy)
endif()
set(skipped_headers)
if(SWEEPFACE_RUNTIME_ONLY)
  foreach(header IN LISTS converting_headers)
    list(APPEND skipped_headers PATTERN ${header} EXCLUDE)
  endforeach()
else()
  list(PREPEND installed_libraries sweepface_picture sweepface_convert)
  list(PREPEND installed_archives -lsweepface_picture -lsweepface_convert)
  list(APPEND private_archives -lembree3 -ltbb -lfmt -lmeshoptimizer -lz)
  install(TARGETS sweepface RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

install(TARGETS ${installed_libraries} EXPORT sweepfaceTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/sweepface DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN *.hpp PATTERN *.h ${skipped_headers})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# find_package(sweepface): targets sweepface::runtime and, unless built without, sweepface::convert and
# sweepface::picture.
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/sweepface)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/sweepfaceConfig.cmake.in
  ${PROJECT_BINARY_DIR}/sweepfaceConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/sweepfaceConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sweepfaceConfig.cmake ${PROJECT_BINARY_DIR}/sweepfaceConfigVersion.cmake
        DESTINATION ${package_dir})
install(EXPORT sweepfaceTargets NAMESPACE sweepface:: DESTINATION ${package_dir})

# pkg-config: `--libs` links what plays; add `--static` to link what converts with what it needs.
file(RELATIVE_PATH prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" prefix_from_pc ${prefix_from_pc})
list(JOIN installed_archives " " installed_archives)
list(JOIN private_archives " " private_archives)
configure_file(${CMAKE_CURRENT_LIST_DIR}/sweepface.pc.in ${PROJECT_BINARY_DIR}/sweepface.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/sweepface.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
