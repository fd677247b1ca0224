// Annotations in files of other programs: what GDAL's ogrinfo reads, and what comes back.
#include "core/annotations/annotation_files.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

#include <GeographicLib/Geodesic.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace marsview::test {
namespace {

using testing::HasSubstr;

Georeference mapOn(const std::string& crs)
{
    Result<Crs> known = Crs::fromText(crs);
    EXPECT_TRUE(known) << crs;
    return {100, 100, GeoTransform(), *known};
}

Annotation drawn(const Georeference& map,
                 FeatureShape shape,
                 const std::string& name,
                 const std::vector<std::pair<double, double>>& lonlat)
{
    Annotation annotation{.shape = shape, .name = name, .body = drawnBody(map, nullptr)};
    for (const auto& [longitude, latitude] : lonlat) {
        annotation.vertices.emplace_back(
            GeographicPoint{Angle::degrees(longitude), Angle::degrees(latitude)});
    }
    return annotation;
}

// One of each shape, with edges short enough to stay as they are.
std::vector<Annotation> oneOfEach(const Georeference& map)
{
    std::vector<Annotation> all{
        drawn(map, FeatureShape::Point, "Rim “north”, \"old\"", {{137.44, -4.59}}),
        drawn(map, FeatureShape::Line, "Fault", {{137.1, -4.2}, {137.3, -4.25}, {137.5, -4.6}}),
        drawn(map, FeatureShape::Polygon, "Unit A", {{137.0, -5.0}, {137.4, -5.0}, {137.2, -4.7}})};
    all[0].note = "sampled";
    all[0].color = Rgb8{255, 0, 16};
    all[0].symbol = MarkSymbol::Triangle;
    all[0].time = DrawnTime(std::chrono::milliseconds(1'800'000'000'125));
    all[1].color = Rgb8{0, 128, 255};
    return all;
}

Result<ImportedAnnotations> importFrom(const std::string& path, const Georeference& map)
{
    JobMonitor monitor;
    const Result<VectorFile> file = readVectorFile(path, monitor);
    if (!file) {
        return file.error();
    }
    return annotationsFrom(path, *file, map, map.crs()->body());
}

void expectSame(const Annotation& read, const Annotation& written)
{
    EXPECT_EQ(read.shape, written.shape);
    EXPECT_EQ(read.name, written.name);
    EXPECT_EQ(read.note, written.note);
    EXPECT_EQ(read.color, written.color);
    EXPECT_EQ(read.symbol, written.symbol);
    EXPECT_EQ(read.time, written.time);
    EXPECT_EQ(read.body, written.body);
    ASSERT_EQ(read.vertices.size(), written.vertices.size());
    for (std::size_t i = 0; i < read.vertices.size(); ++i) {
        const auto& a = std::get<GeographicPoint>(read.vertices[i]);
        const auto& b = std::get<GeographicPoint>(written.vertices[i]);
        EXPECT_NEAR(a.longitude.degrees(), b.longitude.degrees(), 1e-9);
        EXPECT_NEAR(a.latitude.degrees(), b.latitude.degrees(), 1e-9);
    }
}

class AnnotationFiles : public testing::TestWithParam<const char*> {
protected:
    std::string write(const std::vector<Annotation>& annotations, const std::string& name)
    {
        JobMonitor monitor;
        const auto written = writeAnnotations(annotations, folder_.file(name), monitor);
        EXPECT_TRUE(written) << (written ? "" : written.error().message);
        return folder_.file(name);
    }

    TempFolder folder_;
};

} // namespace

TEST_P(AnnotationFiles, EverythingComesBackFromEveryFormat)
{
    // The Earth's ellipsoid has other planetographic than planetocentric latitudes.
    for (const char* crs : {"IAU_2015:49900", "IAU_2015:30100", "EPSG:4326"}) {
        SCOPED_TRACE(crs);
        const Georeference map = mapOn(crs);
        const std::vector<Annotation> all = oneOfEach(map);
        const std::string file = write(all, std::string("all") + GetParam());
        const auto read = importFrom(file, map);
        ASSERT_TRUE(read) << read.error().message;
        ASSERT_EQ(read->annotations.size(), all.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            SCOPED_TRACE(all[i].name);
            expectSame(read->annotations[i], all[i]);
        }
        EXPECT_TRUE(read->notices.empty()) << read->notices.front();
    }
}

INSTANTIATE_TEST_SUITE_P(Formats,
                         AnnotationFiles,
                         testing::Values(".gpkg", ".geojson", ".kml", ".csv"));

