#include "core/raster/mosaic.h"
#include "core/raster/raster_file.h"
#include "core/sources/source_identity.h"
#include "tests/support/gdal_tools.h"
#include "tests/support/make_raster.h"
#include "tests/support/random.h"
#include "tests/support/run_program.h"
#include "tests/support/sample_types.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <type_traits>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr std::size_t kColumns = 61;
constexpr std::size_t kRows = 47;
constexpr std::size_t kWest = 25; // columns
constexpr std::size_t kNorth = 20;

// A map, and a folder for parts of it.
class MosaicTest : public testing::Test {
protected:
    MosaicTest() { fs::create_directory(parts()); }

    std::string parts() const { return folder_.file("parts"); }
    std::string part(const std::string& name) const { return parts() + "/" + name; }

    template <typename T>
    std::vector<T> samples()
    {
        std::vector<T> samples(kColumns * kRows);
        for (T& sample : samples) {
            sample = static_cast<T>(random_.uniform(0.0, 120.0));
        }
        return samples;
    }

    // Cuts a rectangle from the map with gdal_translate.
    std::string cut(const test::RasterRecipe& map,
                    const std::string& name,
                    const GridWindow& window,
                    std::vector<std::string> options = {}) const
    {
        std::vector<std::string> command{"gdal_translate", "-q", "-srcwin"};
        for (const std::size_t number : {window.column, window.row, window.columns, window.rows}) {
            command.push_back(fmt::format("{}", number));
        }
        command.insert(command.end(), options.begin(), options.end());
        command.push_back(test::writeVrt(folder_, "map", map));
        command.push_back(part(name));
        test::runTool(command);
        return part(name);
    }

    // Into 2 × 2 parts; the first one overlaps the others.
    void cutIntoFour(const test::RasterRecipe& map) const
    {
        cut(map, "00.tif", {0, 0, kWest + 1, kNorth + 1});
        cut(map, "01.tif", {kWest, 0, kColumns - kWest, kNorth});
        cut(map, "10.tif", {0, kNorth, kWest, kRows - kNorth});
        cut(map, "11.tif", {kWest, kNorth, kColumns - kWest, kRows - kNorth});
    }

    static LoadedSamples read(RasterFile& file)
    {
        JobMonitor monitor;
        Result<LoadedSamples> loaded =
            file.readAll(monitor, {file.info().nodata}, std::size_t{1} << 30);
        EXPECT_TRUE(loaded) << loaded.error().message;
        return std::move(loaded).value();
    }

    RasterFile opened() const
    {
        Result<RasterFile> file = RasterFile::open(parts());
        EXPECT_TRUE(file) << file.error().message;
        return std::move(file).value();
    }

    std::string refusal() const
    {
        const Result<RasterFile> file = RasterFile::open(parts());
        EXPECT_FALSE(file);
        return file ? std::string() : file.error().message;
    }

    test::TempFolder folder_;
    test::Random random_;
};

template <typename T>
class MosaicOf : public MosaicTest {};

TYPED_TEST_SUITE(MosaicOf, test::AllSampleTypes);

TYPED_TEST(MosaicOf, IsTheMapThatItsPartsWereCutFrom)
{
    using T = TypeParam;
    std::vector<T> samples = this->template samples<T>();
    if constexpr (sizeof(T) >= 4) {
        for (T& sample : samples) { // full precision of the type
            sample = static_cast<T>(this->random_.uniform(0.0, sizeof(T) == 4 ? 4e6 : 4e12));
        }
    }
    const test::RasterRecipe map = test::recipeFor(kColumns, samples);
    this->cutIntoFour(map);
    RasterFile file = this->opened();
    EXPECT_EQ(file.info().columns, kColumns);
    EXPECT_EQ(file.info().rows, kRows);
    EXPECT_EQ(file.info().transform->terms(), *map.transform);
    EXPECT_EQ(file.info().nodata, std::nullopt);
    EXPECT_EQ(file.info().path, this->parts());
    const LoadedSamples loaded = this->read(file);
    EXPECT_EQ(loaded.statistics.void_count, 0U);
    loaded.grid.visit([&samples](auto view) {
        using Read = std::remove_cvref_t<decltype(view(0, 0))>;
        if constexpr (std::is_same_v<Read, T>) {
            for (std::size_t i = 0; i < samples.size(); ++i) {
                ASSERT_EQ(view(i % kColumns, i / kColumns), samples[i]) << i;
            }
        } else {
            FAIL() << "samples of another type";
        }
    });
}

