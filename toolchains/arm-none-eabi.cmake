# Shared by every Cortex-M family. The including file sets CMAKE_SYSTEM_PROCESSOR and
# weir_cpu_flags. The processor's name also chooses the boards: port/cortex_m builds those whose
# board.cmake names it.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # there is no libc to link a test program with
set(CMAKE_C_FLAGS_INIT "${weir_cpu_flags} -mthumb")
set(CMAKE_CXX_FLAGS_INIT "${weir_cpu_flags} -mthumb")
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
