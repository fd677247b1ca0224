#include "app/bench/reference/fractal_heights.h"
#include "core/files/raster_path.h"
#include "core/files/remote_raster.h"
#include "core/raster/raster_file.h"
#include "core/tiles/geotiff_tile_source.h"
#include "tests/support/http_server.h"
#include "tests/support/make_raster.h"
#include "tests/support/random.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using test::HttpCounts;
using test::HttpServer;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::size_t kSide = 2048;

// Labels that are looked for next to a TIFF, with a request each, and not found.
constexpr std::uint64_t kLabelNames = 2;

std::vector<std::int16_t> mapSamples(std::uint64_t seed)
{
    const std::vector<float> heights = fractalHeights(kSide, kSide, seed);
    std::vector<std::int16_t> samples(heights.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<std::int16_t>(std::lround(heights[i] * 10.0F));
    }
    return samples;
}

bool isSame(const SampleGrid& a, const SampleGrid& b)
{
    if (a.type() != b.type() || a.columns() != b.columns() || a.rows() != b.rows()) {
        return false;
    }
    for (std::size_t row = 0; row < a.rows(); ++row) {
        for (std::size_t column = 0; column < a.columns(); ++column) {
            if (a.raw(column, row) != b.raw(column, row) ||
                a.isVoid(column, row) != b.isVoid(column, row)) {
                return false;
            }
        }
    }
    return true;
}

class RemoteRasterTest : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        originals_ = new test::TempFolder;
        const std::vector<std::string> options{
            "-co", "COMPRESS=DEFLATE", "-co", "PREDICTOR=YES",
            "-co", "BLOCKSIZE=256",    "-co", "RESAMPLING=AVERAGE"};
        for (const std::uint64_t seed : {7U, 8U}) {
            const test::RasterRecipe recipe = test::recipeFor(kSide, mapSamples(seed));
            const std::string name = seed == 7 ? "map" : "other";
            test::writeRaster(*originals_, name + ".tif", "COG", recipe, options);
            if (seed == 7) {
                test::writeRaster(*originals_, "strips.tif", "GTiff", recipe);
                test::writeRaster(*originals_, "no_overviews.tif", "GTiff", recipe,
                                  {"-co", "TILED=YES"});
            }
        }
    }
    static void TearDownTestSuite() { delete std::exchange(originals_, nullptr); }

    RemoteRasterTest() { fs::copy_file(original("map.tif"), folder_.file("map.tif")); }

    static std::string original(const std::string& name) { return originals_->file(name); }

    RasterFile opened(const std::string& path)
    {
        Result<RasterFile> file = RasterFile::open(path);
        EXPECT_TRUE(file) << (file ? "" : file.error().message);
        return std::move(file).value();
    }
    // The samples on disk.
    static SampleGrid truth(const std::string& path, const GridWindow& window)
    {
        return std::move(RasterFile::open(path)->readWindow(window, {})->grid);
    }
    // Replaces the map by `name`, as when a new edition is published.
    void publish(const std::string& name)
    {
        const std::string fresh = folder_.file("fresh.tif");
        fs::copy_file(original(name), fresh);
        // With a time that differs by seconds, servers with second resolution distinguish the
        // editions.
        fs::last_write_time(fresh,
                            fs::last_write_time(folder_.file("map.tif")) + std::chrono::seconds(5));
        fs::rename(fresh, folder_.file("map.tif"));
    }
    static GridWindow tileAt(std::size_t column, std::size_t row)
    {
        return {column * kTileSide, row * kTileSide, kTileSide, kTileSide};
    }

    test::TempFolder folder_;
    HttpServer server_{folder_.path()};

private:
    static test::TempFolder* originals_;
};

test::TempFolder* RemoteRasterTest::originals_ = nullptr;

TEST(RemoteName, ConvertsEveryAddressAndBack)
{
    const std::vector<std::pair<std::string, std::string>> table{
        {"https://example.org/a/map.tif", "/vsicurl/https://example.org/a/map.tif"},
        {"http://127.0.0.1:80/map.tif?key=1", "/vsicurl/http://127.0.0.1:80/map.tif?key=1"},
        {"s3://bucket/a/map.tif", "/vsis3/bucket/a/map.tif"},
        {"gs://bucket/map.tif", "/vsigs/bucket/map.tif"},
    };
    for (const auto& [address, name] : table) {
        EXPECT_EQ(remoteNameFor(address), name);
        EXPECT_EQ(remoteNameFor(name), name);
        EXPECT_EQ(addressOf(name), address);
        EXPECT_EQ(rasterNamesFor(address).value(), std::vector<std::string>{name});
    }
    EXPECT_EQ(remoteNameFor("HTTPS://example.org/x.tif"), "/vsicurl/HTTPS://example.org/x.tif");
}

