# Xtensa without an FPU: the LX106 of an ESP8266.
set(CMAKE_SYSTEM_PROCESSOR lx106)
set(CMAKE_C_COMPILER xtensa-lx106-elf-gcc)
set(CMAKE_CXX_COMPILER xtensa-lx106-elf-g++)
# Constants stand beside the code that loads them, and calls reach everywhere.
set(CMAKE_C_FLAGS_INIT "-mlongcalls -mtext-section-literals")
include(${CMAKE_CURRENT_LIST_DIR}/bare_metal.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/cxx_headers.cmake)
