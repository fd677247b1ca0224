#include "core/prepare/level_errors.h"

#include "core/levels/level_file.h"
#include "core/prepare/tile_rows.h"
#include "core/terrain/detail_measure.h"
#include "core/terrain/fill_range.h"
#include "core/terrain/sample_rows.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kBlock = RawRanges::kBlock;
constexpr std::size_t kSparseStep = std::size_t{1} << DetailMeasure::kSparseLevel;
static_assert(std::size_t{1} << (kTallLevel - 1) == kTileSide);

} // namespace

std::vector<SparseRow> sparseRowsFor(const TileLayout& layout, const TileRowRange& rows)
{
    constexpr std::size_t kTallStep = std::size_t{1} << (kTallLevel - DetailMeasure::kSparseLevel);
    const std::size_t last_row = layout.rows - 1;
    const std::size_t tile_rows = layout.tileRows(TileKind::Samples, 0);
    const std::size_t first = std::min(rows.first, tile_rows) * kTileSide;
    const std::size_t end = std::min(std::min(rows.end, tile_rows) * kTileSide, last_row);
    std::map<std::size_t, std::size_t> steps; // by row of samples
    for (std::size_t step = std::size_t{1} << kTallLevel; first <= last_row; step *= 2) {
        for (const std::size_t row :
             {first / step * step, std::min((end + step - 1) / step * step, last_row)}) {
            steps[row] = kTallStep;
        }
        if (step >= layout.rows) {
            break;
        }
    }
    for (std::size_t row = first; row <= end && first <= last_row; row += kSparseStep) {
        steps[row] = 1;
    }
    if (first <= last_row && end == last_row) {
        steps[last_row] = 1;
    }
    std::vector<SparseRow> needed;
    for (const auto& [row, step] : steps) {
        needed.push_back({(row + kSparseStep - 1) / kSparseStep, step});
    }
    return needed;
}