TEST(RemoteName, IsEmptyForFilesAndOtherNames)
{
    for (const char* path : {"map.tif", "/data/http/map.tif", "NETCDF:map.nc:z", "/vsizip/a.zip",
                             "https:/one/slash", ""}) {
        EXPECT_EQ(remoteNameFor(path), std::nullopt) << path;
    }
}

TEST_F(RemoteRasterTest, OpeningAndReadingATileTransferAFractionOfTheFile)
{
    RasterFile file = opened(server_.url("map.tif"));
    const HttpCounts at_open = server_.counts();
    const auto tile = file.readWindow(tileAt(3, 4), {});
    ASSERT_TRUE(tile) << tile.error().message;
    EXPECT_TRUE(isSame(tile->grid, truth(original("map.tif"), tileAt(3, 4))));
    const HttpCounts counts = server_.counts();
    const std::uintmax_t bytes = fs::file_size(original("map.tif"));
    std::cout << "open: " << at_open.requests << " requests, " << at_open.body_bytes
              << " bytes; with one tile: " << counts.requests << " requests, " << counts.body_bytes
              << " of " << bytes << " bytes\n";
    EXPECT_LE(at_open.requests, 2U + kLabelNames);
    EXPECT_LE(at_open.body_bytes, bytes / 100);
    EXPECT_LE(counts.requests, 3U + kLabelNames);
    EXPECT_LE(counts.body_bytes, bytes * 3 / 100);
}

TEST_F(RemoteRasterTest, DescriptionMatchesTheLocalFile)
{
    const RasterFile remote = opened(server_.url("map.tif"));
    const RasterFile local = opened(original("map.tif"));
    EXPECT_EQ(remote.info().columns, local.info().columns);
    EXPECT_EQ(remote.info().type, local.info().type);
    EXPECT_EQ(remote.info().transform->terms(), local.info().transform->terms());
    EXPECT_EQ(remote.info().notices, local.info().notices);
    EXPECT_EQ(remote.overviewCount(), local.overviewCount());
    EXPECT_NE(remote.info().remote_version, "");
    EXPECT_EQ(local.info().remote_version, "");
}

TEST_F(RemoteRasterTest, RequestsNoCompanionFilesExceptLabels)
{
    for (int i = 0; i < 3; ++i) {
        opened(server_.url("map.tif"));
    }
    std::vector<std::string> others;
    for (const test::HttpRequest& request : server_.requests()) {
        if (request.target != "/map.tif") {
            others.push_back(request.method + " " + request.target);
        }
    }
    EXPECT_THAT(others, testing::ElementsAre("HEAD /map.lbl", "HEAD /map.xml"));
}

// As on disk, where tests/core/raster/label_elevation_test.cpp compares them with their text.
TEST_F(RemoteRasterTest, TheLabelNextToTheFileIsApplied)
{
    test::RasterRecipe recipe = test::recipeFor(4, std::vector<std::int16_t>(16, 100));
    recipe.transform.reset();
    const std::string image =
        " OBJECT = IMAGE\n  LINES = 4\n  LINE_SAMPLES = 4\n"
        "  SAMPLE_TYPE = LSB_INTEGER\n  SAMPLE_BITS = 16\n"
        "  SCALING_FACTOR = 0.5\n  OFFSET = -7\n  UNIT = METER\n"
        " END_OBJECT = IMAGE\nEND\n";
    const auto label_of = [&image](const std::string& data) {
        return "PDS_VERSION_ID = PDS3\n^IMAGE = \"" + data + "\"\n" + image;
    };
    for (const auto& [data, label, format] : std::vector<std::array<const char*, 3>>{
             {"raw.tif", "raw.lbl", "GTiff"},
             {"CASE.TIF", "CASE.LBL", "GTiff"},
             {"code.jp2", "code.lbl", "JP2OpenJPEG"},
             {"twin.jp2", "twin_jp2.lbl", "JP2OpenJPEG"},
         }) {
        SCOPED_TRACE(data);
        test::writeRaster(
            folder_, data, format, recipe,
            std::string(format) == "GTiff"
                ? std::vector<std::string>{}
                : std::vector<std::string>{"-co", "QUALITY=100", "-co", "REVERSIBLE=YES"});
        folder_.write(label, label_of(data));
        RasterFile file = opened(server_.url(data));
        EXPECT_EQ(file.info().elevationScale().height(100.0), 43.0);
        EXPECT_TRUE(file.info().is_unit_declared);
        EXPECT_THAT(file.info().notices,
                    testing::Contains(HasSubstr(std::string("from the label ") + label)));
        const auto samples = file.readWindow({0, 0, 4, 4}, {});
        ASSERT_TRUE(samples) << samples.error().message;
        EXPECT_EQ(samples->grid.raw(3, 3), 100.0);
    }
}

