// Elevations of labeled products against their labels, which are read here as text. GDAL 3.6
// ignores a part of each.
#include "core/raster/label_elevation.h"
#include "core/raster/raster_file.h"
#include "tests/support/make_raster.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {
namespace {

using test::TempFolder;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr std::size_t kLabelColumns = 40;
constexpr std::size_t kLabelRows = 20;

template <typename T>
std::string bytesOf(const std::vector<T>& samples)
{
    return {reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof(T)};
}

std::vector<std::int16_t> someSamples()
{
    std::vector<std::int16_t> samples(kLabelColumns * kLabelRows);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<std::int16_t>(static_cast<int>(i * 79 % 37000) - 17000);
    }
    return samples;
}

// The number after "KEY =" in a label.
double numberBehind(const std::string& label, const std::string& key)
{
    const std::size_t at = label.find(key);
    const std::size_t equals = label.find('=', at);
    if (at == std::string::npos || equals == std::string::npos) {
        throw std::runtime_error("no " + key);
    }
    return std::stod(label.substr(label.find_first_not_of(" \"(", equals + 1)));
}

constexpr std::string_view kProjection = R"(OBJECT = IMAGE_MAP_PROJECTION
 MAP_PROJECTION_TYPE          = "SIMPLE CYLINDRICAL"
 MAP_RESOLUTION               = 4 <pix/deg>
 A_AXIS_RADIUS                = 1737.4 <km>
 B_AXIS_RADIUS                = 1737.4 <km>
 C_AXIS_RADIUS                = 1737.4 <km>
 POSITIVE_LONGITUDE_DIRECTION = "EAST"
 CENTER_LATITUDE              = 0 <deg>
 CENTER_LONGITUDE             = 180 <deg>
 LINE_FIRST_PIXEL             = 1
 SAMPLE_FIRST_PIXEL           = 1
 MAP_PROJECTION_ROTATION      = 0.0
 MAP_SCALE                    = 7580.84 <m/pix>
 MAXIMUM_LATITUDE             = 90 <deg>
 MINIMUM_LATITUDE             = 85 <deg>
 WESTERNMOST_LONGITUDE        = 0 <deg>
 EASTERNMOST_LONGITUDE        = 10 <deg>
 LINE_PROJECTION_OFFSET       = 359.5 <pix>
 SAMPLE_PROJECTION_OFFSET     = 719.5 <pix>
END_OBJECT = IMAGE_MAP_PROJECTION
)";

struct Product {
    std::string pointer{};    // the file that ^IMAGE names
    std::string compressed{}; // the file of a COMPRESSED_FILE object
    std::string image{};      // statements of IMAGE in addition to its size
    std::string type = "LSB_INTEGER";
    int bits = 16;
    bool is_nested = true;
};

// A label in the form of LOLA's labels.
std::string pds3Label(const Product& product)
{
    const std::size_t row_bytes = kLabelColumns * static_cast<std::size_t>(product.bits) / 8;
    std::string label = "PDS_VERSION_ID = \"PDS3\"\n/* made for a test */\nTARGET_NAME = MOON\n";
    if (!product.compressed.empty()) {
        label += "OBJECT = COMPRESSED_FILE\n FILE_NAME = \"" + product.compressed +
                 "\"\n RECORD_TYPE = UNDEFINED\n ENCODING_TYPE = \"JP2\"\n"
                 " ENCODING_TYPE_VERSION_NAME = \"ISO/IEC15444-1:2004\"\n"
                 " INTERCHANGE_FORMAT = BINARY\n UNCOMPRESSED_FILE_NAME = \"" +
                 product.pointer +
                 "\"\n REQUIRED_STORAGE_BYTES = " + std::to_string(row_bytes * kLabelRows) +
                 " <BYTES>\nEND_OBJECT = COMPRESSED_FILE\n";
    }
    if (product.is_nested) {
        label += "OBJECT = UNCOMPRESSED_FILE\n FILE_NAME = \"" + product.pointer + "\"\n";
    }
    label += " RECORD_TYPE = FIXED_LENGTH\n FILE_RECORDS = " + std::to_string(kLabelRows) +
             "\n RECORD_BYTES = " + std::to_string(row_bytes) + "\n ^IMAGE = \"" + product.pointer +
             "\"\n OBJECT = IMAGE\n  NAME = HEIGHT\n  LINES = " + std::to_string(kLabelRows) +
             "\n  LINE_SAMPLES = " + std::to_string(kLabelColumns) +
             "\n  SAMPLE_TYPE = " + product.type +
             "\n  SAMPLE_BITS = " + std::to_string(product.bits) + "\n" + product.image +
             " END_OBJECT = IMAGE\n";
    if (product.is_nested) {
        label += "END_OBJECT = UNCOMPRESSED_FILE\n";
    }
    return label + std::string(kProjection) + "END\n";
}

constexpr const char* kRadii = "  UNIT = METER\n  SCALING_FACTOR = 0.5\n  OFFSET = 1737400.\n";

