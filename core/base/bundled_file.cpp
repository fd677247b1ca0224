#include "core/base/bundled_file.h"

#include <system_error>

namespace marsview {

std::filesystem::path bundledFileFor(const std::filesystem::path& program_folder,
                                     const std::filesystem::path& name)
{
    std::error_code error; // a path that cannot be checked counts as missing
    const auto found = [&](const std::filesystem::path& folder) {
        const std::filesystem::path file = folder / name;
        return std::filesystem::is_regular_file(file, error)
                   ? std::filesystem::canonical(file, error)
                   : std::filesystem::path();
    };
    std::filesystem::path file = found(program_folder / "../share/marsview");
    std::filesystem::path folder = std::filesystem::absolute(program_folder, error);
    while (file.empty()) {
        file = found(folder / "resources");
        const std::filesystem::path above = folder.parent_path();
        if (above == folder) {
            break;
        }
        folder = above;
    }
    return file;
}

std::filesystem::path bundledFile(const std::filesystem::path& name)
{
    std::error_code none;
    return bundledFileFor(std::filesystem::read_symlink("/proc/self/exe", none).parent_path(),
                          name);
}

} // namespace marsview
