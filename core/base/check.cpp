#include "core/base/check.h"

#include <cstdio>
#include <cstdlib>

namespace marsview {

void checkFailed(const char* condition, const char* file, int line) noexcept
{
    std::fprintf(stderr, "marsview: check failed: %s (%s:%d)\n", condition, file, line);
    std::abort();
}

} // namespace marsview
