set(board_processor cortex-m7)
set(board_timer cmsdk_dual)
