#include "core/raster/sample_grid.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"
#include "tests/support/sample_types.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <vector>

// Sanitizers abort if an allocation exceeds the available memory; here the allocation must fail.
#if defined(__SANITIZE_ADDRESS__)
extern "C" const char* __asan_default_options() // NOLINT
{
    return "allocator_may_return_null=1";
}
#elif defined(__SANITIZE_THREAD__)
extern "C" const char* __tsan_default_options() // NOLINT
{
    return "allocator_may_return_null=1";
}
#endif

namespace marsview {
namespace {

template <typename T>
constexpr SampleType sampleTypeOf()
{
    if constexpr (std::is_same_v<T, std::uint8_t>) {
        return SampleType::UInt8;
    } else if constexpr (std::is_same_v<T, std::int8_t>) {
        return SampleType::Int8;
    } else if constexpr (std::is_same_v<T, std::uint16_t>) {
        return SampleType::UInt16;
    } else if constexpr (std::is_same_v<T, std::int16_t>) {
        return SampleType::Int16;
    } else if constexpr (std::is_same_v<T, std::uint32_t>) {
        return SampleType::UInt32;
    } else if constexpr (std::is_same_v<T, std::int32_t>) {
        return SampleType::Int32;
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
        return SampleType::UInt64;
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
        return SampleType::Int64;
    } else if constexpr (std::is_same_v<T, float>) {
        return SampleType::Float32;
    } else {
        return SampleType::Float64;
    }
}

template <typename T>
SampleGrid gridOf(std::size_t columns, const std::vector<T>& samples)
{
    const std::size_t rows = samples.size() / columns;
    SampleGrid grid = SampleGrid::create(sampleTypeOf<T>(), columns, rows).value();
    for (std::size_t r = 0; r < rows; ++r) {
        std::memcpy(grid.rowData(r), samples.data() + r * columns, columns * sizeof(T));
    }
    return grid;
}

template <typename T>
class SampleGridOf : public testing::Test {};

TYPED_TEST_SUITE(SampleGridOf, test::AllSampleTypes);

// Whether a sample means "not measured", by definition: NaN, or the declared nodata value as a
// reader of that type would store it.
template <typename T>
bool isVoidByMeaning(T sample, const std::optional<double>& nodata)
{
    if constexpr (std::is_floating_point_v<T>) {
        if (std::isnan(sample) || std::isinf(sample)) {
            return true;
        }
        return nodata && sample == static_cast<T>(*nodata);
    } else {
        if (!nodata) {
            return false;
        }
        // Doubles cannot represent 2^63 - 1 and 2^64 - 1; as nodata they are read as one more.
        if (*nodata == static_cast<double>(std::numeric_limits<T>::max())) {
            return sample == std::numeric_limits<T>::max();
        }
        // 64-bit integers exceed the precision of a double; a long double holds both.
        return static_cast<long double>(sample) == static_cast<long double>(*nodata);
    }
}

// Few distinct values, so that nodata occurs often; the limits of the type, so that edge cases
// occur.
template <typename T>
std::vector<T> palette()
{
    std::vector<T> values{
        T{0}, T{1}, T{7}, T{99}, std::numeric_limits<T>::max(), std::numeric_limits<T>::lowest()};
    if constexpr (std::is_floating_point_v<T>) {
        values.insert(values.end(),
                      {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity(),
                       -std::numeric_limits<T>::infinity(), T(-0.0), T(-9999), T(1e-34), T(-1e34),
                       T(0.1), std::numeric_limits<T>::denorm_min()});
    }
    return values;
}

const std::vector<std::optional<double>>& nodataValues()
{
    static const std::vector<std::optional<double>> kValues{std::nullopt,
                                                            0.0,
                                                            1.0,
                                                            7.0,
                                                            99.0,
                                                            255.0,
                                                            -128.0,
                                                            127.0,
                                                            -1.0,
                                                            65535.0,
                                                            32767.0,
                                                            -32768.0,
                                                            -9999.0,
                                                            1e10,
                                                            4294967295.0,
                                                            0.5,
                                                            0.1,
                                                            1e-34,
                                                            -1e34,
                                                            1e300,
                                                            -1e300,
                                                            kNan,
                                                            -0.0,
                                                            -3.4028234663852886e+38,
                                                            3.4028234663852886e+38,
                                                            1.7976931348623157e308,
                                                            9223372036854775807.0,
                                                            -9223372036854775808.0,
                                                            18446744073709551615.0,
                                                            -2147483648.0,
                                                            2147483647.0};
    return kValues;
}

TYPED_TEST(SampleGridOf, VoidsAreExactlyTheSamplesThatStandForNothing)
{
    using T = TypeParam;
    test::Random random;
    const std::vector<T> values = palette<T>();
    for (const auto& nodata : nodataValues()) {
        if constexpr (std::is_same_v<T, float>) {
            if (nodata && std::abs(*nodata) > 3.5e38) {
                continue; // undefined conversion; tested below
            }
        }
        SCOPED_TRACE(nodata ? std::to_string(*nodata) : "none");
        for (const std::size_t columns : {1UL, 2UL, 63UL, 64UL, 65UL, 130UL}) {
            std::vector<T> samples(columns * 5);
            for (T& sample : samples) {
                sample = values[random.below(values.size())];
            }
            SampleGrid grid = gridOf(columns, samples);
            const SampleStatistics found = grid.applyRule({nodata}, 0, 5);
            std::uint64_t voids = 0;
            double low = std::numeric_limits<double>::infinity();
            double high = -low;
            std::set<double> valid;
            for (std::size_t i = 0; i < samples.size(); ++i) {
                const bool is_void = isVoidByMeaning(samples[i], nodata);
                ASSERT_EQ(grid.isVoid(i % columns, i / columns), is_void) << +samples[i];
                voids += is_void ? 1U : 0U;
                if (!is_void) {
                    low = std::min(low, static_cast<double>(samples[i]));
                    high = std::max(high, static_cast<double>(samples[i]));
                    valid.insert(static_cast<double>(samples[i]));
                    ASSERT_EQ(grid.raw(i % columns, i / columns), static_cast<double>(samples[i]));
                }
            }
            EXPECT_EQ(found.void_count, voids);
            EXPECT_EQ(found.sample_count, samples.size());
            EXPECT_EQ(found.raw_minimum, low);
            EXPECT_EQ(found.raw_maximum, high);
            EXPECT_EQ(found.raw_next_minimum, valid.size() < 2
                                                  ? std::numeric_limits<double>::infinity()
                                                  : *std::next(valid.begin()));
            EXPECT_EQ(found.raw_next_maximum, valid.size() < 2
                                                  ? -std::numeric_limits<double>::infinity()
                                                  : *std::next(valid.rbegin()));
            EXPECT_EQ(found.hasSamples(), voids < samples.size());
            EXPECT_EQ(grid.hasVoids(), voids > 0);
        }
    }
}

TYPED_TEST(SampleGridOf, KeepsPartsThatArePutInMemoryAndInFiles)
{
    using T = TypeParam;
    test::Random random;
    const test::TempFolder folder;
    const ScratchPlace scratch{.folder = folder.path(), .bytes_min = 1};
    const std::vector<T> values = palette<T>();
    for (int round = 0; round < 20; ++round) {
        const std::size_t columns = 1 + random.below(200);
        const std::size_t rows = 1 + random.below(9);
        const std::size_t first = random.below(150);
        std::vector<T> samples(columns * rows);
        for (T& sample : samples) {
            sample = values[random.below(values.size())];
        }
        SampleGrid part = gridOf(columns, samples);
        part.applyRule({static_cast<double>(values[0])}, 0, rows);
        for (const ScratchPlace* place : {static_cast<const ScratchPlace*>(nullptr), &scratch}) {
            SampleGrid grid =
                SampleGrid::create(part.type(), first + columns + 70, rows + 2, place).value();
            EXPECT_EQ(grid.isInFile(), place != nullptr);
            EXPECT_TRUE(std::filesystem::is_empty(folder.path())); // its files have no names
            grid.put(part, first, 1);
            grid.releasePages();
            for (std::size_t row = 0; row < grid.rows(); ++row) {
                for (std::size_t column = 0; column < grid.columns(); ++column) {
                    const bool is_in =
                        row > 0 && row <= rows && column >= first && column < first + columns;
                    ASSERT_EQ(grid.isVoid(column, row),
                              is_in && part.isVoid(column - first, row - 1));
                    if (is_in && !grid.isVoid(column, row)) {
                        ASSERT_EQ(grid.raw(column, row), part.raw(column - first, row - 1));
                    }
                }
            }
            grid.clearVoids();
            EXPECT_FALSE(grid.hasVoids());
            grid.markVoid(0, 0);
            EXPECT_FALSE(grid.isVoid(first, 1) && first > 0);
        }
    }
}

TEST(SampleGrid, InAFileNamesTheFolderThatHasNoRoom)
{
    const test::TempFolder folder;
    const std::string missing = folder.file("missing");
    const ScratchPlace scratch{.folder = missing, .bytes_min = 1};
    const auto grid = SampleGrid::create(SampleType::Int16, 10, 10, &scratch);
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().code, ErrorCode::TooLarge);
    EXPECT_TRUE(grid.error().message.starts_with(missing + ": no room for 0.0 MB"));
}

TYPED_TEST(SampleGridOf, BandsOfRowsAddUpToTheWhole)
{
    using T = TypeParam;
    test::Random random;
    const std::vector<T> values = palette<T>();
    for (int round = 0; round < 20; ++round) {
        const std::size_t columns = 1 + random.below(100);
        const std::size_t rows = 1 + random.below(30);
        std::vector<T> samples(columns * rows);
        for (T& sample : samples) {
            sample = values[random.below(values.size())];
        }
        SampleGrid whole = gridOf(columns, samples);
        SampleGrid banded = gridOf(columns, samples);
        const VoidRule rule{7.0};
        const SampleStatistics expected = whole.applyRule(rule, 0, rows);
        SampleStatistics merged;
        for (std::size_t row = 0; row < rows;) {
            const std::size_t count = 1 + random.below(rows - row);
            merged.merge(banded.applyRule(rule, row, count));
            row += count;
        }
        EXPECT_EQ(merged.raw_minimum, expected.raw_minimum);
        EXPECT_EQ(merged.raw_maximum, expected.raw_maximum);
        EXPECT_EQ(merged.raw_next_minimum, expected.raw_next_minimum);
        EXPECT_EQ(merged.raw_next_maximum, expected.raw_next_maximum);
        EXPECT_EQ(merged.void_count, expected.void_count);
        EXPECT_EQ(merged.sample_count, expected.sample_count);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            ASSERT_EQ(banded.isVoid(i % columns, i / columns),
                      whole.isVoid(i % columns, i / columns));
        }
    }
}

