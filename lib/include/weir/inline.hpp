// What each compiler calls a function that is always inlined.
#pragma once

#if defined(_MSC_VER) && !defined(__clang__)
#define WEIR_ALWAYS_INLINE __forceinline
#else
#define WEIR_ALWAYS_INLINE [[gnu::always_inline]] inline
#endif