TYPED_TEST(MosaicOf, HasVoidsWhereNoPartIsAndWhereTheirsAre)
{
    using T = TypeParam;
    std::vector<T> samples = this->template samples<T>();
    std::vector<bool> is_void(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (this->random_.chance(0.2)) {
            samples[i] = T{99};
        }
        is_void[i] = samples[i] == T{99};
    }
    test::RasterRecipe map = test::recipeFor(kColumns, samples);
    map.band_xml += "<NoDataValue>99</NoDataValue>";
    this->cutIntoFour(map);
    fs::remove(this->part("11.tif"));
    for (std::size_t r = kNorth; r < kRows; ++r) {
        for (std::size_t c = kWest; c < kColumns; ++c) {
            if (r > kNorth || c > kWest) { // a sample that the first part has too
                is_void[r * kColumns + c] = true;
            }
        }
    }
    RasterFile file = this->opened();
    EXPECT_EQ(file.info().nodata, 99.0);
    EXPECT_THAT(file.info().notices,
                testing::Contains(StartsWith("a mosaic of 3 rasters, which cover 66.1 %")));
    const LoadedSamples loaded = this->read(file);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        ASSERT_EQ(loaded.grid.isVoid(i % kColumns, i / kColumns), is_void[i]) << i;
        if (!is_void[i]) {
            ASSERT_EQ(loaded.grid.raw(i % kColumns, i / kColumns), static_cast<double>(samples[i]));
        }
    }
}

TYPED_TEST(MosaicOf, FindsAVoidForGapsWhereEverySampleIsAHeight)
{
    using T = TypeParam;
    std::vector<T> samples = this->template samples<T>();
    samples[0] = sizeof(T) < 8 ? std::numeric_limits<T>::max() : static_cast<T>(1e15);
    if constexpr (std::is_unsigned_v<T>) {
        samples[1] = T{0};
    }
    this->cut(test::recipeFor(kColumns, samples), "a.tif", {0, 0, 20, kRows});
    this->cut(test::recipeFor(kColumns, samples), "b.tif", {30, 0, 31, kRows});
    if (std::is_same_v<T, std::int8_t>) {
        EXPECT_THAT(this->refusal(), HasSubstr("Int8 samples have no value left for nodata"));
        return;
    }
    RasterFile file = this->opened();
    const LoadedSamples loaded = this->read(file);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const bool is_gap = i % kColumns >= 20 && i % kColumns < 30;
        ASSERT_EQ(loaded.grid.isVoid(i % kColumns, i / kColumns), is_gap) << i;
        if (!is_gap) {
            ASSERT_EQ(loaded.grid.raw(i % kColumns, i / kColumns), static_cast<double>(samples[i]));
        }
    }
}

TEST_F(MosaicTest, KeepsVoidsOfEveryKindApart)
{
    const std::vector<std::int16_t> samples = this->samples<std::int16_t>();
    const test::RasterRecipe map = test::recipeFor(kColumns, samples);
    // Three parts with different nodata values, and one with a mask.
    cut(map, "a.tif", {0, 0, 20, kRows}, {"-a_nodata", "7"});
    cut(map, "b.tif", {20, 0, 20, kRows}, {"-a_nodata", "8"});
    cut(map, "c.tif", {40, 0, 11, kRows});
    const std::string masked = cut(map, "d.tif", {51, 0, 10, kRows});
    test::runTool({"gdal_translate", "-q", "-b", "1", "-mask", "1", "--config",
                   "GDAL_TIFF_INTERNAL_MASK", "YES", masked, folder_.file("d.tif")});
    fs::rename(folder_.file("d.tif"), masked);
    RasterFile file = opened();
    const LoadedSamples loaded = read(file);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t column = i % kColumns;
        const std::int16_t nothing = column < 20 ? 7 : 8;
        const bool is_void = (column < 40 && samples[i] == nothing) ||
                             (column >= 51 && samples[i] == 0); // the mask is the band itself
        ASSERT_EQ(loaded.grid.isVoid(column, i / kColumns), is_void) << i;
        if (!is_void) {
            ASSERT_EQ(loaded.grid.raw(column, i / kColumns), samples[i]);
        }
    }
}