TEST_F(AnnotationFiles, AShapefileHoldsOneShape)
{
    const Georeference map = mapOn("IAU_2015:49900");
    const std::vector<Annotation> all = oneOfEach(map);
    write(all, "all.shp");
    EXPECT_FALSE(std::filesystem::exists(folder_.file("all.shp")));
    std::size_t i = 0;
    for (const char* name : {"all-points.shp", "all-lines.shp", "all-polygons.shp"}) {
        const auto read = importFrom(folder_.file(name), map);
        ASSERT_TRUE(read) << read.error().message;
        ASSERT_EQ(read->annotations.size(), 1U);
        Annotation expected = all[i++];
        if (expected.shape == FeatureShape::Polygon) { // Shapefiles have them clockwise
            Annotation& got = const_cast<ImportedAnnotations&>(*read).annotations.front();
            std::rotate(
                got.vertices.begin(),
                std::find_if(got.vertices.begin(), got.vertices.end(),
                             [&](const DrawnVertex& vertex) {
                                 return std::abs(
                                            std::get<GeographicPoint>(vertex).longitude.degrees() -
                                            137.0) < 1e-6;
                             }),
                got.vertices.end());
            std::reverse(got.vertices.begin() + 1, got.vertices.end());
        }
        expectSame(read->annotations.front(), expected);
    }
    write({all[1]}, "faults.shp");
    EXPECT_TRUE(importFrom(folder_.file("faults.shp"), map));
}

TEST_F(AnnotationFiles, AnotherProgramReadsNamesColorsAndTheBody)
{
    const Georeference map = mapOn("IAU_2015:49900");
    const std::string file = write(oneOfEach(map), "all.gpkg");
    const std::string text = runTool({"ogrinfo", "-ro", "-al", file});
    for (const char* part :
         {"Layer name: points\nGeometry: Point", "Layer name: lines\nGeometry: Line String",
          "Layer name: polygons\nGeometry: Polygon", "Mars", "name (String) = Unit A",
          "note (String) = sampled", "color (String) = #ff0010", "symbol (String) = triangle",
          "POINT (137.44 -4.59)", "POLYGON ((137 -5"}) {
        EXPECT_THAT(text, HasSubstr(part));
    }
}

TEST_F(AnnotationFiles, LongEdgesFollowTheGeodesicsOfAnotherLibrary)
{
    const Georeference map = mapOn("IAU_2015:49900");
    const std::vector<Annotation> lines{
        drawn(map, FeatureShape::Line, "Long", {{150.0, 50.0}, {-120.0, 40.0}})};
    const auto contents = annotationFeatures(lines, FeatureLayers::One);
    ASSERT_EQ(contents.size(), 1U);
    const auto& points = contents[0].layers[0].features[0].parts[0].points;
    ASSERT_GT(points.size(), 100U);
    const GeographicLib::Geodesic geodesic(3396190.0, 0.0);
    double whole_m = 0.0;
    geodesic.Inverse(50.0, 150.0, 40.0, -120.0, whole_m);
    double along_m = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        EXPECT_LT(std::abs(points[i].x - points[i - 1].x), 20.0) << "longitudes do not jump";
        double piece_m = 0.0;
        geodesic.Inverse(points[i - 1].y, points[i - 1].x, points[i].y, points[i].x, piece_m);
        along_m += piece_m;
    }
    EXPECT_NEAR(along_m / whole_m, 1.0, 1e-9);
}

TEST_F(AnnotationFiles, AFileOfAnotherBodyIsRefusedWithTheReason)
{
    const std::string file = write(oneOfEach(mapOn("IAU_2015:49900")), "mars.gpkg");
    const auto read = importFrom(file, mapOn("IAU_2015:30100"));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::Invalid);
    EXPECT_THAT(read.error().message, HasSubstr("is on Mars, but the map is on the Moon"));
}

TEST_F(AnnotationFiles, EachBodyHasAFileOfItsOwn)
{
    std::vector<Annotation> both = oneOfEach(mapOn("IAU_2015:49900"));
    both.push_back(drawn(mapOn("IAU_2015:30100"), FeatureShape::Point, "Hadley", {{3.6, 26.1}}));
    write(both, "both.kml");
    EXPECT_FALSE(std::filesystem::exists(folder_.file("both.kml")));
    EXPECT_TRUE(importFrom(folder_.file("both-mars.kml"), mapOn("IAU_2015:49900")));
    const auto moon = importFrom(folder_.file("both-moon.kml"), mapOn("IAU_2015:30100"));
    ASSERT_TRUE(moon);
    EXPECT_EQ(moon->annotations.front().name, "Hadley");
}

TEST_F(AnnotationFiles, PartsBecomeAnnotationsAndHolesAreReported)
{
    const std::string file =
        folder_.write("parts.csv",
                      "wkt,Name,height\n"
                      "\"MULTIPOINT(1 2,3 4)\",Two,5\n"
                      "\"POLYGON((0 0,10 0,10 10,0 0),(2 1,8 1,8 6,2 1))\",Hellas,\n"
                      "\"LINESTRING(10 20,10 20)\",None,\n");
    const auto read = importFrom(file, mapOn("IAU_2015:49900"));
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->annotations.size(), 3U);
    EXPECT_EQ(read->annotations[0].name, "Two");
    EXPECT_EQ(read->annotations[1].name, "Two");
    EXPECT_EQ(read->annotations[2].vertices.size(), 3U);
    ASSERT_EQ(read->notices.size(), 2U);
    EXPECT_THAT(read->notices[0], HasSubstr("1 holes"));
    EXPECT_THAT(read->notices[1], HasSubstr("left out: height"));
}

} // namespace marsview::test