TEST_F(RemoteRasterTest, HighLatencyOnlySlowsReading)
{
    server_.setLatency(std::chrono::milliseconds(50));
    server_.setBandwidth(std::size_t{2} << 20);
    RasterFile file = opened(server_.url("map.tif"));
    const auto tile = file.readWindow(tileAt(1, 6), {});
    ASSERT_TRUE(tile) << tile.error().message;
    EXPECT_TRUE(isSame(tile->grid, truth(original("map.tif"), tileAt(1, 6))));
}

TEST_F(RemoteRasterTest, RetriesAfterServerErrors)
{
    RasterFile file = opened(server_.url("map.tif"));
    for (const int status : {503, 500, 429}) {
        server_.resetCounts();
        server_.failNext(1, status);
        const GridWindow window = tileAt(2, static_cast<std::size_t>(status % 7));
        const auto tile = file.readWindow(window, {});
        ASSERT_TRUE(tile) << tile.error().message;
        EXPECT_TRUE(isSame(tile->grid, truth(original("map.tif"), window)));
        EXPECT_EQ(server_.counts().failures, 1U) << status;
    }
}

TEST_F(RemoteRasterTest, RetriesWhenAConnectionIsLostDuringOpening)
{
    // GDAL caches its knowledge of a file, so every attempt uses a different file.
    for (const std::size_t body_bytes : {0U, 100U, 5000U}) {
        const std::string name = "cut_" + std::to_string(body_bytes) + ".tif";
        std::filesystem::copy_file(folder_.file("map.tif"), folder_.file(name));
        server_.cutNext(1, body_bytes);
        const Result<RasterFile> file = RasterFile::open(server_.url(name), 1);
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_EQ(file->info().columns, kSide);
        EXPECT_EQ(server_.counts().failures, 1U + kLabelNames);
        server_.resetCounts();
    }
}

