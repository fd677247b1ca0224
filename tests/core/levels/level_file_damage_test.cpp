// Level files that were cut, overwritten, forged, or built for another map.
#include "core/levels/level_file.h"
#include "core/prepare/level_builder.h"
#include "tests/support/grid_tile_source.h"
#include "tests/support/make_terrain.h"
#include "tests/support/nan.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>
#include <zlib.h>

namespace marsview {
namespace {

LevelFileKey someKey()
{
    return {.raster = {.path = "/maps/mars.tif", .bytes = 1234, .modified_s = 77, .digest = "ab12"},
            .band = 1,
            .nodata = -32768.0};
}

// Large enough for stored levels, with voids in all arrays, yet small: every byte is tested.
Heightfield smallTerrain()
{
    return test::int16Terrain(1030, 3, {}, [](std::size_t c, std::size_t r) {
        return c % 512 == 0 && r == 0 ? kNan : static_cast<double>(c / 8 + r);
    });
}

// Every query of a level file; nullopt if any of them fails.
struct Content {
    std::vector<float> numbers;
    bool operator==(const Content&) const = default;
};

std::optional<Content> contentOf(const std::string& path, std::string* reason = nullptr)
{
    const auto refuse = [&](const Error& error) {
        EXPECT_TRUE(error.code == ErrorCode::Invalid || error.code == ErrorCode::Unreadable);
        EXPECT_EQ(error.message.rfind(path, 0), 0U) << error.message;
        EXPECT_NE(error.message.back(), '.');
        if (reason != nullptr) {
            *reason = error.message;
        }
        return std::nullopt;
    };
    const auto file = LevelFile::open(path, someKey());
    if (!file) {
        return refuse(file.error());
    }
    const auto levels = file->readLevels({});
    if (!levels) {
        return refuse(levels.error());
    }
    Content content;
    const auto add = [&content](double number) {
        content.numbers.push_back(std::isnan(number) ? -12345.0F : static_cast<float>(number));
    };
    const SurfaceAnalysis& analysis = *levels->analysis;
    for (std::size_t level = 0; level < analysis.bounds.levelCount(); ++level) {
        for (std::size_t row = 0; row < analysis.bounds.rows(level); ++row) {
            for (std::size_t c = 0; c < analysis.bounds.columns(level); ++c) {
                add(static_cast<double>(analysis.bounds.bounds(level, c, row).minimum_m));
                add(static_cast<double>(analysis.bounds.bounds(level, c, row).maximum_m));
                add(static_cast<double>(analysis.errors.nodeError({level, c, row})));
            }
        }
    }
    for (std::size_t level = 0; level < analysis.means.levelCount(); ++level) {
        const auto means = analysis.means.means(level);
        for (std::size_t row = 0; row < means.rows(); ++row) {
            for (std::size_t c = 0; c < means.columns(); ++c) {
                add(static_cast<double>(means(c, row)));
                add(static_cast<double>(analysis.means.share(level, c, row)));
            }
        }
    }
    for (const auto& level : levels->filled_maxima_m) {
        for (const float maximum : level) {
            add(static_cast<double>(maximum));
        }
    }
    const TileLayout& layout = levels->layout;
    for (std::uint8_t level = 0; level <= layout.topLevel(); ++level) {
        if (level == 1 || level == 2) {
            continue;
        }
        for (std::uint32_t row = 0; row < layout.tileRows(TileKind::Samples, level); ++row) {
            for (std::uint32_t c = 0; c < layout.tileColumns(TileKind::Samples, level); ++c) {
                const TileId id{.kind = TileKind::Samples, .level = level, .column = c, .row = row};
                const auto fill = file->readFilled(id, {});
                if (!fill) {
                    return refuse(fill.error());
                }
                for (const float height : *fill) {
                    add(static_cast<double>(height));
                }
                if (level == 0) {
                    continue;
                }
                const auto samples = file->readSamples(id);
                if (!samples) {
                    return refuse(samples.error());
                }
                for (std::size_t y = 0; y < samples->rows(); ++y) {
                    for (std::size_t x = 0; x < samples->columns(); ++x) {
                        add(samples->isVoid(x, y) ? kNan : samples->raw(x, y));
                    }
                }
            }
        }
    }
    return content;
}

class LevelFileDamage : public testing::Test {
protected:
    LevelFileDamage()
        : source_(smallTerrain())
    {
        const LevelBuild build{
            .source = &source_, .scale = {}, .key = someKey(), .path = folder_.file("whole")};
        JobMonitor monitor;
        const Status status = buildLevelFile(build, monitor);
        EXPECT_TRUE(status) << status.error().message;
        bytes_ = test::readFile(folder_.file("whole"));
        whole_ = contentOf(folder_.file("whole"));
        EXPECT_TRUE(whole_);
    }

