# How a program becomes a firmware image, and an image a test. Used by weir_add_program
# (../program.cmake), or directly for one board.

set(WEIR_CORTEX_M_DIR ${CMAKE_CURRENT_LIST_DIR} CACHE INTERNAL "")

# weir_add_firmware(NAME target BOARD board SOURCES file... [LIBRARIES target...]
#                   [STACK bytes] [RAM bytes])
#   STACK  room for main()'s stack, default 4096; overflow is a named fault
#   RAM    pretend the board has no more than this (a power of two); linker and MPU both enforce it
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
  set(sections ${WEIR_CORTEX_M_DIR}/sections.ld)
  set(board_dir ${WEIR_CORTEX_M_DIR}/boards/${arg_BOARD})
  set_target_properties(${arg_NAME} PROPERTIES SUFFIX .elf
    LINK_DEPENDS "${sections};${board_dir}/memory.ld")
  target_link_libraries(${arg_NAME} PRIVATE
    ${arg_LIBRARIES} weir_port_${arg_BOARD} weir_core_flags gcc)
  target_link_options(${arg_NAME} PRIVATE
    -nostartfiles -nostdlib -nodefaultlibs
    -L${board_dir} -T${sections}
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
  add_test(NAME ${arg_NAME} COMMAND ${WEIR_CORTEX_M_DIR}/../check ${arg_EXIT_CODE}
    ${arg_PASS_REGULAR_EXPRESSION} --
    ${WEIR_CORTEX_M_DIR}/run ${arg_BOARD} $<TARGET_FILE:${arg_TARGET}> ${arg_ARGS})
  set_tests_properties(${arg_NAME} PROPERTIES TIMEOUT ${arg_TIMEOUT} LABELS ${arg_BOARD})
endfunction()