TEST_F(MosaicTest, ShowsOfOverlapsWhatGdalbuildvrtShows)
{
    std::vector<std::string> command{"gdalbuildvrt", "-q", folder_.file("oracle.vrt")};
    for (int i = 0; i < 12; ++i) {
        test::RasterRecipe map = test::recipeFor(kColumns, samples<float>());
        map.band_xml = "<NoDataValue>-1</NoDataValue>";
        const std::size_t column = random_.below(50);
        const std::size_t row = random_.below(40);
        command.push_back(cut(map, fmt::format("{:02}.tif", i),
                              {column, row, 2 + random_.below(kColumns - column - 1),
                               2 + random_.below(kRows - row - 1)}));
    }
    test::runTool(command);
    RasterFile file = opened();
    const LoadedSamples loaded = read(file);
    std::vector<test::Pixel> pixels;
    for (std::size_t i = 0; i < file.info().columns * file.info().rows; ++i) {
        pixels.push_back({i % file.info().columns, i / file.info().columns});
    }
    const std::vector<double> raw = test::rawSamples(folder_.file("oracle.vrt"), pixels);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const bool is_void = raw[i] == -1.0;
        ASSERT_EQ(loaded.grid.isVoid(pixels[i].column, pixels[i].row), is_void);
        if (!is_void) {
            ASSERT_NEAR(loaded.grid.raw(pixels[i].column, pixels[i].row), raw[i], 1e-5);
        }
    }
}

TEST_F(MosaicTest, TakesTilesOfSrtm)
{
    constexpr std::size_t kSide = 1201;
    std::vector<std::int16_t> samples((2 * kSide - 1) * kSide);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<std::int16_t>(i * 31 % 4001);
    }
    test::RasterRecipe map = test::recipeFor(2 * kSide - 1, samples);
    map.srs = "EPSG:4326";
    const double pixel = 1.0 / 1200.0;
    // On both sides of the antimeridian.
    map.transform = {179.0 - pixel / 2.0, pixel, 0.0, -16.0 + pixel / 2.0, 0.0, -pixel};
    cut(map, "S17E179.hgt", {0, 0, kSide, kSide}, {"-of", "SRTMHGT"});
    cut(map, "S17W180.hgt", {kSide - 1, 0, kSide, kSide},
        {"-of", "SRTMHGT", "-a_ullr", fmt::format("{:.17g}", -180.0 - pixel / 2.0),
         fmt::format("{:.17g}", -16.0 + pixel / 2.0), fmt::format("{:.17g}", -179.0 + pixel / 2.0),
         fmt::format("{:.17g}", -17.0 - pixel / 2.0)});
    RasterFile file = opened();
    EXPECT_EQ(file.info().columns, 2 * kSide - 1);
    EXPECT_EQ(file.info().rows, kSide);
    EXPECT_EQ(file.info().vertical_datum, "EGM96 geoid");
    EXPECT_NEAR(file.info().transform->terms()[0], 179.0 - pixel / 2.0, 1e-12);
    const LoadedSamples loaded = read(file);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        ASSERT_EQ(loaded.grid.raw(i % (2 * kSide - 1), i / (2 * kSide - 1)), samples[i]);
    }
}

