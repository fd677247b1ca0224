// Every real file against GDAL's own tools: properties as from gdalinfo, samples as from
// gdallocationinfo.
#include "core/raster/raster_file.h"
#include "core/session/map.h"
#include "tests/support/gdal_tools.h"
#include "tests/support/random.h"
#include "tests/support/reference_surface.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kPositions = 200;
constexpr const char* kAbsent = "(absent)";

std::vector<std::string> readableFiles()
{
    std::vector<std::string> paths;
    for (const test::CatalogueEntry& entry : test::catalogue()) {
        const bool is_truncated = entry.path.find("truncated.") != std::string::npos &&
                                  entry.path.find("39079G6") == std::string::npos;
        if (entry.driver != "DOES NOT OPEN" && !is_truncated) {
            paths.push_back(entry.path);
        }
    }
    if (paths.empty()) {
        paths.emplace_back(kAbsent);
    }
    return paths;
}

// Meters in a unit that gdalinfo prints.
double unitMeters(std::string unit)
{
    std::transform(unit.begin(), unit.end(), unit.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (unit.empty() || unit == "m" || unit == "metre" || unit == "meters") {
        return 1.0;
    }
    if (unit == "ft") {
        return 0.3048;
    }
    ADD_FAILURE() << "the test does not know the unit \"" << unit << "\"";
    return 1.0;
}

class CatalogFile : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override
    {
        if (GetParam() == kAbsent) {
            GTEST_SKIP() << "the real elevation data is not at " << test::sharedData();
        }
        path_ = (test::sharedData() / GetParam()).string();
        // A .prj file is opened through its data; the oracle gets the data file directly.
        oracle_path_ = path_.ends_with(".prj") && !GetParam().starts_with("gdal_autotest")
                           ? path_.substr(0, path_.size() - 4) + ".flt"
                       : path_.ends_with(".prj") ? path_.substr(0, path_.size() - 4) + ".bil"
                                                 : path_;
        gdal_ = test::gdalInfo(oracle_path_);
        const nlohmann::json& band = test::firstBand(gdal_);
        scale_ = band.value("scale", 1.0);
        offset_ = band.value("offset", 0.0);
        meters_ = unitMeters(band.value("unit", std::string()));
        // The lunar products here give radii: the offset is the reference radius.
        reference_m_ = offset_ == 1737400.0 ? 1737400.0 : 0.0;
        type_ = band.at("type").get<std::string>();
        if (band.contains("noDataValue")) {
            nodata_ = test::jsonNumber(band.at("noDataValue"));
        }
        columns_ = gdal_.at("size").at(0).get<std::size_t>();
        rows_ = gdal_.at("size").at(1).get<std::size_t>();
        // ISIS3 and PDS4 have several special values, which only the mask covers.
        if (band.contains("mask")) { // gdalinfo lists it unless it follows from nodata alone
            mask_ = test::maskOf(oracle_path_);
        }
    }

    // Elevation of a raw sample, computed from gdalinfo's fields; NaN where void.
    double height(double raw, const test::Pixel& pixel) const
    {
        const bool is_nodata =
            nodata_ && (type_ == "Float32" ? static_cast<float>(raw) == static_cast<float>(*nodata_)
                                           : raw == *nodata_);
        const bool is_masked = !mask_.empty() && mask_[pixel.row * columns_ + pixel.column] == 0;
        if (is_nodata || is_masked || !std::isfinite(raw)) {
            return std::numeric_limits<double>::quiet_NaN();
        }
        return (raw * scale_ + offset_) * meters_ - reference_m_;
    }

    // The digits that gdallocationinfo prints, plus the rounding of the conversion.
    double tolerance(double height_m) const
    {
        const double digits = type_ == "Float64" ? 1e-14 : type_ == "Float32" ? 1e-14 : 0.0;
        return (digits + 4e-16) * (std::abs(height_m) + std::abs(reference_m_) + 1.0);
    }

    void expectHeight(double found, double expected, const std::string& where) const
    {
        if (std::isnan(expected)) {
            EXPECT_TRUE(std::isnan(found)) << where << ": " << found << " where void";
        } else {
            EXPECT_NEAR(found, expected, tolerance(expected)) << where;
        }
    }

    bool isSurface() const { return columns_ > 1 && rows_ > 1; }

    std::shared_ptr<const class Map> load() const
    {
        JobMonitor monitor;
        auto dataset = readMap(RasterSpec{path_, 1, {}}, monitor, defaultMemoryBudget());
        EXPECT_TRUE(dataset) << dataset.error().message;
        return dataset ? *dataset : nullptr;
    }

    std::string path_;
    std::string oracle_path_;
    nlohmann::json gdal_;
    std::string type_;
    std::optional<double> nodata_;
    std::vector<unsigned char> mask_;
    double scale_ = 1.0;
    double offset_ = 0.0;
    double meters_ = 1.0;
    double reference_m_ = 0.0;
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;
};

