#include "tests/support/damage.h"

#include <filesystem>
#include <fstream>

namespace marsview::test {

void flipBits(const std::string& path, int count, Random& random)
{
    constexpr std::size_t kKept = 70'000;
    const auto time = std::filesystem::last_write_time(path);
    const std::size_t bytes = std::filesystem::file_size(path);
    {
        std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
        for (int i = 0; i < count; ++i) {
            const auto at = static_cast<std::streamoff>(kKept + random.below(bytes - 2 * kKept));
            file.seekg(at);
            const int byte = file.get();
            file.seekp(at);
            file.put(static_cast<char>(byte ^ (1 << random.below(8))));
        }
    }
    std::filesystem::last_write_time(path, time);
}

} // namespace marsview::test
