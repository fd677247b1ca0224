// Giving memory back to the system.
#pragma once

#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace marsview {

/// Returns what the allocator holds back after a large job has freed its working memory. Does
/// nothing where the C library has no way to. Takes milliseconds; any thread but the servo's.
inline void returnFreeMemory() noexcept
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

} // namespace marsview