TEST_F(MosaicTest, CountsEveryRasterOnceAndPassesOverWhatIsNone)
{
    const test::RasterRecipe map = test::recipeFor(kColumns, samples<float>());
    cut(map, "west.flt", {0, 0, 30, kRows}, {"-of", "EHdr"}); // with .hdr, .prj and .aux.xml
    cut(map, "east.flt", {30, 0, 31, kRows}, {"-of", "EHdr"});
    folder_.write("parts/README.txt", "two tiles\n");
    folder_.write("parts/north.xyz", "not a raster at all\n");
    const auto mosaic = mosaicOf(parts(), 1);
    ASSERT_TRUE(mosaic) << mosaic.error().message;
    EXPECT_EQ((*mosaic)->parts.size(), 2U);
    EXPECT_EQ((*mosaic)->info.columns, kColumns);
    EXPECT_THAT((*mosaic)->info.notices, Not(Contains(HasSubstr("left out"))));
}

TEST_F(MosaicTest, TellsOfRastersThatItLeavesOut)
{
    const test::RasterRecipe map = test::recipeFor(kColumns, samples<float>());
    cut(map, "west.flt", {0, 0, 30, kRows}, {"-of", "EHdr"});
    cut(map, "east.flt", {30, 0, 31, kRows}, {"-of", "EHdr"});
    const std::string cut_short = cut(map, "all.tif", {0, 0, kColumns, kRows});
    fs::resize_file(cut_short, fs::file_size(cut_short) / 2);
    const auto mosaic = mosaicOf(parts(), 1);
    ASSERT_TRUE(mosaic) << mosaic.error().message;
    EXPECT_EQ((*mosaic)->parts.size(), 2U);
    EXPECT_THAT((*mosaic)->info.notices,
                Contains("left out all.tif: no elevations that could be read"));
}

TEST_F(MosaicTest, OfOneRasterIsThatRaster)
{
    cut(test::recipeFor(kColumns, samples<float>()), "only.tif", {0, 0, kColumns, kRows});
    const RasterFile file = opened();
    EXPECT_EQ(file.info().columns, kColumns);
    EXPECT_THAT(file.info().notices, testing::Not(testing::Contains(HasSubstr("mosaic"))));
}

TEST_F(MosaicTest, NoticesEveryChangeOfItsFolder)
{
    const test::RasterRecipe map = test::recipeFor(kColumns, samples<float>());
    cut(map, "a.tif", {0, 0, 30, kRows});
    cut(map, "b.tif", {30, 0, 21, kRows});
    const auto first = mosaicOf(parts(), 1);
    ASSERT_TRUE(first);
    EXPECT_EQ(*mosaicOf(parts(), 1), *first) << "opened again although nothing has changed";
    EXPECT_EQ(*mosaicOf(parts() + "/", 1), *first);
    const auto before = identify(parts());
    ASSERT_TRUE(before);
    EXPECT_EQ(before->path, parts());
    EXPECT_EQ(identify(parts() + "/")->path, parts());
    EXPECT_TRUE(isSameContent(*before, *identify(parts())));
    // Another part.
    cut(map, "c.tif", {51, 0, 10, kRows});
    EXPECT_EQ((*mosaicOf(parts(), 1))->info.columns, kColumns);
    const auto with_three = identify(parts());
    ASSERT_TRUE(with_three);
    EXPECT_FALSE(isSameContent(*before, *with_three));
    // Other samples in a part.
    cut(test::recipeFor(kColumns, samples<float>()), "b.tif", {30, 0, 21, kRows});
    EXPECT_FALSE(isSameContent(*with_three, *identify(parts())));
    // One part fewer.
    fs::remove(part("a.tif"));
    EXPECT_EQ((*mosaicOf(parts(), 1))->info.columns, 31U);
}