template <typename T>
std::string
writeJpeg2000(const TempFolder& folder, const std::string& file, const std::vector<T>& samples)
{
    test::RasterRecipe recipe = test::recipeFor(kLabelColumns, samples);
    recipe.transform.reset();
    return test::writeRaster(
        folder, file, "JP2OpenJPEG", recipe,
        {"-co", "QUALITY=100", "-co", "REVERSIBLE=YES", "-co", "GMLJP2=NO", "-co", "GeoJP2=NO"});
}

RasterFile openOrThrow(const std::string& path)
{
    auto file = RasterFile::open(path);
    if (!file) {
        throw std::runtime_error(file.error().message);
    }
    return std::move(*file);
}

std::vector<double> elevationsOf(RasterFile& file)
{
    JobMonitor monitor;
    auto loaded = file.readAll(monitor, {file.info().nodata}, std::size_t{1} << 30);
    if (!loaded) {
        throw std::runtime_error(loaded.error().message);
    }
    std::vector<double> elevations;
    for (std::size_t r = 0; r < loaded->grid.rows(); ++r) {
        for (std::size_t c = 0; c < loaded->grid.columns(); ++c) {
            elevations.push_back(loaded->grid.isVoid(c, r)
                                     ? std::numeric_limits<double>::quiet_NaN()
                                     : file.info().elevationScale().height(loaded->grid.raw(c, r)));
        }
    }
    return elevations;
}

void expectElevations(RasterFile& file,
                      const std::vector<std::int16_t>& samples,
                      double scale,
                      double offset)
{
    const std::vector<double> elevations = elevationsOf(file);
    ASSERT_EQ(elevations.size(), samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        ASSERT_DOUBLE_EQ(elevations[i], samples[i] * scale + offset) << i;
    }
}

TEST(Pds3InJpeg2000, MatchesTheSameProductAsRawSamples)
{
    const TempFolder folder;
    const std::vector<std::int16_t> samples = someSamples();
    folder.write("twin.img", bytesOf(samples));
    RasterFile twin =
        openOrThrow(folder.write("twin.lbl", pds3Label({.pointer = "TWIN.IMG", .image = kRadii})));
    const std::string label =
        pds3Label({.pointer = "LDEM.IMG", .compressed = "LDEM.JP2", .image = kRadii});
    writeJpeg2000(folder, "ldem.jp2", samples);
    folder.write("ldem_jp2.lbl", label);
    const double radius_m = numberBehind(label, "OFFSET");
    for (const char* name : {"ldem_jp2.lbl", "ldem.jp2"}) {
        SCOPED_TRACE(name);
        RasterFile file = openOrThrow(folder.file(name));
        const RasterInfo& info = file.info();
        expectElevations(file, samples, numberBehind(label, "SCALING_FACTOR"), 0.0);
        EXPECT_EQ(elevationsOf(file), elevationsOf(twin));
        EXPECT_EQ(info.scale, 0.5);
        EXPECT_EQ(info.offset, radius_m);
        EXPECT_EQ(info.reference_radius_m, radius_m);
        EXPECT_TRUE(info.is_unit_declared);
        EXPECT_EQ(info.nodata, twin.info().nodata);
        EXPECT_EQ(info.transform, twin.info().transform);
        ASSERT_TRUE(info.crs);
        EXPECT_EQ(info.crs->wkt(), twin.info().crs->wkt());
        EXPECT_THAT(info.notices,
                    Contains("from the label ldem_jp2.lbl: scale 0.5, offset 1737400 (GDAL reads "
                             "scale 1, offset 0)"));
    }
}

TEST(Pds3InJpeg2000, FindsTheLabelOfTheSameNameInAnyCase)
{
    const TempFolder folder;
    const std::vector<std::int16_t> samples = someSamples();
    const std::string image = "  SCALING_FACTOR = 0.25\n  UNIT = KILOMETER\n";
    folder.write("A.LBL", pds3Label({.pointer = "a.img", .compressed = "a.jp2", .image = image}));
    RasterFile upper = openOrThrow(writeJpeg2000(folder, "A.JP2", samples));
    expectElevations(upper, samples, 250.0, 0.0);
    // The label of the raw image, where only the JPEG2000 edition is present.
    folder.write("b.lbl", pds3Label({.pointer = "B.IMG", .image = image}));
    RasterFile edition = openOrThrow(writeJpeg2000(folder, "b.jp2", samples));
    expectElevations(edition, samples, 250.0, 0.0);
    // And with no label at all.
    RasterFile bare = openOrThrow(writeJpeg2000(folder, "c.jp2", samples));
    expectElevations(bare, samples, 1.0, 0.0);
    EXPECT_FALSE(bare.info().is_unit_declared);
}

TEST(Pds3InJpeg2000, MissingConstantsAreVoid)
{
    const TempFolder folder;
    std::vector<std::int16_t> samples = someSamples();
    samples[5] = -32000;
    for (const char* statement : {"MISSING_CONSTANT = -32000", "CORE_NULL = \"-32000\"",
                                  "MISSING_CONSTANT = 16#8300#", "INVALID_CONSTANT = -32000"}) {
        SCOPED_TRACE(statement);
        folder.write("v.lbl",
                     pds3Label({.pointer = "v.img",
                                .compressed = "v.jp2",
                                .image = kRadii + ("  " + std::string(statement) + "\n")}));
        RasterFile file = openOrThrow(writeJpeg2000(folder, "v.jp2", samples));
        EXPECT_EQ(file.info().nodata, -32000.0);
        EXPECT_TRUE(std::isnan(elevationsOf(file)[5]));
        EXPECT_FALSE(std::isnan(elevationsOf(file)[6]));
        EXPECT_THAT(file.info().notices, Contains(HasSubstr("nodata -32000")));
    }
}

