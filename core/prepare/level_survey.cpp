#include "core/prepare/level_survey.h"

#include "core/prepare/tile_counts.h"
#include "core/prepare/tile_rows.h"
#include "core/terrain/detail_measure.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace marsview {
namespace {

// A block is at most as large as a tile, so that tiles can be measured separately.
BlockExtent surveyedBlocks(const TileLayout& layout, std::size_t blocks_max)
{
    BlockExtent extent = finestBlocks(layout, blocks_max);
    extent.block_samples = std::min(extent.block_samples, kTileSide);
    return extent;
}

} // namespace

class LevelSurveyPass::Impl {
public:
    Impl(const SurveyOptions& options, LevelFileWriter* writer, JobMonitor& monitor)
        : options_(options)
        , layout_(options.source->layout())
        , ordered_(writer)
        , monitor_(monitor)
        , tile_columns_(layout_.tileColumns(TileKind::Samples, 0))
        , tile_rows_(layout_.tileRows(TileKind::Samples, 0))
        , top_level_(layout_.topLevel())
        , nested_(layout_, layout_.type, LevelFile::kFirstLevel, top_level_, options.scratch)
    {
        found_.kept = surveyedBlocks(layout_, options_.mean_blocks_max);
        found_.ranges = RawRanges::toBeFilled(layout_.type, layout_.columns, layout_.rows);
        const auto [first, end] = rangeRows();
        found_.ranges.clear(first, end);
        found_.blocks = blocksToBeFilled(found_.kept,
                                         layout_.has_voids ? BlockShares::Kept : BlockShares::None);
        found_.has_voids.resize(tile_columns_ * tile_rows_);
        found_.checksums = std::make_shared<TileChecksums>(layout_);
        found_.samples_index.resize(keptTileCount(layout_));
    }

    Status begin()
    {
        const auto [sparse_columns, sparse_rows] = sparseSize();
        auto sparse = SampleGrid::create(layout_.type, sparse_columns, sparse_rows);
        auto first_rows = SampleGrid::create(layout_.type, layout_.columns, firstRowCount());
        if (!sparse || !first_rows) {
            return sparse ? std::move(first_rows).error() : std::move(sparse).error();
        }
        found_.sparse = std::move(sparse).value();
        found_.first_rows = std::move(first_rows).value();
        return openFineMeans(FineMeans::Content::Empty);
    }

    bool save(CheckpointWriter& to) const
    {
        to.putArray(found_.ranges.bytes());
        to.putArray(found_.blocks.means_m);
        to.putArray(found_.blocks.shares);
        to.putArray(found_.has_voids);
        to.putArray(std::as_const(*found_.checksums).values());
        for (const FilePart& part : found_.samples_index) {
            to.put(part.offset);
            to.put(part.bytes);
            to.put(part.checksum);
        }
        to.put(void_count_.load());
        to.put(std::uint64_t{done_});
        to.putGrid(*found_.sparse);
        to.putGrid(*found_.first_rows);
        nested_.save(to);
        return found_.fine_means.save(to);
    }

    bool restore(CheckpointReader& from)
    {
        bool is_good = from.getArray(found_.ranges.bytes()) &&
                       from.getArray(found_.blocks.means_m) && from.getAny(found_.blocks.shares) &&
                       from.getArray(found_.has_voids) && from.getArray(found_.checksums->values());
        for (FilePart& part : found_.samples_index) {
            is_good =
                is_good && from.get(part.offset) && from.get(part.bytes) && from.get(part.checksum);
        }
        std::uint64_t void_count = 0;
        std::uint64_t done = 0;
        is_good = is_good && from.get(void_count) && from.get(done);
        void_count_ = void_count;
        done_ = done;
        ordered_.startAt(std::min<std::size_t>(done / tile_columns_, tile_rows_));
        const auto [sparse_columns, sparse_rows] = sparseSize();
        found_.sparse = from.getGrid(layout_.type, sparse_columns, sparse_rows);
        found_.first_rows = from.getGrid(layout_.type, layout_.columns, firstRowCount());
        return is_good && found_.sparse && found_.first_rows && nested_.restore(from) &&
               openFineMeans(FineMeans::Content::AsItWas) && found_.fine_means.restore(from);
    }

