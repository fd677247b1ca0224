#include "core/prepare/parts/part_tiles.h"

#include "core/base/check.h"
#include "core/base/deflate.h"
#include "core/prepare/geotiff_skeleton.h"
#include "core/prepare/overview_builder.h"
#include "core/prepare/tiff/tiff_tiles.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <optional>
#include <unistd.h>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kNone = ~std::size_t{0};

// The page of a level, 0 being the raster, or of its mask; kNone if there is none.
std::size_t
pageOf(const PartedMap& map, const std::vector<TiffPage>& pages, std::size_t level, bool is_mask)
{
    const std::size_t columns = TileLayout::samplesAlong(TileKind::Means, level, map.info.columns);
    const std::size_t rows = TileLayout::samplesAlong(TileKind::Means, level, map.info.rows);
    const auto at = std::find_if(pages.begin(), pages.end(), [&](const TiffPage& page) {
        return page.is_mask == is_mask && page.columns == columns && page.rows == rows;
    });
    return at != pages.end() ? static_cast<std::size_t>(at - pages.begin()) : kNone;
}

class Reader final : public TileReader {
public:
    Reader(const PartedMap& map, const PartTileFile& file, const TileLayout& layout)
        : map_(map)
        , file_(file)
        , layout_(layout)
    {}

    Result<Tile> read(const TileId& id) override
    {
        MARSVIEW_CHECK(layout_.contains(id) && TileChecksums::covers(id));
        const std::size_t level = id.kind == TileKind::Means ? id.level : 0;
        const std::size_t sample_bytes = sampleBytes(layout_.type);
        std::vector<std::byte> bytes(kTileSide * kTileSide * sample_bytes);
        if (Status decoded = decode(level, false, id, bytes); !decoded) {
            return std::move(decoded).error();
        }
        Result<SampleGrid> samples =
            SampleGrid::create(layout_.type, layout_.tileWidth(id), layout_.tileHeight(id));
        if (!samples) {
            return std::move(samples).error();
        }
        for (std::size_t row = 0; row < samples->rows(); ++row) {
            std::memcpy(samples->rowData(row), bytes.data() + row * kTileSide * sample_bytes,
                        samples->columns() * sample_bytes);
        }
        if (map_.info.needsVoidMask()) {
            if (Status masked = applyMask(level, id, *samples); !masked) {
                return std::move(masked).error();
            }
        }
        samples->applyRule(map_.voids, 0, samples->rows());
        return Tile{.id = id, .samples = std::move(samples).value(), .filled_m = {}};
    }

private:
    Status decode(std::size_t level, bool is_mask, const TileId& id, std::span<std::byte> to) const
    {
        const std::size_t page = pageOf(map_, file_.pages(), level, is_mask);
        MARSVIEW_CHECK(page != kNone);
        const TiffPage& of = file_.pages()[page];
        const auto encoded = file_.encoded(page, id.row * of.tile_columns + id.column);
        if (!encoded) {
            return encoded.error();
        }
        const std::size_t row_samples = is_mask && of.has_bits ? kTileSide / 8 : kTileSide;
        return decodeTile(*encoded, row_samples, is_mask ? 1 : sampleBytes(layout_.type),
                          of.predictor, to)
                   ? Status(Done{})
                   : Status(Error{ErrorCode::Unreadable,
                                  fmt::format("{}: tile {}, {} of overview {} is damaged",
                                              file_.path(), id.column, id.row, level)});
    }

    Status applyMask(std::size_t level, const TileId& id, SampleGrid& samples) const
    {
        const bool has_bits = file_.pages()[pageOf(map_, file_.pages(), level, true)].has_bits;
        const std::size_t row_bytes = has_bits ? kTileSide / 8 : kTileSide;
        std::vector<std::byte> mask(kTileSide * row_bytes);
        if (Status decoded = decode(level, true, id, mask); !decoded) {
            return decoded;
        }
        for (std::size_t row = 0; row < samples.rows(); ++row) {
            const std::byte* valid = mask.data() + row * row_bytes;
            for (std::size_t column = 0; column < samples.columns(); ++column) {
                const std::byte bit = has_bits
                                          ? valid[column / 8] & (std::byte{0x80} >> (column % 8))
                                          : valid[column];
                if (bit == std::byte{0}) {
                    samples.markVoid(column, row);
                }
            }
        }
        return Done{};
    }

    const PartedMap& map_;
    const PartTileFile& file_;
    const TileLayout& layout_;
};

