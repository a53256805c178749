set(board_processor cortex-m3)
set(board_timer cmsdk_dual)
