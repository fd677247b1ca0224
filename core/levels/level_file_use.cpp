#include "core/levels/level_file_use.h"

#include "core/files/remote_raster.h"
#include "core/raster/source_identity.h"
#include "core/tiles/geotiff_tile_source.h"

#include <fmt/format.h>
#include <utility>

namespace marsview {

Result<LevelFileKey> levelFileKey(const std::string& raster_path, int band, const RasterInfo& info)
{
    Result<SourceIdentity> identity = identify(raster_path, OverviewFiles::Counted);
    if (!identity) {
        return std::move(identity).error();
    }
    return LevelFileKey{.raster = std::move(*identity), .band = band, .nodata = info.nodata};
}

Status checkLevels(const std::string& level_path,
                   const std::string& raster_path,
                   int band,
                   const RasterInfo& info)
{
    if (!fileExists(level_path)) {
        return Error{ErrorCode::NotFound, ""};
    }
    const Result<LevelFileKey> key = levelFileKey(raster_path, band, info);
    if (!key) {
        return key.error();
    }
    const Result<LevelFile> file = LevelFile::open(level_path, *key);
    return file ? Status(Done{}) : Status(file.error());
}

bool hasLevels(const std::string& level_path,
               const std::string& raster_path,
               int band,
               const RasterInfo& info)
{
    return checkLevels(level_path, raster_path, band, info).has_value();
}

std::string notUsed(const std::string& level_path, const Error& why)
{
    const std::string beginning = level_path + ": ";
    const bool is_about_it = why.message.starts_with(beginning);
    return fmt::format("the level file beside it is not used: it {}",
                       is_about_it ? why.message.substr(beginning.size())
                                   : "cannot be told to be its own (" + why.message + ")");
}

Result<VouchedTiles> vouchedTiles(const RasterFile& file, const RasterInfo& info)
{
    const std::string level_path = LevelFile::pathFor(info.path);
    if (!fileExists(level_path)) {
        return VouchedTiles{};
    }
    const auto key = levelFileKey(info.path, info.band, info);
    const auto levels = key ? LevelFile::open(level_path, *key) : key.error();
    if (!levels && levels.error().code == ErrorCode::Damaged) {
        return levels.error();
    }
    if (!levels) {
        return VouchedTiles{.tiles = nullptr, .notice = notUsed(level_path, levels.error())};
    }
    const auto tiles = GeotiffTileSource::of(file, {info.nodata});
    if (!tiles) {
        return VouchedTiles{.tiles = nullptr, .notice = notUsed(level_path, tiles.error())};
    }
    auto checksums = levels->readChecksums();
    if (!checksums) {
        return std::move(checksums).error();
    }
    return VouchedTiles{.tiles = (*tiles)->checkedBy(std::move(*checksums)), .notice = {}};
}

} // namespace marsview
