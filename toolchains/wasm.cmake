# WebAssembly with its 128-bit lanes, by Emscripten; tested in Node.js, for which all is one file.
execute_process(COMMAND em-config EMSCRIPTEN_ROOT OUTPUT_VARIABLE weir_emscripten
  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
include(${weir_emscripten}/cmake/Modules/Platform/Emscripten.cmake)
set(CMAKE_CXX_FLAGS_INIT -msimd128)
set(CMAKE_EXE_LINKER_FLAGS_INIT "-sSINGLE_FILE=1 -sINITIAL_MEMORY=64MB -sEXIT_RUNTIME=1")
