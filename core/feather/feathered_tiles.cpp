#include "core/feather/feathered_tiles.h"

#include "core/base/check.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <unordered_map>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// By how much the means of a tile change.
struct RaisedMeans {
    std::vector<std::uint16_t> places; // row · kTileSide + column, ascending
    std::vector<double> raised_m;
};
using MeansByTile = std::unordered_map<TileId, RaisedMeans, TileIdHash>;

// Of all levels: each from the sums of the one before.
MeansByTile raisedMeans(const TileLayout& layout, const FeatherBand& band)
{
    MeansByTile tiles;
    std::unordered_map<std::uint64_t, double>
        sums; // by row << 32 | column, of the blocks of a level
    for (std::size_t level = 1; level <= layout.mean_levels; ++level) {
        std::unordered_map<std::uint64_t, double> coarser;
        const auto add = [&coarser](std::uint64_t column, std::uint64_t row, double raised_m) {
            coarser[row / 2 << 32U | column / 2] += raised_m;
        };
        if (level == 1) {
            band.eachSquare(
                [&](std::size_t column, std::size_t row, const FeatherBand::Square& square) {
                    for (std::size_t i = 0; i < square.places.size(); ++i) {
                        add(column * kTileSide + square.places[i] % kTileSide,
                            row * kTileSide + square.places[i] / kTileSide,
                            static_cast<double>(square.raised_m[i]));
                    }
                });
        } else {
            for (const auto& [block, sum_m] : sums) {
                add(block & 0xFFFFFFFFU, block >> 32U, sum_m);
            }
        }
        sums = std::move(coarser);
        std::vector<std::pair<std::uint64_t, double>> sorted(sums.begin(), sums.end());
        std::sort(sorted.begin(), sorted.end());
        const std::size_t side = std::size_t{1} << level;
        for (const auto& [block, sum_m] : sorted) {
            const auto column = static_cast<std::size_t>(block & 0xFFFFFFFFU);
            const auto row = static_cast<std::size_t>(block >> 32U);
            const auto samples =
                static_cast<double>(std::min(side, layout.columns - column * side) *
                                    std::min(side, layout.rows - row * side));
            RaisedMeans& means = tiles[{.kind = TileKind::Means,
                                        .level = static_cast<std::uint8_t>(level),
                                        .column = static_cast<std::uint32_t>(column / kTileSide),
                                        .row = static_cast<std::uint32_t>(row / kTileSide)}];
            means.places.push_back(
                static_cast<std::uint16_t>(row % kTileSide * kTileSide + column % kTileSide));
            means.raised_m.push_back(sum_m / samples);
        }
    }
    return tiles;
}

struct FeatheredTileData {
    std::shared_ptr<const FeatherBand> band;
    ElevationScale scale;
    TileLayout layout;
    MeansByTile means;
};

// Writes samples of a tile, in their float type.
class SampleWriter {
public:
    explicit SampleWriter(SampleGrid& samples)
        : samples_(samples)
    {}

    void put(std::size_t column, std::size_t row, double raw)
    {
        std::byte* at = samples_.rowData(row) + column * sampleBytes(samples_.type());
        if (samples_.type() == SampleType::Float32) {
            const auto single = static_cast<float>(raw);
            std::memcpy(at, &single, sizeof single);
        } else {
            std::memcpy(at, &raw, sizeof raw);
        }
    }

private:
    SampleGrid& samples_;
};

class FeatheredTileReader final : public TileReader {
public:
    FeatheredTileReader(std::shared_ptr<const FeatheredTileData> data,
                        std::unique_ptr<TileReader> own)
        : data_(std::move(data))
        , own_(std::move(own))
    {}

    Result<Tile> read(const TileId& id) override
    {
        Result<Tile> own = own_->read(id);
        if (!own) {
            return own;
        }
        const std::size_t columns = own->samples.columns();
        const std::size_t rows = own->samples.rows();
        Result<SampleGrid> samples = SampleGrid::create(data_->layout.type, columns, rows);
        if (!samples) {
            return std::move(samples).error();
        }
        SampleWriter writer(*samples);
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t column = 0; column < columns; ++column) {
                writer.put(column, row, own->samples.raw(column, row));
                if (own->samples.isVoid(column, row)) {
                    samples->markVoid(column, row);
                }
            }
        }
        if (id.kind == TileKind::Means) {
            raiseMeans(id, *samples, writer);
        } else {
            putBand(id, *samples, writer);
        }
        return Tile{.id = id, .samples = std::move(*samples), .filled_m = std::move(own->filled_m)};
    }

