# Boards, how a program becomes a firmware image for one, and an image a test. The folders of
# processors call the first; weir_add_program (../program.cmake) the others, or a program that is
# for one board.

set(WEIR_BARE_METAL_DIR ${CMAKE_CURRENT_LIST_DIR} CACHE INTERNAL "")
set(weir_boards "" CACHE INTERNAL "The boards this build makes images for")

# weir_add_boards(BOARDS board... SOURCES file...)
#   Of the boards in the calling folder's boards/, those whose processor is the toolchain's: a
#   library of objects each, of bare_metal/, SOURCES and what the board adds.
#   boards/<board>/board.cmake sets
#     board_processor  CMAKE_SYSTEM_PROCESSOR of the toolchain file
#     board_sources    files more, relative to the calling folder (a timer), if any
#     board_ram_end    the first address past its RAM, hexadecimal, small letters, without 0x: tests
#                      store there
#     board_port       a file in place of port.cpp and semihosting.cpp, relative as well, if any
#     board_small      yes: runs only what was made for it, tests that want more memory pass it by
#   Objects, not an archive: start-up code and memcpy then link whatever the order of the libraries.
function(weir_add_boards)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "BOARDS;SOURCES")
  set(folder ${CMAKE_CURRENT_SOURCE_DIR})
  set(boards ${weir_boards})
  foreach(board ${arg_BOARDS})
    unset(board_processor)
    unset(board_ram_end)
    unset(board_small)
    unset(board_sources)
    set(board_port ${WEIR_BARE_METAL_DIR}/port.cpp ${WEIR_BARE_METAL_DIR}/semihosting.cpp)
    include(${folder}/boards/${board}/board.cmake)
    if(NOT board_processor OR NOT board_ram_end MATCHES "^[0-9a-f]+$")
      message(FATAL_ERROR "${folder}/boards/${board}/board.cmake: set board_processor, and "
        "board_ram_end in hexadecimal, small letters, without 0x")
    endif()
    if(NOT board_processor STREQUAL CMAKE_SYSTEM_PROCESSOR)
      continue()
    endif()
    if(NOT board_small)
      list(APPEND boards ${board})
    endif()
    add_library(weir_port_${board} OBJECT ${arg_SOURCES} ${board_sources} ${board_port}
      ${WEIR_BARE_METAL_DIR}/memory.cpp ${WEIR_BARE_METAL_DIR}/start.cpp)
    target_include_directories(weir_port_${board} PRIVATE
      ${folder} ${folder}/boards/${board} ${WEIR_BARE_METAL_DIR})
    target_link_libraries(weir_port_${board} PUBLIC weir_port_interface PRIVATE weir_core_flags)
    set_target_properties(weir_port_${board} PROPERTIES
      WEIR_SCRIPTS "${folder}/processor.ld;${folder}/boards/${board}/memory.ld")
    set(weir_ram_end.${board} ${board_ram_end} CACHE INTERNAL "")
  endforeach()
  set(weir_boards ${boards} CACHE INTERNAL "The boards this build makes images for")
  # memcpy made of a call to memcpy would never return; optimized at link time it would be gone.
  set_source_files_properties(${WEIR_BARE_METAL_DIR}/memory.cpp PROPERTIES COMPILE_OPTIONS
    "-fno-builtin;-fno-tree-loop-distribute-patterns;-fno-lto")
endfunction()

# weir_add_firmware(NAME target BOARD board SOURCES file... [LIBRARIES target...]
#                   [STACK bytes] [RAM bytes])
#   STACK  room for main()'s stack, default 4096; overflow is a named fault
#   RAM    pretend the board has no more than this (a power of two, if a Cortex-M is to have its MPU
#          enforce it, too)
# Links without libc: any use of the heap is an undefined symbol.
function(weir_add_firmware)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME;BOARD;STACK;RAM" "SOURCES;LIBRARIES")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_NAME OR NOT arg_BOARD OR NOT arg_SOURCES)
    message(FATAL_ERROR "weir_add_firmware(NAME t BOARD b SOURCES f...): got '${ARGV}'")
  endif()
  if(NOT TARGET weir_port_${arg_BOARD})
    message(FATAL_ERROR "weir_add_firmware: ${arg_BOARD}: this build's boards are ${weir_boards}")
  endif()
  if(NOT arg_STACK)
    set(arg_STACK 4096)
  endif()
  set(limit "")
  if(arg_RAM)
    set(limit LINKER:--defsym=weir_ram_limit=${arg_RAM})
  endif()
  add_executable(${arg_NAME} ${arg_SOURCES})
  set(sections ${WEIR_BARE_METAL_DIR}/sections.ld)
  get_target_property(scripts weir_port_${arg_BOARD} WEIR_SCRIPTS)
  list(TRANSFORM scripts REPLACE "(.+)/[^/]+$" "-L\\1" OUTPUT_VARIABLE search)
  set_target_properties(${arg_NAME} PROPERTIES SUFFIX .elf LINK_DEPENDS "${sections};${scripts}")
  target_link_libraries(${arg_NAME} PRIVATE
    ${arg_LIBRARIES} weir_port_${arg_BOARD} weir_core_flags gcc)
  target_link_options(${arg_NAME} PRIVATE
    -nostartfiles -nostdlib -nodefaultlibs
    ${search} -T${sections}
    LINKER:--defsym=weir_stack_bytes=${arg_STACK} ${limit}
    LINKER:--gc-sections,--fatal-warnings,--print-memory-usage,-Map=$<TARGET_FILE:${arg_NAME}>.map)
endfunction()

# weir_add_firmware_test(NAME test BOARD board TARGET image [ARGS key=value...] [EXIT_CODE n]
#                        [TIMEOUT seconds] [PASS_REGULAR_EXPRESSION pattern...])
# Passes if the image ends with the exit code (default 0) and its console matches every pattern
# (grep -E).
function(weir_add_firmware_test)
  cmake_parse_arguments(PARSE_ARGV 0 arg ""
    "NAME;BOARD;TARGET;EXIT_CODE;TIMEOUT" "ARGS;PASS_REGULAR_EXPRESSION")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_NAME OR NOT arg_BOARD OR NOT arg_TARGET)
    message(FATAL_ERROR "weir_add_firmware_test(NAME n BOARD b TARGET t): got '${ARGV}'")
  endif()
  if(NOT DEFINED arg_EXIT_CODE)
    set(arg_EXIT_CODE 0)
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  add_test(NAME ${arg_NAME} COMMAND ${WEIR_PORT_DIR}/check ${arg_EXIT_CODE}
    ${arg_PASS_REGULAR_EXPRESSION} --
    ${WEIR_PORT_DIR}/run ${arg_BOARD} $<TARGET_FILE:${arg_TARGET}> ${arg_ARGS})
  set_tests_properties(${arg_NAME} PROPERTIES TIMEOUT ${arg_TIMEOUT} LABELS ${arg_BOARD})
endfunction()
