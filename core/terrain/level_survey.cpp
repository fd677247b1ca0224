#include "core/terrain/level_survey.h"

#include "core/base/parallel.h"
#include "core/terrain/detail_measure.h"
#include "core/terrain/nested_levels.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <fmt/format.h>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kTileBlocks = kTileSide / BlockMeans::kBlock;
constexpr std::size_t kTileRanges = kTileSide / RawRanges::kBlock;

// A tile has no less than one of these blocks, so that tiles can be measured on their own.
BlockExtent surveyedBlocks(const TileLayout& layout, std::size_t blocks_max)
{
    BlockExtent extent = finestBlocks(layout, blocks_max);
    extent.block_samples = std::min(extent.block_samples, kTileSide);
    return extent;
}

class Survey {
public:
    Survey(const SurveyOptions& options, LevelFileWriter& writer, JobMonitor& monitor)
        : options_(options)
        , layout_(options.source->layout())
        , writer_(writer)
        , monitor_(monitor)
        , tile_columns_(layout_.tileColumns(TileKind::Samples, 0))
        , tile_rows_(layout_.tileRows(TileKind::Samples, 0))
        , top_level_(layout_.topLevel())
        , nested_(layout_,
                  layout_.type,
                  top_level_ >= LevelFile::kFirstLevel ? LevelFile::kFirstLevel
                                                       : DetailMeasure::kSparseLevel,
                  std::max(top_level_, DetailMeasure::kSparseLevel))
    {}

    Result<LevelSurvey> run(TileReaders& readers)
    {
        found_.kept = surveyedBlocks(layout_, options_.mean_blocks_max);
        found_.ranges = RawRanges(layout_.type, layout_.columns, layout_.rows);
        found_.blocks =
            emptyBlocks(found_.kept, layout_.has_voids ? BlockShares::Kept : BlockShares::None);
        found_.has_voids.resize(tile_columns_ * tile_rows_);
        found_.checksums.resize(found_.has_voids.size());
        found_.samples_index.resize(keptTileCount(layout_));
        constexpr std::size_t kSparse = DetailMeasure::kSparseLevel;
        auto sparse =
            SampleGrid::create(layout_.type, layout_.columnsAt(TileKind::Samples, kSparse),
                               layout_.rowsAt(TileKind::Samples, kSparse));
        auto first_rows = SampleGrid::create(layout_.type, layout_.columns,
                                             std::max<std::size_t>(1, tile_rows_ - 1));
        if (!sparse || !first_rows) {
            return sparse ? std::move(first_rows).error() : std::move(sparse).error();
        }
        found_.sparse = std::move(sparse).value();
        found_.first_rows = std::move(first_rows).value();
        if (layout_.has_voids) {
            auto fine = FineMeans::create(found_.kept, options_.path);
            if (!fine) {
                return std::move(fine).error();
            }
            found_.fine_means = std::move(fine).value();
        }
        auto done = readers.eachTileRow(
            [this](TileReader& reader, std::size_t tile_row) {
                return surveyRow(reader, tile_row);
            },
            options_.threads_max, monitor_);
        if (!done) {
            return std::move(done).error();
        }
        const SampleStatistics extremes = found_.ranges.extremes();
        found_.statistics = {.raw_minimum = extremes.raw_minimum,
                             .raw_maximum = extremes.raw_maximum,
                             .void_count = void_count_,
                             .sample_count = layout_.columns * layout_.rows};
        if (void_count_ == 0) {
            found_.blocks.shares.clear();
        }
        return std::move(found_);
    }

private:
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
            monitor_.report(static_cast<double>(++done_) /
                            static_cast<double>(tile_columns_ * tile_rows_));
        }
        for (std::size_t level = 0; level < fine.size(); ++level) {
            if (auto written = found_.fine_means.write(level, fine[level]); !written) {
                return written;
            }
        }
        return Done{};
    }

    Status surveyTile(const TileId& id, const SampleGrid& samples, std::vector<BlockRows>& fine)
    {
        const std::size_t number = id.row * tile_columns_ + id.column;
        found_.checksums[number] = sampleChecksum(samples);
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
        }
        measureMeans(id, samples, fine);
        for (const LevelBand& band : nested_.add(id, &samples)) {
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

    // A tile is cut into blocks as the map is, and reduced on its own.
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

    Status keepBand(const LevelBand& band)
    {
        if (band.level == DetailMeasure::kSparseLevel) {
            const std::lock_guard lock(mutex_);
            keepSparse(band);
        }
        if (band.level > top_level_ || band.level < LevelFile::kFirstLevel) {
            return Done{};
        }
        for (std::size_t first = 0; first < band.samples.columns(); first += kTileSide) {
            if (monitor_.isCancelled()) {
                return Error{ErrorCode::Cancelled, "cancelled"};
            }
            const TileId id{.kind = TileKind::Samples,
                            .level = static_cast<std::uint8_t>(band.level),
                            .column = static_cast<std::uint32_t>(first / kTileSide),
                            .row = static_cast<std::uint32_t>(band.tile_row)};
            const SampleGrid tile = columnsOf(band.samples, first, layout_.tileWidth(id));
            auto part = writer_.append(packedSamples(tile));
            if (!part) {
                return std::move(part).error();
            }
            found_.samples_index[keptTileNumber(layout_, id)] = *part;
        }
        return Done{};
    }

    void keepSparse(const LevelBand& band)
    {
        const std::size_t first_row = band.tile_row * kTileSide;
        for (std::size_t row = 0; row < band.samples.rows(); ++row) {
            band.samples.visit([&](auto values) {
                std::memcpy(found_.sparse->rowData(first_row + row), values.row(row).data(),
                            band.samples.columns() * sampleBytes(layout_.type));
            });
            for (std::size_t column = 0; column < band.samples.columns(); ++column) {
                if (band.samples.isVoid(column, row)) {
                    found_.sparse->markVoid(column, first_row + row);
                }
            }
        }
    }

    const SurveyOptions& options_;
    TileLayout layout_;
    LevelFileWriter& writer_;
    JobMonitor& monitor_;
    std::size_t tile_columns_;
    std::size_t tile_rows_;
    std::size_t top_level_;
    NestedLevels nested_;
    std::mutex mutex_; // of what tiles of several rows share in found_
    LevelSurvey found_;
    std::atomic<std::uint64_t> void_count_{0};
    std::atomic<std::size_t> done_{0};
};

} // namespace

