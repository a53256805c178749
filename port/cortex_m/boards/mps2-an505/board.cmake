set(board_processor cortex-m33)
set(board_sources timers/cmsdk_dual.cpp)
set(board_ram_end 38400000)
