# Cortex-M33 with the single-precision FPU.
set(CMAKE_SYSTEM_PROCESSOR cortex-m33)
set(weir_cpu_flags "-mcpu=cortex-m33 -mfpu=fpv5-sp-d16 -mfloat-abi=hard")
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