private:
    double raw(float height_m) const
    {
        return rawOf(static_cast<double>(height_m), data_->scale, data_->layout.type);
    }

    void putBand(const TileId& id, const SampleGrid& samples, SampleWriter& writer) const
    {
        const FeatherBand& band = *data_->band;
        const auto sampleAt = [&id](std::size_t tile, std::size_t i, std::size_t count) {
            return std::min((tile * kTileSide + i) << id.level, count - 1);
        };
        for (std::size_t j = 0; j < samples.rows(); ++j) {
            const std::size_t row = sampleAt(id.row, j, data_->layout.rows);
            const FeatherBand::Square* square = nullptr;
            std::size_t square_column = std::size_t(-1);
            for (std::size_t i = 0; i < samples.columns(); ++i) {
                const std::size_t column = sampleAt(id.column, i, data_->layout.columns);
                if (column / FeatherBand::kSide != square_column) {
                    square_column = column / FeatherBand::kSide;
                    square = band.square(square_column, row / FeatherBand::kSide);
                }
                const auto found = square != nullptr ? square->find(column % FeatherBand::kSide,
                                                                    row % FeatherBand::kSide)
                                                     : std::nullopt;
                if (found) {
                    writer.put(i, j, raw(square->heights_m[*found]));
                }
            }
        }
    }

    void raiseMeans(const TileId& id, const SampleGrid& samples, SampleWriter& writer) const
    {
        const auto found = data_->means.find(id);
        if (found == data_->means.end()) {
            return;
        }
        for (std::size_t i = 0; i < found->second.places.size(); ++i) {
            const std::size_t column = found->second.places[i] % kTileSide;
            const std::size_t row = found->second.places[i] / kTileSide;
            writer.put(column, row,
                       samples.raw(column, row) + found->second.raised_m[i] / data_->scale.gain);
        }
    }

    std::shared_ptr<const FeatheredTileData> data_;
    std::unique_ptr<TileReader> own_;
};

class FeatheredTileSource final : public TileSource {
public:
    FeatheredTileSource(std::shared_ptr<const TileSource> own, FeatheredTileData data)
        : own_(std::move(own))
        , data_(std::make_shared<const FeatheredTileData>(std::move(data)))
    {}

    const TileLayout& layout() const noexcept override { return data_->layout; }
    const std::string& name() const noexcept override { return own_->name(); }

    Result<std::unique_ptr<TileReader>> open() const override
    {
        Result<std::unique_ptr<TileReader>> own = own_->open();
        if (!own) {
            return own;
        }
        return std::unique_ptr<TileReader>(
            std::make_unique<FeatheredTileReader>(data_, std::move(own).value()));
    }

private:
    std::shared_ptr<const TileSource> own_;
    std::shared_ptr<const FeatheredTileData> data_;
};

TileLayout floatLayout(TileLayout layout)
{
    layout.type = floatTypeFor(layout.type);
    return layout;
}

// Calls `use(column, row, i, square)` for all samples of the band.
template <typename F>
void eachSample(const FeatherBand& band, F&& use)
{
    band.eachSquare([&](std::size_t column, std::size_t row, const FeatherBand::Square& square) {
        for (std::size_t i = 0; i < square.places.size(); ++i) {
            use(column * FeatherBand::kSide + square.places[i] % FeatherBand::kSide,
                row * FeatherBand::kSide + square.places[i] / FeatherBand::kSide, i, square);
        }
    });
}

// The first and last of the blocks of so many cells along an axis that have a sample.
std::array<std::size_t, 2> blocksOf(std::size_t sample, std::size_t cells, std::size_t blocks)
{
    const std::size_t after = std::min(sample / cells, blocks - 1);
    const bool is_shared = sample % cells == 0 && sample > 0;
    return {is_shared ? std::min(sample / cells - 1, blocks - 1) : after, after};
}

// What they come to as samples of the float type.
template <typename T>
RawRanges rangesWith(const MapLevels& own, const FeatherBand& band, const ElevationScale& scale)
{
    const TileLayout& layout = own.layout;
    const SampleType type = floatTypeFor(layout.type);
    RawRanges ranges(type, layout.columns, layout.rows);
    auto* blocks = reinterpret_cast<RawRanges::Range<T>*>(ranges.bytes().data());
    own.analysis->bounds.blocks().visit([&](auto from) {
        for (std::size_t row = 0; row < ranges.rows(); ++row) {
            for (std::size_t column = 0; column < ranges.columns(); ++column) {
                if (!from(column, row).isEmpty()) {
                    blocks[row * ranges.columns() + column] = {
                        static_cast<T>(from(column, row).minimum),
                        static_cast<T>(from(column, row).maximum)};
                }
            }
        }
    });
    eachSample(band, [&](std::size_t column, std::size_t row, std::size_t i,
                         const FeatherBand::Square& square) {
        const auto raw =
            static_cast<T>(rawOf(static_cast<double>(square.heights_m[i]), scale, type));
        const auto columns = blocksOf(column, RawRanges::kBlock, ranges.columns());
        const auto rows = blocksOf(row, RawRanges::kBlock, ranges.rows());
        for (std::size_t r = rows[0]; r <= rows[1]; ++r) {
            for (std::size_t c = columns[0]; c <= columns[1]; ++c) {
                blocks[r * ranges.columns() + c].include({raw, raw});
            }
        }
    });
    return ranges;
}