TEST(Pds3InJpeg2000, ReportsADisagreementAboutSigns)
{
    const TempFolder folder;
    folder.write("u.lbl", pds3Label({.pointer = "u.img", .compressed = "u.jp2", .image = kRadii}));
    const RasterFile file = openOrThrow(writeJpeg2000(
        folder, "u.jp2",
        std::vector<std::uint16_t>(kLabelColumns * kLabelRows, std::uint16_t{40000})));
    EXPECT_THAT(file.info().notices, Contains(HasSubstr("declares signed samples")));
}

TEST(Pds3InJpeg2000, ReportsNumbersThatItCannotRead)
{
    const TempFolder folder;
    for (const char* text : {"0,5", "abc", "\"0.5 m\""}) {
        SCOPED_TRACE(text);
        folder.write("n.lbl",
                     pds3Label({.pointer = "n.img",
                                .compressed = "n.jp2",
                                .image = std::string("  SCALING_FACTOR = ") + text +
                                         "\n  OFFSET = none\n  MISSING_CONSTANT = nothing\n"}));
        RasterFile file = openOrThrow(writeJpeg2000(folder, "n.jp2", someSamples()));
        expectElevations(file, someSamples(), 1.0, 0.0);
        const RasterInfo& info = file.info();
        EXPECT_THAT(info.notices, Contains(AllOf(HasSubstr("the label n.lbl gives SCALING_FACTOR"),
                                                 HasSubstr("1 is used instead"))));
        EXPECT_THAT(info.notices, Contains(HasSubstr("MISSING_CONSTANT as \"nothing\"")));
        EXPECT_THAT(info.notices, Not(Contains(HasSubstr("OFFSET")))); // "none" is no value
        // Set as the notice asks.
        RasterOverrides overrides;
        overrides.scale = 0.5;
        const auto set = withOverrides(info, overrides);
        ASSERT_TRUE(set);
        EXPECT_THAT(set->notices, Not(Contains(HasSubstr("SCALING_FACTOR"))));
        EXPECT_THAT(set->notices, Contains(HasSubstr("MISSING_CONSTANT")));
    }
}

TEST(Pds3Label, ReportsAScaleThatItCannotReadOnce)
{
    const TempFolder folder;
    folder.write("raw.img", bytesOf(someSamples()));
    for (const char* text : {"0,5", "abc"}) {
        RasterFile file = openOrThrow(folder.write(
            "raw.lbl", pds3Label({.pointer = "RAW.IMG",
                                  .image = std::string("  SCALING_FACTOR = ") + text + "\n"})));
        expectElevations(file, someSamples(), 1.0, 0.0);
        const std::vector<std::string>& notices = file.info().notices;
        EXPECT_EQ(std::count_if(notices.begin(), notices.end(),
                                [](const std::string& notice) {
                                    return notice.find("1 is used instead") != std::string::npos;
                                }),
                  1)
            << text;
    }
}

TEST(Pds3InJpeg2000, ReportsASizeOtherThanTheLabels)
{
    const TempFolder folder;
    std::string label = pds3Label({.pointer = "s.img", .compressed = "s.jp2", .image = kRadii});
    const std::string lines = "LINES = " + std::to_string(kLabelRows);
    label.replace(label.find(lines), lines.size(), "LINES = 77");
    folder.write("s.lbl", label);
    const RasterFile file = openOrThrow(writeJpeg2000(folder, "s.jp2", someSamples()));
    EXPECT_THAT(file.info().notices,
                Contains("the label s.lbl describes 40 × 77 samples, but the file holds 40 × 20; "
                         "check that they belong together"));
}

TEST(LabelNotices, AreNotMadeForValuesThatTheUserSets)
{
    const TempFolder folder;
    folder.write("o.lbl", pds3Label({.pointer = "o.img", .compressed = "o.jp2", .image = kRadii}));
    const RasterFile file = openOrThrow(writeJpeg2000(folder, "o.jp2", someSamples()));
    RasterOverrides overrides;
    overrides.scale = 2.0;
    EXPECT_THAT(withOverrides(file.info(), overrides)->notices,
                AllOf(Contains("from the label o.lbl: offset 1737400 (GDAL reads offset 0)"),
                      Not(Contains(HasSubstr("scale")))));
    overrides.offset = 0.0;
    EXPECT_THAT(withOverrides(file.info(), overrides)->notices,
                Not(Contains(HasSubstr("from the label"))));
    // Nor for a placement: a raster without one, and one that the label moves.
    const RasterFile bare = openOrThrow(writeJpeg2000(folder, "bare.jp2", someSamples()));
    EXPECT_THAT(bare.info().notices, Contains(HasSubstr("no georeferencing")));
    overrides = {};
    overrides.transform = GeoTransform::Terms{0, 30, 0, 0, 0, -30};
    EXPECT_THAT(withOverrides(bare.info(), overrides)->notices,
                Not(Contains(HasSubstr("no georeferencing"))));
}