TYPED_TEST(SampleGridOf, SamplesMaskedBeforeStayVoidAndOutOfTheStatistics)
{
    using T = TypeParam;
    const std::vector<T> samples{1, 2, 3, 4, 5, 6};
    SampleGrid grid = gridOf(3, samples);
    EXPECT_FALSE(grid.hasVoids());
    grid.markVoid(2, 1);
    grid.markVoid(0, 0);
    const SampleStatistics found = grid.applyRule({3.0}, 0, 2);
    EXPECT_EQ(found.void_count, 3U);
    EXPECT_EQ(found.raw_minimum, 2.0);
    EXPECT_EQ(found.raw_maximum, 5.0);
    const std::array<bool, 6> expected{true, false, true, false, false, true};
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(grid.isVoid(i % 3, i / 3), expected[i]) << i;
    }
    grid.clearVoids();
    EXPECT_FALSE(grid.hasVoids());
    EXPECT_FALSE(grid.isVoid(0, 0));
}

TYPED_TEST(SampleGridOf, SamplesKeepTheirOwnTypeAndSize)
{
    using T = TypeParam;
    const std::vector<T> samples{1, 2, 3, 4, 5, 6};
    SampleGrid grid = gridOf(3, samples);
    EXPECT_EQ(grid.bytes(), 6 * sizeof(T));
    grid.visit([&](auto view) {
        using Held = std::remove_cvref_t<decltype(view(0, 0))>;
        EXPECT_TRUE((std::is_same_v<Held, T>));
        for (std::size_t i = 0; i < 6; ++i) {
            EXPECT_EQ(static_cast<T>(view(i % 3, i / 3)), samples[i]);
        }
    });
    grid.markVoid(0, 0);
    EXPECT_EQ(grid.bytes(), 6 * sizeof(T) + 2 * sizeof(std::uint64_t)); // one word per row
}

