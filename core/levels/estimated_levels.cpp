// Notation: the overview has level K, so its means stand for blocks of 2^K samples a side. e(k) is
// the error of the surface drawn at level k, as DetailErrors defines it. Terrain is self-similar
// over many scales: e(k) = a · 2^(H k), with H between 0.5 and 1. From the overview, whose samples
// are 2^K apart, only differences between levels can be measured:
//
//     E(j)² = e(K + j)² - e(K)² = a² 2^(2 H K) (2^(2 H j) - 1)
//
// since detail of different sizes is independent. Hence H from two levels, over the whole map,
//
//     E(2)² / E(1)² = 2^(2 H) + 1,
//
// and e(K + j) = E(j) / sqrt(1 - 2^(-2 H j)), node by node. The overview does not show how smooth
// the terrain is at finer scales: maps may be made from coarser data. So a few tiles are read at
// full resolution, where E(1) is small, medium and large. Their e(1), e(2) and e(3), in units of
// the local E(1), are used for all nodes; the levels between follow a power law.

#include "core/levels/estimated_levels.h"

#include "core/base/check.h"
#include "core/terrain/drawn_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Bounds are widened by this many times the largest step between neighboring means, and by a
// fraction of the map's mean step, for peaks in plains.
constexpr double kStepsBeyond = 1.0;
constexpr double kMeanStepsBeyond = 1.0;

// Levels consist of samples, overviews of means, which are smoother. The error of a node is that of
// its worst block of 32 × 32 cells at full resolution, of which an overview's block contains many.
// The second factor was measured on maps of the Moon, Mars and the Earth.
constexpr double kRougherThanMeans = 1.25;
constexpr double kWorstBlockPerLevel = 0.2;

// A node that seems flat gets at least this fraction of the mean error.
constexpr double kErrorShareMin = 0.05;

// The ranks, by error among all nodes, of the nodes whose tiles are read.
constexpr std::array<double, 5> kRanks{0.1, 0.3, 0.5, 0.7, 0.9};

constexpr double kHurstMin = 0.5;
constexpr double kHurstMax = 1.0;
constexpr double kHurstTypical = 0.85;

// One complete level of a source.
struct Overview {
    std::size_t level = 0;
    SampleGrid samples;
};

// Copies a part with its voids.
void putInto(SampleGrid& grid, const SampleGrid& part, std::size_t left, std::size_t upper)
{
    const std::size_t sample_bytes = sampleBytes(grid.type());
    part.visit([&](auto view) {
        for (std::size_t row = 0; row < part.rows(); ++row) {
            std::memcpy(grid.rowData(upper + row) + left * sample_bytes, view.row(row).data(),
                        part.columns() * sample_bytes);
            for (std::size_t c = 0; part.hasVoids() && c < part.columns(); ++c) {
                if (part.isVoid(c, row)) {
                    grid.markVoid(left + c, upper + row);
                }
            }
        }
    });
}

Result<Overview>
readAll(const TileSource& source, TileKind kind, std::size_t level, JobMonitor& monitor)
{
    const TileLayout& layout = source.layout();
    Result<SampleGrid> grid =
        SampleGrid::create(layout.type, layout.columnsAt(kind, level), layout.rowsAt(kind, level));
    if (!grid) {
        return Error{grid.error().code, fmt::format("{}: {}", source.name(), grid.error().message)};
    }
    Result<std::unique_ptr<TileReader>> reader = source.open();
    if (!reader) {
        return std::move(reader).error();
    }
    const std::size_t columns = layout.tileColumns(kind, level);
    const std::size_t rows = layout.tileRows(kind, level);
    for (std::size_t i = 0; i < columns * rows; ++i) {
        if (monitor.isCanceled()) {
            return Error{ErrorCode::Canceled,
                         fmt::format("{}: reading was canceled", source.name())};
        }
        const TileId id{kind, static_cast<std::uint8_t>(level),
                        static_cast<std::uint32_t>(i % columns),
                        static_cast<std::uint32_t>(i / columns)};
        const Result<Tile> tile = (*reader)->read(id);
        if (!tile) {
            return tile.error();
        }
        putInto(*grid, tile->samples, id.column * kTileSide, id.row * kTileSide);
        monitor.report(static_cast<double>(i + 1) / static_cast<double>(columns * rows));
    }
    return Overview{level, std::move(grid).value()};
}

