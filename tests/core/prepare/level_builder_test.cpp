// Building level files when errors occur.
#include "core/levels/level_file.h"
#include "core/prepare/level_builder.h"
#include "tests/support/grid_tile_source.h"
#include "tests/support/make_terrain.h"
#include "tests/support/nan.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#ifdef __unix__
#include <sys/resource.h>
#endif

namespace marsview {
namespace {

Heightfield someTerrain(double void_share = 0.05)
{
    test::Random random;
    const auto heights = test::fractalHeights(random, 2500, 1100, 900.0, 0.6);
    return test::int16Terrain(2500, 1100, {}, [&](std::size_t c, std::size_t r) {
        return random.chance(void_share) ? kNan : heights[r * 2500 + c];
    });
}

class LevelBuilder : public testing::Test {
protected:
    Status build(TileSource& source, JobMonitor& monitor) const
    {
        const LevelBuild build{.source = &source,
                               .scale = {},
                               .key = {},
                               .path = path(),
                               .mean_blocks_max = 2000}; // so that some of them are moved to disk
        return buildLevelFile(build, monitor);
    }
    Status build(TileSource& source) const
    {
        JobMonitor monitor;
        return build(source, monitor);
    }

    std::string path() const { return folder_.file("map.marsview"); }
    std::size_t fileCount() const
    {
        std::size_t count = 0;
        for ([[maybe_unused]] const auto& entry :
             std::filesystem::directory_iterator(folder_.path())) {
            ++count;
        }
        return count;
    }

    test::TempFolder folder_;
};

TEST_F(LevelBuilder, ReadsEveryTileTwice)
{
    test::GridTileSource source(someTerrain());
    ASSERT_TRUE(build(source));
    EXPECT_EQ(source.readCount(), 2U * 10 * 5);
    EXPECT_EQ(fileCount(), 1U);
}

TEST_F(LevelBuilder, WritesTheSameBytesOnAnyNumberOfThreads)
{
    const auto built = [this](std::size_t memory_bytes_max) {
        test::GridTileSource source(someTerrain());
        JobMonitor monitor;
        EXPECT_TRUE(buildLevelFile({.source = &source,
                                    .scale = {},
                                    .key = {},
                                    .path = path(),
                                    .memory_bytes_max = memory_bytes_max,
                                    .mean_blocks_max = 2000},
                                   monitor));
        return test::readFile(path());
    };
    const std::string alone = built(1);
    for (int i = 0; i < 5; ++i) {
        EXPECT_TRUE(built(std::size_t{1} << 30) == alone);
    }
}

TEST_F(LevelBuilder, StopsSoonWhenCanceledAndLeavesNoFiles)
{
    for (const std::uint64_t after : {0U, 1U, 30U, 52U, 99U}) {
        JobMonitor monitor;
        std::atomic<std::uint64_t> reads{0};
        test::GridTileSource source(someTerrain(),
                                    {.before_read = [&](const TileId&) -> std::optional<Error> {
                                        if (++reads > after) {
                                            monitor.cancel();
                                        }
                                        return std::nullopt;
                                    }});
        const Status status = build(source, monitor);
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().code, ErrorCode::Canceled);
        EXPECT_EQ(fileCount(), 0U);
        // No thread reads past its current tile.
        EXPECT_LE(source.readCount(), after + 1 + std::thread::hardware_concurrency());
    }
}

TEST_F(LevelBuilder, ReportsATilesErrorAndKeepsTheExistingFile)
{
    folder_.write("map.marsview", "of yesterday");
    for (const int which : {1, 2}) { // the first readings succeed
        std::mutex mutex;
        int reads = 0;
        test::GridTileSource source(
            someTerrain(), {.before_read = [&](const TileId& id) -> std::optional<Error> {
                const std::lock_guard lock(mutex);
                if (id.column == 3 && id.row == 2 && ++reads == which) {
                    return Error{ErrorCode::Unreadable, "/maps/m.tif: the tape is torn"};
                }
                return std::nullopt;
            }});
        const Status status = build(source);
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().code, ErrorCode::Unreadable);
        EXPECT_EQ(status.error().message, "/maps/m.tif: the tape is torn");
        EXPECT_EQ(fileCount(), 1U);
        EXPECT_EQ(test::readFile(path()), "of yesterday");
    }
}