TEST_F(RemoteRasterTest, LostConnectionsNeverYieldAPartialTile)
{
    RasterFile file = opened(server_.url("map.tif"));
    test::Random random;
    std::size_t failed = 0;
    for (int i = 0; i < 60; ++i) {
        const GridWindow window{random.below(kSide - 400), random.below(kSide - 400),
                                1 + random.below(400), 1 + random.below(400)};
        const SampleGrid right = truth(original("map.tif"), window);
        server_.cutNext(1, random.below(40'000));
        auto read = file.readWindow(window, {});
        server_.cutNext(0, 0);
        if (!read) {
            ++failed;
            EXPECT_THAT(read.error().message, StartsWith(server_.url("map.tif") + ": reading"));
            EXPECT_EQ(read.error().code, ErrorCode::Unreadable);
            read = file.readWindow(window, {});
            ASSERT_TRUE(read) << read.error().message;
        }
        ASSERT_TRUE(isSame(read->grid, right)) << "window " << i;
    }
    std::cout << failed << " of 60 reads failed\n";
    EXPECT_GT(failed, 10U);
}

TEST_F(RemoteRasterTest, RequestsATileTwiceMoreAfterTruncatedResponses)
{
    const RasterFile file = opened(server_.url("map.tif"));
    const auto source = GeotiffTileSource::of(file, {});
    ASSERT_TRUE(source) << source.error().message;
    const auto reader = (*source)->open();
    ASSERT_TRUE(reader) << reader.error().message;
    // The first cut hits the request for the tile, the second one the request that reopens the
    // file.
    for (std::size_t cuts = 1; cuts <= 2; ++cuts) {
        for (std::uint32_t column = 1; column < 4; ++column) {
            const TileId id{.kind = TileKind::Samples,
                            .level = 0,
                            .column = column,
                            .row = static_cast<std::uint32_t>(2 * cuts)};
            server_.resetCounts();
            server_.cutNext(cuts, 1000 * column);
            const Result<Tile> tile = (*reader)->read(id);
            EXPECT_EQ(server_.counts().failures, cuts);
            ASSERT_TRUE(tile) << tile.error().message;
            EXPECT_TRUE(isSame(tile->samples, truth(original("map.tif"), tileAt(column, id.row))));
        }
    }
    server_.cutNext(100, 500);
    const TileId id{.kind = TileKind::Samples, .level = 0, .column = 5, .row = 6};
    const Result<Tile> failed = (*reader)->read(id);
    server_.cutNext(0, 0);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code, ErrorCode::Unreadable);
    EXPECT_THAT(failed.error().message, HasSubstr("the connection was lost"));
    const Result<Tile> tile = (*reader)->read(id);
    ASSERT_TRUE(tile) << tile.error().message;
    EXPECT_TRUE(isSame(tile->samples, truth(original("map.tif"), tileAt(5, 6))));
}

TEST_F(RemoteRasterTest, DetectsAChangedFileAndNeverMixesVersions)
{
    for (const auto validators :
         {test::HttpValidators::EtagAndTime, test::HttpValidators::TimeOnly}) {
        server_.setValidators(validators);
        RasterFile file = opened(server_.url("map.tif"));
        ASSERT_TRUE(file.readWindow(tileAt(0, 0), {}));
        publish("other.tif");
        bool is_noticed = false;
        for (std::size_t row = 0; row < kSide / kTileSide; ++row) {
            const auto tile = file.readWindow(tileAt(5, row), {});
            if (tile) { // read before the change
                EXPECT_TRUE(isSame(tile->grid, truth(original("map.tif"), tileAt(5, row))));
            } else {
                EXPECT_EQ(tile.error().message,
                          server_.url("map.tif") +
                              ": has changed at the server since it was opened; open it again");
                is_noticed = true;
            }
        }
        EXPECT_TRUE(is_noticed);
        RasterFile again = opened(server_.url("map.tif"));
        for (std::size_t row = 0; row < kSide / kTileSide; ++row) {
            const auto tile = again.readWindow(tileAt(5, row), {});
            ASSERT_TRUE(tile) << tile.error().message;
            EXPECT_TRUE(isSame(tile->grid, truth(original("other.tif"), tileAt(5, row))));
        }
        publish("map.tif");
    }
}

TEST_F(RemoteRasterTest, ErrorsNameTheCause)
{
    const auto message = [&](const std::string& address) {
        const auto file = RasterFile::open(address);
        return file ? "" : file.error().message;
    };
    EXPECT_EQ(message(server_.url("absent.tif")),
              server_.url("absent.tif") +
                  ": nothing was found at this address (404); check its spelling");
    folder_.write("text.tif", std::string(5000, 'x'));
    EXPECT_EQ(message(server_.url("text.tif")),
              server_.url("text.tif") +
                  ": is not a raster that GDAL can read, or the connection was lost");
    for (const auto& [status, says] : {std::pair{404, "nothing was found at this address (404)"},
                                       std::pair{410, "nothing was found at this address (410)"},
                                       std::pair{401, "the server denies access (401)"},
                                       std::pair{403, "the server denies access (403)"},
                                       std::pair{500, "the server reports an error (500)"},
                                       std::pair{503, "the server reports an error (503)"}}) {
        server_.failNext(100, status);
        EXPECT_THAT(message(server_.url("map.tif")),
                    StartsWith(server_.url("map.tif") + ": " + says));
        server_.failNext(0, 0);
    }
    server_.refuse();
    EXPECT_THAT(message(server_.url("map.tif")),
                StartsWith(server_.url("map.tif") + ": the server does not respond; check the "
                                                    "address and the network (Failed to connect"));
    server_.accept();
    EXPECT_EQ(message(server_.url("map.tif")), "");
}

TEST_F(RemoteRasterTest, ReadsBucketsByTheirAddress)
{
    fs::create_directory(folder_.path() / "bucket");
    fs::rename(folder_.file("map.tif"), folder_.file("bucket/map.tif"));
    const std::string endpoint = "127.0.0.1:" + std::to_string(server_.port());
    for (const auto& [name, value] :
         {std::pair<const char*, std::string>{"AWS_S3_ENDPOINT", endpoint},
          {"AWS_HTTPS", "NO"},
          {"AWS_VIRTUAL_HOSTING", "FALSE"},
          {"AWS_NO_SIGN_REQUEST", "YES"}}) {
        setenv(name, value.c_str(), 1); // NOLINT(concurrency-mt-unsafe): not read now
    }
    RasterFile file = opened("s3://bucket/map.tif");
    const auto tile = file.readWindow(tileAt(3, 2), {});
    ASSERT_TRUE(tile) << tile.error().message;
    EXPECT_TRUE(isSame(tile->grid, truth(original("map.tif"), tileAt(3, 2))));
    const auto absent = RasterFile::open("s3://bucket/absent.tif");
    ASSERT_FALSE(absent);
    EXPECT_EQ(absent.error().code, ErrorCode::NotFound);
    EXPECT_THAT(absent.error().message, StartsWith("s3://bucket/absent.tif: nothing was found at"));
}

TEST_F(RemoteRasterTest, ContinuesReadingAfterAServerOutage)
{
    RasterFile file = opened(server_.url("map.tif"));
    server_.refuse();
    const auto failed = file.readWindow(tileAt(6, 6), {});
    ASSERT_FALSE(failed);
    EXPECT_THAT(failed.error().message, HasSubstr("the server does not respond"));
    server_.accept();
    const auto tile = file.readWindow(tileAt(6, 6), {});
    ASSERT_TRUE(tile) << tile.error().message;
    EXPECT_TRUE(isSame(tile->grid, truth(original("map.tif"), tileAt(6, 6))));
}

TEST_F(RemoteRasterTest, RefusesServersWithoutRangeRequests)
{
    RasterFile file = opened(server_.url("map.tif"));
    server_.setRanges(test::HttpRanges::Ignored);
    // otherwise the file fits into socket buffers before they are closed
    server_.setBandwidth(4'000'000);
    const auto tile = file.readWindow(tileAt(6, 6), {});
    ASSERT_FALSE(tile);
    const std::string sentence =
        ": the server sends whole files only (it ignores range "
        "requests); download the file and open it from disk";
    EXPECT_EQ(tile.error().message, server_.url("map.tif") + sentence);
    fs::copy_file(original("other.tif"), folder_.file("second.tif"));
    server_.resetCounts();
    const auto second = RasterFile::open(server_.url("second.tif"));
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().message, server_.url("second.tif") + sentence);
    EXPECT_LT(server_.counts().body_bytes, fs::file_size(original("other.tif")));
}