    std::string written(const std::string& bytes) const { return folder_.write("damaged", bytes); }

    // The file with a different header and correct checksums.
    std::string forged(const std::string& json) const
    {
        std::uint64_t header = 0;
        std::memcpy(&header, bytes_.data() + 40, sizeof(header));
        std::string forgery = bytes_.substr(0, header) + json;
        const std::uint64_t size = forgery.size();
        std::memcpy(forgery.data() + 16, &size, sizeof(size));
        const auto sum = [](const char* data, std::size_t count) {
            return static_cast<std::uint32_t>(
                crc32_z(0, reinterpret_cast<const Bytef*>(data), count));
        };
        const std::uint32_t header_sum = sum(json.data(), json.size());
        std::memcpy(forgery.data() + 12, &header_sum, sizeof(header_sum));
        const std::uint32_t front_sum = sum(forgery.data(), 60);
        std::memcpy(forgery.data() + 60, &front_sum, sizeof(front_sum));
        return written(forgery);
    }
    nlohmann::json header() const
    {
        std::uint64_t offset = 0;
        std::memcpy(&offset, bytes_.data() + 40, sizeof(offset));
        return nlohmann::json::parse(bytes_.substr(offset));
    }

    test::TempFolder folder_;
    test::GridTileSource source_;
    std::string bytes_;
    std::optional<Content> whole_;
};

TEST_F(LevelFileDamage, IsDetectedInEveryByte)
{
    ASSERT_LT(bytes_.size(), 20'000U) << "too large to try every byte";
    for (std::size_t i = 0; i < bytes_.size(); ++i) {
        std::string damaged = bytes_;
        damaged[i] = static_cast<char>(damaged[i] ^ (i % 2 == 0 ? '\xFF' : '\x01'));
        ASSERT_FALSE(contentOf(written(damaged))) << "byte " << i << " of " << bytes_.size();
    }
}

TEST_F(LevelFileDamage, IsDetectedAtEveryTruncation)
{
    for (std::size_t size = 0; size < bytes_.size(); ++size) {
        ASSERT_FALSE(LevelFile::open(written(bytes_.substr(0, size)), someKey())) << size;
    }
    EXPECT_FALSE(LevelFile::open(written(bytes_ + '\0'), someKey()));
    EXPECT_FALSE(LevelFile::open(written(bytes_ + bytes_), someKey()));
    EXPECT_TRUE(LevelFile::open(written(bytes_), someKey()));
}

TEST_F(LevelFileDamage, IsDetectedInSwappedAndZeroedBlocks)
{
    test::Random random;
    for (int i = 0; i < 300; ++i) {
        std::string damaged = bytes_;
        const std::size_t count = 1 + random.below(64);
        const std::size_t a = random.below(bytes_.size() - count);
        const std::size_t b = random.below(bytes_.size() - count);
        if (i % 2 == 0) {
            damaged.replace(a, count, count, '\0');
        } else {
            damaged.replace(a, count, bytes_.substr(b, count));
        }
        if (damaged != bytes_) {
            ASSERT_FALSE(contentOf(written(damaged))) << a << ", " << b << ", " << count;
        }
    }
}

TEST_F(LevelFileDamage, HeadersThatDeclareMoreThanTheFileHoldsAreRefused)
{
    EXPECT_EQ(contentOf(forged(header().dump())), whole_) << "forging works";
    const std::vector<std::pair<std::string, nlohmann::json>> changes{
        {"/layout/columns", 2147483648U},
        {"/layout/columns", 4294967297U},
        {"/layout/columns", 1},
        {"/layout/columns", -5},
        {"/layout/columns", 1e300},
        {"/layout/columns", "many"},
        {"/layout/rows", 2147483648U},
        {"/layout/rows", 0},
        {"/layout/type", "Float64"},
        {"/layout/type", "Complex"},
        {"/layout", nullptr},
        {"/statistics/void_count", 0},
        {"/statistics/void_count", 1e18},
        {"/block_samples", 0},
        {"/block_samples", 24},
        {"/block_samples", 16},
        {"/fill_tiles", 0},
        {"/fill_tiles", 5},
        {"/fill_tiles", 1000000000000U},
        {"/coarse_tiles", 7},
        {"/planes", nlohmann::json::array()},
        {"/planes/0/name", "means"},
        {"/planes/0/chunks", nlohmann::json::array()},
        {"/planes/0/chunks/0/0", bytes_.size() - 1},
        {"/planes/0/chunks/0/0", 0},
        {"/planes/0/chunks/0/1", 0},
        {"/planes/0/chunks/0/1", 18446744073709551615U},
        {"/planes/0/chunks/0/2", 4294967296U},
        {"/scale/gain", "nan"},
        {"/scale/gain", 0.0},
        {"/raster", 5},
        {"/nodata", "something"}};
    for (const auto& [pointer, value] : changes) {
        nlohmann::json changed = header();
        changed[nlohmann::json::json_pointer(pointer)] = value;
        std::string reason;
        EXPECT_FALSE(contentOf(forged(changed.dump()), &reason)) << pointer << " " << value;
    }
    for (const char* text : {"", "{}", "[]", "null", "{\"raster\":", "\xFF\xFE", "1e999"}) {
        EXPECT_FALSE(contentOf(forged(text))) << text;
    }
    EXPECT_FALSE(contentOf(forged(std::string(100'000, '['))));
}

// Whatever the header contains: a result or an error, and no crash.
TEST_F(LevelFileDamage, RandomHeadersDoNoHarm)
{
    test::Random random;
    const nlohmann::json flat = header().flatten();
    const std::vector<nlohmann::json> values{
        0,       1,    -1, 2,     3,      255,  65536, 1e300,      -0.5,
        nullptr, true, "", "inf", "Int8", 1030, 1.5e9, 1ULL << 63, nlohmann::json::array(),
        77};
    for (int i = 0; i < 500; ++i) {
        nlohmann::json changed = flat;
        for (std::size_t count = 1 + random.below(3); count > 0; --count) {
            auto at = changed.begin();
            std::advance(at, static_cast<std::ptrdiff_t>(random.below(changed.size())));
            *at = values[random.below(values.size())];
        }
        nlohmann::json root;
        for (const auto& [pointer, value] : changed.items()) {
            root[nlohmann::json::json_pointer(pointer)] = value;
        }
        contentOf(forged(root.dump()));
    }
}

TEST_F(LevelFileDamage, IsDistinguishedFromOtherVersionsAndOtherFiles)
{
    std::string other = bytes_;
    other[8] = 3;
    const auto version = LevelFile::open(written(other), someKey());
    ASSERT_FALSE(version);
    EXPECT_NE(version.error().message.find("is of version 3"), std::string::npos);
    const auto text = LevelFile::open(written(std::string(1000, 'x')), someKey());
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().code, ErrorCode::Invalid);
    EXPECT_NE(text.error().message.find("is not a level file"), std::string::npos);
    const auto missing = LevelFile::open(folder_.file("missing"), someKey());
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::NotFound);
    EXPECT_FALSE(LevelFile::open(folder_.path().string(), someKey())) << "a folder";
}

TEST_F(LevelFileDamage, FilesOfAnotherRasterAreNotUsed)
{
    const auto expect_refused = [&](const LevelFileKey& key, ErrorCode code = ErrorCode::Invalid) {
        const auto file = LevelFile::open(folder_.file("whole"), key);
        ASSERT_FALSE(file);
        EXPECT_EQ(file.error().code, code);
    };
    LevelFileKey key = someKey();
    key.raster.path = "/elsewhere/mars.tif";
    EXPECT_TRUE(LevelFile::open(folder_.file("whole"), key)) << "files move together";
    key = someKey();
    key.raster.bytes = 1235;
    expect_refused(key);
    key = someKey();
    key.raster.digest = "ab13";
    expect_refused(key, ErrorCode::Damaged); // its time claims that it has not changed
    ++key.raster.modified_s;
    expect_refused(key);
    key = someKey();
    key.band = 2;
    expect_refused(key);
    for (const std::optional<double> nodata : {std::optional<double>{}, {0.0}, {kNan}}) {
        key = someKey();
        key.nodata = nodata;
        expect_refused(key);
    }
}

} // namespace
} // namespace marsview
