# A cross compiler that Debian packs without C++ headers. Weir wants cstdint, cstddef, cstring,
# type_traits and new; those of the compiler for Arm, of the same version, are the same for all.
execute_process(COMMAND ${CMAKE_COMMAND} -E echo "#include <cstdint>"
  COMMAND ${CMAKE_CXX_COMPILER} -E -x c++ - OUTPUT_QUIET ERROR_QUIET RESULT_VARIABLE weir_without)
if(weir_without)
  file(GLOB weir_headers /usr/include/newlib/c++/*)
  if(NOT weir_headers)
    message(FATAL_ERROR "${CMAKE_CXX_COMPILER} has no C++ headers, and those of Debian's "
      "libstdc++-arm-none-eabi-newlib are not there either (toolchains/install)")
  endif()
  list(GET weir_headers -1 weir_headers)
  string(APPEND CMAKE_CXX_FLAGS_INIT " -nostdinc++ -isystem ${weir_headers}"
    " -isystem ${weir_headers}/arm-none-eabi -isystem /usr/include/newlib")
endif()