TEST_P(CatalogFile, IsDescribedAsGdalinfoDescribesIt)
{
    const auto file = RasterFile::open(path_);
    ASSERT_TRUE(file) << file.error().message;
    const RasterInfo& info = file->info();
    EXPECT_EQ(info.driver, gdal_.at("driverShortName"));
    EXPECT_EQ(info.columns, columns_);
    EXPECT_EQ(info.rows, rows_);
    EXPECT_EQ(sampleTypeName(info.type), type_);
    EXPECT_EQ(info.band_count, static_cast<int>(gdal_.at("bands").size()));
    EXPECT_EQ(info.nodata.has_value(), nodata_.has_value());
    if (nodata_ && info.nodata && !std::isnan(*nodata_)) {
        // gdalinfo rounds float values to the digits of a float.
        const double digits = type_ == "Float32" ? 1e-7 : 1e-14;
        EXPECT_NEAR(*info.nodata, *nodata_, digits * std::abs(*nodata_));
    }
    EXPECT_EQ(info.scale, scale_);
    EXPECT_EQ(info.offset, offset_);
    EXPECT_EQ(info.has_mask_band, !mask_.empty());
    EXPECT_EQ(info.reference_radius_m.has_value(), reference_m_ != 0.0);
    if (info.reference_radius_m) {
        EXPECT_EQ(*info.reference_radius_m, reference_m_);
    }
}

TEST_P(CatalogFile, HasTheCornersOfGdalinfo)
{
    const auto file = RasterFile::open(path_);
    ASSERT_TRUE(file) << file.error().message;
    const RasterInfo& info = file->info();
    const bool has_crs = gdal_.contains("coordinateSystem") &&
                         !gdal_["coordinateSystem"].value("wkt", std::string()).empty();
    EXPECT_EQ(info.crs.has_value(), has_crs);
    if (has_crs && info.crs) {
        EXPECT_EQ(test::compactWkt(info.crs->wkt()),
                  test::compactWkt(gdal_["coordinateSystem"]["wkt"].get<std::string>()));
    }
    ASSERT_EQ(info.transform.has_value(), gdal_.contains("geoTransform"));
    if (!info.transform) {
        return;
    }
    std::array<double, 6> expected = gdal_["geoTransform"].get<std::array<double, 6>>();
    if (GetParam().starts_with("mars_mola/megt90n000cb")) {
        // GDAL places the grid of this label one pixel north and west of the label's limits.
        expected[0] += expected[1];
        expected[3] += expected[5];
        EXPECT_TRUE(std::any_of(info.notices.begin(), info.notices.end(), [](const std::string& n) {
            return n.starts_with("shifted by 1 column and 1 row");
        }));
    }
    for (std::size_t i = 0; i < 6; ++i) {
        // gdalinfo prints 16 decimals.
        EXPECT_NEAR(info.transform->terms()[i], expected[i], 1e-15 * std::abs(expected[i]) + 1e-16)
            << i;
    }
}