TEST(Pds3InJpeg2000, ReportsThatADamagedLabelIsNotApplied)
{
    const TempFolder folder;
    std::string label = pds3Label({.pointer = "d.img", .compressed = "d.jp2", .image = kRadii});
    label.resize(label.find("OBJECT = IMAGE")); // cut short
    folder.write("d.lbl", label);
    RasterFile file = openOrThrow(writeJpeg2000(folder, "d.jp2", someSamples()));
    expectElevations(file, someSamples(), 1.0, 0.0);
    EXPECT_THAT(file.info().notices, Contains(HasSubstr("the label d.lbl is damaged")));
}

// GDAL would read the bytes of the compressed file as samples.
TEST(Pds3Label, OpensTheEncodedImageThatItDescribes)
{
    const TempFolder folder;
    const std::vector<std::int16_t> samples = someSamples();
    writeJpeg2000(folder, "plain.jp2", samples);
    test::RasterRecipe recipe = test::recipeFor(kLabelColumns, samples);
    recipe.transform.reset();
    test::writeRaster(folder, "plain.tif", "GTiff", recipe, {"-co", "COMPRESS=DEFLATE"});
    folder.write("raw.img", bytesOf(samples));
    const RasterFile twin =
        openOrThrow(folder.write("raw.lbl", pds3Label({.pointer = "RAW.IMG", .image = kRadii})));
    for (const char* data : {"PLAIN.JP2", "PLAIN.TIF"}) {
        SCOPED_TRACE(data);
        for (const bool is_nested : {true, false}) {
            const std::string label =
                folder.write("product.lbl",
                             pds3Label({.pointer = data, .image = kRadii, .is_nested = is_nested}));
            RasterFile file = openOrThrow(label);
            expectElevations(file, samples, 0.5, 0.0);
            EXPECT_EQ(file.info().transform, twin.info().transform);
            EXPECT_THAT(file.info().notices, Contains(HasSubstr("from the label product.lbl")));
        }
    }
    // With another pointer, which includes the position in the file.
    std::string other = pds3Label({.pointer = "PLAIN.JP2", .image = kRadii});
    const std::string pointer = "^IMAGE = \"PLAIN.JP2\"";
    other.replace(other.find(pointer), pointer.size(), "^HEIGHT_IMAGE = (\"PLAIN.JP2\", 1)");
    RasterFile height = openOrThrow(folder.write("product.lbl", other));
    expectElevations(height, samples, 0.5, 0.0);
    // Opened through its data alone; a label with the same base name describes it.
    std::filesystem::remove(folder.file("product.lbl"));
    folder.write("plain.lbl", pds3Label({.pointer = "plain.tif", .image = kRadii}));
    RasterFile data = openOrThrow(folder.file("plain.tif"));
    expectElevations(data, samples, 0.5, 0.0);
    EXPECT_EQ(data.info().transform, twin.info().transform);
}

TEST(Pds3Label, IsNotAppliedToATiffThatItDoesNotName)
{
    const TempFolder folder;
    const std::vector<std::int16_t> samples = someSamples();
    folder.write("made.lbl", pds3Label({.pointer = "made.img", .image = kRadii}));
    RasterFile made = openOrThrow(
        test::writeRaster(folder, "made.tif", "GTiff", test::recipeFor(kLabelColumns, samples)));
    expectElevations(made, samples, 1.0, 0.0);
}

TEST(Pds3Label, OverridesNumbersThatGdalMisreads)
{
    struct Case {
        const char* image;
        double scale, offset, meters;
    };
    const TempFolder folder;
    const std::vector<std::int16_t> samples = someSamples();
    folder.write("d.img", bytesOf(samples));
    for (const Case& one : {
             Case{"  SCALING_FACTOR = \"0.25\"\n  OFFSET = \"12\"\n", 0.25, 12.0, 1.0},
             Case{"  SCALING_FACTOR = (0.25)\n  OFFSET = (12.0)\n", 0.25, 12.0, 1.0},
             Case{"  SCALING_FACTOR = 2.5E-1 <m>\n  OFFSET = +12 <m>\n", 0.25, 12.0, 1.0},
             Case{"  SCALING_FACTOR = 0.001\n  UNIT = \"KILOMETERS\"\n", 0.001, 0.0, 1000.0},
             Case{"  UNIT = 'FEET'\n", 1.0, 0.0, 0.3048},
             Case{"  UNIT = 'N/A'\n", 1.0, 0.0, 1.0},
         }) {
        for (const bool is_nested : {true, false}) {
            SCOPED_TRACE(one.image);
            RasterFile file = openOrThrow(folder.write(
                "d.lbl",
                pds3Label({.pointer = "d.img", .image = one.image, .is_nested = is_nested})));
            expectElevations(file, samples, one.scale * one.meters, one.offset * one.meters);
        }
    }
}

