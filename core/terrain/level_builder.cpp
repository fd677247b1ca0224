// Two passes. The first finds everything but errors, and keeps what the second needs of other
// tiles: the first row of each row of tiles, and every 64th sample of every 64th row, which are the
// vertices of levels coarser than a block. The second compares every sample with every level, tile
// by tile, the tile to the right being read ahead for its first column.

#include "core/terrain/detail_measure.h"
#include "core/terrain/fill_range.h"
#include "core/terrain/level_file.h"
#include "core/terrain/level_file_writer.h"
#include "core/terrain/level_survey.h"
#include "core/terrain/nested_levels.h"
#include "core/terrain/sample_rows.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <span>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kBlock = RawRanges::kBlock;

// Shares of the time, as measured.
constexpr double kSurveyShare = 0.3;
constexpr double kErrorsShare = 0.67;

// Tiles that are complete at some time: numbers, and where they lie.
class TileParts {
public:
    void add(std::uint64_t number, const FilePart& part)
    {
        const std::lock_guard lock(mutex_);
        parts_.emplace_back(number, part);
    }
    std::size_t size() const { return parts_.size(); }
    // As the file has them: four rows.
    std::vector<std::uint64_t> index()
    {
        std::sort(parts_.begin(), parts_.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<std::uint64_t> rows;
        for (const auto& [number, part] : parts_) {
            rows.push_back(number);
        }
        for (const auto& [number, part] : parts_) {
            rows.push_back(part.offset);
        }
        for (const auto& [number, part] : parts_) {
            rows.push_back(part.bytes);
        }
        for (const auto& [number, part] : parts_) {
            rows.push_back(part.checksum);
        }
        return rows;
    }

private:
    std::mutex mutex_;
    std::vector<std::pair<std::uint64_t, FilePart>> parts_;
};

std::vector<std::uint64_t> indexOf(const std::vector<FilePart>& parts)
{
    std::vector<std::uint64_t> rows;
    for (const FilePart& part : parts) {
        rows.push_back(part.offset);
    }
    for (const FilePart& part : parts) {
        rows.push_back(part.bytes);
    }
    for (const FilePart& part : parts) {
        rows.push_back(part.checksum);
    }
    return rows;
}

// The second pass.
class ErrorPass {
public:
    ErrorPass(const LevelBuild& build,
              const LevelSurvey& survey,
              LevelFileWriter& writer,
              JobMonitor& monitor)
        : build_(build)
        , layout_(build.source->layout())
        , survey_(survey)
        , writer_(writer)
        , monitor_(monitor)
        , means_(BlockMeans::from(survey.blocks, survey.kept))
        , range_(heightRange(survey.statistics, build.scale))
        , has_voids_(survey.statistics.void_count > 0)
        , has_coarse_fills_(has_voids_ && layout_.topLevel() >= LevelFile::kFirstLevel)
        , tile_columns_(layout_.tileColumns(TileKind::Samples, 0))
        , tile_rows_(layout_.tileRows(TileKind::Samples, 0))
        , coarse_fills_(layout_, SampleType::Float32, LevelFile::kFirstLevel, layout_.topLevel())
    {
        const HeightRange range =
            heightRange(survey.statistics, build.scale).value_or(HeightRange{});
        base_m_ = (range.minimum_m + range.maximum_m) / 2.0;
        if (has_voids_) {
            constexpr float kInfinity = std::numeric_limits<float>::infinity();
            for (std::size_t i = 0; i < survey.ranges.columns() * survey.ranges.rows(); ++i) {
                fills_m_.push_back(kInfinity);
                fills_m_.push_back(-kInfinity);
            }
        }
    }

    Status run(TileReaders& readers, std::size_t threads_max)
    {
        auto sparse = sparseHeights();
        if (!sparse) {
            return std::move(sparse).error();
        }
        measure_.emplace(layout_.columns, layout_.rows, std::move(sparse).value());
        return readers.eachTileRow(
            [this](TileReader& reader, std::size_t tile_row) {
                return measureRow(reader, tile_row);
            },
            threads_max, monitor_);
    }

