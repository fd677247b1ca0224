#include "core/levels/level_file.h"
#include "core/prepare/level_builder.h"
#include "core/raster/raster_file.h"
#include "core/terrain/filled_heightfield.h"
#include "tests/support/grid_tile_source.h"
#include "tests/support/make_terrain.h"
#include "tests/support/nan.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <thread>
#include <type_traits>
#include <vector>
#include <zlib.h>

namespace marsview {
namespace {

LevelFileKey someKey()
{
    return {.raster = {.path = "/maps/mars.tif", .bytes = 1234, .modified_s = 77, .digest = "ab12"},
            .band = 1,
            .nodata = kNan};
}

struct Limits {
    std::size_t memory_bytes = std::size_t{1} << 30;
    std::size_t mean_blocks = 4'000'000;
    std::vector<std::uint64_t> stops{}; // tiles read by a series of interrupted builds
};

/// The level file of a map in memory, in its own folder.
class BuiltFile {
public:
    explicit BuiltFile(const Heightfield& field, const Limits& limits = {})
        : source_(field,
                  {.mean_levels = kMeanLevels,
                   .before_read = [this](const TileId&) -> std::optional<Error> {
                       if (stop_ && reads_++ >= *stop_) {
                           monitor_->cancel();
                       }
                       return std::nullopt;
                   }})
    {
        const LevelBuild build{.source = &source_,
                               .scale = field.scale(),
                               .key = someKey(),
                               .path = path(),
                               .memory_bytes_max = limits.memory_bytes,
                               .mean_blocks_max = limits.mean_blocks,
                               .checkpoint_interval = std::chrono::milliseconds(0)};
        for (const std::uint64_t stop : limits.stops) {
            monitor_.emplace();
            stop_ = stop;
            reads_ = 0;
            const Status status = buildLevelFile(build, *monitor_);
            EXPECT_FALSE(status);
            EXPECT_EQ(status.error().code, ErrorCode::Canceled);
        }
        stop_.reset();
        reads_before_ = source_.readCount();
        monitor_.emplace();
        const Status status = buildLevelFile(build, *monitor_);
        EXPECT_TRUE(status) << status.error().message;
        EXPECT_EQ(monitor_->fraction(), 1.0);
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()),
                                std::filesystem::directory_iterator()),
                  1);
    }

    std::string path() const { return folder_.file("map.tif.marsview"); }
    const test::GridTileSource& source() const { return source_; }
    /// Tiles read by the uninterrupted build.
    std::uint64_t readsAtLast() const { return source_.readCount() - reads_before_; }
    LevelFile open() const
    {
        auto file = LevelFile::open(path(), someKey());
        EXPECT_TRUE(file) << file.error().message;
        return std::move(file).value();
    }

private:
    static constexpr std::size_t kMeanLevels = 2;

    test::TempFolder folder_;
    std::optional<JobMonitor> monitor_;
    std::optional<std::uint64_t> stop_;
    std::atomic<std::uint64_t> reads_{0};
    std::uint64_t reads_before_ = 0;
    test::GridTileSource source_;
};

bool isSame(float a, float b)
{
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) ||
           (std::isnan(a) && std::isnan(b));
}

void expectSameBounds(const MinMaxPyramid& got, const MinMaxPyramid& expected)
{
    ASSERT_EQ(got.levelCount(), expected.levelCount());
    for (std::size_t level = 0; level < got.levelCount(); ++level) {
        ASSERT_EQ(got.columns(level), expected.columns(level));
        ASSERT_EQ(got.rows(level), expected.rows(level));
        for (std::size_t row = 0; row < got.rows(level); ++row) {
            for (std::size_t column = 0; column < got.columns(level); ++column) {
                const auto& a = got.bounds(level, column, row);
                const auto& b = expected.bounds(level, column, row);
                ASSERT_TRUE(isSame(a.minimum_m, b.minimum_m) && isSame(a.maximum_m, b.maximum_m))
                    << level << ": " << column << ", " << row;
            }
        }
    }
}