// Nodata is written as a double; the file stores the nearest float.
TEST(SampleGrid, FloatNodataComparesInFloat)
{
    const struct {
        double declared;
        float stored;
    } cases[] = {
        {-3.4028234663852886e+38, -std::numeric_limits<float>::max()},
        // 9 digits, a common notation
        {-3.40282346600000016e+38, -std::numeric_limits<float>::max()},
        {-3.4028235e38, -std::numeric_limits<float>::max()},
        {3.4028235e38, std::numeric_limits<float>::max()},
        {-1e34, -1e34F},
        {1e-34, 1e-34F},
        {-9999.99, -9999.99F},
        {-32767.001, -32767.001F},
    };
    for (const auto& c : cases) {
        SampleGrid grid = gridOf<float>(2, {c.stored, 5.0F});
        EXPECT_EQ(grid.applyRule({c.declared}, 0, 1).void_count, 1U) << c.declared;
        EXPECT_TRUE(grid.isVoid(0, 0)) << c.declared;
    }
}

TEST(SampleGrid, FloatNodataOutOfRangeMarksNoFiniteSample)
{
    for (const double declared : {1e300, -1e300, 1.7976931348623157e308, -1.7976931348623157e308}) {
        SampleGrid grid = gridOf<float>(
            3, {5.0F, std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()});
        EXPECT_EQ(grid.applyRule({declared}, 0, 1).void_count, 0U) << declared;
    }
    for (const double declared :
         {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
        SampleGrid grid = gridOf<float>(2, {5.0F, static_cast<float>(declared)});
        EXPECT_EQ(grid.applyRule({declared}, 0, 1).void_count, 1U) << declared;
    }
}

TEST(SampleGrid, NodataAtTheLimitOf64BitsIsTheTypesLimit)
{
    SampleGrid grid = gridOf<std::int64_t>(4, {std::numeric_limits<std::int64_t>::min(),
                                               std::numeric_limits<std::int64_t>::max(), 0, -1});
    EXPECT_EQ(grid.applyRule({-9223372036854775808.0}, 0, 1).void_count, 1U);
    EXPECT_TRUE(grid.isVoid(0, 0));
    // 2^64 does not fit uint64: it must not wrap around to 0.
    SampleGrid wide = gridOf<std::uint64_t>(2, {0, 5});
    EXPECT_EQ(wide.applyRule({36893488147419103232.0}, 0, 1).void_count, 0U);
}

TEST(SampleGrid, RefusesAGridTooLargeForAnyMemory)
{
    const auto grid =
        SampleGrid::create(SampleType::Float64, std::size_t{1} << 24, std::size_t{1} << 24);
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().code, ErrorCode::TooLarge);
    // More bytes than fit a size_t: the product must not wrap around to a small number.
    const auto wrapped =
        SampleGrid::create(SampleType::Float64, std::size_t{1} << 31, std::size_t{1} << 31);
    ASSERT_FALSE(wrapped);
    EXPECT_EQ(wrapped.error().code, ErrorCode::TooLarge);
}

TEST(SampleType, NamesAreThoseOfGdalsTools)
{
    EXPECT_EQ(sampleTypeName(SampleType::UInt8), "Byte");
    EXPECT_EQ(sampleTypeName(SampleType::Int16), "Int16");
    EXPECT_EQ(sampleTypeName(SampleType::UInt64), "UInt64");
    EXPECT_EQ(sampleTypeName(SampleType::Float32), "Float32");
    EXPECT_EQ(sampleBytes(SampleType::Int8), 1U);
    EXPECT_EQ(sampleBytes(SampleType::UInt16), 2U);
    EXPECT_EQ(sampleBytes(SampleType::Float64), 8U);
}

} // namespace
} // namespace marsview
