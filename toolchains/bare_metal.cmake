# Shared by all processors without an operating system. The including file has set
# CMAKE_SYSTEM_PROCESSOR, which also chooses the boards (port/ builds those whose board.cmake names
# it), and CMAKE_C_FLAGS_INIT, the flags of both languages.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # there is no libc to link a test program with
set(CMAKE_CXX_FLAGS_INIT ${CMAKE_C_FLAGS_INIT})
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
