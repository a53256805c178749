# The host with address and undefined-behaviour sanitizers: the first finding ends the program with
# an error. float-cast-overflow is not part of "undefined", and is what an unclamped conversion to
# fixed point would do. clang++ sanitizes in half of the time of g++, and finds arithmetic with null
# pointers, which g++ lets pass. Two checks of each access, a fifth of the compiling, are left to
# others: null pointers end the program anyway, and what is not aligned is a fault on a Cortex-M0.
include(${CMAKE_CURRENT_LIST_DIR}/clang.cmake)
string(JOIN " " CMAKE_CXX_FLAGS_INIT -g1 -fno-omit-frame-pointer
  -fsanitize=address,undefined,float-cast-overflow -fno-sanitize=null,alignment
  -fno-sanitize-recover=all)