void expectSameErrors(const DetailErrors& got, const DetailErrors& expected)
{
    ASSERT_EQ(got.levelCount(), expected.levelCount());
    for (std::size_t level = 0; level < got.levelCount(); ++level) {
        ASSERT_EQ(got.columns(level), expected.columns(level));
        ASSERT_EQ(got.rows(level), expected.rows(level));
        for (std::size_t row = 0; row <= got.rows(level); ++row) {
            for (std::size_t column = 0; column <= got.columns(level); ++column) {
                if (row < got.rows(level) && column < got.columns(level)) {
                    ASSERT_TRUE(isSame(got.nodeError({level, column, row}),
                                       expected.nodeError({level, column, row})))
                        << level << ": " << column << ", " << row;
                }
                if (level > 0) {
                    ASSERT_TRUE(isSame(got.cornerError(level, column, row),
                                       expected.cornerError(level, column, row)));
                }
            }
        }
    }
}

/// The stored levels are the coarsest ones of the whole map.
void expectSameMeans(const BlockMeans& got, const BlockMeans& expected)
{
    const std::size_t left_out = expected.levelCount() - got.levelCount();
    ASSERT_EQ(got.blockSamples(), expected.blockSamples() << left_out);
    for (std::size_t level = 0; level < got.levelCount(); ++level) {
        const auto a = got.means(level);
        const auto b = expected.means(level + left_out);
        ASSERT_EQ(a.columns(), b.columns());
        ASSERT_EQ(a.rows(), b.rows());
        for (std::size_t row = 0; row < a.rows(); ++row) {
            for (std::size_t column = 0; column < a.columns(); ++column) {
                ASSERT_TRUE(isSame(a(column, row), b(column, row)))
                    << level << ": " << column << ", " << row;
                ASSERT_TRUE(isSame(got.share(level, column, row),
                                   expected.share(level + left_out, column, row)));
            }
        }
    }
}

void expectSameMaxima(const std::vector<std::vector<float>>& got, const FilledHeightfield& filled)
{
    if (!filled.heightfield().hasVoids()) {
        EXPECT_TRUE(got.empty());
        return;
    }
    ASSERT_EQ(got.size(), filled.levelCount());
    JobMonitor monitor;
    const MinMaxPyramid bounds = MinMaxPyramid::build(filled.heightfield(), monitor).value();
    for (std::size_t level = 0; level < got.size(); ++level) {
        ASSERT_EQ(got[level].size(), bounds.columns(level) * bounds.rows(level));
        for (std::size_t i = 0; i < got[level].size(); ++i) {
            const std::size_t columns = bounds.columns(level);
            ASSERT_EQ(static_cast<double>(got[level][i]),
                      filled.maximum(level, i % columns, i / columns))
                << level << ": " << i % columns << ", " << i / columns;
        }
    }
}

/// Every tile of samples and every fill, against the map.
void expectSameTiles(const LevelFile& file, const test::GridTileSource& source)
{
    const TileLayout& layout = source.layout();
    for (std::uint8_t level = 0; level <= layout.topLevel(); ++level) {
        if (level > 0 && level < LevelFile::kFirstLevel) {
            continue;
        }
        for (std::uint32_t row = 0; row < layout.tileRows(TileKind::Samples, level); ++row) {
            for (std::uint32_t c = 0; c < layout.tileColumns(TileKind::Samples, level); ++c) {
                const TileId id{.kind = TileKind::Samples, .level = level, .column = c, .row = row};
                const Tile truth = source.tile(id);
                const auto fill = file.readFilled(id, source.heightfield().scale());
                ASSERT_TRUE(fill) << fill.error().message;
                ASSERT_EQ(fill->empty(), !truth.samples.hasVoids());
                std::optional<SampleGrid> samples;
                if (level > 0) {
                    auto read = file.readSamples(id);
                    ASSERT_TRUE(read) << read.error().message;
                    samples = std::move(read).value();
                    ASSERT_EQ(samples->type(), truth.samples.type());
                    ASSERT_EQ(samples->hasVoids(), truth.samples.hasVoids());
                }
                const std::size_t columns = truth.samples.columns();
                for (std::size_t i = 0; i < columns * truth.samples.rows(); ++i) {
                    const std::size_t x = i % columns;
                    const std::size_t y = i / columns;
                    if (truth.samples.isVoid(x, y)) {
                        ASSERT_TRUE(isSame((*fill)[i], truth.filled_m[i]));
                    }
                    if (samples) {
                        ASSERT_EQ(samples->isVoid(x, y), truth.samples.isVoid(x, y));
                        const double a = samples->raw(x, y);
                        const double b = truth.samples.raw(x, y);
                        ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
                    }
                }
            }
        }
    }
}