    const LevelSurvey& finish()
    {
        const auto [first, end] = rangeRows();
        found_.statistics.merge(found_.ranges.extremes(first, end));
        found_.statistics.void_count = void_count_;
        found_.statistics.sample_count = layout_.columns * layout_.rows;
        if (void_count_ == 0) {
            found_.blocks.shares.clear();
        }
        return found_;
    }

    std::size_t meanRowCount() const
    {
        std::size_t count = 0;
        for (std::size_t level = 1; level <= layout_.mean_levels; ++level) {
            count += layout_.tileRows(TileKind::Means, level);
        }
        return count;
    }

    Status surveyMeanRow(TileReader& reader, std::size_t row)
    {
        TileId id{.kind = TileKind::Means, .level = 1, .column = 0, .row = 0};
        for (; row >= layout_.tileRows(TileKind::Means, id.level); ++id.level) {
            row -= layout_.tileRows(TileKind::Means, id.level);
        }
        id.row = static_cast<std::uint32_t>(row);
        for (; id.column < layout_.tileColumns(TileKind::Means, id.level); ++id.column) {
            auto tile = readTile(reader, *options_.source, id, monitor_);
            if (!tile) {
                return std::move(tile).error();
            }
            found_.checksums->set(id, sampleChecksum(tile->samples));
            countTile();
        }
        return Done{};
    }

    Status surveyRow(TileReader& reader, std::size_t tile_row)
    {
        std::vector<BlockRows> fine;
        for (std::size_t level = 0; level < found_.fine_means.levelCount(); ++level) {
            const BlockExtent& extent = found_.fine_means.extent(level);
            const std::size_t side = kTileBlocks >> level;
            BlockRows rows{.columns = extent.blockColumns(),
                           .level_rows = extent.blockRows(),
                           .first_row = tile_row * side,
                           .heights_m = {}};
            rows.heights_m.resize(rows.columns * std::min(side, rows.level_rows - rows.first_row));
            fine.push_back(std::move(rows));
        }
        for (std::size_t column = 0; column < tile_columns_; ++column) {
            const TileId id{.kind = TileKind::Samples,
                            .level = 0,
                            .column = static_cast<std::uint32_t>(column),
                            .row = static_cast<std::uint32_t>(tile_row)};
            auto tile = readTile(reader, *options_.source, id, monitor_);
            if (!tile) {
                return std::move(tile).error();
            }
            if (auto surveyed = surveyTile(id, tile->samples, fine); !surveyed) {
                return surveyed;
            }
            countTile();
        }
        nested_.release();
        for (std::size_t level = 0; level < fine.size(); ++level) {
            if (auto written = found_.fine_means.write(level, fine[level]); !written) {
                return written;
            }
        }
        return ordered_.done(tile_row);
    }

    State state() { return {found_, nested_, ordered_, void_count_}; }

    Status keepBand(const LevelBand& band)
    {
        const auto keep = [&](const TileId& id, const SampleGrid& tile) {
            ordered_.put(
                {lastTileRowOf(layout_, band.level, band.tile_row), band.level, id.row, id.column},
                packedSamples(tile),
                [to = &found_.samples_index[keptTileNumber(layout_, id)]](const FilePart& part) {
                    *to = part;
                });
        };
        return forEachTile(band, layout_, monitor_, keep);
    }

private:
    GridSize sparseSize() const
    {
        return {layout_.columnsAt(TileKind::Samples, DetailMeasure::kSparseLevel),
                layout_.rowsAt(TileKind::Samples, DetailMeasure::kSparseLevel)};
    }
    // The rows of blocks of ranges with samples of the surveyed rows of tiles: one before them
    // shares its last row of samples.
    std::pair<std::size_t, std::size_t> rangeRows() const
    {
        const std::size_t rows = found_.ranges.rows();
        const std::size_t first = std::min(options_.rows.first, tile_rows_) * kTileRanges;
        const std::size_t end = std::min(options_.rows.end, tile_rows_) * kTileRanges;
        return {std::min(first - (first > 0 ? 1 : 0), rows), std::min(end, rows)};
    }
    std::size_t firstRowCount() const { return std::max<std::size_t>(1, tile_rows_ - 1); }

