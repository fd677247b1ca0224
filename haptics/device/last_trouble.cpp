#include "haptics/device/last_trouble.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTroubleEnding = ".trouble";

void removeOldest(const fs::path& folder)
{
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        if (entry.path().extension().string().starts_with(kTroubleEnding)) {
            files.emplace_back(entry.last_write_time(none), entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    for (std::size_t i = 0; i + LastTrouble::kFilesMax < files.size(); ++i) {
        fs::remove(files[i].second, none);
    }
}

} // namespace

LastTrouble::LastTrouble(fs::path folder, std::string_view device)
    : folder_(std::move(folder))
    , file_(folder_ /
            fmt::format("{:016x}{}", std::hash<std::string_view>()(device), kTroubleEnding))
{}

std::string LastTrouble::get() const
{
    std::string trouble(kBytesMax, '\0');
    std::ifstream file(file_);
    file.read(trouble.data(), static_cast<std::streamsize>(trouble.size()));
    trouble.resize(static_cast<std::size_t>(file.gcount()));
    return trouble.substr(0, trouble.find('\n'));
}

void LastTrouble::set(std::string_view trouble) const
{
    std::error_code none;
    if (trouble.empty()) {
        fs::remove(file_, none);
        return;
    }
    fs::create_directories(folder_, none);
    // Written and renamed, so that concurrent readers see the old sentence or the new one.
    const fs::path written = fs::path(file_).concat(fmt::format("-{}", getpid()));
    std::ofstream file(written);
    file << trouble.substr(0, kBytesMax);
    file.close();
    if (file) {
        fs::rename(written, file_, none);
    }
    fs::remove(written, none);
    removeOldest(folder_);
}

} // namespace marsview