Status
TileReaders::eachTileRow(const Work& work, std::size_t threads_max, const JobMonitor& monitor)
{
    std::mutex mutex;
    std::optional<Error> failure; // the first
    std::atomic<bool> has_failed{false};
    const auto fail = [&](Error error) {
        const std::lock_guard lock(mutex);
        if (!failure) {
            failure = std::move(error);
        }
        has_failed = true;
    };
    const std::size_t rows = source_.layout().tileRows(TileKind::Samples, 0);
    parallelRanges(
        rows, 1,
        [&](std::size_t begin, std::size_t) {
            if (has_failed || monitor.isCancelled()) {
                return;
            }
            std::unique_ptr<TileReader> reader;
            {
                const std::lock_guard lock(mutex_);
                if (!idle_.empty()) {
                    reader = std::move(idle_.back());
                    idle_.pop_back();
                }
            }
            if (!reader) {
                auto opened = source_.open();
                if (!opened) {
                    return fail(std::move(opened).error());
                }
                reader = std::move(opened).value();
            }
            if (auto done = work(*reader, begin); !done) {
                fail(std::move(done).error());
            }
            const std::lock_guard lock(mutex_);
            idle_.push_back(std::move(reader));
        },
        threads_max);
    if (monitor.isCancelled()) {
        return Error{ErrorCode::Cancelled, "cancelled"};
    }
    if (failure) {
        return std::move(*failure);
    }
    return Done{};
}

Result<Tile>
readTile(TileReader& reader, const TileSource& source, const TileId& id, const JobMonitor& monitor)
{
    if (monitor.isCancelled()) {
        return Error{ErrorCode::Cancelled, "cancelled"};
    }
    auto tile = reader.read(id);
    MARSVIEW_CHECK(!tile || (tile->samples.type() == source.layout().type &&
                             tile->samples.columns() == source.layout().tileWidth(id) &&
                             tile->samples.rows() == source.layout().tileHeight(id)));
    if (tile && tile->samples.hasVoids() && !source.layout().has_voids) {
        return Error{
            ErrorCode::Invalid,
            fmt::format("{}: has voids, which it had not when it was opened; open it again",
                        source.name())};
    }
    return tile;
}

std::uint32_t sampleChecksum(const SampleGrid& samples)
{
    return samples.visit([](auto values) {
        return checksum({reinterpret_cast<const std::byte*>(values.data()),
                         values.columns() * values.rows() * sizeof(values(0, 0))});
    });
}

Result<LevelSurvey> surveyLevels(const SurveyOptions& options,
                                 TileReaders& readers,
                                 LevelFileWriter& writer,
                                 JobMonitor& monitor)
{
    return Survey(options, writer, monitor).run(readers);
}

} // namespace marsview
