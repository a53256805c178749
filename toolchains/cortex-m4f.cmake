# Cortex-M4 with the single-precision FPU.
set(CMAKE_SYSTEM_PROCESSOR cortex-m4)
set(weir_cpu_flags "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard")
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
