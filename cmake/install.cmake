# What `cmake --install` puts in place: libraries, headers, the tool, and how other projects find them.
include(CMakePackageConfigHelpers)

# Headers of what converts; a runtime-only install goes without them.
set(converting_headers mesh.hpp io.hpp gltf.hpp fit.hpp measure.hpp drawing.hpp edit.hpp strip.hpp
    region_file.hpp laws.hpp sweepface_clips.h)
set(picture_headers picture.hpp report.hpp plot.hpp)

set(installed_libraries sweepface_runtime)
set(installed_components runtime)
set(installed_archives -lsweepface_runtime)
set(private_archives)
set(runtime_needs)
if(SWEEPFACE_SIMD AND NOT CMAKE_SYSTEM_NAME STREQUAL "WASI")
  set(runtime_needs hwy)
  list(APPEND installed_archives -lhwy)
endif()
set(absent_headers)
set(shared_components)
foreach(component IN ITEMS shared shared_clips)
  if(TARGET sweepface_${component})
    list(APPEND shared_components ${component})
  endif()
endforeach()
list(APPEND installed_components ${shared_components})
if(TARGET sweepface_convert)
  list(PREPEND installed_libraries sweepface_convert)
  list(APPEND installed_components convert)
  list(PREPEND installed_archives -lsweepface_convert)
  list(APPEND private_archives -ltbb -lfmt -lmeshoptimizer -lz)
else()
  list(APPEND absent_headers ${converting_headers})
endif()
if(TARGET sweepface_picture)
  list(PREPEND installed_libraries sweepface_picture)
  list(APPEND installed_components picture)
  list(PREPEND installed_archives -lsweepface_picture)
  list(PREPEND private_archives -lembree3)
else()
  list(APPEND absent_headers ${picture_headers})
endif()
list(TRANSFORM absent_headers REPLACE "(.+)" "PATTERN;\\1;EXCLUDE" OUTPUT_VARIABLE skipped_headers)
if(SWEEPFACE_BUILD_TOOL AND NOT SWEEPFACE_RUNTIME_ONLY)
  install(TARGETS sweepface RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

install(TARGETS ${installed_libraries} EXPORT sweepfaceTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/sweepface DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN *.hpp PATTERN *.h ${skipped_headers})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# find_package(sweepface): targets sweepface::runtime and, unless built without, sweepface::shared, sweepface::convert
# and sweepface::picture.
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/sweepface)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/sweepfaceConfig.cmake.in
  ${PROJECT_BINARY_DIR}/sweepfaceConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/sweepfaceConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sweepfaceConfig.cmake ${PROJECT_BINARY_DIR}/sweepfaceConfigVersion.cmake
        DESTINATION ${package_dir})
install(EXPORT sweepfaceTargets NAMESPACE sweepface:: DESTINATION ${package_dir})
foreach(component IN LISTS shared_components)  # each is found without the archives, too
  set(targets sweepface_${component}_targets)
  install(TARGETS sweepface_${component} EXPORT ${targets} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT ${targets} NAMESPACE sweepface:: DESTINATION ${package_dir})
endforeach()

# pkg-config: `--libs` links what plays; add `--static` to link what converts with what it needs. The shared libraries
# have files of their own.
# Their folders go by where it lies, unless they were told to be elsewhere.
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
  set(pc_prefix ${CMAKE_INSTALL_PREFIX})
else()
  file(RELATIVE_PATH prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  string(REGEX REPLACE "/$" "" prefix_from_pc ${prefix_from_pc})
  set(pc_prefix \${pcfiledir}/${prefix_from_pc})
endif()
foreach(folder LIBDIR INCLUDEDIR)
  cmake_path(APPEND pc_${folder} \${prefix} ${CMAKE_INSTALL_${folder}})
endforeach()
function(install_pc name libraries private)
  list(JOIN libraries " " pc_libraries)
  list(JOIN private " " pc_private)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/sweepface.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
install_pc(sweepface "${installed_archives}" "${private_archives}")
foreach(component IN LISTS shared_components)
  get_target_property(library sweepface_${component} OUTPUT_NAME)
  install_pc(sweepface_${component} -l${library} "")
endforeach()
