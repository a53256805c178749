# RISC-V microcontrollers without an FPU: RV32IMAC, as FE310 and CH32V203. The processor's name also
# chooses the boards: port/riscv builds those whose board.cmake names it.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR riscv32)
find_program(weir_riscv_compiler NAMES riscv-none-elf-g++ riscv32-unknown-elf-g++
  riscv64-unknown-elf-g++ riscv64-elf-g++ REQUIRED)
string(REGEX REPLACE "g\\+\\+$" "gcc" CMAKE_C_COMPILER ${weir_riscv_compiler})
set(CMAKE_CXX_COMPILER ${weir_riscv_compiler})
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # there is no libc to link a test program with
set(CMAKE_C_FLAGS_INIT "-misa-spec=2.2 -march=rv32imac -mabi=ilp32")
set(CMAKE_CXX_FLAGS_INIT ${CMAKE_C_FLAGS_INIT})
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
include(${CMAKE_CURRENT_LIST_DIR}/cxx_headers.cmake)
