#include "app/bench/terrain/file_eviction.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace marsview {
namespace {

// The number of a file's bytes in memory.
double residentBytes(int file, std::size_t bytes)
{
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    void* content = mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file, 0);
    if (content == MAP_FAILED) { // NOLINT
        return 0.0;
    }
    std::vector<unsigned char> pages((bytes + page - 1) / page);
    std::size_t resident = 0;
    if (mincore(content, bytes, pages.data()) == 0) {
        for (const unsigned char state : pages) {
            resident += state & 1U;
        }
    }
    munmap(content, bytes);
    return static_cast<double>(resident) * static_cast<double>(page);
}

void evictFile(const std::filesystem::path& path, EvictedFiles& evicted)
{
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC); // NOLINT
    if (file < 0) {
        return;
    }
    struct stat status {};
    if (fstat(file, &status) == 0 && status.st_size > 0) {
        fdatasync(file); // dirty pages cannot be dropped
        posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
        ++evicted.file_count;
        evicted.bytes += static_cast<double>(status.st_size);
        evicted.resident_share += residentBytes(file, static_cast<std::size_t>(status.st_size));
    }
    close(file);
}

} // namespace

EvictedFiles evict(const std::vector<std::filesystem::path>& paths)
{
    namespace fs = std::filesystem;
    EvictedFiles evicted;
    for (const fs::path& path : paths) {
        std::error_code error;
        if (!fs::is_directory(path, error)) {
            evictFile(path, evicted);
            continue;
        }
        for (auto it = fs::recursive_directory_iterator(path, error);
             !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
            if (it->is_regular_file(error)) {
                evictFile(it->path(), evicted);
            }
        }
    }
    evicted.resident_share = evicted.bytes > 0.0 ? evicted.resident_share / evicted.bytes : 0.0;
    return evicted;
}

} // namespace marsview
