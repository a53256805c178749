set(board_processor cortex-m33)
set(board_timer cmsdk_dual)
