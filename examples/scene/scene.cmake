# Drawings become constant data at build time, for the host and for firmware alike.

# Debian's own python has the packages that apt installs; another one on the PATH may not.
if(EXISTS /usr/bin/python3 AND NOT DEFINED Python3_EXECUTABLE)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter)

set(WEIR_SCENE_DIR ${CMAKE_CURRENT_LIST_DIR})

# weir_add_scene(target DRAWING.svg [converter option...]): an interface target whose users can #include "drawing.hpp",
# which defines kScene.
function(weir_add_scene target drawing)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target})
  file(MAKE_DIRECTORY ${folder})
  file(GLOB converter ${WEIR_SCENE_DIR}/*.py)
  add_custom_command(OUTPUT ${folder}/drawing.hpp
    COMMAND ${Python3_EXECUTABLE} ${WEIR_SCENE_DIR}/svg_to_scene.py ${drawing} ${folder}/drawing.hpp
      ${ARGN}
    DEPENDS ${drawing} ${converter} VERBATIM)
  add_custom_target(${target}_drawing DEPENDS ${folder}/drawing.hpp)
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_drawing)
  target_include_directories(${target} INTERFACE ${folder} ${WEIR_SCENE_DIR})
endfunction()