class Source final : public TileSource {
public:
    Source(const PartedMap& map, const PartTileFile& file)
        : map_(map)
        , file_(file)
        , layout_(layoutOf(map))
    {}

    const TileLayout& layout() const noexcept override { return layout_; }
    const std::string& name() const noexcept override { return file_.path(); }
    Result<std::unique_ptr<TileReader>> open() const override
    {
        return std::unique_ptr<TileReader>(std::make_unique<Reader>(map_, file_, layout_));
    }

private:
    const PartedMap& map_;
    const PartTileFile& file_;
    TileLayout layout_;
};

} // namespace

Result<std::vector<TiffPage>> pagesOfMap(const PartedMap& map, std::size_t part)
{
    // One overview, if the map has any, is enough: the others are like it.
    constexpr std::size_t kSideMax = 2 * kTileSide;
    RasterInfo small = map.info;
    small.columns = std::min(small.columns, kSideMax);
    small.rows = std::min(small.rows, kSideMax);
    small.crs.reset();
    small.transform.reset();
    const std::string path = map.file(part, "layout.tif");
    if (Status made = writeGeoTiffSkeleton(path, small, {map.key, map.source_path}); !made) {
        return std::move(made).error();
    }
    const Result<TiffTiles> tiles = TiffTiles::open(path, TiffTiles::Access::Read);
    removePartFile(path);
    if (!tiles) {
        return tiles.error();
    }
    std::vector<TiffPage> pages;
    for (std::size_t level = 0; level <= overviewCount(map.info.columns, map.info.rows); ++level) {
        for (const TiffPage& like : tiles->pages()) {
            const bool is_overview = like.columns < small.columns || like.rows < small.rows;
            if (is_overview != (level > 0)) {
                continue;
            }
            TiffPage page = like;
            page.columns = TileLayout::samplesAlong(TileKind::Means, level, map.info.columns);
            page.rows = TileLayout::samplesAlong(TileKind::Means, level, map.info.rows);
            page.tile_columns = (page.columns + kTileSide - 1) / kTileSide;
            page.tile_rows = (page.rows + kTileSide - 1) / kTileSide;
            pages.push_back(page);
        }
    }
    return pages;
}

PartTileFile::PartTileFile(std::vector<TiffPage> pages, std::string path)
    : pages_(std::move(pages))
    , path_(std::move(path))
    , tiles_(pages_.size())
{}

PartTileFile::~PartTileFile()
{
    if (file_ >= 0) {
        ::close(file_);
    }
}

Status PartTileFile::begin(const PartedMap& map, const PartRows& rows, int flags)
{
    constexpr mode_t kMode = 0666;
    file_ = ::open(path_.c_str(), flags | O_CLOEXEC, kMode);
    if (file_ < 0) {
        return writeError(path_, errno, "cannot be opened");
    }
    Status listed = Done{};
    forEachTileRow(map, rows, [&](std::size_t level, std::size_t row) {
        if (!rows.hasMeans(level, row, map.tileRows())) {
            return;
        }
        for (const bool is_mask : {false, true}) {
            const std::size_t page = pageOf(map, pages_, level, is_mask);
            if (page == kNone) {
                if (!is_mask || map.info.needsVoidMask()) {
                    listed = writeError(path_, 0, "cannot have the requested layout");
                }
                continue;
            }
            PageTiles& of = tiles_[page];
            const std::size_t columns = pages_[page].tile_columns;
            if (of.tiles.empty()) {
                of.first = row * columns;
            }
            for (std::size_t column = 0; column < columns; ++column) {
                in_order_.emplace_back(page, row * columns + column);
            }
            of.tiles.resize((row + 1) * columns - of.first);
        }
    });
    return listed;
}

Result<std::unique_ptr<PartTileFile>> PartTileFile::create(const PartedMap& map,
                                                           const PartRows& rows,
                                                           std::vector<TiffPage> pages,
                                                           const std::string& path)
{
    std::unique_ptr<PartTileFile> file(new PartTileFile(std::move(pages), path));
    if (Status begun = file->begin(map, rows, O_RDWR | O_CREAT | O_TRUNC); !begun) {
        return std::move(begun).error();
    }
    return file;
}