// GDAL 3.6 assumes nodata 0 for every product with unsigned samples.
TEST(Pds3Label, ZeroIsAnElevationUnlessDeclaredMissing)
{
    const TempFolder folder;
    std::vector<std::uint16_t> samples(kLabelColumns * kLabelRows, std::uint16_t{300});
    samples[7] = 0;
    folder.write("u.img", bytesOf(samples));
    const auto open = [&folder](const std::string& image) {
        return openOrThrow(folder.write(
            "u.lbl",
            pds3Label({.pointer = "u.img", .image = image, .type = "LSB_UNSIGNED_INTEGER"})));
    };
    RasterFile plain = open("  OFFSET = -100\n");
    EXPECT_FALSE(plain.info().nodata);
    EXPECT_EQ(elevationsOf(plain)[7], -100.0);
    EXPECT_EQ(elevationsOf(plain)[8], 200.0);
    RasterFile declared = open("  MISSING_CONSTANT = 0\n");
    EXPECT_TRUE(std::isnan(elevationsOf(declared)[7]));
}

TEST(Pds3Label, ReadsTheBitsOfAFloatMissingConstant)
{
    const TempFolder folder;
    std::vector<float> samples(kLabelColumns * kLabelRows, 1.5F);
    samples[3] = -3.40282266e38F; // 16#FF7FFFFB#
    folder.write("f.img", bytesOf(samples));
    RasterFile file =
        openOrThrow(folder.write("f.lbl", pds3Label({.pointer = "f.img",
                                                     .image = "  UNIT = KILOMETER\n"
                                                              "  MISSING_CONSTANT = 16#FF7FFFFB#\n",
                                                     .type = "PC_REAL",
                                                     .bits = 32})));
    EXPECT_TRUE(std::isnan(elevationsOf(file)[3]));
    EXPECT_EQ(elevationsOf(file)[4], 1500.0);
}

TEST(Isis2Label, AppliesBaseAndMultiplier)
{
    const TempFolder folder;
    const std::vector<std::int16_t> samples = someSamples();
    test::RasterRecipe recipe = test::recipeFor(kLabelColumns, samples);
    recipe.transform.reset();
    const std::string path = test::writeRaster(folder, "cube.lab", "ISIS2", recipe);
    std::string cube = test::readFile(path);
    // Replaced by texts of the same length, so that the samples stay at the offset in the label.
    const auto replace = [&cube](const std::string& key, const std::string& value) {
        const std::size_t at = cube.find(key);
        ASSERT_NE(at, std::string::npos) << key;
        const std::size_t begin = cube.find('=', at) + 1;
        const std::size_t end = cube.find('\n', begin);
        ASSERT_GE(end - begin, value.size()) << key;
        cube.replace(begin, end - begin, value + std::string(end - begin - value.size(), ' '));
    };
    replace("CORE_MULTIPLIER", " .1");
    replace("CORE_BASE", " 50");
    RasterFile file = openOrThrow(folder.write("cube.lab", cube));
    EXPECT_EQ(file.info().driver, "ISIS2");
    expectElevations(file, samples, 0.1, 50.0);
}

// GDAL reads these correctly: the values of the label must not be applied twice.
TEST(ScaleAndOffset, AreAppliedOnceForEveryOtherFormat)
{
    struct Format {
        const char* driver;
        const char* file;
        std::vector<std::string> options{};
    };
    const TempFolder folder;
    const std::vector<std::int16_t> samples = someSamples();
    test::RasterRecipe recipe = test::recipeFor(kLabelColumns, samples);
    recipe.srs = "EPSG:32611";
    recipe.transform = {5e5, 30.0, 0.0, 4e6, 0.0, -30.0};
    recipe.band_xml = "<Scale>0.25</Scale><Offset>-40</Offset><UnitType>m</UnitType>";
    for (const Format& format : std::vector<Format>{
             {"GTiff", "s.tif"},
             {"ENVI", "s.bin"},
             {"netCDF", "s.nc"},
             {"ISIS3", "s.cub"},
             {"ISIS3", "detached.lbl", {"-co", "DATA_LOCATION=EXTERNAL"}},
             {"PDS4", "s.xml"},
             {"PDS4", "geotiff.xml", {"-co", "IMAGE_FORMAT=GEOTIFF"}},
         }) {
        SCOPED_TRACE(format.file);
        RasterFile file = openOrThrow(
            test::writeRaster(folder, format.file, format.driver, recipe, format.options));
        EXPECT_EQ(file.info().driver, format.driver);
        expectElevations(file, samples, 0.25, -40.0);
        EXPECT_THAT(file.info().notices, testing::Not(Contains(HasSubstr("from the label"))));
    }
}

TEST(VicarLabel, AppliesScaleAndOffsetOfItsTerrainModel)
{
    const TempFolder folder;
    const std::vector<std::int16_t> samples = someSamples();
    test::RasterRecipe recipe = test::recipeFor(kLabelColumns, samples);
    recipe.transform.reset();
    const std::string written = test::readFile(test::writeRaster(folder, "v.vic", "VICAR", recipe));
    const std::size_t label_bytes = std::stoul(written.substr(written.find('=') + 1));
    std::string label = written.substr(0, written.find('\0'));
    label += " PROPERTY='DTM' DTM_OFFSET=-40.0 DTM_SCALING_FACTOR=0.25 DTM_MISSING_DN=-17000 ";
    const std::size_t record = kLabelColumns * sizeof(std::int16_t);
    const std::size_t bytes = (label.size() / record + 1) * record;
    const std::size_t number = label.find('=') + 1;
    const std::string size = std::to_string(bytes);
    label.replace(number, label.find(' ', number) - number, size);
    label.resize(bytes, '\0');
    RasterFile file = openOrThrow(folder.write("v.vic", label + written.substr(label_bytes)));
    EXPECT_EQ(file.info().driver, "VICAR");
    const std::vector<double> elevations = elevationsOf(file);
    EXPECT_TRUE(std::isnan(elevations[0]));
    for (std::size_t i = 1; i < samples.size(); ++i) {
        ASSERT_DOUBLE_EQ(elevations[i], samples[i] * 0.25 - 40.0) << i;
    }
}

