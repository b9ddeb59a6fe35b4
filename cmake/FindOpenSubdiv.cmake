# Defines sweepface_osd::osdCPU, a name that nobody else uses. The config file of Debian's package names libraries that
# it lacks.
find_path(OpenSubdiv_INCLUDE_DIR opensubdiv/far/primvarRefiner.h)
find_library(OpenSubdiv_LIBRARY osdCPU)
mark_as_advanced(OpenSubdiv_INCLUDE_DIR OpenSubdiv_LIBRARY)
if(OpenSubdiv_INCLUDE_DIR)
  file(STRINGS ${OpenSubdiv_INCLUDE_DIR}/opensubdiv/version.h version REGEX "OPENSUBDIV_VERSION_NUMBER")
  string(REGEX REPLACE ".* ([0-9])([0-9][0-9])([0-9][0-9])$" "\\1.\\2.\\3" OpenSubdiv_VERSION "${version}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenSubdiv
  REQUIRED_VARS OpenSubdiv_LIBRARY OpenSubdiv_INCLUDE_DIR VERSION_VAR OpenSubdiv_VERSION)
if(OpenSubdiv_FOUND AND NOT TARGET sweepface_osd::osdCPU)
  add_library(sweepface_osd::osdCPU UNKNOWN IMPORTED)
  set_target_properties(sweepface_osd::osdCPU PROPERTIES
    IMPORTED_LOCATION ${OpenSubdiv_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${OpenSubdiv_INCLUDE_DIR})
endif()
