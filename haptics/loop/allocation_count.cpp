// An operator new and delete that count within RtScope: for programs that say how much their ticks
// allocate, and for tests that allow none. Not part of the library: linked by those who ask for it.
#include "haptics/loop/rt_scope.h"

#include <cstdlib>
#include <new>

namespace {

// Not inlined, so that the compiler does not match delete with malloc.
[[gnu::noinline]] void* counted(std::size_t bytes) noexcept
{
    marsview::RtScope::countAllocation();
    return std::malloc(bytes == 0 ? 1 : bytes); // NOLINT
}

[[gnu::noinline]] void* countedAligned(std::size_t bytes, std::align_val_t alignment) noexcept
{
    marsview::RtScope::countAllocation();
    const auto step = static_cast<std::size_t>(alignment);
    return std::aligned_alloc(step, (bytes + step - 1) / step * step + (bytes == 0 ? step : 0));
}

// As the standard requires: asks the handler of the program until there is memory.
template <typename Allocate>
void* orThrow(Allocate allocate)
{
    while (true) {
        if (void* const memory = allocate()) {
            return memory;
        }
        const std::new_handler handler = std::get_new_handler();
        if (handler == nullptr) {
            throw std::bad_alloc();
        }
        handler();
    }
}

[[gnu::noinline]] void release(void* memory) noexcept
{
    if (memory != nullptr) {
        marsview::RtScope::countAllocation();
    }
    std::free(memory); // NOLINT
}

} // namespace

void* operator new(std::size_t bytes)
{
    return orThrow([bytes] { return counted(bytes); });
}
void* operator new[](std::size_t bytes)
{
    return orThrow([bytes] { return counted(bytes); });
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept
{
    return counted(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept
{
    return counted(bytes);
}
void* operator new(std::size_t bytes, std::align_val_t alignment)
{
    return orThrow([bytes, alignment] { return countedAligned(bytes, alignment); });
}
void* operator new[](std::size_t bytes, std::align_val_t alignment)
{
    return orThrow([bytes, alignment] { return countedAligned(bytes, alignment); });
}
void operator delete(void* memory) noexcept
{
    release(memory);
}
void operator delete[](void* memory) noexcept
{
    release(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
    release(memory);
}
void operator delete[](void* memory, std::size_t) noexcept
{
    release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
    release(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept
{
    release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
    release(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept
{
    release(memory);
}