    Status openFineMeans(FineMeans::Content content)
    {
        if (!layout_.has_voids) {
            return Done{};
        }
        if (options_.means_path.empty()) {
            found_.fine_means = FineMeans(found_.kept);
            return Done{};
        }
        auto fine = FineMeans::open(found_.kept, options_.means_path, content, options_.rows);
        if (!fine) {
            return std::move(fine).error();
        }
        found_.fine_means = std::move(fine).value();
        return Done{};
    }

    void countTile()
    {
        monitor_.report(static_cast<double>(++done_) /
                        static_cast<double>(found_.checksums->values().size()));
    }

    Status surveyTile(const TileId& id, const SampleGrid& samples, std::vector<BlockRows>& fine)
    {
        const std::size_t number = id.row * tile_columns_ + id.column;
        found_.checksums->set(id, sampleChecksum(samples));
        std::uint64_t void_count = 0;
        for (std::size_t row = 0; samples.hasVoids() && row < samples.rows(); ++row) {
            for (std::size_t column = 0; column < samples.columns(); ++column) {
                void_count += samples.isVoid(column, row) ? 1U : 0U;
            }
        }
        found_.has_voids[number] = void_count > 0 ? 1 : 0;
        void_count_ += void_count;
        const RawRanges::Part ranges(samples);
        {
            const std::lock_guard lock(mutex_);
            found_.ranges.include(ranges, id.column * kTileRanges, id.row * kTileRanges);
            if (id.row > 0) {
                keepFirstRow(id, samples);
            }
            keepSparse(id, samples);
        }
        measureMeans(id, samples, fine);
        const auto complete = nested_.add(id, &samples);
        if (!complete) {
            return complete.error();
        }
        if (id.column % kTilesPerRelease == kTilesPerRelease - 1) {
            nested_.release();
        }
        for (const LevelBand& band : *complete) {
            if (auto kept = keepBand(band); !kept) {
                return kept;
            }
        }
        return Done{};
    }

    void keepFirstRow(const TileId& id, const SampleGrid& samples)
    {
        SampleGrid& rows = *found_.first_rows;
        const std::size_t first = id.column * kTileSide;
        const std::size_t bytes = sampleBytes(samples.type());
        samples.visit([&](auto values) {
            std::memcpy(rows.rowData(id.row - 1) + first * bytes, values.row(0).data(),
                        samples.columns() * bytes);
        });
        for (std::size_t column = 0; column < samples.columns(); ++column) {
            if (samples.isVoid(column, 0)) {
                rows.markVoid(first + column, id.row - 1);
            }
        }
    }

    // A tile is divided into the blocks of the map and reduced separately.
    void measureMeans(const TileId& id, const SampleGrid& samples, std::vector<BlockRows>& fine)
    {
        BlockExtent extent{samples.columns(), samples.rows(), BlockMeans::kBlock};
        BlockGrid blocks =
            emptyBlocks(extent, layout_.has_voids ? BlockShares::Kept : BlockShares::None);
        measureBlocks(samples, extent.block_samples, options_.scale, 0, blocks.rows, blocks);
        const auto put = [&id](const BlockGrid& from, std::size_t side, std::size_t first_row,
                               const LargeVector<float>& values, float* to, std::size_t columns) {
            for (std::size_t row = 0; row < from.rows; ++row) {
                std::copy_n(values.data() + row * from.columns, from.columns,
                            to + (first_row + row) * columns + id.column * side);
            }
        };
        for (std::size_t level = 0; extent.block_samples < found_.kept.block_samples; ++level) {
            if (level < fine.size()) {
                put(blocks, kTileBlocks >> level, 0, blocks.means_m, fine[level].heights_m.data(),
                    fine[level].columns);
            }
            blocks = reduced(blocks, extent);
            extent = extent.coarser();
        }
        const std::size_t side = kTileSide / extent.block_samples;
        put(blocks, side, id.row * side, blocks.means_m, found_.blocks.means_m.data(),
            found_.blocks.columns);
        if (!blocks.shares.empty()) {
            put(blocks, side, id.row * side, blocks.shares, found_.blocks.shares.data(),
                found_.blocks.columns);
        }
    }