// One number per block of the overview.
struct BlockNumbers {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<double> values;

    double operator()(std::size_t column, std::size_t row) const
    {
        return values[row * columns + column];
    }

    // A grid of the same size with function(column, row).
    template <typename F>
    BlockNumbers map(const F& function) const
    {
        BlockNumbers result{columns, rows, std::vector<double>(values.size())};
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t column = 0; column < columns; ++column) {
                result.values[row * columns + column] = function(column, row);
            }
        }
        return result;
    }

    // Calls function(value) with the values of a block and its neighbors.
    template <typename F>
    void around(std::size_t column, std::size_t row, const F& function) const
    {
        for (std::size_t r = row - std::min<std::size_t>(row, 1); r <= std::min(row + 1, rows - 1);
             ++r) {
            for (std::size_t c = column - std::min<std::size_t>(column, 1);
                 c <= std::min(column + 1, columns - 1); ++c) {
                function((*this)(c, r));
            }
        }
    }

    // Ignores NaN; -infinity if all values are NaN.
    BlockNumbers largestAround() const
    {
        return map([this](std::size_t column, std::size_t row) {
            double largest = -std::numeric_limits<double>::infinity();
            around(column, row, [&](double value) { largest = value > largest ? value : largest; });
            return largest;
        });
    }
};

BlockNumbers rawMeans(const SampleGrid& samples)
{
    BlockNumbers means{samples.columns(), samples.rows(),
                       std::vector<double>(samples.columns() * samples.rows())};
    return means.map([&samples](std::size_t column, std::size_t row) {
        return samples.isVoid(column, row) ? kNan : samples.raw(column, row);
    });
}

// A raw value rounded to the type.
template <typename T>
T held(double value)
{
    if (value <= static_cast<double>(std::numeric_limits<T>::lowest())) {
        return std::numeric_limits<T>::lowest();
    }
    if (value >= static_cast<double>(std::numeric_limits<T>::max())) {
        return std::numeric_limits<T>::max();
    }
    return static_cast<T>(value);
}

RawRanges estimatedRanges(const TileLayout& layout, const Overview& overview)
{
    const BlockNumbers means = rawMeans(overview.samples);
    const BlockNumbers steps = means.map([&means](std::size_t column, std::size_t row) {
        double largest = 0.0; // also if void
        const double mean = means(column, row);
        means.around(column, row, [&](double other) {
            const double step = std::abs(other - mean);
            largest = step > largest ? step : largest;
        });
        return largest;
    });
    double sum = 0.0;
    for (const double step : steps.values) {
        sum += step;
    }
    const double beyond = kMeanStepsBeyond * sum / static_cast<double>(steps.values.size());
    const BlockNumbers largest_steps = steps.largestAround();
    const BlockNumbers negative =
        means.map([&](std::size_t column, std::size_t row) { return -means(column, row); });
    const BlockNumbers highest = means.largestAround();
    const BlockNumbers lowest = negative.largestAround(); // negated
    RawRanges ranges(layout.type, layout.columns, layout.rows);
    ranges.visit([&](auto nodes) {
        using Range = std::remove_cvref_t<decltype(nodes(0, 0))>;
        using T = decltype(Range::minimum);
        const auto last_of = [&](std::size_t node, std::size_t samples) {
            return std::min((node + 1) * RawRanges::kBlock, samples - 1) >> overview.level;
        };
        for (std::size_t row = 0; row < nodes.rows(); ++row) {
            for (std::size_t column = 0; column < nodes.columns(); ++column) {
                Range range{};
                for (std::size_t r = row * RawRanges::kBlock >> overview.level;
                     r <= last_of(row, layout.rows); ++r) {
                    for (std::size_t c = column * RawRanges::kBlock >> overview.level;
                         c <= last_of(column, layout.columns); ++c) {
                        const double margin = kStepsBeyond * largest_steps(c, r) + beyond;
                        if (std::isfinite(highest(c, r))) {
                            range.include({held<T>(std::floor(-lowest(c, r) - margin)),
                                           held<T>(std::ceil(highest(c, r) + margin))});
                        }
                    }
                }
                nodes(column, row) = range;
            }
        }
    });
    return ranges;
}

