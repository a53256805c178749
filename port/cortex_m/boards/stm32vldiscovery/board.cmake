set(board_processor cortex-m3)
set(board_timer none)
set(board_small yes)