TEST_P(CatalogFile, HasTheSamplesOfGdallocationinfo)
{
    if (!isSurface()) {
        GTEST_SKIP() << "1 × 1 samples do not form a surface";
    }
    const auto dataset = load();
    auto file = RasterFile::open(path_);
    ASSERT_TRUE(dataset && file);
    test::Random random;
    std::vector<test::Pixel> pixels{
        {0, 0}, {columns_ - 1, 0}, {0, rows_ - 1}, {columns_ - 1, rows_ - 1}};
    for (std::size_t i = 0; i < kPositions; ++i) {
        pixels.push_back({random.below(columns_), random.below(rows_)});
    }
    const std::vector<double> raw = test::rawSamples(oracle_path_, pixels);
    const ElevationScale scale = file->info().elevationScale();
    std::size_t voids = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const test::Pixel& p = pixels[i];
        const double expected = height(raw[i], p);
        const std::string where = fmt::format("column {} row {}", p.column, p.row);
        const Heightfield& surface = dataset->heightfield();
        expectHeight(surface.sample(p.column, p.row), expected, where);
        expectHeight(surface.height({static_cast<double>(p.column), static_cast<double>(p.row)}),
                     expected, where);
        auto window = file->readWindow({p.column, p.row, 1, 1}, VoidRule{file->info().nodata});
        ASSERT_TRUE(window) << window.error().message;
        expectHeight(window->grid.isVoid(0, 0) ? std::numeric_limits<double>::quiet_NaN()
                                               : scale.height(window->grid.raw(0, 0)),
                     expected, where + ", window");
        voids += std::isnan(expected) ? 1U : 0U;
    }
    std::printf("%s: %zu samples, %zu of them void\n", GetParam().c_str(), pixels.size(), voids);
}

TEST_P(CatalogFile, IsTriangulatedBetweenSamples)
{
    if (!isSurface()) {
        GTEST_SKIP() << "1 × 1 samples do not form a surface";
    }
    const auto dataset = load();
    auto file = RasterFile::open(path_);
    ASSERT_TRUE(dataset && file);
    test::Random random;
    std::vector<GridPoint> positions;
    std::vector<test::Pixel> corners;
    for (std::size_t i = 0; i < kPositions; ++i) {
        const GridPoint p{random.uniform(0.0, static_cast<double>(columns_ - 1)),
                          random.uniform(0.0, static_cast<double>(rows_ - 1))};
        const auto c = static_cast<std::size_t>(p.column);
        const auto r = static_cast<std::size_t>(p.row);
        positions.push_back(p);
        corners.insert(corners.end(), {{c, r}, {c + 1, r}, {c, r + 1}, {c + 1, r + 1}});
    }
    const std::vector<double> raw = test::rawSamples(oracle_path_, corners);
    const ElevationScale scale = file->info().elevationScale();
    double worst_m = 0.0;
    std::size_t voids = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const GridPoint& p = positions[i];
        const std::string where = fmt::format("column {:.17g} row {:.17g}", p.column, p.row);
        std::array<long double, 4> z{};
        double largest = 0.0;
        for (std::size_t k = 0; k < 4; ++k) {
            const double corner = height(raw[4 * i + k], corners[4 * i + k]);
            z[k] = corner;
            largest = std::isnan(corner) ? largest : std::max(largest, std::abs(corner));
        }
        const double u = p.column - std::floor(p.column);
        const double v = p.row - std::floor(p.row);
        const auto expected = static_cast<double>(test::planeHeight(z, u, v));
        const double found = dataset->heightfield().height(p);
        // The tolerance of the corners, plus 4 ulp for the interpolation.
        const double bound = tolerance(largest) + 4.0 * 2.3e-16 * largest;
        const test::Pixel& corner = corners[4 * i];
        auto window =
            file->readWindow({corner.column, corner.row, 2, 2}, VoidRule{file->info().nodata});
        ASSERT_TRUE(window) << window.error().message;
        const auto sample = [&](std::size_t c, std::size_t r) {
            return window->grid.isVoid(c, r) ? std::numeric_limits<double>::quiet_NaN()
                                             : scale.height(window->grid.raw(c, r));
        };
        const double through_window =
            heightInCell({sample(0, 0), sample(1, 0), sample(0, 1), sample(1, 1)}, u, v);
        if (std::isnan(expected)) {
            EXPECT_TRUE(std::isnan(found)) << where;
            EXPECT_TRUE(std::isnan(through_window)) << where;
            ++voids;
            continue;
        }
        EXPECT_NEAR(found, expected, bound) << where;
        EXPECT_EQ(through_window, found) << where;
        worst_m = std::max(worst_m, std::abs(found - expected));
    }
    std::printf("%s: %zu positions, %zu of them void, worst %.3g m\n", GetParam().c_str(),
                positions.size(), voids, worst_m);
}