BlockMeans
estimatedMeans(const TileLayout& layout, const Overview& overview, const ElevationScale& scale)
{
    const SampleGrid& samples = overview.samples;
    BlockExtent extent{layout.columns, layout.rows, std::size_t{1} << overview.level};
    BlockGrid grid =
        emptyBlocks(extent, samples.hasVoids() ? BlockShares::Kept : BlockShares::None);
    for (std::size_t row = 0; row < grid.rows; ++row) {
        for (std::size_t column = 0; column < grid.columns; ++column) {
            const std::size_t i = row * grid.columns + column;
            const bool is_void = samples.isVoid(column, row);
            grid.means_m[i] = is_void ? std::numeric_limits<float>::quiet_NaN()
                                      : static_cast<float>(scale.height(samples.raw(column, row)));
            if (!grid.shares.empty()) {
                grid.shares[i] = is_void ? 0.0F : 1.0F; // an overview has no shares
            }
        }
    }
    while (extent.block_samples < BlockMeans::kBlock) {
        grid = reduced(grid, extent);
        extent = extent.coarser();
    }
    return BlockMeans::from(std::move(grid), extent);
}

// The errors between the levels of a map that has these samples.
Result<DetailErrors>
errorsWithin(const SampleGrid& from, const ElevationScale& scale, JobMonitor& monitor)
{
    Result<SampleGrid> copy = SampleGrid::create(from.type(), from.columns(), from.rows());
    if (!copy) {
        return std::move(copy).error();
    }
    putInto(*copy, from, 0, 0);
    const SampleStatistics statistics = copy->applyRule({}, 0, copy->rows());
    const Heightfield heightfield(std::make_shared<const SampleGrid>(std::move(copy).value()),
                                  statistics, scale);
    Result<BlockMeans> fills = BlockMeans::build(heightfield, monitor);
    if (!fills) {
        return std::move(fills).error();
    }
    return DetailErrors::build({heightfield, *fills}, monitor);
}

double meanSquare(const DetailErrors& errors, std::size_t level)
{
    const LargeVector<float>& values = errors.nodeErrors()[level].errors_m;
    double sum = 0.0;
    for (const float value : values) {
        sum += static_cast<double>(value) * static_cast<double>(value);
    }
    return sum / static_cast<double>(values.size());
}

double hurstExponent(const DetailErrors& measured)
{
    // The error of a second-level node is that of the worst of four blocks, and so on: with only a
    // few nodes, this hides the power law.
    if (measured.levelCount() < 4) {
        return kHurstTypical;
    }
    const double first = meanSquare(measured, 1);
    const double second = meanSquare(measured, 2);
    if (!(first > 0.0) || !(second > 2.0 * first)) {
        return kHurstMin;
    }
    return std::clamp(0.5 * std::log2(second / first - 1.0), kHurstMin, kHurstMax);
}

// The errors of the first levels, in units of E(1) of the surrounding node: element k - 1 is for
// level k.
using FineErrors = std::vector<double>;

double meanError(const DetailErrors& errors, std::size_t level)
{
    const LargeVector<float>& values = errors.nodeErrors()[level].errors_m;
    double sum = 0.0;
    for (const float value : values) {
        sum += static_cast<double>(value);
    }
    return sum / static_cast<double>(values.size());
}

