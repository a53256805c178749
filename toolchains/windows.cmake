# Windows on x86-64, by MinGW-w64; tested under Wine.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
find_program(weir_windows_compiler
  NAMES x86_64-w64-mingw32-g++-posix x86_64-w64-mingw32-g++ REQUIRED)
set(CMAKE_CXX_COMPILER ${weir_windows_compiler})
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
find_program(weir_wine NAMES wine64 wine PATHS /usr/lib/wine)
set(CMAKE_CROSSCOMPILING_EMULATOR ${weir_wine})