// How far what the band raises lies off its triangles at a level, in each node.
class RaisedErrors {
public:
    RaisedErrors(const TileLayout& layout,
                 const FeatherBand& band,
                 std::size_t cells,
                 std::size_t level,
                 const DetailErrors::NodeLevel& nodes)
        : layout_(layout)
        , band_(band)
        , step_(std::size_t{1} << level)
        , is_wide_(step_ > cells)
        , columns_(nodes.columns)
        , rows_(nodes.rows)
        , largest_m_(nodes.columns * nodes.rows, 0.0F)
    {}

    std::vector<float> measured()
    {
        eachSample(band_, [this](std::size_t column, std::size_t row, std::size_t i,
                                 const FeatherBand::Square& square) {
            const Cell cell = cellOf(column, row);
            const auto raised_m = static_cast<double>(square.raised_m[i]);
            include(column, row, std::abs(raised_m - heightIn(cell, column, row)));
            if (isVertex(column, layout_.columns) && isVertex(row, layout_.rows)) {
                includeAround(column, row, std::abs(raised_m));
            }
        });
        return std::move(largest_m_);
    }

private:
    struct Cell {
        std::size_t left, right, top, bottom; // samples
    };

    bool isVertex(std::size_t sample, std::size_t count) const
    {
        return sample % step_ == 0 || sample + 1 == count;
    }
    Cell cellAt(std::size_t column, std::size_t row) const
    {
        return {column, std::min(column + step_, layout_.columns - 1), row,
                std::min(row + step_, layout_.rows - 1)};
    }
    // The last sample belongs to the last cell.
    Cell cellOf(std::size_t column, std::size_t row) const
    {
        const auto first = [this](std::size_t sample, std::size_t count) {
            return std::min(sample, count - 2) / step_ * step_;
        };
        return cellAt(first(column, layout_.columns), first(row, layout_.rows));
    }
    std::array<std::optional<float>, 4> cornersOf(const Cell& cell) const
    {
        return {band_.raised(cell.left, cell.top), band_.raised(cell.right, cell.top),
                band_.raised(cell.left, cell.bottom), band_.raised(cell.right, cell.bottom)};
    }
    double heightIn(const Cell& cell, std::size_t column, std::size_t row) const
    {
        const auto corners = cornersOf(cell);
        const auto height = [&corners](std::size_t i) {
            return static_cast<double>(corners.at(i).value_or(0.0F));
        };
        const auto share = [](std::size_t at, std::size_t from, std::size_t to) {
            return static_cast<double>(at - from) / static_cast<double>(to - from);
        };
        return heightInCell({height(0), height(1), height(2), height(3)},
                            share(column, cell.left, cell.right),
                            share(row, cell.top, cell.bottom));
    }

    // Samples outside the band lie below triangles with corners in it.
    void includeAround(std::size_t column, std::size_t row, double raised_m)
    {
        const auto firsts = [this](std::size_t sample, std::size_t count) {
            const std::size_t last = (count - 2) / step_ * step_;
            const std::size_t after = std::min(sample / step_ * step_, last);
            const std::size_t before = sample % step_ == 0 && sample > 0 ? sample - step_ : after;
            return std::array{std::min(before, last), after};
        };
        for (const std::size_t top : firsts(row, layout_.rows)) {
            for (const std::size_t left : firsts(column, layout_.columns)) {
                const Cell cell = cellAt(left, top);
                const auto corners = cornersOf(cell);
                if (is_wide_ || std::any_of(corners.begin(), corners.end(),
                                            [](const auto& corner) { return !corner; })) {
                    include(cell.left, cell.top, raised_m);
                    include(cell.right, cell.bottom, raised_m);
                }
            }
        }
    }

