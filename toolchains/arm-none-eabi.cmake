# Shared by every Cortex-M family. The including file sets CMAKE_SYSTEM_PROCESSOR and
# weir_cpu_flags.
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_C_FLAGS_INIT "${weir_cpu_flags} -mthumb")
include(${CMAKE_CURRENT_LIST_DIR}/bare_metal.cmake)
