#include "core/sources/output_check.h"

#include "core/sources/source_files.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>

namespace marsview {
namespace {

namespace fs = std::filesystem;

// Also for files that do not exist yet.
bool isSameFile(const std::string& a, const std::string& b)
{
    std::error_code none;
    if (fs::equivalent(a, b, none)) {
        return true;
    }
    const fs::path whole_a = fs::weakly_canonical(a, none);
    const fs::path whole_b = fs::weakly_canonical(b, none);
    return !whole_a.empty() && whole_a == whole_b;
}

bool isIn(const std::vector<std::string>& files, const std::string& path)
{
    return std::any_of(files.begin(), files.end(),
                       [&path](const std::string& file) { return isSameFile(file, path); });
}

} // namespace

Result<OpenFiles> checkOutputs(const FilesInUse& files)
{
    const KeepOpen opening;
    std::vector<std::string> map_files = files.maps;
    std::vector<std::string> written;
    bool has_sources = false;
    for (const std::string& path : files.written) {
        std::error_code none;
        const bool is_there = fs::exists(path, none);
        if (path.empty() || (is_there && !fs::is_regular_file(path, none))) {
            continue; // a terminal or /dev/null loses nothing
        }
        if (const fs::path folder = fs::path(path).parent_path();
            !folder.empty() && !fs::is_directory(folder, none)) {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: the folder {} does not exist; create it first", path,
                                     folder.string())};
        }
        if (!has_sources && is_there) { // otherwise it cannot be part of a map
            has_sources = true;
            for (const std::string& map : files.maps) {
                if (!fs::exists(map, none)) {
                    continue; // on a server: no local file is part of it
                }
                const std::vector<std::string> sources = sourceFilesOf(map);
                map_files.insert(map_files.end(), sources.begin(), sources.end());
            }
        }
        if (isIn(map_files, path)) {
            return Error{
                ErrorCode::Invalid,
                fmt::format("{}: is an input raster or a part of one; choose another output file",
                            path)};
        }
        if (isIn(files.read, path)) {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: is an input file; choose another output file", path)};
        }
        if (isIn(written, path)) {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: is given for two outputs; choose two files", path)};
        }
        written.push_back(path);
    }
    return opening.files();
}

} // namespace marsview