/// The checksum of every tile that the raster stores, against the tile.
void expectChecksums(const TileChecksums& checksums, const test::GridTileSource& source)
{
    const TileLayout& layout = source.layout();
    std::size_t count = 0;
    for (std::uint8_t level = 0; level <= layout.mean_levels; ++level) {
        const TileKind kind = level == 0 ? TileKind::Samples : TileKind::Means;
        for (std::uint32_t row = 0; row < layout.tileRows(kind, level); ++row) {
            for (std::uint32_t column = 0; column < layout.tileColumns(kind, level); ++column) {
                const TileId id{.kind = kind, .level = level, .column = column, .row = row};
                SampleGrid tile = source.tile(id).samples;
                const std::size_t bytes = tile.columns() * tile.rows() * sampleBytes(tile.type());
                ASSERT_EQ(checksums.of(id),
                          crc32_z(0, reinterpret_cast<const Bytef*>(tile.rowData(0)), bytes))
                    << int{level} << ": " << column << ", " << row;
                ++count;
            }
        }
    }
    EXPECT_EQ(checksums.values().size(), count);
}

/// Every query of a level file, against the same map in memory.
void expectSameAsInMemory(const Heightfield& field, const Limits& limits = {})
{
    SCOPED_TRACE(std::to_string(field.columns()) + " x " + std::to_string(field.rows()) + " " +
                 std::string(sampleTypeName(field.samples().type())));
    const BuiltFile built(field, limits);
    const LevelFile file = built.open();
    const auto levels = file.readLevels(field.scale());
    ASSERT_TRUE(levels) << levels.error().message;
    const auto analysis = test::analyzed(field);
    JobMonitor monitor;
    const auto filled = FilledHeightfield::build(field, analysis, monitor).value();
    EXPECT_EQ(levels->layout.columns, field.columns());
    EXPECT_EQ(levels->layout.rows, field.rows());
    EXPECT_EQ(levels->layout.type, field.samples().type());
    EXPECT_EQ(levels->layout.has_voids, field.hasVoids());
    const auto range = heightRange(levels->statistics, field.scale());
    ASSERT_EQ(range.has_value(), field.range().has_value());
    if (range) {
        EXPECT_EQ(range->minimum_m, field.range()->minimum_m);
        EXPECT_EQ(range->maximum_m, field.range()->maximum_m);
    }
    expectSameBounds(levels->analysis->bounds, analysis->bounds);
    expectSameErrors(levels->analysis->errors, analysis->errors);
    expectSameMeans(levels->analysis->means, analysis->means);
    expectSameMaxima(levels->filled_maxima_m, filled);
    expectSameTiles(file, built.source());
    ASSERT_NE(levels->checksums, nullptr);
    expectChecksums(*levels->checksums, built.source());
}

constexpr std::array<std::array<std::size_t, 2>, 10> kSizes{{{2, 2},
                                                             {33, 65},
                                                             {256, 256},
                                                             {257, 257},
                                                             {257, 513},
                                                             {513, 258},
                                                             {3, 1500},
                                                             {2100, 2},
                                                             {1000, 777},
                                                             {1030, 1300}}};