Result<std::unique_ptr<PartTileFile>> PartTileFile::open(const PartedMap& map,
                                                         const PartRows& rows,
                                                         std::vector<TiffPage> pages,
                                                         const std::string& path,
                                                         std::span<const std::uint32_t> sizes,
                                                         std::span<const std::uint32_t> checksums)
{
    std::unique_ptr<PartTileFile> file(new PartTileFile(std::move(pages), path));
    if (Status begun = file->begin(map, rows, O_RDONLY); !begun) {
        return std::move(begun).error();
    }
    if (sizes.size() != file->in_order_.size() || checksums.size() != sizes.size()) {
        return notOfThisPart();
    }
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const auto [page, tile] = file->in_order_[i];
        PageTiles& of = file->tiles_[page];
        of.tiles[tile - of.first] = {
            .offset = file->end_, .bytes = sizes[i], .checksum = checksums[i]};
        file->end_ += sizes[i];
    }
    return file;
}

Error PartTileFile::failed(const char* what) const
{
    return writeError(path_, errno, what);
}

Status PartTileFile::append(std::size_t page, std::size_t tile, std::span<const std::byte> encoded)
{
    PageTiles& of = tiles_.at(page);
    MARSVIEW_CHECK(tile >= of.first && tile - of.first < of.tiles.size());
    for (std::size_t done = 0; done < encoded.size();) {
        const ssize_t written = pwrite(file_, encoded.data() + done, encoded.size() - done,
                                       static_cast<off_t>(end_ + done));
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            return failed("cannot be written");
        }
        done += static_cast<std::size_t>(written);
    }
    of.tiles[tile - of.first] = {.offset = end_,
                                 .bytes = static_cast<std::uint32_t>(encoded.size()),
                                 .checksum = crc32Of(encoded)};
    end_ += encoded.size();
    return Done{};
}

Status PartTileFile::flush()
{
    return fdatasync(file_) == 0 ? Status(Done{}) : Status(failed("cannot be written to the disk"));
}

const PartTileFile::Stored* PartTileFile::find(std::size_t page, std::size_t tile) const
{
    const PageTiles& of = tiles_.at(page);
    return tile >= of.first && tile - of.first < of.tiles.size() ? &of.tiles[tile - of.first]
                                                                 : nullptr;
}

std::uint64_t PartTileFile::encodedBytes(std::size_t page, std::size_t tile) const
{
    const Stored* stored = find(page, tile);
    return stored != nullptr ? stored->bytes : 0;
}

std::uint32_t PartTileFile::checksum(std::size_t page, std::size_t tile) const
{
    const Stored* stored = find(page, tile);
    return stored != nullptr ? stored->checksum : 0;
}

Result<std::vector<std::byte>> PartTileFile::encoded(std::size_t page, std::size_t tile) const
{
    const Stored* stored = find(page, tile);
    std::vector<std::byte> bytes(stored != nullptr ? stored->bytes : 0);
    if (bytes.empty() ||
        pread(file_, bytes.data(), bytes.size(), static_cast<off_t>(stored->offset)) !=
            static_cast<ssize_t>(bytes.size())) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: tile {} of page {} is missing", path_, tile, page)};
    }
    return bytes;
}

std::vector<std::uint32_t> PartTileFile::sizes() const
{
    std::vector<std::uint32_t> sizes;
    for (const auto& [page, tile] : in_order_) {
        sizes.push_back(find(page, tile)->bytes);
    }
    return sizes;
}

std::vector<std::uint32_t> PartTileFile::checksums() const
{
    std::vector<std::uint32_t> checksums;
    for (const auto& [page, tile] : in_order_) {
        checksums.push_back(find(page, tile)->checksum);
    }
    return checksums;
}

bool PartTileFile::isIntact() const
{
    return std::all_of(in_order_.begin(), in_order_.end(), [this](const auto& at) {
        const auto bytes = encoded(at.first, at.second);
        return bytes && crc32Of(*bytes) == checksum(at.first, at.second);
    });
}

Result<std::unique_ptr<PartTileFile>> openPartTiles(const PartedMap& map, std::size_t part)
{
    Result<CheckpointReader> state = openPartState(map, part, kPartSurvey);
    if (!state) {
        return std::move(state).error();
    }
    PartFiles files;
    auto pages = pagesOfMap(map, part);
    if (!pages) {
        return std::move(pages).error();
    }
    if (!files.restore(*state)) {
        return notOfThisPart();
    }
    return PartTileFile::open(map, map.rowsOf(part), std::move(pages).value(),
                              map.file(part, kPartTiles), files.sizes, files.checksums);
}

std::shared_ptr<const TileSource> sourceOf(const PartedMap& map, const PartTileFile& file)
{
    return std::make_shared<const Source>(map, file);
}

} // namespace marsview
