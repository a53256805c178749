# Cortex-M7 with the single-precision FPU (what the smallest M7 parts have).
set(CMAKE_SYSTEM_PROCESSOR cortex-m7)
set(weir_cpu_flags "-mcpu=cortex-m7 -mfpu=fpv5-sp-d16 -mfloat-abi=hard")
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