TEST(LevelFile, MatchesTheAnalysisOfTheWholeMap)
{
    test::Random random;
    for (const auto& [columns, rows] : kSizes) {
        const auto heights =
            test::heightsFrom(test::fractalHeights(random, columns, rows, 4000.0, 0.55), columns);
        expectSameAsInMemory(test::int16Terrain(columns, rows, {}, heights));
        expectSameAsInMemory(test::floatTerrain(columns, rows, heights));
    }
}

TEST(LevelFile, HasAllTilesWhereTwoRowsOfALevelEndInOneRowOfTiles)
{
    test::Random random;
    for (const std::size_t rows : {4096U, 4097U, 2049U}) {
        const auto heights =
            test::heightsFrom(test::fractalHeights(random, 40, rows, 4000.0, 0.55), 40);
        expectSameAsInMemory(test::int16Terrain(40, rows, {}, heights));
    }
}

/// Kinds of holes.
std::vector<std::function<bool(std::size_t column, std::size_t row)>> holes(test::Random& random)
{
    return {[&random](std::size_t, std::size_t) { return random.chance(0.01); },
            [](std::size_t c, std::size_t r) { return c > 240 && c < 700 && r > 100 && r < 600; },
            [](std::size_t c, std::size_t r) { return c / 300 % 2 == 0 || r / 70 % 3 == 1; },
            [](std::size_t c, std::size_t r) { return c != 1 || r != 0; },
            [](std::size_t c, std::size_t r) { return c == 256 || r == 512 || (c == 0 && r == 0); },
            [](std::size_t, std::size_t) { return true; }};
}

TEST(LevelFile, MatchesTheAnalysisOfMapsWithVoids)
{
    test::Random random;
    for (const auto& [columns, rows] : kSizes) {
        const auto heights = test::fractalHeights(random, columns, rows, 900.0, 0.6);
        const std::size_t width = columns;
        for (const auto& is_void : holes(random)) {
            const auto holed = [&](std::size_t c, std::size_t r) {
                return is_void(c, r) ? kNan : heights[r * width + c];
            };
            expectSameAsInMemory(
                test::int16Terrain(columns, rows, {.gain = -0.25, .offset_m = 200.0}, holed));
            expectSameAsInMemory(test::floatTerrain(columns, rows, holed));
        }
    }
}

TEST(LevelFile, MatchesTheAnalysisWithFewStoredMeans)
{
    test::Random random;
    for (const auto& [columns, rows] :
         {std::array<std::size_t, 2>{1000, 777}, {257, 513}, {1100, 300}, {33, 65}}) {
        const auto heights = test::fractalHeights(random, columns, rows, 900.0, 0.6);
        const std::size_t width = columns;
        for (const std::size_t blocks : {3000U, 150U, 1U}) {
            for (const auto& is_void : holes(random)) {
                expectSameAsInMemory(test::int16Terrain(columns, rows, {},
                                                        [&](std::size_t c, std::size_t r) {
                                                            return is_void(c, r)
                                                                       ? kNan
                                                                       : heights[r * width + c];
                                                        }),
                                     {.mean_blocks = blocks});
            }
        }
    }
}

TEST(LevelFile, MatchesTheAnalysisWithLittleMemory)
{
    test::Random random;
    const auto heights = test::fractalHeights(random, 2500, 1300, 900.0, 0.6);
    expectSameAsInMemory(test::int16Terrain(2500, 1300, {},
                                            [&](std::size_t c, std::size_t r) {
                                                return random.chance(0.1) ? kNan
                                                                          : heights[r * 2500 + c];
                                            }),
                         {.memory_bytes = 1, .mean_blocks = 100});
}

