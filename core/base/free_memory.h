// Returns freed memory to the system.
#pragma once

#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace marsview {

/// Returns memory that the allocator keeps after a large job has freed its working memory. Does
/// nothing if the C library has no such call. Takes milliseconds; any thread except the servo
/// thread.
inline void returnFreeMemory() noexcept
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

} // namespace marsview