    DetailErrors errors() { return std::move(*measure_).finish(); }
    const std::vector<float>& fills() const { return fills_m_; }
    TileParts& tileFills() { return tile_fills_; }
    TileParts& coarseFills() { return coarse_fill_parts_; }
    // Which may be larger than those of the survey.
    BlockGrid blocksOf(std::size_t block_samples) const
    {
        BlockGrid blocks = survey_.blocks;
        for (BlockExtent extent = survey_.kept; extent.block_samples < block_samples;
             extent = extent.coarser()) {
            blocks = reduced(blocks, extent);
        }
        return blocks;
    }

private:
    // What one thread works with.
    struct Scratch {
        std::vector<float> heights; // of a tile and the first column and row after it
        std::vector<float> drawn;
        std::vector<float> fill_row;
    };

    bool hasVoids(std::size_t column, std::size_t row) const
    {
        return column < tile_columns_ && row < tile_rows_ &&
               survey_.has_voids[row * tile_columns_ + column] != 0;
    }
    bool rowHasVoids(std::size_t row) const
    {
        for (std::size_t column = 0; column < tile_columns_; ++column) {
            if (hasVoids(column, row)) {
                return true;
            }
        }
        return false;
    }

    // The drawn heights of the sparse level: those that are void need the means around.
    Result<std::vector<float>> sparseHeights()
    {
        constexpr std::size_t kStep = std::size_t{1} << DetailMeasure::kSparseLevel;
        const SampleGrid& samples = *survey_.sparse;
        std::vector<float> heights(samples.columns() * samples.rows());
        std::optional<BlockRows> filled;
        std::size_t filled_tile_row = 0;
        for (std::size_t row = 0; row < samples.rows(); ++row) {
            const std::size_t map_row = std::min(row * kStep, layout_.rows - 1);
            const std::size_t tile_row = map_row / kTileSide;
            for (std::size_t column = 0; column < samples.columns(); ++column) {
                float& height = heights[row * samples.columns() + column];
                if (!samples.isVoid(column, row)) {
                    height =
                        static_cast<float>(build_.scale.height(samples.raw(column, row)) - base_m_);
                    continue;
                }
                if (!filled || filled_tile_row != tile_row) {
                    if (monitor_.isCancelled()) {
                        return Error{ErrorCode::Cancelled, "cancelled"};
                    }
                    auto rows = filledRows(survey_.fine_means, means_, tile_row);
                    if (!rows) {
                        return std::move(rows).error();
                    }
                    filled = std::move(rows).value();
                    filled_tile_row = tile_row;
                }
                const std::size_t map_column = std::min(column * kStep, layout_.columns - 1);
                height = overBase(filledAt(*filled, map_column, map_row));
            }
        }
        return heights;
    }

    static float filledAt(const BlockRows& filled, std::size_t column, std::size_t row)
    {
        const BlockPlace x = placeOfSample(column, BlockMeans::kBlock, filled.columns);
        const BlockPlace y = placeOfSample(row, BlockMeans::kBlock, filled.level_rows);
        return interpolated(
            interpolated(filled(x.before, y.before), filled(x.after, y.before), x.share),
            interpolated(filled(x.before, y.after), filled(x.after, y.after), x.share), y.share);
    }

    float overBase(float height_m) const
    {
        return static_cast<float>(static_cast<double>(height_m) - base_m_);
    }

    Status measureRow(TileReader& reader, std::size_t tile_row)
    {
        std::optional<BlockRows> filled;
        if (has_voids_ && (rowHasVoids(tile_row) || rowHasVoids(tile_row + 1))) {
            auto rows = filledRows(survey_.fine_means, means_, tile_row);
            if (!rows) {
                return std::move(rows).error();
            }
            filled = std::move(rows).value();
        }
        DetailMeasure::Worker worker(*measure_);
        Scratch scratch;
        std::optional<Tile> next;
        for (std::size_t column = 0; column < tile_columns_; ++column) {
            std::optional<Tile> tile = std::move(next);
            next.reset();
            if (!tile) {
                auto read = readAgain(reader, column, tile_row);
                if (!read) {
                    return std::move(read).error();
                }
                tile = std::move(read).value();
            }
            if (column + 1 < tile_columns_) {
                auto read = readAgain(reader, column + 1, tile_row);
                if (!read) {
                    return std::move(read).error();
                }
                next = std::move(read).value();
            }
            if (auto done = measureTile(*tile, next ? &next->samples : nullptr,
                                        filled ? &*filled : nullptr, worker, scratch);
                !done) {
                return done;
            }
            monitor_.report(static_cast<double>(++done_) /
                            static_cast<double>(tile_columns_ * tile_rows_));
        }
        return Done{};
    }

