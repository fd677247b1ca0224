// What another program reads in a file of measurements: GDAL's ogrinfo, and GeographicLib for the
// lines on the ellipsoid.
#include "core/session/measurement_features.h"
#include "core/session/open_map.h"
#include "tests/support/map_maker.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicLine.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace marsview::test {
namespace {

using testing::HasSubstr;

NamedMeasurement measuredOn(const Map& map,
                            MeasurementKind kind,
                            const std::vector<std::pair<double, double>>& lonlat)
{
    NamedMeasurement named{.measurement = {.kind = kind, .name = "Rim “north”"},
                           .layer_name = "MOLA",
                           .crs = map.georeference().crs()};
    for (const auto& [longitude, latitude] : lonlat) {
        named.measurement.vertices.emplace_back(
            GeographicPoint{Angle::degrees(longitude), Angle::degrees(latitude)});
    }
    named.measurement.area.base = VolumeBase::BorderPlane;
    JobMonitor monitor;
    named.measurement.result = measured(named.measurement, map, MeasureDetail::Full, monitor);
    return named;
}

} // namespace

TEST(MeasurementFeatures, LinesAreTheGeodesicsOfAnotherLibrary)
{
    const auto map = loadedMap(bundledMars());
    // Long, and across the meridian at which longitudes jump.
    const std::vector<NamedMeasurement> measurements{measuredOn(
        *map, MeasurementKind::Distance, {{150.0, 50.0}, {-120.0, 40.0}, {-60.0, -70.0}})};
    const std::vector<FeatureCollection> contents = measurementFeatures(measurements);
    ASSERT_EQ(contents.size(), 1U);
    ASSERT_EQ(contents.front().layers.size(), 1U);
    const auto& points = contents.front().layers.front().features.front().parts.front().points;
    const Ellipsoid& ellipsoid = *map->georeference().crs()->ellipsoid();
    const GeographicLib::Geodesic geodesic(ellipsoid.equatorial_m, 0.0);
    const auto line = geodesic.InverseLine(50.0, 150.0, 40.0, -120.0);
    double along_m = 0.0;
    std::size_t checked = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        EXPECT_LT(std::abs(points[i].x - points[i - 1].x), 20.0) << "longitudes do not jump";
        double piece_m = 0.0;
        geodesic.Inverse(points[i - 1].y, points[i - 1].x, points[i].y, points[i].x, piece_m);
        EXPECT_LT(piece_m, 0.0088 * ellipsoid.equatorial_m);
        along_m += piece_m;
        if (along_m < line.Distance() * (1.0 + 1e-9)) {
            double latitude = 0.0;
            double longitude = 0.0;
            line.Position(along_m, latitude, longitude);
            EXPECT_NEAR(points[i].y, latitude, 1e-7);
            EXPECT_NEAR(std::remainder(points[i].x - longitude, 360.0), 0.0, 1e-7);
            ++checked;
        }
    }
    EXPECT_GT(checked, 100U);
    EXPECT_NEAR(along_m, std::get<Distance>(*measurements[0].measurement.result->values).geodesic_m,
                1e-6 * along_m);
}

TEST(MeasurementFeatures, AnotherProgramReadsEveryKindWithItsResults)
{
    const auto map = loadedMap(bundledMars());
    const std::vector<std::pair<double, double>> corners{
        {-134.5, 17.5}, {-132.5, 17.5}, {-132.5, 19.5}, {-134.5, 19.5}};
    std::vector<NamedMeasurement> measurements;
    for (const MeasurementKind kind :
         {MeasurementKind::Distance, MeasurementKind::Area, MeasurementKind::Profile,
          MeasurementKind::Attitude, MeasurementKind::Crater, MeasurementKind::Slope}) {
        measurements.push_back(measuredOn(*map, kind, corners));
    }
    const TempFolder folder;
    const std::string file = folder.file("measured.gpkg");
    const Status written = writeMeasurements(measurements, file);
    ASSERT_TRUE(written) << written.error().message;

    const std::string summary = runTool({"ogrinfo", "-ro", "-so", "-al", file});
    for (const char* part :
         {"Layer name: distances\nGeometry: Line String", "Layer name: areas\nGeometry: Polygon",
          "Layer name: profiles\nGeometry: Line String", "Layer name: attitudes\nGeometry: Point",
          "Layer name: craters\nGeometry: Polygon", "Mars"}) {
        EXPECT_THAT(summary, HasSubstr(part));
    }
    const auto& area = std::get<TerrainArea>(*measurements[1].measurement.result->values);
    const std::string text = runTool({"ogrinfo", "-ro", "-q", "-geom=NO", file, "areas"});
    EXPECT_THAT(text, HasSubstr("name (String) = Rim “north”"));
    EXPECT_THAT(text, HasSubstr("layer (String) = MOLA"));
    const auto value_at = [&text](const std::string& field) {
        const std::size_t at = text.find(field + " (Real) = ");
        return at == std::string::npos ? -1.0 : std::stod(text.substr(at + field.size() + 10));
    };
    EXPECT_NEAR(value_at("area_m2") / area.geodesic_m2, 1.0, 1e-12);
    EXPECT_NEAR(value_at("perimeter_m") / area.perimeter_m, 1.0, 1e-12);
    EXPECT_NEAR(value_at("volume_above_m3") / *area.volume_above_m3, 1.0, 1e-12);
}

TEST(MeasurementFeatures, EachBodyHasAFileOfItsOwn)
{
    const auto mars = loadedMap(bundledMars());
    RasterOverrides as_moon;
    as_moon.crs = "IAU_2015:30100";
    const auto moon = overridden(*mars, as_moon);
    ASSERT_TRUE(moon) << moon.error().message;
    const std::vector<NamedMeasurement> measurements{
        measuredOn(*mars, MeasurementKind::Slope, {{10.0, 10.0}}),
        measuredOn(**moon, MeasurementKind::Slope, {{20.0, 20.0}})};
    const TempFolder folder;
    ASSERT_TRUE(writeMeasurements(measurements, folder.file("both.gpkg")));
    EXPECT_THAT(runTool({"ogrinfo", "-ro", "-so", "-al", folder.file("both-mars.gpkg")}),
                HasSubstr("Mars"));
    EXPECT_THAT(runTool({"ogrinfo", "-ro", "-so", "-al", folder.file("both-moon.gpkg")}),
                HasSubstr("Moon"));
    EXPECT_FALSE(std::filesystem::exists(folder.file("both.gpkg")));
}

} // namespace marsview::test