    // In all nodes with the sample.
    void include(std::size_t column, std::size_t row, double error_m)
    {
        const std::size_t cells = DetailErrors::kNodeCells * step_;
        const auto columns = blocksOf(column, cells, columns_);
        const auto rows = blocksOf(row, cells, rows_);
        for (std::size_t r = rows[0]; r <= rows[1]; ++r) {
            for (std::size_t c = columns[0]; c <= columns[1]; ++c) {
                float& largest_m = largest_m_[r * columns_ + c];
                largest_m = std::max(largest_m, static_cast<float>(error_m));
            }
        }
    }

    const TileLayout& layout_;
    const FeatherBand& band_;
    std::size_t step_;
    bool is_wide_; // cells are: their corners may be in the band, and what lies between is not
    std::size_t columns_;
    std::size_t rows_;
    std::vector<float> largest_m_;
};

// The error of a node is at most 1.25 times that of its worst sample (DetailErrors::nodeError), and
// that of a sum of surfaces at most the sum of their errors.
DetailErrors errorsWith(const MapLevels& own, const FeatherBand& band, std::size_t cells)
{
    DetailErrors::NodeErrors levels = own.analysis->errors.nodeErrors();
    constexpr float kErrorPerSample = 1.25F;
    parallelRanges(levels.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t level = std::max<std::size_t>(begin, 1); level < end; ++level) {
            DetailErrors::NodeLevel& nodes = levels[level];
            const std::vector<float> raised_m =
                RaisedErrors(own.layout, band, cells, level, nodes).measured();
            for (std::size_t i = 0; i < raised_m.size(); ++i) {
                if (raised_m[i] > 0.0F) {
                    nodes.errors_m[i] =
                        roundedUpShort(nodes.errors_m[i] + kErrorPerSample * raised_m[i]);
                }
            }
        }
    });
    return DetailErrors::from(std::move(levels));
}

void raiseMaxima(std::vector<std::vector<float>>& maxima_m, const MinMaxPyramid& bounds)
{
    for (std::size_t level = 0; level < maxima_m.size(); ++level) {
        const std::size_t columns = bounds.columns(level);
        for (std::size_t i = 0; i < maxima_m[level].size(); ++i) {
            const auto here = bounds.bounds(level, i % columns, i / columns);
            if (!here.isEmpty()) {
                maxima_m[level][i] = std::max(maxima_m[level][i], here.maximum_m);
            }
        }
    }
}

} // namespace

SampleType floatTypeFor(SampleType type)
{
    switch (type) {
    case SampleType::UInt8:
    case SampleType::Int8:
    case SampleType::UInt16:
    case SampleType::Int16:
    case SampleType::Float32:
        return SampleType::Float32;
    default:
        return SampleType::Float64;
    }
}

double rawOf(double height_m, const ElevationScale& scale, SampleType type)
{
    const double raw = (height_m - scale.offset_m) / scale.gain;
    return type == SampleType::Float32 ? static_cast<double>(static_cast<float>(raw)) : raw;
}

std::shared_ptr<const TileSource> featheredTiles(std::shared_ptr<const TileSource> own,
                                                 std::shared_ptr<const FeatherBand> band,
                                                 const ElevationScale& scale)
{
    MARSVIEW_CHECK(own != nullptr && band != nullptr);
    const TileLayout layout = floatLayout(own->layout());
    MeansByTile means = raisedMeans(layout, *band);
    return std::make_shared<const FeatheredTileSource>(
        std::move(own),
        FeatheredTileData{
            .band = std::move(band), .scale = scale, .layout = layout, .means = std::move(means)});
}

MapLevels featheredLevels(const MapLevels& own,
                          const FeatherBand& band,
                          std::size_t cells,
                          const ElevationScale& scale)
{
    RawRanges ranges = floatTypeFor(own.layout.type) == SampleType::Float32
                           ? rangesWith<float>(own, band, scale)
                           : rangesWith<double>(own, band, scale);
    MapLevels levels{.layout = floatLayout(own.layout),
                     .statistics = own.statistics,
                     .analysis = nullptr,
                     .filled_maxima_m = own.filled_maxima_m,
                     .checksums = own.checksums};
    const SampleStatistics extremes = ranges.extremes();
    levels.statistics.raw_minimum = std::min(own.statistics.raw_minimum, extremes.raw_minimum);
    levels.statistics.raw_maximum = std::max(own.statistics.raw_maximum, extremes.raw_maximum);
    levels.analysis = std::make_shared<const SurfaceAnalysis>(
        SurfaceAnalysis{.bounds = MinMaxPyramid::from(std::move(ranges), scale),
                        .means = own.analysis->means,
                        .errors = errorsWith(own, band, cells)});
    raiseMaxima(levels.filled_maxima_m, levels.analysis->bounds);
    return levels;
}

} // namespace marsview