    Result<Tile> readAgain(TileReader& reader, std::size_t column, std::size_t row)
    {
        const TileId id{.kind = TileKind::Samples,
                        .level = 0,
                        .column = static_cast<std::uint32_t>(column),
                        .row = static_cast<std::uint32_t>(row)};
        auto tile = readTile(reader, *build_.source, id, monitor_);
        if (tile &&
            sampleChecksum(tile->samples) != survey_.checksums[row * tile_columns_ + column]) {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: changed while it was read; open it again when nothing "
                                     "writes to it any more",
                                     build_.source->name())};
        }
        return tile;
    }

    Status measureTile(const Tile& tile,
                       const SampleGrid* right,
                       const BlockRows* filled,
                       DetailMeasure::Worker& worker,
                       Scratch& scratch)
    {
        const TileId& id = tile.id;
        DetailPart part{.first_column = id.column * kTileSide,
                        .first_row = id.row * kTileSide,
                        .columns = tile.samples.columns() + (right != nullptr ? 1 : 0),
                        .rows = tile.samples.rows() + (id.row + 1 < tile_rows_ ? 1 : 0)};
        readPart(tile.samples, right, part, scratch.heights);
        part.heights = scratch.heights.data();
        std::optional<TileFill> fill;
        if (hasVoids(id.column, id.row) || hasVoids(id.column + 1, id.row) ||
            hasVoids(id.column, id.row + 1) || hasVoids(id.column + 1, id.row + 1)) {
            fill = tileFill(*filled, layout_, id);
            fillPart(*fill, part, scratch);
            part.drawn = scratch.drawn.data();
        }
        if (part.columns > 1 && part.rows > 1) {
            worker.measure(part);
        }
        return hasVoids(id.column, id.row) || has_coarse_fills_
                   ? keepFill(tile, fill ? &*fill : nullptr)
                   : Status(Done{});
    }

    // The tile's heights over the base, with the first column and row of what follows.
    void readPart(const SampleGrid& samples,
                  const SampleGrid* right,
                  const DetailPart& part,
                  std::vector<float>& heights) const
    {
        heights.resize(part.columns * part.rows);
        const std::size_t width = samples.columns();
        for (std::size_t row = 0; row < samples.rows(); ++row) {
            float* to = heights.data() + row * part.columns;
            readHeights(samples, build_.scale, 0, row, base_m_, {to, width});
            if (right != nullptr) {
                readHeights(*right, build_.scale, 0, row, base_m_, {to + width, 1});
            }
        }
        if (part.rows > samples.rows()) {
            readHeights(*survey_.first_rows, build_.scale, part.first_column,
                        part.first_row / kTileSide, base_m_,
                        {heights.data() + samples.rows() * part.columns, part.columns});
        }
    }

    // Fills the gaps for drawing, and notes the range of fills of each block.
    void fillPart(const TileFill& fill, const DetailPart& part, Scratch& scratch)
    {
        scratch.drawn = scratch.heights;
        scratch.fill_row.resize(part.columns);
        for (std::size_t row = 0; row < part.rows; ++row) {
            float* drawn = scratch.drawn.data() + row * part.columns;
            if (std::none_of(drawn, drawn + part.columns,
                             [](float height) { return std::isnan(height); })) {
                continue;
            }
            fill.row(part.first_column, part.first_row + row, scratch.fill_row);
            for (std::size_t column = 0; column < part.columns; ++column) {
                if (std::isnan(drawn[column])) {
                    noteFill(part, column, row, range_.clamped(scratch.fill_row[column]));
                    drawn[column] = overBase(scratch.fill_row[column]);
                }
            }
        }
    }

    // Blocks share their sides.
    void noteFill(const DetailPart& part, std::size_t column, std::size_t row, float height_m)
    {
        const auto blocks_of = [](std::size_t i, std::size_t count) {
            const std::size_t last = i / kBlock;
            return std::pair{i % kBlock == 0 && last > 0 ? last - 1 : last,
                             std::min(last + 1, (count - 1 + kBlock - 1) / kBlock)};
        };
        const auto [left, right] = blocks_of(column, part.columns);
        const auto [upper, lower] = blocks_of(row, part.rows);
        for (std::size_t y = upper; y < lower; ++y) {
            for (std::size_t x = left; x < right; ++x) {
                float* range = fills_m_.data() +
                               2 * ((part.first_row / kBlock + y) * survey_.ranges.columns() +
                                    part.first_column / kBlock + x);
                range[0] = std::min(range[0], height_m);
                range[1] = std::max(range[1], height_m);
            }
        }
    }

    Status keepFill(const Tile& tile, const TileFill* fill)
    {
        const TileId& id = tile.id;
        const bool is_filled = hasVoids(id.column, id.row);
        if (is_filled) {
            auto part = writer_.append(packed({.columns = fill->window.columns,
                                               .rows = fill->window.rows,
                                               .element_bytes = sizeof(float)},
                                              std::as_bytes(std::span(fill->means_m))));
            if (!part) {
                return std::move(part).error();
            }
            tile_fills_.add(id.row * tile_columns_ + id.column, *part);
        }
        if (!has_coarse_fills_) {
            return Done{};
        }
        std::optional<SampleGrid> heights;
        if (is_filled) {
            heights = coarseHeights(tile, *fill);
        }
        for (const LevelBand& band : coarse_fills_.add(id, heights ? &*heights : nullptr)) {
            if (auto kept = keepCoarseFills(band); !kept) {
                return kept;
            }
        }
        return Done{};
    }

    // The fills of the samples that coarser levels have; where there are any, marked as void.
    SampleGrid coarseHeights(const Tile& tile, const TileFill& fill) const
    {
        constexpr std::size_t kStep = std::size_t{1} << LevelFile::kFirstLevel;
        const std::size_t width = tile.samples.columns();
        const std::size_t height = tile.samples.rows();
        const std::size_t first_column = tile.id.column * kTileSide;
        const std::size_t first_row = tile.id.row * kTileSide;
        SampleGrid heights = SampleGrid::create(SampleType::Float32, width, height).value();
        std::vector<float> row_heights(width);
        for (std::size_t row = 0; row < height; ++row) {
            if (row % kStep != 0 && first_row + row + 1 != layout_.rows) {
                continue;
            }
            fill.row(first_column, first_row + row, row_heights);
            for (std::size_t column = 0; column < width; ++column) {
                const bool is_kept =
                    column % kStep == 0 || first_column + column + 1 == layout_.columns;
                if (is_kept && tile.samples.isVoid(column, row)) {
                    heights.markVoid(column, row);
                } else {
                    row_heights[column] = 0.0F;
                }
            }
            std::copy(row_heights.begin(), row_heights.end(),
                      reinterpret_cast<float*>(heights.rowData(row)));
        }
        return heights;
    }

    Status keepCoarseFills(const LevelBand& band)
    {
        for (std::size_t first = 0; first < band.samples.columns(); first += kTileSide) {
            if (monitor_.isCancelled()) {
                return Error{ErrorCode::Cancelled, "cancelled"};
            }
            const TileId id{.kind = TileKind::Samples,
                            .level = static_cast<std::uint8_t>(band.level),
                            .column = static_cast<std::uint32_t>(first / kTileSide),
                            .row = static_cast<std::uint32_t>(band.tile_row)};
            const SampleGrid tile = columnsOf(band.samples, first, layout_.tileWidth(id));
            if (!tile.hasVoids()) {
                continue;
            }
            auto part = writer_.append(packedArray(tile));
            if (!part) {
                return std::move(part).error();
            }
            coarse_fill_parts_.add(keptTileNumber(layout_, id), *part);
        }
        return Done{};
    }

    const LevelBuild& build_;
    TileLayout layout_;
    const LevelSurvey& survey_;
    LevelFileWriter& writer_;
    JobMonitor& monitor_;
    BlockMeans means_;
    FillRange range_;
    bool has_voids_;
    bool has_coarse_fills_;
    std::size_t tile_columns_;
    std::size_t tile_rows_;
    double base_m_ = 0.0;
    std::optional<DetailMeasure> measure_;
    // Smallest and largest fill of each block of RawRanges; a row of tiles has its own blocks.
    std::vector<float> fills_m_;
    NestedLevels coarse_fills_;
    TileParts tile_fills_;
    TileParts coarse_fill_parts_;
    std::atomic<std::size_t> done_{0};
};