// From tiles at full resolution.
Result<FineErrors> fineErrors(const TileSource& source,
                              std::size_t overview_level,
                              const DetailErrors& measured,
                              const ElevationScale& scale,
                              JobMonitor& monitor)
{
    const TileLayout& layout = source.layout();
    std::vector<std::pair<float, DetailNode>> nodes;
    for (std::size_t row = 0; row < measured.rows(1); ++row) {
        for (std::size_t column = 0; column < measured.columns(1); ++column) {
            const DetailNode node{1, column, row};
            if (measured.nodeError(node) > 0.0F) {
                nodes.emplace_back(measured.nodeError(node), node);
            }
        }
    }
    std::sort(nodes.begin(), nodes.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    Result<std::unique_ptr<TileReader>> reader = source.open();
    if (!reader) {
        return std::move(reader).error();
    }
    std::vector<std::vector<double>> shares; // by level, of each tile
    for (const double rank : kRanks) {
        if (nodes.empty()) {
            break;
        }
        const auto& [error, node] =
            nodes[static_cast<std::size_t>(rank * static_cast<double>(nodes.size()))];
        const auto tile_around = [&](std::size_t place, std::size_t samples) {
            const std::size_t node_samples = DetailErrors::kNodeCells << (overview_level + 1);
            return static_cast<std::uint32_t>(
                std::min(place * node_samples + node_samples / 2, samples - 1) / kTileSide);
        };
        const TileId id{TileKind::Samples, 0, tile_around(node.column, layout.columns),
                        tile_around(node.row, layout.rows)};
        if (layout.tileWidth(id) < 2 || layout.tileHeight(id) < 2) {
            continue;
        }
        const Result<Tile> tile = (*reader)->read(id);
        if (!tile) {
            return tile.error();
        }
        const Result<DetailErrors> errors = errorsWithin(tile->samples, scale, monitor);
        if (!errors) {
            return errors.error();
        }
        shares.resize(std::max(shares.size(), errors->levelCount() - 1));
        for (std::size_t level = 1; level < errors->levelCount(); ++level) {
            shares[level - 1].push_back(meanError(*errors, level) / static_cast<double>(error));
        }
    }
    FineErrors fine;
    for (std::vector<double>& of_level : shares) {
        const auto middle = of_level.begin() + static_cast<std::ptrdiff_t>(of_level.size() / 2);
        std::nth_element(of_level.begin(), middle, of_level.end());
        fine.push_back(*middle);
    }
    return fine;
}

DetailErrors estimatedErrors(const TileLayout& layout,
                             std::size_t overview_level,
                             const DetailErrors& measured,
                             const FineErrors& fine)
{
    DetailErrors::NodeErrors errors = DetailErrors::noErrors(layout.columns, layout.rows);
    if (measured.levelCount() < 2) {
        return DetailErrors::from(std::move(errors)); // a map of a single node is always drawn at
                                                      // level 0
    }
    const double hurst = hurstExponent(measured);
    const double rougher =
        kRougherThanMeans * (1.0 + kWorstBlockPerLevel * static_cast<double>(overview_level));
    const auto seen_from_samples = [&](std::size_t j) {
        return rougher / std::sqrt(1.0 - std::exp2(-2.0 * hurst * static_cast<double>(j)));
    };
    // e(level) in units of E(1), below the first level that the overview determines.
    const std::size_t first_measured = overview_level + 1;
    const auto below = [&](std::size_t level) {
        const double last = seen_from_samples(1);
        const std::size_t known = std::min(fine.size(), overview_level);
        if (known == 0 || !(fine[known - 1] > 0.0)) {
            return last * std::exp2(-hurst * static_cast<double>(first_measured - level));
        }
        if (level <= known) {
            return std::min(fine[level - 1], last);
        }
        const double share =
            static_cast<double>(level - known) / static_cast<double>(first_measured - known);
        return std::pow(std::min(fine[known - 1], last), 1.0 - share) * std::pow(last, share);
    };
    const auto least = static_cast<float>(kErrorShareMin * meanError(measured, 1));
    for (std::size_t level = 1; level < errors.size(); ++level) {
        DetailErrors::NodeLevel& nodes = errors[level];
        // The measured level to use: this one or the nearest.
        const std::size_t j = std::clamp<std::size_t>(
            level > overview_level ? level - overview_level : 1, 1, measured.levelCount() - 1);
        const std::size_t measured_level = overview_level + j;
        const double factor =
            level < first_measured
                ? below(level)
                : seen_from_samples(j) *
                      std::exp2(hurst * static_cast<double>(level - measured_level));
        for (std::size_t row = 0; row < nodes.rows; ++row) {
            for (std::size_t column = 0; column < nodes.columns; ++column) {
                // The overview's last node may end shortly after the map's last node begins.
                const auto place = [&](std::size_t node, std::size_t count) {
                    return std::min(measured_level >= level ? node >> (measured_level - level)
                                                            : node << (level - measured_level),
                                    count - 1);
                };
                const float error = measured.nodeError(
                    {j, place(column, measured.columns(j)), place(row, measured.rows(j))});
                nodes.errors_m[row * nodes.columns + column] =
                    static_cast<float>(factor * static_cast<double>(std::max(error, least)));
            }
        }
    }
    return DetailErrors::from(std::move(errors));
}

// A fill is never higher than the means between which it is interpolated.
std::vector<std::vector<float>>
filledMaxima(const TileLayout& layout, const MinMaxPyramid& bounds, const BlockMeans& means)
{
    const GridView<const float> filled = means.filledMeans();
    std::vector<std::vector<float>> maxima(bounds.levelCount());
    for (std::size_t level = 0; level < maxima.size(); ++level) {
        maxima[level].assign(bounds.columns(level) * bounds.rows(level),
                             -std::numeric_limits<float>::infinity());
    }
    const auto first = [&](std::size_t node) {
        const std::size_t block = node * MinMaxPyramid::kBlock / means.blockSamples();
        return block - std::min<std::size_t>(block, 1);
    };
    const auto last = [&](std::size_t node, std::size_t samples, std::size_t blocks) {
        return std::min(
            std::min((node + 1) * MinMaxPyramid::kBlock, samples - 1) / means.blockSamples() + 1,
            blocks - 1);
    };
    for (std::size_t row = 0; row < bounds.rows(0); ++row) {
        for (std::size_t column = 0; column < bounds.columns(0); ++column) {
            float& largest = maxima[0][row * bounds.columns(0) + column];
            for (std::size_t r = first(row); r <= last(row, layout.rows, filled.rows()); ++r) {
                for (std::size_t c = first(column);
                     c <= last(column, layout.columns, filled.columns()); ++c) {
                    largest = std::max(largest, filled(c, r));
                }
            }
        }
    }
    for (std::size_t level = 1; level < maxima.size(); ++level) {
        for (std::size_t row = 0; row < bounds.rows(level - 1); ++row) {
            for (std::size_t column = 0; column < bounds.columns(level - 1); ++column) {
                float& largest = maxima[level][row / 2 * bounds.columns(level) + column / 2];
                largest =
                    std::max(largest, maxima[level - 1][row * bounds.columns(level - 1) + column]);
            }
        }
    }
    return maxima;
}

// Some samples exceed estimated bounds, and the proxy must not fall through them: casts skip
// nothing.
std::vector<std::vector<float>> unknownMaxima(const MinMaxPyramid& bounds)
{
    std::vector<std::vector<float>> maxima(bounds.levelCount());
    for (std::size_t level = 0; level < maxima.size(); ++level) {
        maxima[level].assign(bounds.columns(level) * bounds.rows(level),
                             std::numeric_limits<float>::max());
    }
    return maxima;
}

MapLevels levelsOf(const TileLayout& layout,
                   const SampleStatistics& statistics,
                   std::shared_ptr<const SurfaceAnalysis> analysis)
{
    MapLevels levels{.layout = layout,
                     .statistics = statistics,
                     .analysis = std::move(analysis),
                     .filled_maxima_m = {},
                     .checksums = nullptr};
    if (layout.has_voids) {
        levels.filled_maxima_m =
            filledMaxima(layout, levels.analysis->bounds, levels.analysis->means);
    }
    return levels;
}

// A map small enough to read all its samples.
Result<MapLevels>
measuredLevels(const TileSource& source, const ElevationScale& scale, JobMonitor& monitor)
{
    Result<Overview> whole = readAll(source, TileKind::Samples, 0, monitor);
    if (!whole) {
        return std::move(whole).error();
    }
    const SampleStatistics statistics = whole->samples.applyRule({}, 0, whole->samples.rows());
    const Heightfield heightfield(std::make_shared<const SampleGrid>(std::move(whole->samples)),
                                  statistics, scale);
    Result<std::shared_ptr<const SurfaceAnalysis>> analysis = analyze(heightfield, monitor);
    if (!analysis) {
        return std::move(analysis).error();
    }
    TileLayout layout = source.layout();
    layout.has_voids = statistics.void_count > 0;
    return levelsOf(layout, statistics, std::move(analysis).value());
}

} // namespace