TEST_F(LevelBuilder, ReportsTheErrorOfOpening)
{
    test::GridTileSource source(someTerrain(), {.before_open = []() -> std::optional<Error> {
                                    return Error{ErrorCode::NotFound, "/maps/m.tif: is gone"};
                                }});
    const Status status = build(source);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message, "/maps/m.tif: is gone");
    EXPECT_EQ(fileCount(), 0U);
}

/// Another map from the second reading of a tile on.
class ChangingSource final : public TileSource {
public:
    ChangingSource(const Heightfield& before, const Heightfield& after)
        : before_(before)
        , after_(after)
    {}

    const TileLayout& layout() const noexcept override { return before_.layout(); }
    const std::string& name() const noexcept override { return before_.name(); }
    Result<std::unique_ptr<TileReader>> open() const override
    {
        return std::unique_ptr<TileReader>(std::make_unique<Reader>(*this));
    }

private:
    class Reader final : public TileReader {
    public:
        explicit Reader(const ChangingSource& source)
            : source_(source)
        {}
        Result<Tile> read(const TileId& id) override
        {
            const std::lock_guard lock(source_.mutex_);
            const bool is_again = source_.reads_[{id.column, id.row}]++ > 0;
            return (is_again ? source_.after_ : source_.before_).tile(id);
        }

    private:
        const ChangingSource& source_;
    };

    test::GridTileSource before_;
    test::GridTileSource after_;
    mutable std::mutex mutex_;
    mutable std::map<std::pair<std::uint32_t, std::uint32_t>, int> reads_;
};

TEST_F(LevelBuilder, RefusesASourceThatChanges)
{
    ChangingSource source(someTerrain(0.05), someTerrain(0.01));
    const Status status = build(source);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::Invalid);
    EXPECT_NE(status.error().message.find("changed while it was read"), std::string::npos);
    EXPECT_EQ(fileCount(), 0U);
}

TEST_F(LevelBuilder, OverwritesFilesLeftByAKilledProgram)
{
    folder_.write("map.marsview.part", std::string(10'000'000, 'x'));
    test::GridTileSource source(someTerrain());
    ASSERT_TRUE(build(source));
    EXPECT_EQ(fileCount(), 1U);
    EXPECT_LT(std::filesystem::file_size(path()), 10'000'000U);
    EXPECT_TRUE(LevelFile::open(path(), {}));
}

TEST_F(LevelBuilder, DoesNotTouchAFileThatAnotherProgramIsWriting)
{
    std::atomic<bool> has_tried{false};
    test::GridTileSource other(someTerrain());
    test::GridTileSource source(
        someTerrain(), {.before_read = [&](const TileId&) -> std::optional<Error> {
            if (!has_tried.exchange(true)) {
                const Status status = build(other);
                EXPECT_FALSE(status);
                EXPECT_NE(status.error().message.find("another program"), std::string::npos);
            }
            return std::nullopt;
        }});
    ASSERT_TRUE(build(source));
    EXPECT_TRUE(LevelFile::open(path(), {}));
}

TEST_F(LevelBuilder, PublishesNothingWithoutConfirmation)
{
    folder_.write("map.marsview", "of yesterday");
    test::GridTileSource source(someTerrain());
    const LevelBuild build{
        .source = &source, .scale = {}, .key = {}, .path = path(), .confirm = [this]() -> Status {
            EXPECT_EQ(test::readFile(path()), "of yesterday");
            return Error{ErrorCode::Invalid, "/maps/m.tif: changed"};
        }};
    JobMonitor monitor;
    const Status status = buildLevelFile(build, monitor);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message, "/maps/m.tif: changed");
    EXPECT_EQ(test::readFile(path()), "of yesterday");
    EXPECT_EQ(fileCount(), 1U);
}

