set(board_processor cortex-m4)
set(board_sources timers/stm32.cpp)
set(board_ram_end 20020000)
