# The host with clang++, coverage for libFuzzer, address and undefined-behaviour sanitizers.
include(${CMAKE_CURRENT_LIST_DIR}/clang.cmake)
string(JOIN " " CMAKE_CXX_FLAGS_INIT -g -fno-omit-frame-pointer
  -fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow -fno-sanitize-recover=all)