// As after a power failure: the checkpoint exists, but the data it depends on does not.
TEST_F(LevelBuilder, RestartsIfTheDataOfACheckpointIsDamaged)
{
    const auto job = [this](const TileSource& source) {
        return LevelBuild{.source = &source,
                          .scale = {},
                          .key = {},
                          .path = path(),
                          .mean_blocks_max = 2000,
                          .checkpoint_interval = std::chrono::milliseconds(0)};
    };
    test::GridTileSource source(someTerrain());
    JobMonitor monitor;
    ASSERT_TRUE(buildLevelFile(job(source), monitor));
    // The order of the tiles in the file depends on the threads.
    const auto content = [this] {
        std::vector<float> numbers;
        const LevelFile file = LevelFile::open(path(), {}).value();
        const MapLevels levels = file.readLevels({}).value();
        for (const std::vector<float>& maxima : levels.filled_maxima_m) {
            numbers.insert(numbers.end(), maxima.begin(), maxima.end());
        }
        for (std::uint32_t row = 0; row < 5; ++row) {
            for (std::uint32_t column = 0; column < 10; ++column) {
                const TileId id{TileKind::Samples, 0, column, row};
                const std::vector<float> filled = file.readFilled(id, {}).value();
                numbers.insert(numbers.end(), filled.begin(), filled.end());
            }
        }
        return numbers;
    };
    const std::vector<float> expected = content();
    std::filesystem::remove(path());
    const auto cut = [](const std::string& file) {
        std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    };
    const auto overwrite = [](const std::string& file) {
        std::string bytes = test::readFile(file);
        bytes[bytes.size() / 3] = static_cast<char>(bytes[bytes.size() / 3] ^ 0x10);
        std::ofstream(file, std::ios::binary) << bytes;
    };
    const auto leave = [](const std::string&) {};
    using Damage = std::function<void(const std::string&)>;
    for (const char* ending : {".part", ".part.means", ".part.checkpoint"}) {
        for (const Damage& damage : {Damage(cut), Damage(overwrite), Damage(leave)}) {
            for (const int last_row : {2, 4}) { // of the second reading
                std::atomic<int> reads{0};
                test::GridTileSource torn(
                    someTerrain(), {.before_read = [&](const TileId& id) -> std::optional<Error> {
                        if (id.row == static_cast<std::uint32_t>(last_row) && ++reads > 10) {
                            return Error{ErrorCode::Unreadable, "the tape is torn"};
                        }
                        return std::nullopt;
                    }});
                ASSERT_FALSE(buildLevelFile(job(torn), monitor));
                ASSERT_EQ(fileCount(), 3U);
                damage(path() + ending);
                const std::uint64_t reads_before = source.readCount();
                const Status again = buildLevelFile(job(source), monitor);
                ASSERT_TRUE(again) << ending << ": " << again.error().message;
                EXPECT_TRUE(content() == expected) << ending;
                EXPECT_TRUE(LevelFile::open(path(), {})->check(monitor));
                EXPECT_EQ(source.readCount() - reads_before < 100,
                          damage.target_type() == Damage(leave).target_type())
                    << ending;
                EXPECT_EQ(fileCount(), 1U);
                std::filesystem::remove(path());
            }
        }
    }
}

TEST_F(LevelBuilder, NamesTheFolderThatItCannotWriteTo)
{
    test::GridTileSource source(someTerrain());
    const LevelBuild build{
        .source = &source, .scale = {}, .key = {}, .path = folder_.file("no/such/folder/map")};
    JobMonitor monitor;
    const Status status = buildLevelFile(build, monitor);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message.rfind(build.path + ".part: cannot be written", 0), 0U)
        << status.error().message;
    EXPECT_EQ(source.readCount(), 0U);
}

#ifdef __unix__
TEST_F(LevelBuilder, LeavesNoFilesOnAFullDisk)
{
    test::GridTileSource source(someTerrain());
    ASSERT_TRUE(build(source));
    const std::uintmax_t size = std::filesystem::file_size(path());
    std::filesystem::remove(path());
    // A limit on the file size fails in the same way as a full disk.
    auto* const before = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
    for (const std::uintmax_t bytes : {std::uintmax_t{0}, size / 3, size * 9 / 10}) {
        rlimit small = limit;
        small.rlim_cur = static_cast<rlim_t>(bytes);
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
        const Status status = build(source);
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
        ASSERT_FALSE(status) << bytes << " of " << size;
        EXPECT_NE(status.error().message.find("cannot be"), std::string::npos);
        EXPECT_EQ(fileCount(), 0U);
    }
    std::signal(SIGXFSZ, before);
}
#endif

} // namespace
} // namespace marsview
