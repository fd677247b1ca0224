#include "core/session/sample_map.h"

#include <system_error>

namespace marsview {
namespace {

constexpr const char* kFile = "mars_mola_4ppd.tif";

} // namespace

std::filesystem::path sampleMapFor(const std::filesystem::path& program_folder)
{
    std::error_code error; // whatever cannot be looked at is not there
    const auto found = [&error](const std::filesystem::path& folder) {
        const std::filesystem::path file = folder / kFile;
        return std::filesystem::is_regular_file(file, error)
                   ? std::filesystem::canonical(file, error)
                   : std::filesystem::path();
    };
    std::filesystem::path sample = found(program_folder / "../share/marsview/samples");
    std::filesystem::path folder = std::filesystem::absolute(program_folder, error);
    while (sample.empty()) {
        sample = found(folder / "resources/samples");
        const std::filesystem::path above = folder.parent_path();
        if (above == folder) {
            break;
        }
        folder = above;
    }
    return sample;
}

} // namespace marsview