    void keepSparse(const TileId& id, const SampleGrid& samples)
    {
        constexpr std::size_t kStep = std::size_t{1} << DetailMeasure::kSparseLevel;
        const auto samples_along = [](std::size_t first, std::size_t count, std::size_t all) {
            std::vector<std::size_t> kept; // within the tile
            for (std::size_t i = 0; i < count; ++i) {
                if (i % kStep == 0 || first + i + 1 == all) {
                    kept.push_back(i);
                }
            }
            return kept;
        };
        const std::size_t first_column = id.column * kTileSide;
        const std::size_t first_row = id.row * kTileSide;
        SampleGrid& sparse = *found_.sparse;
        const auto columns = samples_along(first_column, samples.columns(), layout_.columns);
        for (const std::size_t row : samples_along(first_row, samples.rows(), layout_.rows)) {
            const std::size_t to_row = (first_row + row + kStep - 1) / kStep;
            samples.visit([&](auto values) {
                using T = std::remove_cvref_t<decltype(values(0, 0))>;
                auto* to = reinterpret_cast<T*>(sparse.rowData(to_row));
                for (const std::size_t column : columns) {
                    to[(first_column + column + kStep - 1) / kStep] = values(column, row);
                }
            });
            for (const std::size_t column : columns) {
                if (samples.isVoid(column, row)) {
                    sparse.markVoid((first_column + column + kStep - 1) / kStep, to_row);
                }
            }
        }
    }

    SurveyOptions options_;
    TileLayout layout_;
    OrderedTiles ordered_;
    JobMonitor& monitor_;
    std::size_t tile_columns_;
    std::size_t tile_rows_;
    std::size_t top_level_;
    NestedLevels nested_;
    std::mutex mutex_; // guards the data in found_ that tiles of several rows share
    LevelSurvey found_;
    std::atomic<std::uint64_t> void_count_{0};
    std::atomic<std::uint64_t> done_{0}; // tiles
};

LevelSurveyPass::LevelSurveyPass(const SurveyOptions& options,
                                 LevelFileWriter* writer,
                                 JobMonitor& monitor)
    : impl_(std::make_unique<Impl>(options, writer, monitor))
{}

LevelSurveyPass::~LevelSurveyPass() = default;

Status LevelSurveyPass::begin()
{
    return impl_->begin();
}

bool LevelSurveyPass::restore(CheckpointReader& from)
{
    return impl_->restore(from);
}

bool LevelSurveyPass::save(CheckpointWriter& to) const
{
    return impl_->save(to);
}

Status LevelSurveyPass::surveyRow(TileReader& reader, std::size_t tile_row)
{
    return impl_->surveyRow(reader, tile_row);
}

std::size_t LevelSurveyPass::meanRowCount() const
{
    return impl_->meanRowCount();
}

Status LevelSurveyPass::surveyMeanRow(TileReader& reader, std::size_t row)
{
    return impl_->surveyMeanRow(reader, row);
}

LevelSurveyPass::State LevelSurveyPass::state()
{
    return impl_->state();
}

Status LevelSurveyPass::keepBand(const LevelBand& band)
{
    return impl_->keepBand(band);
}

const LevelSurvey& LevelSurveyPass::finish()
{
    return impl_->finish();
}

} // namespace marsview
