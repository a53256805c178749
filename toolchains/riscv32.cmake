# RISC-V microcontrollers without an FPU: RV32IMAC, as FE310 and CH32V203.
set(CMAKE_SYSTEM_PROCESSOR riscv32)
find_program(weir_riscv_compiler NAMES riscv-none-elf-g++ riscv32-unknown-elf-g++
  riscv64-unknown-elf-g++ riscv64-elf-g++ REQUIRED)
string(REGEX REPLACE "g\\+\\+$" "gcc" CMAKE_C_COMPILER ${weir_riscv_compiler})
set(CMAKE_CXX_COMPILER ${weir_riscv_compiler})
set(CMAKE_C_FLAGS_INIT "-misa-spec=2.2 -march=rv32imac -mabi=ilp32")
include(${CMAKE_CURRENT_LIST_DIR}/bare_metal.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/cxx_headers.cmake)