TEST_P(CatalogFile, ScanAndWholeReadFindTheSameRange)
{
    auto file = RasterFile::open(path_);
    ASSERT_TRUE(file);
    JobMonitor monitor;
    const VoidRule rule{file->info().nodata};
    const auto scanned = file->scan(monitor, rule);
    EXPECT_EQ(monitor.fraction(), 1.0);
    const auto loaded = file->readAll(monitor, rule, defaultMemoryBudget());
    ASSERT_TRUE(scanned && loaded);
    EXPECT_EQ(scanned->raw_minimum, loaded->statistics.raw_minimum);
    EXPECT_EQ(scanned->raw_maximum, loaded->statistics.raw_maximum);
    EXPECT_EQ(scanned->void_count, loaded->statistics.void_count);
    EXPECT_EQ(scanned->sample_count, columns_ * rows_);
    // Brute force over the loaded samples.
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    std::uint64_t voids = 0;
    for (std::size_t r = 0; r < rows_; ++r) {
        for (std::size_t c = 0; c < columns_; ++c) {
            if (loaded->grid.isVoid(c, r)) {
                ++voids;
            } else {
                low = std::min(low, loaded->grid.raw(c, r));
                high = std::max(high, loaded->grid.raw(c, r));
            }
        }
    }
    EXPECT_EQ(loaded->statistics.void_count, voids);
    EXPECT_EQ(loaded->statistics.raw_minimum, low);
    EXPECT_EQ(loaded->statistics.raw_maximum, high);
}

std::string fileName(const testing::TestParamInfo<std::string>& info)
{
    std::string name = info.param;
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(SharedData, CatalogFile, testing::ValuesIn(readableFiles()), fileName);

// Headers and data files of labels open through their companion file; all others are rejected.
TEST(Catalogue, DataAndHeadersOpenThroughTheirCompanions)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const std::pair<const char*, const char*> pairs[] = {
        {"mars_mola/megt90n000cb.img", "mars_mola/megt90n000cb.lbl"},
        {"moon_lola/LDEM_4.IMG", "moon_lola/LDEM_4.LBL"},
        {"derived/W100N40_etopo5.HDR", "derived/W100N40_etopo5.DEM"},
        {"derived/craterlake_ned.hdr", "derived/craterlake_ned.flt"},
        {"derived/craterlake_ned.prj", "derived/craterlake_ned.flt"},
        {"gdal_autotest/gdrivers/data/ehdr/float32.hdr",
         "gdal_autotest/gdrivers/data/ehdr/float32.bil"},
        {"gdal_autotest/gdrivers/data/pds4/byte_pds4_cart_1700.img",
         "gdal_autotest/gdrivers/data/pds4/byte_pds4_cart_1700.xml"},
        {"gdal_autotest/gdrivers/data/isis3/isis3_detached.cub",
         "gdal_autotest/gdrivers/data/isis3/isis3_detached.lbl"},
    };
    for (const auto& [asked, opened] : pairs) {
        const auto file = RasterFile::open((test::sharedData() / asked).string());
        ASSERT_TRUE(file) << asked << ": " << file.error().message;
        EXPECT_EQ(file->info().path, (test::sharedData() / opened).string());
        ASSERT_FALSE(file->info().notices.empty()) << asked;
        const auto name = [](const char* path) {
            return std::filesystem::path(path).filename().string();
        };
        EXPECT_EQ(file->info().notices.front(),
                  "opened " + name(opened) + " in place of " + name(asked));
    }
}

} // namespace
} // namespace marsview
