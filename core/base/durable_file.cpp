#include "core/base/durable_file.h"

#ifdef __unix__
#include <fcntl.h>
#include <unistd.h>
#endif

namespace marsview {

bool flushToDisk(std::FILE* file)
{
#ifdef __unix__
    return std::fflush(file) == 0 && fsync(fileno(file)) == 0;
#else
    return std::fflush(file) == 0;
#endif
}

void flushFolderToDisk([[maybe_unused]] const std::filesystem::path& folder)
{
#ifdef __unix__
    const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor >= 0) {
        fsync(descriptor);
        close(descriptor);
    }
#endif
}

} // namespace marsview
