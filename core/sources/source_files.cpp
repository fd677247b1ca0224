#include "core/sources/source_files.h"

#include "core/files/gdal_runtime.h"
#include "core/files/open_guard.h"
#include "core/files/raster_path.h"
#include "core/files/shared_file.h"
#include "core/raster/mosaic.h"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

// Statistics and overviews that other programs leave next to a raster do not change its samples.
bool isSidecar(std::string_view name, OverviewFiles overviews)
{
    return name.ends_with(".aux.xml") ||
           (overviews == OverviewFiles::Ignored && name.ends_with(".ovr"));
}

// The file itself, or one in the same folder whose name differs only in case: GDAL lists a header
// as .hdr that it found as .HDR. Empty if neither exists.
std::string asOnDisk(const std::string& file)
{
    VSIStatBufL status{};
    if (VSIStatL(file.c_str(), &status) == 0) {
        return file;
    }
    const fs::path path(file);
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(path.parent_path(), ignored)) {
        if (EQUAL(entry.path().filename().c_str(), path.filename().c_str())) {
            return entry.path().string();
        }
    }
    return {};
}

// As GDAL lists them, or the parts of a mosaic; empty if GDAL does not open it.
std::vector<std::string> listedFilesOf(const std::string& path)
{
    const Result<std::vector<std::string>> names = rasterNamesFor(path);
    if (!names) {
        return {};
    }
    const GdalMessages messages;
    if (const Result<GuardedDataset> opened = openFirst(*names)) {
        const CPLStringList listed(opened->dataset->GetFileList());
        return {listed.List(), listed.List() + listed.Count()};
    }
    if (isFolder(path)) {
        const Result<std::shared_ptr<const Mosaic>> mosaic = mosaicOf(path, 1);
        return mosaic ? (*mosaic)->files : std::vector<std::string>();
    }
    return {};
}

} // namespace

std::vector<std::string> sourceFilesOf(const std::string& path, OverviewFiles overviews)
{
    ensureGdal();
    const KeepOpen opening;
    std::vector<std::string> files;
    for (const std::string& listed : listedFilesOf(path)) {
        std::string file = isSidecar(listed, overviews) ? std::string() : asOnDisk(listed);
        if (!file.empty()) {
            files.push_back(std::move(file));
        }
    }
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    return files;
}

} // namespace marsview