Result<MapLevels> estimateLevels(const TileSource& source,
                                 const ElevationScale& scale,
                                 JobMonitor& monitor,
                                 std::size_t means_max)
{
    const TileLayout& layout = source.layout();
    if (layout.mean_levels == 0 && layout.columns * layout.rows <= means_max) {
        return measuredLevels(source, scale, monitor);
    }
    const auto is_small = [&](std::size_t level) {
        return layout.columnsAt(TileKind::Means, level) * layout.rowsAt(TileKind::Means, level) <=
               means_max;
    };
    std::size_t level = 1;
    while (level <= layout.mean_levels && !is_small(level)) {
        ++level;
    }
    if (level > layout.mean_levels) {
        return Error{ErrorCode::TooLarge,
                     fmt::format("{}: has no overviews that are small enough", source.name())};
    }
    monitor.beginStage(0.0, 0.9);
    const Result<Overview> overview = readAll(source, TileKind::Means, level, monitor);
    if (!overview) {
        return overview.error();
    }
    monitor.beginStage(0.9, 1.0);
    RawRanges ranges = estimatedRanges(layout, *overview);
    SampleStatistics statistics = ranges.extremes();
    statistics.sample_count = std::uint64_t{layout.columns} * layout.rows;
    const SampleGrid& means = overview->samples;
    std::uint64_t void_means = 0;
    for (std::size_t row = 0; means.hasVoids() && row < means.rows(); ++row) {
        for (std::size_t column = 0; column < means.columns(); ++column) {
            void_means += means.isVoid(column, row) ? 1U : 0U;
        }
    }
    statistics.void_count = static_cast<std::uint64_t>(
        static_cast<double>(statistics.sample_count) * static_cast<double>(void_means) /
        static_cast<double>(means.columns() * means.rows()));
    if (means.columns() < 2 || means.rows() < 2) {
        return Error{
            ErrorCode::Unsupported,
            fmt::format("{}: its overviews are too narrow to estimate its levels", source.name())};
    }
    Result<DetailErrors> measured = errorsWithin(overview->samples, scale, monitor);
    if (!measured) {
        return std::move(measured).error();
    }
    FineErrors fine;
    if (measured->levelCount() > 1) {
        Result<FineErrors> found = fineErrors(source, level, *measured, scale, monitor);
        if (!found) {
            return std::move(found).error();
        }
        fine = std::move(found).value();
    }
    auto analysis = std::make_shared<const SurfaceAnalysis>(
        SurfaceAnalysis{.bounds = MinMaxPyramid::from(std::move(ranges), scale),
                        .means = estimatedMeans(layout, *overview, scale),
                        .errors = estimatedErrors(layout, level, *measured, fine)});
    std::vector<std::vector<float>> maxima = unknownMaxima(analysis->bounds);
    return MapLevels{.layout = layout,
                     .statistics = statistics,
                     .analysis = std::move(analysis),
                     .filled_maxima_m = std::move(maxima),
                     .checksums = nullptr};
}

} // namespace marsview