// What a thread needs besides what all share: two tiles, one as floats twice, and its part of the
// bands of nested levels that are not yet whole.
std::size_t threadsFor(const TileLayout& layout, std::size_t memory_bytes_max)
{
    constexpr std::size_t kSamples = (kTileSide + 1) * (kTileSide + 1);
    const std::size_t thread_bytes = kSamples * (2 * sampleBytes(layout.type) + 8) +
                                     layout.columns / 8 * kTileSide * sampleBytes(layout.type) +
                                     layout.columns * sizeof(float);
    return std::max<std::size_t>(1, memory_bytes_max / 2 / thread_bytes);
}

} // namespace

Status buildLevelFile(const LevelBuild& build, JobMonitor& monitor)
{
    MARSVIEW_CHECK(build.source != nullptr);
    auto created = LevelFileWriter::create(build.path);
    if (!created) {
        return std::move(created).error();
    }
    LevelFileWriter& writer = **created;
    TileReaders readers(*build.source);
    const std::size_t threads = threadsFor(build.source->layout(), build.memory_bytes_max);
    monitor.beginStage(0.0, kSurveyShare);
    auto survey = surveyLevels({.source = build.source,
                                .scale = build.scale,
                                .path = build.path,
                                .threads_max = threads,
                                .mean_blocks_max = build.mean_blocks_max},
                               readers, writer, monitor);
    if (!survey) {
        return std::move(survey).error();
    }
    monitor.beginStage(kSurveyShare, kSurveyShare + kErrorsShare);
    ErrorPass pass(build, *survey, writer, monitor);
    if (auto done = pass.run(readers, threads); !done) {
        return done;
    }
    monitor.beginStage(kSurveyShare + kErrorsShare, 1.0);

    LevelFileHeader header{
        .key = build.key,
        .layout = build.source->layout(),
        .statistics = survey->statistics,
        .scale = build.scale,
        .block_samples = finestBlocks(build.source->layout(), build.mean_blocks_max).block_samples,
        .fill_tiles = pass.tileFills().size(),
        .coarse_tiles = pass.coarseFills().size(),
        .planes = {}};
    header.layout.has_voids = header.hasVoids();
    const DetailErrors errors = pass.errors();
    const BlockGrid blocks = pass.blocksOf(header.block_samples);
    const std::vector<std::uint64_t> samples_index = indexOf(survey->samples_index);
    const std::vector<std::uint64_t> fills_index = pass.tileFills().index();
    const std::vector<std::uint64_t> coarse_index = pass.coarseFills().index();
    std::vector<LevelFileWriter::Array> arrays{{"ranges", std::as_const(survey->ranges).bytes()}};
    const auto add = [&arrays](std::string name, const auto& values) {
        arrays.push_back({std::move(name), std::as_bytes(std::span(values))});
    };
    for (std::size_t level = 1; level < errors.levelCount(); ++level) {
        add(fmt::format("errors {}", level), errors.nodeErrors()[level].errors_m);
    }
    add("means", blocks.means_m);
    if (header.hasVoids()) {
        add("shares", blocks.shares);
        add("fills", pass.fills());
    }
    add("samples index", samples_index);
    add("fills index", fills_index);
    add("coarse index", coarse_index);
    if (auto finished = writer.finish(std::move(header), arrays, monitor); !finished) {
        return finished;
    }
    monitor.report(1.0);
    return Done{};
}

} // namespace marsview
