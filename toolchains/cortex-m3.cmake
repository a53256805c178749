# Cortex-M3: no FPU.
set(CMAKE_SYSTEM_PROCESSOR cortex-m3)
set(weir_cpu_flags "-mcpu=cortex-m3")
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