TEST_F(MosaicTest, SaysWhatDoesNotFit)
{
    const test::RasterRecipe map = test::recipeFor(kColumns, samples<float>());
    cut(map, "a.tif", {0, 0, 30, kRows});
    const auto refused_with = [&](const GridWindow& window, std::vector<std::string> options) {
        cut(map, "b.tif", window, std::move(options));
        std::string message = refusal();
        fs::remove(part("b.tif"));
        EXPECT_THAT(message, StartsWith(parts() + ": its rasters do not form a mosaic: "));
        return message;
    };
    const GridWindow east{30, 0, 31, kRows};
    EXPECT_THAT(refused_with(east, {"-ot", "Int16"}),
                EndsWith("b.tif holds Int16 samples, a.tif holds Float32; open them one by one"));
    EXPECT_THAT(refused_with(east, {"-a_srs", "EPSG:32611"}),
                HasSubstr("b.tif has the CRS WGS 84 / UTM zone 11N, a.tif has none; open"));
    EXPECT_THAT(refused_with(east, {"-a_scale", "0.5"}),
                HasSubstr("b.tif has elevations in another unit"));
    EXPECT_THAT(refused_with(east, {"-tr", "2", "2"}), HasSubstr("b.tif has pixels of 2 × -2"));
    EXPECT_THAT(refused_with(east, {"-a_ullr", "1030.5", "2000", "1061.5", "1953"}),
                HasSubstr("b.tif lies -0.5 columns"));
    EXPECT_THAT(refused_with(east, {"-a_ullr", "9000", "9000", "9031", "8953"}),
                HasSubstr("are far apart and cover"));
}

TEST_F(MosaicTest, LeavesNoHoleWhereAPartIsDamaged)
{
    const test::RasterRecipe map = test::recipeFor(kColumns, samples<float>());
    cut(map, "a.flt", {0, 0, 30, kRows}, {"-of", "EHdr"});
    const std::string cut_short = cut(map, "b.flt", {30, 0, 31, kRows}, {"-of", "EHdr"});
    fs::resize_file(cut_short, fs::file_size(cut_short) / 2);
    RasterFile file = opened();
    EXPECT_TRUE(file.readWindow({0, 0, 30, kRows}, {}));
    const auto read = file.readWindow({0, 0, kColumns, kRows}, {});
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message,
                AllOf(StartsWith(parts() + ": reading rows 0 to 46 failed: " + cut_short)));
}

TEST_F(MosaicTest, SkipsDamagedFilesAndNamesThemFirst)
{
    const test::RasterRecipe map = test::recipeFor(kColumns, samples<float>());
    cut(map, "a.flt", {0, 0, 20, kRows}, {"-of", "EHdr"});
    cut(map, "b.flt", {20, 0, 20, kRows}, {"-of", "EHdr"});
    cut(map, "c.flt", {40, 0, 21, kRows}, {"-of", "EHdr"});
    folder_.write("parts/b.flt", "");
    const auto mosaic = mosaicOf(parts(), 1);
    ASSERT_TRUE(mosaic) << mosaic.error().message;
    EXPECT_EQ((*mosaic)->parts.size(), 2U);
    EXPECT_EQ((*mosaic)->info.columns, kColumns) << "with a gap";
    ASSERT_FALSE((*mosaic)->info.notices.empty());
    EXPECT_THAT((*mosaic)->info.notices.front(),
                AllOf(StartsWith("left out a damaged file of the folder ("), HasSubstr("b.flt"),
                      HasSubstr("empty")));
    // Once it is whole again, it is a part.
    cut(map, "b.flt", {20, 0, 20, kRows}, {"-of", "EHdr"});
    const auto whole = mosaicOf(parts(), 1);
    ASSERT_TRUE(whole) << whole.error().message;
    EXPECT_EQ((*whole)->parts.size(), 3U);
    EXPECT_THAT((*whole)->info.notices, Not(Contains(HasSubstr("damaged"))));
}

TEST_F(MosaicTest, SaysWhichPartIsGone)
{
    const test::RasterRecipe map = test::recipeFor(kColumns, samples<float>());
    cut(map, "a.tif", {0, 0, 30, kRows});
    cut(map, "b.tif", {30, 0, 31, kRows});
    RasterFile file = opened();
    fs::rename(part("b.tif"), folder_.file("b.tif"));
    const auto read = file.readWindow({0, 0, kColumns, kRows}, {});
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message, HasSubstr("b.tif"));
    // Reading works again once the file is back.
    fs::rename(folder_.file("b.tif"), part("b.tif"));
    EXPECT_TRUE(file.readWindow({0, 0, kColumns, kRows}, {}));
}

TEST_F(MosaicTest, NeedsRasters)
{
    EXPECT_THAT(refusal(), EndsWith("parts: is a folder without rasters that can be shown; open "
                                    "one with elevations in it"));
}

} // namespace
} // namespace marsview