TEST_F(RemoteRasterTest, RefusesLargeFilesThatCannotBeReadInPieces)
{
    for (const auto& [name, why] :
         {std::pair<std::string, std::string>{"strips.tif", "it is stored in blocks of 2048 × "},
          {"no_overviews.tif", "it has no overviews"}}) {
        fs::copy_file(original(name), folder_.file(name));
        const RasterFile file = opened(server_.url(name));
        const auto source = GeotiffTileSource::of(file, {});
        ASSERT_FALSE(source);
        EXPECT_THAT(source.error().message,
                    StartsWith(server_.url(name) + ": is not a cloud-optimized GeoTIFF: " + why));
        EXPECT_THAT(source.error().message, EndsWith("(gdal_translate -of COG)"));
    }
}

TEST_F(RemoteRasterTest, TilesMatchThoseOfTheLocalFile)
{
    const RasterFile remote_file = opened(server_.url("map.tif"));
    const RasterFile local_file = opened(original("map.tif"));
    const auto remote = GeotiffTileSource::of(remote_file, {});
    const auto local = GeotiffTileSource::of(local_file, {});
    ASSERT_TRUE(remote && local);
    EXPECT_EQ((*remote)->name(), server_.url("map.tif"));
    const auto remote_reader = (*remote)->open();
    const auto local_reader = (*local)->open();
    ASSERT_TRUE(remote_reader && local_reader);
    for (const TileId& id : {TileId{TileKind::Samples, 0, 7, 7}, TileId{TileKind::Samples, 1, 1, 2},
                             TileId{TileKind::Samples, 2, 0, 1}, TileId{TileKind::Means, 1, 2, 3},
                             TileId{TileKind::Means, 3, 0, 0}}) {
        const auto there = (*remote_reader)->read(id);
        const auto here = (*local_reader)->read(id);
        ASSERT_TRUE(there) << there.error().message;
        ASSERT_TRUE(here);
        EXPECT_TRUE(isSame(there->samples, here->samples));
    }
    // A reader for another thread reads the same edition or fails.
    publish("other.tif");
    const auto late = (*remote)->open();
    ASSERT_FALSE(late);
    EXPECT_THAT(late.error().message, HasSubstr("open it again"));
}

} // namespace
} // namespace marsview
