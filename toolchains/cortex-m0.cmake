# Cortex-M0: no FPU, no divide, no 32x32->64 multiply.
set(CMAKE_SYSTEM_PROCESSOR cortex-m0)
set(weir_cpu_flags "-mcpu=cortex-m0")
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
