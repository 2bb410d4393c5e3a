# wold_module(NAME USES rooms… LIBRARIES targets…): the static library wold_NAME from src/NAME.
function(wold_module name)
  cmake_parse_arguments(arg "" "" "USES;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${name}/*.cpp)
  set(scope PUBLIC)
  if(sources)
    add_library(wold_${name} STATIC ${sources})
  else()
    add_library(wold_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  list(TRANSFORM arg_USES PREPEND wold_)
  target_link_libraries(wold_${name} ${scope} wold_options ${arg_USES} ${arg_LIBRARIES})
endfunction()

# wold_program(NAME FOLDER USES rooms… LIBRARIES targets…): a program from all sources in FOLDER.
function(wold_program name folder)
  cmake_parse_arguments(arg "" "" "USES;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(${name} ${sources})
  list(TRANSFORM arg_USES PREPEND wold_)
  target_link_libraries(${name} PRIVATE wold_options ${arg_USES} ${arg_LIBRARIES})
endfunction()

# wold_example_scene(NAME FILE): builds the text of a scene file into the library wold_NAME.
function(wold_example_scene name file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${file})
  file(READ ${CMAKE_SOURCE_DIR}/${file} WOLD_EXAMPLE_SCENE)
  configure_file(${CMAKE_SOURCE_DIR}/cmake/example.cpp.in ${CMAKE_BINARY_DIR}/generated/example.cpp
                 @ONLY)
  target_sources(wold_${name} PRIVATE ${CMAKE_BINARY_DIR}/generated/example.cpp)
endfunction()

# wold_shaders(NAME FOLDER): builds every *.glsl below FOLDER into the library wold_NAME, as text.
function(wold_shaders name folder)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.glsl)
  set(output ${CMAKE_BINARY_DIR}/generated/shader_files.cpp)
  set(script ${CMAKE_SOURCE_DIR}/cmake/EmbedShaders.cmake)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D FOLDER=${CMAKE_SOURCE_DIR}/${folder} -D OUTPUT=${output} -P ${script}
    DEPENDS ${files} ${script}
    COMMENT "Building the shaders in")
  target_sources(wold_${name} PRIVATE ${output})
endfunction()

# wold_page(NAME FILE): builds the text of a web page into the library wold_NAME.
function(wold_page name file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${file})
  file(READ ${CMAKE_SOURCE_DIR}/${file} WOLD_PAGE)
  configure_file(${CMAKE_SOURCE_DIR}/cmake/page.cpp.in ${CMAKE_BINARY_DIR}/generated/page.cpp @ONLY)
  target_sources(wold_${name} PRIVATE ${CMAKE_BINARY_DIR}/generated/page.cpp)
endfunction()
