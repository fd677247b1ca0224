#include "core/contours/contour_export.h"
#include "core/vector/vector_file.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace marsview::test {
namespace {

// The length of all lines at each elevation, in units of the CRS.
std::map<double, double> lengths(const std::string& path, const char* field)
{
    JobMonitor monitor;
    const Result<VectorFile> file = readVectorFile(path, monitor);
    EXPECT_TRUE(file) << (file ? "" : file.error().message);
    std::map<double, double> sums;
    const FeatureLayer& layer = file->content.layers.at(0);
    const auto named = std::find_if(layer.fields.begin(), layer.fields.end(),
                                    [field](const FeatureField& f) { return f.name == field; });
    const auto index = static_cast<std::size_t>(named - layer.fields.begin());
    for (const Feature& feature : layer.features) {
        const double elevation = std::get<double>(feature.values.at(index));
        for (const FeaturePart& part : feature.parts) {
            for (std::size_t i = 1; i < part.points.size(); ++i) {
                sums[elevation] += std::hypot(part.points[i].x - part.points[i - 1].x,
                                              part.points[i].y - part.points[i - 1].y);
            }
        }
    }
    return sums;
}

void expectEqual(const std::map<double, double>& ours,
                 const std::map<double, double>& theirs,
                 double tolerance = 1e-9)
{
    ASSERT_EQ(ours.size(), theirs.size());
    for (const auto& [elevation, length] : theirs) {
        const auto own = ours.find(elevation);
        ASSERT_NE(own, ours.end()) << elevation;
        EXPECT_NEAR(own->second, length, tolerance * length) << elevation;
    }
}

} // namespace

TEST(ContourExport, AgreesWithGdalContour)
{
    const TempFolder folder;
    for (const auto& [raster, interval] : std::vector<std::pair<std::string, double>>{
             {bundledMountain(), 50.0}, {bundledMars(), 1000.0}}) {
        SCOPED_TRACE(raster);
        const std::string theirs = folder.file("theirs.gpkg");
        std::filesystem::remove(theirs);
        runTool({"gdal_contour", "-q", "-f", "GPKG", "-a", "elev", "-i", std::to_string(interval),
                 raster, theirs});
        const auto expected = lengths(theirs, "elev");
        EXPECT_GT(expected.size(), 20U);
        for (const char* name : {"ours.gpkg", "ours.shp"}) {
            JobMonitor monitor;
            const auto report = exportContours(
                {.raster = {.path = raster}, .interval_m = interval, .path = folder.file(name)},
                monitor);
            ASSERT_TRUE(report) << report.error().message;
            EXPECT_GT(report->lines, 50U);
            expectEqual(lengths(folder.file(name), "elevation"), expected);
        }
    }
}

TEST(ContourExport, AppliesTheOverridesOfTheLayer)
{
    const TempFolder folder;
    JobMonitor monitor;
    RasterSpec doubled{.path = bundledMountain()};
    doubled.overrides.scale = 2.0;
    ASSERT_TRUE(exportContours({.raster = doubled,
                                .interval_m = 100.0,
                                .base_m = 30.0,
                                .path = folder.file("doubled.gpkg")},
                               monitor));
    ASSERT_TRUE(exportContours({.raster = {.path = bundledMountain()},
                                .interval_m = 50.0,
                                .base_m = 15.0,
                                .path = folder.file("plain.gpkg")},
                               monitor));
    std::map<double, double> halved;
    for (const auto& [elevation, length] : lengths(folder.file("doubled.gpkg"), "elevation")) {
        halved[0.5 * elevation] = length;
    }
    // GDAL moves samples that lie on a contour by a fixed tiny height.
    expectEqual(halved, lengths(folder.file("plain.gpkg"), "elevation"), 1e-7);
}

TEST(ContourExport, ACanceledExportLeavesTheFolderAsItWas)
{
    const TempFolder folder;
    const std::string path = folder.write("kept.gpkg", "old");
    JobMonitor monitor;
    monitor.cancel();
    const auto report = exportContours(
        {.raster = {.path = bundledMountain()}, .interval_m = 50.0, .path = path}, monitor);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::Canceled);
    EXPECT_EQ(readFile(path), "old");
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        ++files;
    }
    EXPECT_EQ(files, 1U);
}

TEST(ContourExport, RefusesOtherFormatsAndIntervals)
{
    const TempFolder folder;
    JobMonitor monitor;
    const auto refusal = [&](const std::string& name, double interval) {
        const auto report = exportContours({.raster = {.path = bundledMountain()},
                                            .interval_m = interval,
                                            .path = folder.file(name)},
                                           monitor);
        return report ? std::string() : report.error().message;
    };
    EXPECT_NE(refusal("x.dxf", 10.0).find("GeoPackage"), std::string::npos);
    EXPECT_NE(refusal("x.gpkg", 0.0).find("greater than 0 m"), std::string::npos);
    EXPECT_NE(refusal("none/x.gpkg", 10.0).find("cannot be written"), std::string::npos);
}

} // namespace marsview::test
