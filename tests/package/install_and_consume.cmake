function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
set(prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})

set(compile -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release)
if(SANITIZE)  # C programs as well, since they load a sanitized plugin
  set(flags "-fsanitize=${SANITIZE} -fno-sanitize=vptr")
  list(APPEND compile -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_C_FLAGS=${flags} -DCMAKE_CXX_FLAGS=${flags})
endif()

function(consume source folder)
  run(${CMAKE_COMMAND} -S ${source} -B ${WORK}/${folder} ${compile} ${ARGN})
  run(${CMAKE_COMMAND} --build ${WORK}/${folder})
  file(GLOB programs ${WORK}/${folder}/plays* ${WORK}/${folder}/converts*
       ${WORK}/${folder}/pictures*)
  foreach(program IN LISTS programs)
    run(${program})
  endforeach()
endfunction()

consume(${CONSUMER} by_cmake -DCMAKE_PREFIX_PATH=${prefix})

# The package for Python needs nothing of the build folder.
if(PYTHON)
  run(${CMAKE_COMMAND} -E env PYTHONPATH=${prefix}/${SITE_PACKAGES} PYTHONDONTWRITEBYTECODE=1
      ${PYTHON} -c "import sweepface; assert '${prefix}' in sweepface.__file__")
endif()

function(refuse_exports file matching)
  execute_process(COMMAND nm -D --defined-only ${file} OUTPUT_VARIABLE exported COMMAND_ERROR_IS_FATAL ANY)
  if(exported MATCHES ${matching})
    message(FATAL_ERROR "${file} exports what is inside the library: ${CMAKE_MATCH_0}")
  endif()
endfunction()

# Plugins with their own versions of the library must not share its internals.
refuse_exports(${WORK}/by_cmake/libplugin.so "[^\n]* u [^\n]*|[^\n]*N9sweepface[^\n]*")
foreach(library IN ITEMS sweepface sweepface_clips)
  refuse_exports(${prefix}/${LIBDIR}/lib${library}.so " [A-Za-z] ([^s]|s[^w]|sw[^e])[^\n]*")
endforeach()

# What reads clips needs no more of the converter's libraries than that takes.
execute_process(COMMAND readelf -d ${prefix}/${LIBDIR}/libsweepface_clips.so OUTPUT_VARIABLE needed
                COMMAND_ERROR_IS_FATAL ANY)
if(needed MATCHES "osdCPU")
  message(FATAL_ERROR "libsweepface_clips.so needs OpenSubdiv.")
endif()

set(ENV{PKG_CONFIG_PATH} ${prefix}/${LIBDIR}/pkgconfig)
consume(${CONSUMER} by_pkg_config -DFIND_BY_PKG_CONFIG=ON)

# A C-only project finds and links the shared libraries, which may be shipped without the archives, however old a CMake
# it asks for.
file(GLOB archives ${prefix}/${LIBDIR}/*.a)
file(REMOVE ${archives})
file(WRITE ${WORK}/alone/CMakeLists.txt [[
  cmake_minimum_required(VERSION 3.25)
  project(alone LANGUAGES C)
  cmake_policy(SET CMP0057 OLD)
  set(CMAKE_DISABLE_FIND_PACKAGE_hwy ON)
  find_package(sweepface 0.1 REQUIRED COMPONENTS shared shared_clips)
  add_executable(plays ${CONSUMER}/main.c)
  target_link_libraries(plays PRIVATE sweepface::shared)
  add_executable(plays_clips ${CONSUMER}/clips.c)
  target_link_libraries(plays_clips PRIVATE sweepface::shared_clips)]])
consume(${WORK}/alone by_shared -DCMAKE_PREFIX_PATH=${prefix} -DCONSUMER=${CONSUMER})

# As a subdirectory of another project it adds libraries and nothing else.
file(MAKE_DIRECTORY ${WORK}/parent)
file(CREATE_LINK ${SOURCE} ${WORK}/parent/sweepface SYMBOLIC)
file(WRITE ${WORK}/parent/CMakeLists.txt [[
  cmake_minimum_required(VERSION 3.25)
  project(parent LANGUAGES C CXX)
  set(CMAKE_DISABLE_FIND_PACKAGE_CLI11 ON)
  set(CMAKE_DISABLE_FIND_PACKAGE_embree ON)
  add_subdirectory(sweepface)
  add_executable(play sweepface/tests/consumer/main.cpp)
  target_link_libraries(play PRIVATE sweepface::convert)
  if(TARGET clip OR TARGET sweepface OR TARGET sweepface_picture)
    message(FATAL_ERROR "It brings what nobody asked for.")
  endif()]])
run(${CMAKE_COMMAND} -S ${WORK}/parent -B ${WORK}/parent/build ${compile})

if(EXISTS ${prefix}/bin/sweepface)
  run(${prefix}/bin/sweepface --help OUTPUT_QUIET)
endif()
