#include "core/prepare/parts/part_state.h"

#include "core/base/deflate.h"
#include "core/files/file_bytes.h"
#include "core/levels/level_file_format.h"
#include "core/prepare/disk_room.h"
#include "core/prepare/tiled_geotiff.h"
#include "core/sources/source_identity.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

// To be increased with every change of the files.
constexpr int kVersion = 5;

} // namespace

std::string PartedMap::subject() const
{
    return fmt::format("parts {}; level file {}; at most {} means; {} parts; {}", kVersion,
                       kLevelFileVersion, mean_blocks_max, parts, key);
}

std::string PartedMap::file(std::size_t part, const char* ending) const
{
    return (std::filesystem::path(folder) / fmt::format("{}-of-{}.{}", part, parts, ending))
        .string();
}

Result<PartedMap> partedMap(const OpenRaster& raster,
                            std::size_t parts,
                            const std::string& folder,
                            std::size_t mean_blocks_max,
                            RowMemory memory)
{
    if (!memory.scratch) {
        memory.scratch.emplace();
    }
    memory.scratch->folder = folder;
    const Result<SourceIdentity> identity = identify(raster.spec.path);
    if (!identity) {
        return identity.error();
    }
    return PartedMap{.info = raster.info,
                     .voids = raster.voids(),
                     .scale = raster.info.elevationScale(),
                     .key = tiledGeoTiffKey(raster.info, *identity),
                     .source_path = identity->path,
                     .parts = parts,
                     .folder = folder,
                     .mean_blocks_max = mean_blocks_max,
                     .memory = std::move(memory)};
}

void beginPartState(CheckpointWriter& to, const PartedMap& map)
{
    to.putArray(map.subject());
}

Error notOfThisPart()
{
    return {ErrorCode::Invalid, "is not of this part of the map"};
}

void removePartFile(const std::string& path)
{
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
}

Result<CheckpointReader> openPartState(const PartedMap& map, std::size_t part, const char* ending)
{
    const std::string path = map.file(part, ending);
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        return Error{ErrorCode::NotFound, path + ": does not exist"};
    }
    std::optional<CheckpointReader> reader = CheckpointReader::open(path);
    std::string subject;
    if (!reader || !reader->getAny(subject)) {
        return Error{ErrorCode::Damaged,
                     fmt::format("{}: is damaged; prepare part {} again", path, part)};
    }
    if (subject != map.subject()) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: was made from another source or with other settings; "
                                 "prepare part {} again",
                                 path, part)};
    }
    return std::move(*reader);
}

FileMark FileMark::of(const std::string& path)
{
    constexpr std::uint64_t kPiece = std::uint64_t{1} << 22U;
    const Result<FileBytes> file = FileBytes::open(path);
    if (!file) {
        return {};
    }
    FileMark mark{.bytes = file->size(), .checksum = 0};
    for (std::uint64_t at = 0; at < mark.bytes; at += kPiece) {
        const auto piece = file->read(at, std::min(kPiece, mark.bytes - at));
        if (!piece) {
            return {};
        }
        mark.checksum = crc32Of({piece->data(), piece->size()}, mark.checksum);
    }
    return mark;
}

void FileMark::save(CheckpointWriter& to) const
{
    to.put(bytes);
    to.put(checksum);
}

bool FileMark::restore(CheckpointReader& from)
{
    return from.get(bytes) && from.get(checksum);
}

void PartFiles::save(CheckpointWriter& to) const
{
    to.put(tile_bytes);
    levels.save(to);
    means.save(to);
    to.putArray(sizes);
    to.putArray(checksums);
    to.putArray(sums);
    to.putArray(counts);
}

bool PartFiles::restore(CheckpointReader& from)
{
    return from.get(tile_bytes) && levels.restore(from) && means.restore(from) &&
           from.getAny(sizes) && from.getAny(checksums) && from.getAny(sums) && from.getAny(counts);
}

bool PartFiles::areOnDisk(const PartedMap& map, std::size_t part) const
{
    std::error_code ignored;
    return bytesOnDisk(map.file(part, kPartTiles)) == tile_bytes &&
           bytesOnDisk(map.file(part, kPartLevels)) == levels.bytes &&
           bytesOnDisk(map.file(part, kPartMeans)) == means.bytes &&
           std::filesystem::exists(map.file(part, kPartBorder), ignored) &&
           std::filesystem::exists(map.file(part, kPartEdges), ignored);
}

bool PartFiles::areIntact(const PartedMap& map, std::size_t part) const
{
    return areOnDisk(map, part) && openPartState(map, part, kPartBorder) &&
           openPartState(map, part, kPartEdges) &&
           FileMark::of(map.file(part, kPartLevels)) == levels &&
           FileMark::of(map.file(part, kPartMeans)) == means;
}

TileLayout layoutOf(const PartedMap& map)
{
    const RasterInfo& info = map.info;
    return {.columns = info.columns,
            .rows = info.rows,
            .type = info.type,
            .has_voids = info.needsVoidMask() || map.voids.nodata.has_value() ||
                         info.type == SampleType::Float32 || info.type == SampleType::Float64,
            .mean_levels = overviewCount(info.columns, info.rows)};
}

std::vector<std::size_t> absentParts(const PartedMap& map)
{
    std::vector<std::size_t> absent;
    for (std::size_t part = 1; part <= map.parts; ++part) {
        std::error_code ignored;
        if (!std::filesystem::exists(map.file(part, kPartSurvey), ignored)) {
            absent.push_back(part);
        }
    }
    return absent;
}

std::vector<std::size_t> missingParts(const PartedMap& map)
{
    std::vector<std::size_t> missing;
    for (std::size_t part = 1; part <= map.parts; ++part) {
        Result<CheckpointReader> state = openPartState(map, part, kPartSurvey);
        PartFiles tiles;
        if (!state || !tiles.restore(*state) || !tiles.areOnDisk(map, part)) {
            missing.push_back(part);
        }
    }
    return missing;
}

} // namespace marsview
