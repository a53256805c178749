# One program for whatever the build is for: an executable for a system, this one or one that is
# emulated (both a "host"), or an image for each board.

# weir_add_program(NAME name SOURCES file... [LIBRARIES target...] [BOARDS board...]
#                  [STACK bytes] [RAM bytes])
#   Host: target `name`. Boards: a target `name.<board>` for each of the build's boards, or those
#   of them that BOARDS names.
function(weir_add_program)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME;STACK;RAM" "SOURCES;LIBRARIES;BOARDS")
  if(TARGET weir_port_host)
    add_executable(${arg_NAME} ${arg_SOURCES})
    target_link_libraries(${arg_NAME} PRIVATE ${arg_LIBRARIES} weir_port_host weir_flags)
    return()
  endif()
  foreach(board ${weir_boards})
    if(NOT arg_BOARDS OR board IN_LIST arg_BOARDS)
      weir_add_firmware(NAME ${arg_NAME}.${board} BOARD ${board} STACK ${arg_STACK} RAM ${arg_RAM}
        SOURCES ${arg_SOURCES} LIBRARIES ${arg_LIBRARIES})
    endif()
  endforeach()
endfunction()

# weir_add_program_test(NAME test PROGRAM name [ARGS key=value...] [EXIT_CODE n] [TIMEOUT seconds]
#                       [PASS_REGULAR_EXPRESSION pattern...])
#   Host: ctest `test`. Boards: ctest `test.<board>` for each image of the program.
function(weir_add_program_test)
  cmake_parse_arguments(PARSE_ARGV 0 arg ""
    "NAME;PROGRAM;EXIT_CODE;TIMEOUT" "ARGS;PASS_REGULAR_EXPRESSION")
  set(rest "")
  foreach(option EXIT_CODE TIMEOUT ARGS PASS_REGULAR_EXPRESSION)
    if(DEFINED arg_${option})
      list(APPEND rest ${option} ${arg_${option}})
    endif()
  endforeach()
  if(EMSCRIPTEN AND arg_ARGS)  # its programs have no command line
    return()
  endif()
  if(TARGET weir_port_host)
    if(NOT DEFINED arg_EXIT_CODE)
      set(arg_EXIT_CODE 0)
    endif()
    if(NOT arg_TIMEOUT)
      set(arg_TIMEOUT 120)
    endif()
    add_test(NAME ${arg_NAME} COMMAND ${WEIR_PORT_DIR}/check ${arg_EXIT_CODE}
      ${arg_PASS_REGULAR_EXPRESSION} --
      ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:${arg_PROGRAM}> ${arg_ARGS})
    set_tests_properties(${arg_NAME} PROPERTIES TIMEOUT ${arg_TIMEOUT})
    return()
  endif()
  foreach(board ${weir_boards})
    if(TARGET ${arg_PROGRAM}.${board})
      weir_add_firmware_test(NAME ${arg_NAME}.${board} BOARD ${board}
        TARGET ${arg_PROGRAM}.${board} ${rest})
    endif()
  endforeach()
endfunction()
