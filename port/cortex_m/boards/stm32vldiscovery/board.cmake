set(board_processor cortex-m3)
set(board_sources timers/none.cpp)
set(board_small yes)
set(board_ram_end 20002000)