TEST(Pds4Label, IsAppliedWhenItsTiffIsOpened)
{
    const TempFolder folder;
    const std::vector<std::int16_t> samples = someSamples();
    test::RasterRecipe recipe = test::recipeFor(kLabelColumns, samples);
    recipe.srs = "EPSG:32611";
    recipe.transform = {5e5, 30.0, 0.0, 4e6, 0.0, -30.0};
    recipe.band_xml =
        "<NoDataValue>-17000</NoDataValue><Scale>0.25</Scale><Offset>-40</Offset><UnitType>ft</"
        "UnitType>";
    test::writeRaster(folder, "dtm.xml", "PDS4", recipe, {"-co", "IMAGE_FORMAT=GEOTIFF"});
    RasterFile label = openOrThrow(folder.file("dtm.xml"));
    RasterFile data = openOrThrow(folder.file("dtm.tif"));
    for (RasterFile* file : {&label, &data}) {
        EXPECT_EQ(file->info().unit.name, "ft");
        const std::vector<double> elevations = elevationsOf(*file);
        EXPECT_TRUE(std::isnan(elevations[0])); // -17000
        for (std::size_t i = 1; i < samples.size(); ++i) {
            ASSERT_NEAR(elevations[i], (samples[i] * 0.25 - 40.0) * 0.3048, 1e-9) << i;
        }
    }
}

// GDAL 3.6 takes them for kilometers.
TEST(Pds3Label, ReadsRadiiInTheUnitOfTheLabel)
{
    const TempFolder folder;
    folder.write("r.img", bytesOf(someSamples()));
    writeJpeg2000(folder, "r.jp2", someSamples());
    const std::string label = pds3Label({.pointer = "r.img", .image = kRadii});
    const RasterFile kilometers = openOrThrow(folder.write("km.lbl", label));
    for (const char* radius : {"1737400 <m>", "1737400.0 <METERS>", "1.7374E6<M>", "1737400",
                               "1737.4 <KILOMETER>", "1737.4"}) {
        SCOPED_TRACE(radius);
        std::string changed = label;
        for (std::size_t at = 0; (at = changed.find("1737.4 <km>")) != std::string::npos;) {
            changed.replace(at, std::string_view("1737.4 <km>").size(), radius);
        }
        const std::string path = folder.write("r.lbl", changed);
        for (const std::string& name : {path, folder.file("r.jp2")}) {
            const RasterFile file = openOrThrow(name);
            ASSERT_TRUE(file.info().crs);
            EXPECT_EQ(file.info().crs->ellipsoid()->equatorial_m, 1737400.0);
            EXPECT_EQ(file.info().crs->wkt(), kilometers.info().crs->wkt());
            EXPECT_EQ(file.info().transform, kilometers.info().transform);
            ASSERT_NE(file.info().body, nullptr);
            EXPECT_EQ(file.info().body->name, "Moon");
        }
        const bool is_other_unit = std::string_view(radius).find("1737.4") != 0;
        const bool has_notice = testing::Matches(
            Contains(HasSubstr("from the label r.lbl: radius 1737400 m (GDAL reads ")))(
            openOrThrow(path).info().notices);
        EXPECT_EQ(has_notice, is_other_unit);
    }
}

// As samples × 0 would be.
TEST(Pds3Label, IgnoresAScaleOfZero)
{
    const TempFolder folder;
    const std::vector<std::int16_t> samples = someSamples();
    folder.write("z.img", bytesOf(samples));
    writeJpeg2000(folder, "z.jp2", samples);
    const std::string label =
        folder.write("z.lbl", pds3Label({.pointer = "z.img", .image = "  SCALING_FACTOR = 0.0\n"}));
    for (const std::string& name : {label, folder.file("z.jp2")}) {
        RasterFile file = openOrThrow(name);
        expectElevations(file, samples, 1.0, 0.0);
        EXPECT_THAT(file.info().notices,
                    Contains(AllOf(HasSubstr("z.lbl gives the scale 0"), HasSubstr("--scale"))));
        RasterOverrides overrides;
        overrides.scale = 0.5;
        EXPECT_THAT(withOverrides(file.info(), overrides)->notices,
                    Not(Contains(HasSubstr("gives the scale 0"))))
            << "with the scale that the notice asks for";
    }
}

