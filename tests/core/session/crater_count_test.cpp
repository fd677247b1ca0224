// Counts of craters: which craters count, and what Craterstats finds in the files. The layout of
// the files is that of CraterTools, OpenCraterTool and Craterstats 3.
#include "core/session/crater_count.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

namespace marsview {
namespace {

using testing::HasSubstr;

constexpr double kRadiusM = 3396190.0;

NamedMeasurement named(MeasurementKind kind, const char* name, const char* crs)
{
    NamedMeasurement measurement;
    measurement.measurement.kind = kind;
    measurement.measurement.name = name;
    measurement.crs = *Crs::fromText(crs);
    return measurement;
}

void setValues(NamedMeasurement& measurement, MeasuredValues values)
{
    measurement.measurement.result = std::make_shared<const MeasurementResult>(
        MeasurementResult{.map = {}, .values = std::move(values)});
}

NamedMeasurement
crater(double lon, double lat, double diameter_m, const char* crs = "IAU_2015:49900")
{
    NamedMeasurement measurement = named(MeasurementKind::Crater, "Crater", crs);
    Crater values;
    values.center = {lon, lat};
    values.diameter_m = diameter_m;
    setValues(measurement, values);
    return measurement;
}

NamedMeasurement area(const std::vector<std::pair<double, double>>& lonlat,
                      const char* crs = "IAU_2015:49900")
{
    NamedMeasurement measurement = named(MeasurementKind::Area, "Plain", crs);
    for (const auto& [lon, lat] : lonlat) {
        measurement.measurement.vertices.emplace_back(
            GeographicPoint{Angle::degrees(lon), Angle::degrees(lat)});
    }
    setValues(measurement, TerrainArea{});
    return measurement;
}

// The numbers of the table that begins with `title`.
std::vector<std::vector<double>> table(const std::string& text, const std::string& title)
{
    std::vector<std::vector<double>> rows;
    std::istringstream stream(text.substr(text.find(title)));
    std::string line;
    std::getline(stream, line);
    while (std::getline(stream, line) && line != "}") {
        if (line.starts_with('#')) {
            continue;
        }
        std::istringstream fields(line);
        std::vector<double> row;
        for (std::string field; fields >> field;) {
            row.push_back(field == "ext" ? -1.0 : std::stod(field));
        }
        rows.push_back(row);
    }
    return rows;
}

TEST(CraterCount, CountsTheCratersWhoseCentersLieInTheArea)
{
    const std::vector<NamedMeasurement> measurements{
        area({{175.0, -5.0}, {-175.0, -5.0}, {-175.0, 5.0}, {175.0, 5.0}}), // across 180°
        crater(179.0, 1.0, 1200.0),
        crater(-178.0, -4.0, 350.5),
        crater(181.0, 4.0, 77.0), // another turn
        crater(170.0, 0.0, 5000.0),
        crater(0.0, 0.0, 5000.0),
        crater(180.0, 8.0, 5000.0),
    };
    const auto count = craterCount(measurements);
    ASSERT_TRUE(count) << count.error().message;
    ASSERT_EQ(count->craters.size(), 3U);
    EXPECT_EQ(count->craters[1].diameter_m, 350.5);
    EXPECT_EQ(count->outside, 3U);
}

TEST(CraterCount, KnowsTheInsideAroundAPole)
{
    const Ground ground = Ground::onEllipsoid({kRadiusM, 3376200.0});
    const std::vector<GroundPosition> cap{{0.0, 80.0}, {90.0, 80.0}, {180.0, 80.0}, {270.0, 80.0}};
    EXPECT_TRUE(isInside(ground, cap, {33.0, 89.0}));
    EXPECT_TRUE(isInside(ground, cap, {135.0, 84.0}));
    EXPECT_FALSE(isInside(ground, cap, {135.0, 81.0})) << "edges bend toward the pole";
    EXPECT_TRUE(isInside(ground, cap, {1.0, 80.9}));
    EXPECT_FALSE(isInside(ground, cap, {10.0, -85.0}));
}

TEST(CraterCount, TheSpatialCountFileHasBordersAndKilometers)
{
    const std::vector<NamedMeasurement> measurements{
        area({{10.0, 0.0}, {100.0, 0.0}, {100.0, 90.0}}), // an eighth of the sphere
        crater(50.0, 30.0, 12345.5),
        crater(55.0, 20.0, 800.0),
    };
    const auto count = craterCount(measurements);
    ASSERT_TRUE(count) << count.error().message;
    const std::string text = sccText(*count);
    EXPECT_THAT(text, HasSubstr("\na_axis_radius = 3396.19 <km>\n"));
    EXPECT_THAT(text, HasSubstr("\nc_axis_radius = 3396.19 <km>\n"));
    const auto border = table(text, "unit_boundary = {vertex, sub_area, tag, lon, lat\n");
    ASSERT_EQ(border.size(), 4U);
    EXPECT_EQ(border.front(), (std::vector<double>{1, 1, -1, 10.0, 0.0}));
    EXPECT_EQ(border.back(), (std::vector<double>{4, 1, -1, 10.0, 0.0}));
    const auto craters = table(text, "crater = {diam, fraction, lon, lat, topo_scale_factor\n");
    ASSERT_EQ(craters.size(), 2U);
    EXPECT_EQ(craters.front(), (std::vector<double>{12.3455, 1, 50.0, 30.0, 1}));
    const double eighth_km2 = 4.0 * std::numbers::pi * 3396.19 * 3396.19 / 8.0;
    const auto value = [&](const char* name) {
        return std::stod(text.substr(text.find(name) + std::string(name).size()));
    };
    EXPECT_NEAR(value("\nTotal_area = ") / eighth_km2, 1.0, 1e-9);
    EXPECT_NEAR(value("\nTotal_perimeter = ") / (1.5 * std::numbers::pi * 3396.19), 1.0, 1e-9);
    const std::string diameters = diamText(*count);
    EXPECT_NEAR(std::stod(diameters.substr(diameters.find("\narea = ") + 8)) / eighth_km2, 1.0,
                1e-9);
    EXPECT_EQ(table(diameters, "crater = {diameter, fraction, lon, lat\n").back(),
              (std::vector<double>{0.8, 1, 55.0, 20.0}));
}

TEST(CraterCount, SaysWhatIsMissing)
{
    const auto problem = [](const std::vector<NamedMeasurement>& measurements) {
        const auto count = craterCount(measurements);
        return count ? std::string() : count.error().message;
    };
    const auto square = area({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}});
    EXPECT_THAT(problem({square}), HasSubstr("measure some first"));
    EXPECT_THAT(problem({crater(0.5, 0.5, 10.0)}), HasSubstr("needs the area"));
    EXPECT_THAT(problem({square, crater(0.5, 0.5, 10.0, "IAU_2015:30100")}),
                HasSubstr("on different bodies"));
    EXPECT_THAT(problem({square, crater(5.0, 0.5, 10.0)}), HasSubstr("none of the craters"));
    NamedMeasurement flat = crater(0.5, 0.5, 10.0);
    flat.crs.reset();
    EXPECT_THAT(problem({square, flat}), HasSubstr("map without a body"));
}

} // namespace
} // namespace marsview
