set(board_processor cortex-m3)
set(board_sources timers/cmsdk_dual.cpp)
set(board_ram_end 20400000)