std::vector<std::uint64_t> TileParts::index() const
{
    auto parts = parts_;
    std::sort(parts.begin(), parts.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::uint64_t> rows;
    for (const auto& [number, part] : parts) {
        rows.push_back(number);
    }
    for (const auto& [number, part] : parts) {
        rows.push_back(part.offset);
    }
    for (const auto& [number, part] : parts) {
        rows.push_back(part.bytes);
    }
    for (const auto& [number, part] : parts) {
        rows.push_back(part.checksum);
    }
    return rows;
}

bool TileParts::restore(std::vector<std::uint64_t> index)
{
    const std::size_t count = index.size() / 4;
    parts_.clear();
    for (std::size_t i = 0; i < count; ++i) {
        parts_.emplace_back(index[i],
                            FilePart{.offset = index[count + i],
                                     .bytes = index[2 * count + i],
                                     .checksum = static_cast<std::uint32_t>(index[3 * count + i])});
    }
    return index.size() % 4 == 0;
}

class LevelErrorPass::Impl {
public:
    Impl(const TileSource& source,
         const ElevationScale& scale,
         const LevelSurvey& survey,
         LevelFileWriter* writer,
         JobMonitor& monitor,
         const TileRowRange& rows,
         const ScratchPlace* scratch)
        : source_(source)
        , scale_(scale)
        , layout_(source.layout())
        , survey_(survey)
        , ordered_(writer)
        , monitor_(monitor)
        , range_(heightRange(survey.statistics, scale))
        , has_voids_(survey.statistics.void_count > 0)
        , has_coarse_fills_(has_voids_ && layout_.topLevel() >= LevelFile::kFirstLevel)
        , tile_columns_(layout_.tileColumns(TileKind::Samples, 0))
        , tile_rows_(layout_.tileRows(TileKind::Samples, 0))
        , coarse_fills_(
              layout_, SampleType::Float32, LevelFile::kFirstLevel, layout_.topLevel(), scratch)
    {
        rows_.first = std::min(rows.first, tile_rows_);
        rows_.end = std::min(rows.end, tile_rows_);
        const HeightRange range = heightRange(survey.statistics, scale).value_or(HeightRange{});
        base_m_ = (range.minimum_m + range.maximum_m) / 2.0;
        if (has_voids_) {
            means_ = BlockMeans::from(survey.blocks, survey.kept);
            constexpr float kInfinity = std::numeric_limits<float>::infinity();
            const std::size_t columns = survey.ranges.columns();
            fills_m_.resize(2 * columns * survey.ranges.rows());
            const std::size_t end =
                2 * columns * std::min(rows_.end * kTileRanges, survey.ranges.rows());
            for (std::size_t i =
                     2 * columns * std::min(rows_.first * kTileRanges, survey.ranges.rows());
                 i < end; i += 2) {
                fills_m_[i] = kInfinity;
                fills_m_[i + 1] = -kInfinity;
            }
        }
    }

    Status begin()
    {
        auto sparse = sparseHeights();
        if (!sparse) {
            return std::move(sparse).error();
        }
        measure_.emplace(
            layout_.columns, layout_.rows, std::move(sparse).value(),
            SampleRows{rows_.first * kTileSide, std::min(rows_.end * kTileSide, layout_.rows)});
        return Done{};
    }

    void save(CheckpointWriter& to) const
    {
        for (const DetailErrors::NodeLevel& level : measure_->errors()) {
            to.putArray(level.errors_m);
        }
        to.putArray(fills_m_);
        coarse_fills_.save(to);
        to.putArray(tile_fills_.index());
        to.putArray(coarse_fill_parts_.index());
        to.put(done_.load());
    }

    bool restore(CheckpointReader& from)
    {
        std::vector<std::uint64_t> tile_fills;
        std::vector<std::uint64_t> coarse_fills;
        std::uint64_t done = 0;
        for (DetailErrors::NodeLevel& level : measure_->errors()) {
            if (!from.getArray(level.errors_m)) {
                return false;
            }
        }
        if (!from.getArray(fills_m_) || !coarse_fills_.restore(from) || !from.getAny(tile_fills) ||
            !from.getAny(coarse_fills) || !from.get(done)) {
            return false;
        }
        done_ = done;
        ordered_.startAt(done / tile_columns_);
        return tile_fills_.restore(std::move(tile_fills)) &&
               coarse_fill_parts_.restore(std::move(coarse_fills));
    }

    Status measureRow(TileReader& reader, std::size_t tile_row)
    {
        std::optional<BlockRows> filled;
        if (has_voids_ && (rowHasVoids(tile_row) || rowHasVoids(tile_row + 1))) {
            auto rows = filledRows(survey_.fine_means, *means_, tile_row);
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
        return ordered_.done(tile_row);
    }

    LevelErrors finish()
    {
        return {.errors = std::move(*measure_).finish(), .fills_m = std::move(fills_m_)};
    }
    const TileParts& tileFills() const { return tile_fills_; }
    const TileParts& coarseFills() const { return coarse_fill_parts_; }
    State state()
    {
        return {measure_->errors(), fills_m_,           coarse_fills_,
                tile_fills_,        coarse_fill_parts_, ordered_};
    }

    Status keepCoarseFills(const LevelBand& band)
    {
        const auto keep = [&](const TileId& id, const SampleGrid& tile) {
            if (!tile.hasVoids()) {
                return;
            }
            ordered_.put(
                {lastTileRowOf(layout_, band.level, band.tile_row), band.level, id.row, id.column},
                packedArray(tile),
                [this, number = keptTileNumber(layout_, id)](const FilePart& part) {
                    coarse_fill_parts_.add(number, part);
                });
        };
        return forEachTile(band, layout_, monitor_, keep);
    }

private:
    // The working memory of one thread.
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
    Result<LargeVector<float>> sparseHeights()
    {
        const SampleGrid& samples = *survey_.sparse;
        LargeVector<float> heights(samples.columns() * samples.rows());
        std::optional<BlockRows> filled;
        std::size_t filled_tile_row = 0;
        for (const auto& [row, step] : sparseRowsFor(layout_, rows_)) {
            const std::size_t map_row = std::min(row * kSparseStep, layout_.rows - 1);
            const std::size_t tile_row = map_row / kTileSide;
            for (std::size_t next = 0; next < samples.columns() - 1 + step; next += step) {
                const std::size_t column = std::min(next, samples.columns() - 1);
                float& height = heights[row * samples.columns() + column];
                if (!samples.isVoid(column, row)) {
                    height = static_cast<float>(scale_.height(samples.raw(column, row)) - base_m_);
                    continue;
                }
                if (!filled || filled_tile_row != tile_row) {
                    if (monitor_.isCanceled()) {
                        return Error{ErrorCode::Canceled, "canceled"};
                    }
                    auto rows = filledRows(survey_.fine_means, *means_, tile_row);
                    if (!rows) {
                        return std::move(rows).error();
                    }
                    filled = std::move(rows).value();
                    filled_tile_row = tile_row;
                }
                const std::size_t map_column = std::min(column * kSparseStep, layout_.columns - 1);
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

    Result<Tile> readAgain(TileReader& reader, std::size_t column, std::size_t row)
    {
        const TileId id{.kind = TileKind::Samples,
                        .level = 0,
                        .column = static_cast<std::uint32_t>(column),
                        .row = static_cast<std::uint32_t>(row)};
        auto tile = readTile(reader, source_, id, monitor_);
        if (tile && sampleChecksum(tile->samples) != survey_.checksums->of(id)) {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: changed while it was read; open it again when no program "
                                     "writes to it",
                                     source_.name())};
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

    // The tile's heights over the base, with the first column and row of the following tiles.
    void readPart(const SampleGrid& samples,
                  const SampleGrid* right,
                  const DetailPart& part,
                  std::vector<float>& heights) const
    {
        heights.resize(part.columns * part.rows);
        const std::size_t width = samples.columns();
        for (std::size_t row = 0; row < samples.rows(); ++row) {
            float* to = heights.data() + row * part.columns;
            readHeights(samples, scale_, 0, row, base_m_, {to, width});
            if (right != nullptr) {
                readHeights(*right, scale_, 0, row, base_m_, {to + width, 1});
            }
        }
        if (part.rows > samples.rows()) {
            readHeights(*survey_.first_rows, scale_, part.first_column, part.first_row / kTileSide,
                        base_m_, {heights.data() + samples.rows() * part.columns, part.columns});
        }
    }

    // Fills the gaps for drawing and records the range of fills of each block.
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

    // Adjacent blocks share their sides.
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
            ordered_.put({id.row, 0, id.row, id.column},
                         packed({.columns = fill->window.columns,
                                 .rows = fill->window.rows,
                                 .element_bytes = sizeof(float)},
                                std::as_bytes(std::span(fill->means_m))),
                         [this, number = id.row * tile_columns_ + id.column](const FilePart& part) {
                             tile_fills_.add(number, part);
                         });
        }
        if (!has_coarse_fills_) {
            return Done{};
        }
        std::optional<SampleGrid> heights;
        if (is_filled) {
            heights = coarseHeights(tile, *fill);
        }
        const auto complete = coarse_fills_.add(id, heights ? &*heights : nullptr);
        if (!complete) {
            return complete.error();
        }
        if (id.column % kTilesPerRelease == kTilesPerRelease - 1 ||
            id.column + 1 == tile_columns_) {
            coarse_fills_.release();
        }
        for (const LevelBand& band : *complete) {
            if (auto kept = keepCoarseFills(band); !kept) {
                return kept;
            }
        }
        return Done{};
    }

    // The fills of the samples of coarser levels; filled samples are marked as void.
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

    const TileSource& source_;
    ElevationScale scale_;
    TileLayout layout_;
    const LevelSurvey& survey_;
    OrderedTiles ordered_;
    JobMonitor& monitor_;
    std::optional<BlockMeans> means_; // if there are voids
    FillRange range_;
    bool has_voids_;
    bool has_coarse_fills_;
    std::size_t tile_columns_;
    std::size_t tile_rows_;
    TileRowRange rows_; // that are measured
    double base_m_ = 0.0;
    std::optional<DetailMeasure> measure_;
    // Smallest and largest fill of each block of RawRanges; a row of tiles has its own blocks.
    LargeVector<float> fills_m_;
    NestedLevels coarse_fills_;
    TileParts tile_fills_;
    TileParts coarse_fill_parts_;
    std::atomic<std::uint64_t> done_{0}; // tiles
};

LevelErrorPass::LevelErrorPass(const TileSource& source,
                               const ElevationScale& scale,
                               const LevelSurvey& survey,
                               LevelFileWriter* writer,
                               JobMonitor& monitor,
                               const TileRowRange& rows,
                               const ScratchPlace* scratch)
    : impl_(std::make_unique<Impl>(source, scale, survey, writer, monitor, rows, scratch))
{}

LevelErrorPass::~LevelErrorPass() = default;

Status LevelErrorPass::begin()
{
    return impl_->begin();
}

bool LevelErrorPass::restore(CheckpointReader& from)
{
    return impl_->restore(from);
}

void LevelErrorPass::save(CheckpointWriter& to) const
{
    impl_->save(to);
}

Status LevelErrorPass::measureRow(TileReader& reader, std::size_t tile_row)
{
    return impl_->measureRow(reader, tile_row);
}

LevelErrors LevelErrorPass::finish()
{
    return impl_->finish();
}

const TileParts& LevelErrorPass::tileFills() const
{
    return impl_->tileFills();
}

const TileParts& LevelErrorPass::coarseFills() const
{
    return impl_->coarseFills();
}

LevelErrorPass::State LevelErrorPass::state()
{
    return impl_->state();
}

Status LevelErrorPass::keepCoarseFills(const LevelBand& band)
{
    return impl_->keepCoarseFills(band);
}

} // namespace marsview