TEST(LevelFile, MatchesTheAnalysisAfterAResumedBuild)
{
    test::Random random;
    const auto heights = test::fractalHeights(random, 1030, 2600, 900.0, 0.6);
    const auto terrain = [&](double void_share) {
        return test::int16Terrain(1030, 2600, {}, [&](std::size_t c, std::size_t r) {
            return random.chance(void_share) ? kNan : heights[r * 1030 + c];
        });
    };
    // 55 tiles of samples, 18 and 6 of means, then those of samples again.
    const std::vector<std::vector<std::uint64_t>> all_stops{
        {20}, {54}, {60}, {75}, {90}, {130}, {12, 12, 12, 12, 12, 12, 12, 12}, {60, 30}};
    for (const double void_share : {0.0, 0.05}) {
        const Heightfield field = terrain(void_share);
        for (const auto& stops : all_stops) {
            SCOPED_TRACE(testing::PrintToString(stops));
            expectSameAsInMemory(field, {.mean_blocks = 300, .stops = stops});
        }
    }
}

TEST(LevelFile, AResumedBuildDoesNotRereadFinishedRows)
{
    test::Random random;
    const auto heights =
        test::heightsFrom(test::fractalHeights(random, 1030, 2600, 900.0, 0.6), 1030);
    const Heightfield field = test::int16Terrain(1030, 2600, {}, heights);
    const std::uint64_t all = BuiltFile(field).readsAtLast();
    const std::uint64_t threads = std::thread::hardware_concurrency();
    for (const std::uint64_t stop : {40U, 70U, 100U}) {
        // Each thread may have been working on a row of five tiles.
        EXPECT_LE(BuiltFile(field, {.stops = {stop}}).readsAtLast(), all - stop + 5 * threads);
    }
}

/// Random samples over the full range of the type; the value 7 is void.
Heightfield
wildTerrain(test::Random& random, SampleType type, std::size_t columns, std::size_t rows)
{
    SampleGrid grid = SampleGrid::create(type, columns, rows).value();
    dispatchSampleType(type, [&](auto zero) {
        using T = decltype(zero);
        for (std::size_t i = 0; i < columns * rows; ++i) {
            T value{};
            if constexpr (std::is_floating_point_v<T>) {
                value = random.chance(0.001) ? std::numeric_limits<T>::infinity()
                                             : static_cast<T>(random.uniform(-1e12, 1e12));
            } else {
                value = static_cast<T>(random.bits());
            }
            value = random.chance(0.02) ? T{7} : value;
            std::memcpy(grid.rowData(i / columns) + i % columns * sizeof(T), &value, sizeof(T));
        }
    });
    const SampleStatistics statistics = grid.applyRule({.nodata = 7.0}, 0, rows);
    return {std::make_shared<const SampleGrid>(std::move(grid)), statistics,
            ElevationScale{.gain = 0.5, .offset_m = -3.0}};
}

TEST(LevelFile, StoresSamplesOfAllTypes)
{
    test::Random random;
    for (const SampleType type :
         {SampleType::UInt8, SampleType::Int8, SampleType::UInt16, SampleType::Int16,
          SampleType::UInt32, SampleType::Int32, SampleType::UInt64, SampleType::Int64,
          SampleType::Float32, SampleType::Float64}) {
        expectSameAsInMemory(wildTerrain(random, type, 1300, 290));
    }
}