TEST(Pds4Label, IgnoresAScaleOfZero)
{
    const TempFolder folder;
    const std::vector<std::int16_t> samples = someSamples();
    test::RasterRecipe recipe = test::recipeFor(kLabelColumns, samples);
    recipe.band_xml = "<Scale>0.25</Scale>";
    std::string label = test::readFile(test::writeRaster(folder, "z.xml", "PDS4", recipe));
    const std::string scale = "<scaling_factor>0.25<";
    ASSERT_NE(label.find(scale), std::string::npos);
    label.replace(label.find(scale), scale.size(), "<scaling_factor>0<");
    RasterFile file = openOrThrow(folder.write("z.xml", label));
    expectElevations(file, samples, 1.0, 0.0);
    EXPECT_THAT(file.info().notices, Contains(HasSubstr("z.xml gives the scale 0")));
}

TEST(Pds3Label, TreatsAllSpecialConstantsAsVoid)
{
    const TempFolder folder;
    std::vector<std::int16_t> samples = someSamples();
    samples[5] = -32000;
    samples[6] = -32001;
    samples[7] = -32002;
    samples[8] = 32003;
    folder.write("v.img", bytesOf(samples));
    writeJpeg2000(folder, "v.jp2", samples);
    for (const char* image :
         {"  MISSING_CONSTANT = -32000\n  INVALID_CONSTANT = -32001\n"
          "  NOT_APPLICABLE_CONSTANT = -32002\n  CORE_HIGH_REPR_SATURATION = 32003\n",
          "  CORE_NULL = -32000\n  CORE_NULL = -32001\n  CORE_NULL = -32002\n"
          "  CORE_NULL = 32003\n",
          "  MISSING_CONSTANT = {-32000, -32001, 16#82FE#, 32003}\n",
          "  MISSING_CONSTANT = (-32000, -32001)\n  UNKNOWN_CONSTANT = (-32002, 32003)\n"}) {
        SCOPED_TRACE(image);
        const std::string label =
            folder.write("v.lbl", pds3Label({.pointer = "v.img", .image = image}));
        for (const std::string& name : {label, folder.file("v.jp2")}) {
            RasterFile file = openOrThrow(name);
            const std::vector<double> elevations = elevationsOf(file);
            for (std::size_t i = 0; i < 12; ++i) {
                EXPECT_EQ(std::isnan(elevations[i]), i >= 5 && i <= 8) << i;
            }
            // A window and the statistics agree.
            const auto window = file.readWindow({5, 0, 4, 1}, {file.info().nodata});
            ASSERT_TRUE(window);
            EXPECT_EQ(window->statistics.void_count, 4U);
            JobMonitor monitor;
            const auto all = file.scan(monitor, {file.info().nodata});
            ASSERT_TRUE(all);
            EXPECT_EQ(all->raw_minimum, *std::min_element(samples.begin(), samples.begin() + 5));
            EXPECT_THAT(file.info().notices, Contains(HasSubstr("nodata -32000 -32001")));
        }
    }
}

// A sequence has an item for each band.
TEST(Pds3Label, ReadsTheConstantsOfEachBand)
{
    const std::string label =
        "PDS_VERSION_ID = PDS3\nOBJECT = IMAGE\n BANDS = 2\n"
        " MISSING_CONSTANT = (-1, -2)\nEND_OBJECT = IMAGE\nEND\n";
    EXPECT_EQ(labelElevationIn(label, 1, SampleType::Int16)->nodata, std::vector{-1.0});
    EXPECT_EQ(labelElevationIn(label, 2, SampleType::Int16)->nodata, std::vector{-2.0});
}

TEST(Pds4Label, TreatsAllSpecialConstantsOfItsTiffAsVoid)
{
    const TempFolder folder;
    std::vector<std::int16_t> samples = someSamples();
    samples[5] = -32000;
    samples[6] = -32001;
    test::RasterRecipe recipe = test::recipeFor(kLabelColumns, samples);
    recipe.band_xml = "<NoDataValue>-32000</NoDataValue>";
    std::string label = test::readFile(
        test::writeRaster(folder, "c.xml", "PDS4", recipe, {"-co", "IMAGE_FORMAT=GEOTIFF"}));
    const std::string end = "</missing_constant>";
    ASSERT_NE(label.find(end), std::string::npos);
    label.insert(label.find(end) + end.size(), "<invalid_constant>-32001</invalid_constant>");
    folder.write("c.xml", label);
    for (const char* name : {"c.xml", "c.tif"}) {
        SCOPED_TRACE(name);
        RasterFile file = openOrThrow(folder.file(name));
        const std::vector<double> elevations = elevationsOf(file);
        EXPECT_FALSE(std::isnan(elevations[4]));
        EXPECT_TRUE(std::isnan(elevations[5]));
        EXPECT_TRUE(std::isnan(elevations[6]));
    }
}

