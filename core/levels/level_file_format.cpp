#include "core/levels/level_file_format.h"

#include "core/base/deflate.h"
#include "core/terrain/detail_errors.h"
#include "core/terrain/raw_ranges.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

namespace marsview {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little,
              "level files are little-endian, like memory");

constexpr std::array<unsigned char, 8> kMagic{0x89, 'M', 'V', 'L', '\r', '\n', 0x1A, '\n'};
constexpr std::size_t kChunkBytes = std::size_t{1} << 20U;
// Rasters have at most 2^31 columns and rows.
constexpr std::size_t kSideMax = std::size_t{1} << 31U;

template <typename T>
void put(std::span<std::byte> bytes, std::size_t offset, T value)
{
    std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

template <typename T>
T get(std::span<const std::byte> bytes, std::size_t offset)
{
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

json numberJson(double value)
{
    if (std::isfinite(value)) {
        return value;
    }
    return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

double numberFrom(const json& value)
{
    if (!value.is_string()) {
        return value.get<double>();
    }
    const auto text = value.get<std::string>();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (text == "nan") {
        return std::numeric_limits<double>::quiet_NaN();
    }
    if (text == "inf" || text == "-inf") {
        return text == "inf" ? kInfinity : -kInfinity;
    }
    throw std::invalid_argument("a number is written as " + text);
}

SampleType sampleTypeFrom(const std::string& name)
{
    for (const SampleType type :
         {SampleType::UInt8, SampleType::Int8, SampleType::UInt16, SampleType::Int16,
          SampleType::UInt32, SampleType::Int32, SampleType::UInt64, SampleType::Int64,
          SampleType::Float32, SampleType::Float64}) {
        if (sampleTypeName(type) == name) {
            return type;
        }
    }
    throw std::invalid_argument("a sample type is " + name);
}

// JSON's numbers may be negative or fractions; sizes may not.
std::uint64_t wholeNumberFrom(const json& value, std::uint64_t maximum)
{
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > maximum) {
        throw std::invalid_argument("a size is " + value.dump());
    }
    return value.get<std::uint64_t>();
}

PackShape shapeOf(SampleType type, std::size_t columns, std::size_t rows)
{
    return {.columns = columns, .rows = rows, .element_bytes = sampleBytes(type)};
}

std::size_t maskRowBytes(std::size_t columns)
{
    return (columns + 7) / 8;
}

LevelFileHeader headerFrom(const json& root, std::uint64_t file_bytes)
{
    LevelFileHeader header;
    const json& raster = root.at("raster");
    header.key.raster = {.path = raster.at("path").get<std::string>(),
                         .bytes = raster.at("bytes").get<std::uint64_t>(),
                         .modified_s = raster.at("modified_s").get<std::int64_t>(),
                         .digest = raster.at("digest").get<std::string>()};
    header.key.band = root.at("band").get<int>();
    if (!root.at("nodata").is_null()) {
        header.key.nodata = numberFrom(root.at("nodata"));
    }
    const json& layout = root.at("layout");
    header.layout = {.columns = wholeNumberFrom(layout.at("columns"), kSideMax),
                     .rows = wholeNumberFrom(layout.at("rows"), kSideMax),
                     .type = sampleTypeFrom(layout.at("type").get<std::string>()),
                     .has_voids = layout.at("has_voids").get<bool>(),
                     .mean_levels = wholeNumberFrom(layout.at("mean_levels"), 40)};
    if (header.layout.columns < 2 || header.layout.rows < 2) {
        throw std::invalid_argument("there are fewer than 2 × 2 samples");
    }
    const json& statistics = root.at("statistics");
    header.statistics.raw_minimum = numberFrom(statistics.at("raw_minimum"));
    header.statistics.raw_maximum = numberFrom(statistics.at("raw_maximum"));
    if (statistics.contains("raw_next_minimum")) {
        header.statistics.raw_next_minimum = numberFrom(statistics.at("raw_next_minimum"));
        header.statistics.raw_next_maximum = numberFrom(statistics.at("raw_next_maximum"));
    }
    header.statistics.sample_count = header.layout.columns * header.layout.rows;
    header.statistics.void_count =
        wholeNumberFrom(statistics.at("void_count"), header.statistics.sample_count);
    const json& scale = root.at("scale");
    header.scale = {.gain = numberFrom(scale.at("gain")),
                    .offset_m = numberFrom(scale.at("offset_m"))};
    header.block_samples = wholeNumberFrom(root.at("block_samples"), kSideMax);
    if (header.block_samples < BlockMeans::kBlock || !std::has_single_bit(header.block_samples)) {
        throw std::invalid_argument("the block size is not a power of two");
    }
    const std::uint64_t tiles = header.layout.tileColumns(TileKind::Samples, 0) *
                                header.layout.tileRows(TileKind::Samples, 0);
    header.fill_tiles = wholeNumberFrom(root.at("fill_tiles"), tiles);
    header.coarse_tiles = wholeNumberFrom(root.at("coarse_tiles"), keptTileCount(header.layout));
    header.planes = planesOf(header);
    const json& planes = root.at("planes");
    if (planes.size() != header.planes.size()) {
        throw std::invalid_argument("the number of arrays is wrong");
    }
    for (std::size_t i = 0; i < header.planes.size(); ++i) {
        LevelPlane& plane = header.planes[i];
        const json& chunks = planes.at(i).at("chunks");
        if (planes.at(i).at("name") != plane.name || chunks.size() != plane.chunkCount()) {
            throw std::invalid_argument("the array \"" + plane.name + "\" has the wrong shape");
        }
        for (const json& chunk : chunks) {
            const FilePart part{.offset = wholeNumberFrom(chunk.at(0), file_bytes),
                                .bytes = wholeNumberFrom(chunk.at(1), file_bytes),
                                .checksum = static_cast<std::uint32_t>(wholeNumberFrom(
                                    chunk.at(2), std::numeric_limits<std::uint32_t>::max()))};
            // Allocations are bounded by the size of the packed data.
            const std::size_t raw_bytes = plane.chunkShape(plane.chunks.size()).bytes();
            if (part.bytes > file_bytes - part.offset || raw_bytes / kPackRatioMax > part.bytes) {
                throw std::invalid_argument("the array \"" + plane.name +
                                            "\" does not fit in the file");
            }
            plane.chunks.push_back(part);
        }
    }
    return header;
}

} // namespace

Error damaged(const std::string& path, const std::string& what)
{
    return {ErrorCode::Invalid, fmt::format("{}: {}; prepare the map again", path, what)};
}

std::array<std::byte, kPreambleBytes> writtenPreamble(const LevelFilePreamble& preamble)
{
    std::array<std::byte, kPreambleBytes> bytes{};
    std::memcpy(bytes.data(), kMagic.data(), kMagic.size());
    put(bytes, 8, kLevelFileVersion);
    put(bytes, 12, preamble.header_checksum);
    put(bytes, 16, preamble.file_bytes);
    put(bytes, 24, preamble.planes_offset);
    put(bytes, 32, preamble.tail_offset);
    put(bytes, 40, preamble.header_offset);
    put(bytes, 60, crc32Of(std::span<const std::byte>(bytes).first(60)));
    return bytes;
}

Result<LevelFilePreamble>
readPreamble(std::span<const std::byte> bytes, std::uint64_t file_bytes, const std::string& path)
{
    if (bytes.size() < kPreambleBytes) {
        return damaged(path, fmt::format("has only {} bytes", bytes.size()));
    }
    if (std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0) {
        return damaged(path, "is not a level file");
    }
    if (get<std::uint32_t>(bytes, 8) != kLevelFileVersion) {
        return damaged(path, fmt::format("is of version {}, and this program reads version {}",
                                         get<std::uint32_t>(bytes, 8), kLevelFileVersion));
    }
    if (get<std::uint32_t>(bytes, 60) != crc32Of(bytes.first(60))) {
        return damaged(path, "is damaged at its beginning");
    }
    const LevelFilePreamble preamble{.header_checksum = get<std::uint32_t>(bytes, 12),
                                     .file_bytes = get<std::uint64_t>(bytes, 16),
                                     .planes_offset = get<std::uint64_t>(bytes, 24),
                                     .tail_offset = get<std::uint64_t>(bytes, 32),
                                     .header_offset = get<std::uint64_t>(bytes, 40)};
    if (preamble.file_bytes != file_bytes) {
        return damaged(path, fmt::format("has {} bytes instead of {}: it was cut short or "
                                         "extended",
                                         file_bytes, preamble.file_bytes));
    }
    if (!(kPreambleBytes <= preamble.planes_offset &&
          preamble.planes_offset <= preamble.tail_offset &&
          preamble.tail_offset <= preamble.header_offset && preamble.header_offset < file_bytes)) {
        return damaged(path, "is inconsistent at its beginning");
    }
    return preamble;
}

std::size_t LevelPlane::rowsPerChunk() const noexcept
{
    const std::size_t row_bytes = shape.columns * shape.element_bytes;
    return std::max<std::size_t>(1, kChunkBytes / std::max<std::size_t>(1, row_bytes));
}

std::size_t LevelPlane::chunkCount() const noexcept
{
    return shape.columns == 0 ? 0 : (shape.rows + rowsPerChunk() - 1) / rowsPerChunk();
}

PackShape LevelPlane::chunkShape(std::size_t chunk) const noexcept
{
    PackShape part = shape;
    part.rows = std::min(rowsPerChunk(), shape.rows - chunk * rowsPerChunk());
    return part;
}

std::vector<LevelPlane> planesOf(const LevelFileHeader& header)
{
    const TileLayout& layout = header.layout;
    std::vector<LevelPlane> planes;
    const auto add = [&planes](std::string name, const PackShape& shape) {
        planes.push_back({.name = std::move(name), .shape = shape, .chunks = {}});
    };
    const std::size_t columns = RawRanges::blocksAlong(layout.columns);
    const std::size_t rows = RawRanges::blocksAlong(layout.rows);
    add("ranges", {.columns = 2 * columns,
                   .rows = rows,
                   .element_bytes = sampleBytes(layout.type),
                   .interleaved = 2});
    // Nodes of a level are twice as wide as those of the level below.
    std::size_t node_columns = columns;
    std::size_t node_rows = rows;
    for (std::size_t level = 1; node_columns * node_rows > 1; ++level) {
        node_columns = (node_columns + 1) / 2;
        node_rows = (node_rows + 1) / 2;
        add(fmt::format("errors {}", level),
            {.columns = node_columns, .rows = node_rows, .element_bytes = sizeof(float)});
    }
    const BlockExtent blocks = header.blocks();
    const PackShape block_shape{.columns = blocks.blockColumns(),
                                .rows = blocks.blockRows(),
                                .element_bytes = sizeof(float)};
    add("means", block_shape);
    if (header.hasVoids()) {
        add("shares", block_shape);
        add("fills", {.columns = 2 * columns,
                      .rows = rows,
                      .element_bytes = sizeof(float),
                      .interleaved = 2});
    }
    add("checksums", {.columns = TileChecksums::countFor(layout),
                      .rows = 1,
                      .element_bytes = sizeof(std::uint32_t)});
    constexpr std::size_t kIndexBytes = sizeof(std::uint64_t);
    add("samples index",
        {.columns = keptTileCount(layout), .rows = 3, .element_bytes = kIndexBytes});
    add("fills index", {.columns = header.fill_tiles, .rows = 4, .element_bytes = kIndexBytes});
    add("coarse index", {.columns = header.coarse_tiles, .rows = 4, .element_bytes = kIndexBytes});
    return planes;
}

std::string writtenHeader(const LevelFileHeader& header)
{
    json planes = json::array();
    for (const LevelPlane& plane : header.planes) {
        json chunks = json::array();
        for (const FilePart& part : plane.chunks) {
            chunks.push_back({part.offset, part.bytes, part.checksum});
        }
        planes.push_back({{"name", plane.name}, {"chunks", std::move(chunks)}});
    }
    const LevelFileKey& key = header.key;
    const json root{{"raster",
                     {{"path", key.raster.path},
                      {"bytes", key.raster.bytes},
                      {"modified_s", key.raster.modified_s},
                      {"digest", key.raster.digest}}},
                    {"band", key.band},
                    {"nodata", key.nodata ? numberJson(*key.nodata) : json(nullptr)},
                    {"layout",
                     {{"columns", header.layout.columns},
                      {"rows", header.layout.rows},
                      {"type", sampleTypeName(header.layout.type)},
                      {"has_voids", header.layout.has_voids},
                      {"mean_levels", header.layout.mean_levels}}},
                    {"statistics",
                     {{"raw_minimum", numberJson(header.statistics.raw_minimum)},
                      {"raw_maximum", numberJson(header.statistics.raw_maximum)},
                      {"raw_next_minimum", numberJson(header.statistics.raw_next_minimum)},
                      {"raw_next_maximum", numberJson(header.statistics.raw_next_maximum)},
                      {"void_count", header.statistics.void_count}}},
                    {"scale",
                     {{"gain", numberJson(header.scale.gain)},
                      {"offset_m", numberJson(header.scale.offset_m)}}},
                    {"block_samples", header.block_samples},
                    {"fill_tiles", header.fill_tiles},
                    {"coarse_tiles", header.coarse_tiles},
                    {"planes", std::move(planes)}};
    // A path need not be UTF-8.
    return root.dump(-1, ' ', false, json::error_handler_t::replace);
}

Result<LevelFileHeader>
readHeader(std::span<const std::byte> json_bytes, std::uint64_t file_bytes, const std::string& path)
{
    try {
        const auto* text = reinterpret_cast<const char*>(json_bytes.data());
        return headerFrom(json::parse(text, text + json_bytes.size()), file_bytes);
    } catch (const std::exception& problem) { // from the library and from this file
        return damaged(path, fmt::format("has an invalid header ({})", problem.what()));
    }
}

BlockExtent finestBlocks(const TileLayout& layout, std::size_t blocks_max)
{
    BlockExtent extent{layout.columns, layout.rows, BlockMeans::kBlock};
    while (extent.blockColumns() * extent.blockRows() > std::max<std::size_t>(1, blocks_max)) {
        extent = extent.coarser();
    }
    return extent;
}

std::size_t keptTileCount(const TileLayout& layout)
{
    const std::size_t top = layout.topLevel();
    std::size_t count = 0;
    for (std::size_t level = LevelFile::kFirstLevel; level <= top; ++level) {
        count += layout.tileColumns(TileKind::Samples, level) *
                 layout.tileRows(TileKind::Samples, level);
    }
    return count;
}

std::size_t keptTileNumber(const TileLayout& layout, const TileId& id)
{
    std::size_t number = 0;
    for (std::size_t level = LevelFile::kFirstLevel; level < id.level; ++level) {
        number += layout.tileColumns(TileKind::Samples, level) *
                  layout.tileRows(TileKind::Samples, level);
    }
    return number + id.row * layout.tileColumns(TileKind::Samples, id.level) + id.column;
}

std::vector<std::byte> packedArray(const SampleGrid& samples)
{
    const PackShape shape = shapeOf(samples.type(), samples.columns(), samples.rows());
    return samples.visit([&](auto values) {
        return packed(shape, {reinterpret_cast<const std::byte*>(values.data()), shape.bytes()});
    });
}

std::vector<std::byte> packedSamples(const SampleGrid& samples)
{
    const PackShape shape = shapeOf(samples.type(), samples.columns(), samples.rows());
    const std::size_t row_bytes = maskRowBytes(shape.columns);
    std::vector<std::byte> mask(samples.hasVoids() ? row_bytes * shape.rows : 0);
    for (std::size_t row = 0; !mask.empty() && row < shape.rows; ++row) {
        for (std::size_t column = 0; column < shape.columns; ++column) {
            if (samples.isVoid(column, row)) {
                mask[row * row_bytes + column / 8] |= std::byte{1} << (column % 8);
            }
        }
    }
    std::vector<std::byte> bytes = samples.visit([&](auto values) {
        return packed(shape, {reinterpret_cast<const std::byte*>(values.data()), shape.bytes()},
                      mask);
    });
    bytes.insert(bytes.begin(), std::byte{mask.empty() ? std::uint8_t{0} : std::uint8_t{1}});
    return bytes;
}

std::optional<SampleGrid> unpackSamples(std::span<const std::byte> bytes,
                                        SampleType type,
                                        std::size_t columns,
                                        std::size_t rows)
{
    auto samples = SampleGrid::create(type, columns, rows);
    if (!samples || bytes.empty() || bytes[0] > std::byte{1}) {
        return std::nullopt;
    }
    const PackShape shape = shapeOf(type, columns, rows);
    const std::size_t row_bytes = maskRowBytes(columns);
    std::vector<std::byte> mask(bytes[0] == std::byte{1} ? row_bytes * rows : 0);
    if (!unpack(bytes.subspan(1), shape, {samples->rowData(0), shape.bytes()}, mask)) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < mask.size(); ++i) {
        for (std::size_t bit = 0; mask[i] != std::byte{0} && bit < 8; ++bit) {
            const std::size_t column = i % row_bytes * 8 + bit;
            if ((mask[i] >> bit & std::byte{1}) != std::byte{0} && column < columns) {
                samples->markVoid(column, i / row_bytes);
            }
        }
    }
    return std::move(samples).value();
}

FillWindow fillWindow(const TileLayout& layout, const TileId& id)
{
    constexpr std::size_t kTileBlocks = kTileSide / BlockMeans::kBlock;
    const BlockExtent blocks{layout.columns, layout.rows, BlockMeans::kBlock};
    const auto along = [](std::size_t tile, std::size_t count) {
        const std::size_t first = tile * kTileBlocks - (tile > 0 ? 1 : 0);
        return std::pair{first, std::min((tile + 1) * kTileBlocks + 1, count) - first};
    };
    const auto [first_column, columns] = along(id.column, blocks.blockColumns());
    const auto [first_row, rows] = along(id.row, blocks.blockRows());
    return {.first_column = first_column, .first_row = first_row, .columns = columns, .rows = rows};
}

} // namespace marsview
