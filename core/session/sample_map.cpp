#include "core/session/sample_map.h"

#include "core/base/bundled_file.h"

namespace marsview {

std::filesystem::path sampleMapFor(const std::filesystem::path& program_folder)
{
    return bundledFileFor(program_folder, "samples/mars_mola_4ppd.tif");
}

} // namespace marsview