// The scale of the TIFF with its samples is not applied on top of the label's, or in its place.
TEST(Isis3Label, IsAppliedOnceToATiff)
{
    const TempFolder folder;
    const std::vector<std::int16_t> samples = someSamples();
    test::RasterRecipe recipe = test::recipeFor(kLabelColumns, samples);
    recipe.srs = "EPSG:32611";
    recipe.transform = {5e5, 30.0, 0.0, 4e6, 0.0, -30.0};
    recipe.band_xml = "<Scale>0.25</Scale><Offset>-40</Offset>";
    const std::string label = test::writeRaster(
        folder, "core.lbl", "ISIS3", recipe,
        {"-co", "DATA_LOCATION=GEOTIFF", "-co", "GEOTIFF_OPTIONS=COMPRESS=DEFLATE"});
    const std::string data = folder.file("core.tif");
    for (const std::string& name : {label, data}) {
        SCOPED_TRACE(name);
        RasterFile file = openOrThrow(name);
        expectElevations(file, samples, 0.25, -40.0);
        EXPECT_THAT(file.info().notices, testing::Not(Contains(HasSubstr("of its own"))));
    }
    // The TIFF has its own scale.
    std::filesystem::rename(data, folder.file("plain.tif"));
    test::runTool({"gdal_translate", "-q", "-co", "COMPRESS=DEFLATE", "-a_scale", "0.5",
                   "-a_offset", "7", folder.file("plain.tif"), data});
    for (const std::string& name : {label, data}) {
        SCOPED_TRACE(name);
        RasterFile file = openOrThrow(name);
        expectElevations(file, samples, 0.25, -40.0);
        EXPECT_THAT(file.info().notices,
                    Contains(AllOf(HasSubstr("core.lbl"), HasSubstr("scale 0.5, offset 7"))));
    }
}

// Size and elevations are those of the label; only the raster has a placement.
TEST(Pds3Label, KeepsTheRastersPlacementIfItHasNone)
{
    const TempFolder folder;
    const std::vector<std::int16_t> samples = someSamples();
    test::RasterRecipe recipe = test::recipeFor(kLabelColumns, samples);
    recipe.srs = "EPSG:32611";
    recipe.transform = {5e5, 30.0, 0.0, 4e6, 0.0, -30.0};
    const std::string data = test::writeRaster(folder, "p.jp2", "JP2OpenJPEG", recipe,
                                               {"-co", "QUALITY=100", "-co", "REVERSIBLE=YES"});
    const std::string whole =
        pds3Label({.pointer = "p.img", .image = "  SCALING_FACTOR = 0.5\n", .is_nested = false});
    std::string without_pointer = whole;
    const std::string pointer = " ^IMAGE = \"p.img\"\n";
    without_pointer.erase(without_pointer.find(pointer), pointer.size());
    std::string without_projection = whole;
    const std::string projection(kProjection);
    without_projection.erase(without_projection.find(projection), projection.size());
    for (const std::string& label : {without_pointer, without_projection}) {
        SCOPED_TRACE(label);
        folder.write("p.lbl", label);
        RasterFile file = openOrThrow(data);
        expectElevations(file, samples, 0.5, 0.0);
        ASSERT_TRUE(file.info().crs);
        if (label == without_projection) {
            EXPECT_EQ(file.info().transform->terms(), *recipe.transform);
            EXPECT_EQ(file.info().crs->name(), "WGS 84 / UTM zone 11N");
        }
    }
}

// A label whose samples are elsewhere is refused as before.
TEST(Pds3Label, IsRefusedIfItsCompressedFileIsMissing)
{
    const TempFolder folder;
    const std::string label = folder.write(
        "gone.lbl", pds3Label({.pointer = "gone.img", .compressed = "gone.jp2", .image = kRadii}));
    EXPECT_FALSE(RasterFile::open(label));
}

// For the real products.
TEST(RealLabels, MatchTheirTextAndGdalsSamples)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const std::string label = (test::sharedData() / "moon_lola/LDEM_4.LBL").string();
    const std::string text = test::readFile(label);
    const RasterFile file = openOrThrow(label);
    EXPECT_EQ(file.info().scale, numberBehind(text, "SCALING_FACTOR "));
    EXPECT_EQ(file.info().offset, numberBehind(text, " OFFSET "));
    EXPECT_EQ(file.info().unit.name, "m");
    EXPECT_TRUE(file.info().is_unit_declared);
    const TempFolder folder;
    test::runTool({"gdal_translate", "-q", "-of", "JP2OpenJPEG", "-co", "QUALITY=100", "-co",
                   "REVERSIBLE=YES", "-co", "GeoJP2=NO", "-co", "GMLJP2=NO", label,
                   folder.file("ldem_4.jp2")});
    std::filesystem::remove(folder.file("ldem_4.jp2.aux.xml"));
    const std::size_t begin = text.find("OBJECT                    = UNCOMPRESSED_FILE");
    ASSERT_NE(begin, std::string::npos);
    folder.write("ldem_4_jp2.lbl",
                 text.substr(0, begin) +
                     "OBJECT = COMPRESSED_FILE\n FILE_NAME = \"LDEM_4.JP2\"\n ENCODING_TYPE = "
                     "\"JP2\"\n UNCOMPRESSED_FILE_NAME = \"LDEM_4.IMG\"\nEND_OBJECT = "
                     "COMPRESSED_FILE\n" +
                     text.substr(begin));
    RasterFile raw = openOrThrow(label);
    RasterFile edition = openOrThrow(folder.file("ldem_4.jp2"));
    EXPECT_EQ(elevationsOf(edition), elevationsOf(raw));
    EXPECT_EQ(edition.info().transform, raw.info().transform);
}

} // namespace
} // namespace marsview
