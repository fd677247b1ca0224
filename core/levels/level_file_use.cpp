#include "core/levels/level_file_use.h"

#include "core/files/remote_raster.h"
#include "core/sources/source_identity.h"
#include "core/tiles/geotiff_tile_source.h"

#include <fmt/format.h>
#include <utility>

namespace marsview {

Result<RasterLevels> openLevels(const std::string& level_path,
                                const std::string& raster_path,
                                int band,
                                const RasterInfo& info)
{
    if (!fileExists(level_path)) {
        return Error{ErrorCode::NotFound, level_path + ": not found"};
    }
    Result<SourceIdentity> identity = identify(raster_path, OverviewFiles::Counted);
    if (!identity) {
        return std::move(identity).error();
    }
    LevelFileKey key{.raster = std::move(*identity), .band = band, .nodata = info.nodata};
    Result<LevelFile> file = LevelFile::open(level_path, key);
    if (!file) {
        return std::move(file).error();
    }
    return RasterLevels{.path = level_path, .key = std::move(key), .file = std::move(*file)};
}

std::string notUsed(const std::string& level_path, const Error& why)
{
    const std::string beginning = level_path + ": ";
    const bool is_about_it = why.message.starts_with(beginning);
    return fmt::format("its level file is not used: it {}",
                       is_about_it ? why.message.substr(beginning.size())
                                   : "cannot be verified (" + why.message + ")");
}

Result<VerifiedTiles> verifiedTiles(const OpenRaster& raster)
{
    const RasterInfo& info = raster.info;
    const std::string level_path = LevelFile::pathFor(info.path);
    const Result<RasterLevels> levels = openLevels(level_path, info.path, info.band, info);
    if (!levels) {
        switch (levels.error().code) {
        case ErrorCode::NotFound:
            return VerifiedTiles{};
        case ErrorCode::Damaged:
            return levels.error();
        default:
            return VerifiedTiles{.tiles = nullptr, .notice = notUsed(level_path, levels.error())};
        }
    }
    const auto tiles = GeotiffTileSource::of(raster.file, raster.voids());
    if (!tiles) {
        return VerifiedTiles{.tiles = nullptr, .notice = notUsed(level_path, tiles.error())};
    }
    auto checksums = levels->file.readChecksums();
    if (!checksums) {
        return std::move(checksums).error();
    }
    return VerifiedTiles{.tiles = (*tiles)->checkedBy(std::move(*checksums)), .notice = {}};
}

} // namespace marsview