TEST(LevelFile, ConvertsToOtherScales)
{
    test::Random random;
    constexpr std::size_t kColumns = 1200;
    constexpr std::size_t kRows = 500;
    const auto heights = test::fractalHeights(random, kColumns, kRows, 900.0, 0.6);
    const Heightfield field = test::int16Terrain(
        kColumns, kRows, {.gain = 0.5, .offset_m = 100.0}, [&](std::size_t c, std::size_t r) {
            const bool is_hole = c > 300 && c < 500 && r > 200;
            return is_hole || random.chance(0.01) ? kNan : heights[r * kColumns + c];
        });
    const BuiltFile built(field);
    const LevelFile file = built.open();
    for (const ElevationScale scale : {ElevationScale{.gain = 0.25, .offset_m = -7.0},
                                       {.gain = -2.0, .offset_m = 1e4},
                                       {.gain = 0.0, .offset_m = 5.0}}) {
        SampleGrid copy = SampleGrid::create(SampleType::Int16, kColumns, kRows).value();
        std::memcpy(copy.rowData(0), built.source().heightfield().samples().visit([](auto v) {
            return reinterpret_cast<const std::byte*>(v.data());
        }),
                    kColumns * kRows * 2);
        const auto statistics = copy.applyRule({.nodata = -32768.0}, 0, kRows);
        const Heightfield scaled(std::make_shared<const SampleGrid>(std::move(copy)), statistics,
                                 scale);
        const auto analysis = test::analyzed(scaled);
        const auto levels = file.readLevels(scale);
        ASSERT_TRUE(levels) << levels.error().message;
        expectSameBounds(levels->analysis->bounds, analysis->bounds);
        const double tolerance = 1e-6 * 2e4;
        const DetailErrors& errors = levels->analysis->errors;
        for (std::size_t level = 0; level < errors.levelCount(); ++level) {
            for (std::size_t row = 0; row < errors.rows(level); ++row) {
                for (std::size_t c = 0; c < errors.columns(level); ++c) {
                    ASSERT_NEAR(errors.nodeError({level, c, row}),
                                analysis->errors.nodeError({level, c, row}), tolerance);
                }
            }
            const auto means = levels->analysis->means.means(level);
            const auto truth = analysis->means.means(level);
            for (std::size_t row = 0; row < means.rows(); ++row) {
                for (std::size_t c = 0; c < means.columns(); ++c) {
                    ASSERT_EQ(std::isnan(means(c, row)), std::isnan(truth(c, row)));
                    if (!std::isnan(truth(c, row))) {
                        ASSERT_NEAR(means(c, row), truth(c, row), tolerance);
                    }
                }
            }
        }
        // No fill is higher than its block, and the bounds are tight.
        JobMonitor monitor;
        const auto filled = FilledHeightfield::build(scaled, analysis, monitor).value();
        const auto& maxima = levels->filled_maxima_m;
        for (std::uint32_t row = 0; row < 2; ++row) {
            for (std::uint32_t column = 0; column < 5; ++column) {
                const auto fill = file.readFilled({.column = column, .row = row}, scale).value();
                for (std::size_t i = 0; i < fill.size(); ++i) {
                    const std::size_t width = std::min(kTileSide, kColumns - column * kTileSide);
                    const std::size_t c = column * kTileSide + i % width;
                    const std::size_t r = row * kTileSide + i / width;
                    if (!scaled.samples().isVoid(c, r)) {
                        continue;
                    }
                    ASSERT_NEAR(fill[i], filled.sample(c, r), tolerance);
                    const std::size_t block =
                        std::min(r, kRows - 2) / 32 * 38 + std::min(c, kColumns - 2) / 32;
                    ASSERT_LE(fill[i], maxima[0][block]);
                    ASSERT_NEAR(maxima[0][block], filled.maximum(0, block % 38, block / 38),
                                tolerance);
                }
            }
        }
    }
}

TEST(LevelFile, MatchesTheAnalysisOfRealMaps)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    for (const char* name :
         {"derived/moon_gld100_64ppd_crop_8192x4096.tif", "derived/W100N40_etopo5.DEM",
          "srtm/N44W072.hgt", "mars_mola/megt90n000cb.lbl"}) {
        SCOPED_TRACE(name);
        auto file = RasterFile::open((test::sharedData() / name).string());
        ASSERT_TRUE(file) << file.error().message;
        JobMonitor monitor;
        auto loaded = file->readAll(monitor, {file->info().nodata}, defaultMemoryBudget());
        ASSERT_TRUE(loaded) << loaded.error().message;
        const Heightfield field(std::make_shared<const SampleGrid>(std::move(loaded->grid)),
                                loaded->statistics, file->info().elevationScale());
        expectSameAsInMemory(field, {.mean_blocks = 10'000});
    }
}

} // namespace
} // namespace marsview
