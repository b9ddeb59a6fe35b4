# Checks that the version is the same in all files that repeat it for other programs to read.
function(check_version file pattern)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${PROJECT_SOURCE_DIR}/${file} text)
  if(NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "${file} tells another version than CMakeLists.txt, which is ${PROJECT_VERSION}.")
  endif()
endfunction()

check_version(include/sweepface/sweepface.h
  "_MAJOR ${PROJECT_VERSION_MAJOR}\n.*_MINOR ${PROJECT_VERSION_MINOR}\n.*_PATCH ${PROJECT_VERSION_PATCH}\n")
check_version(python/pyproject.toml "version = \"${PROJECT_VERSION}\"\n")
set(version "\"version\": \"${PROJECT_VERSION}\",\n")
check_version(web/package.json "${version}")
check_version(web/package-lock.json "${version}  \"lockfileVersion\".*${version}      \"license\"")
