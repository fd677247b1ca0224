#include "ui/coordinate_text.h"

#include <QLocale>

#include <gtest/gtest.h>

namespace marsview {
namespace {

RasterInfo globalMap(const Body& body)
{
    RasterInfo info;
    info.columns = 1440;
    info.rows = 720;
    info.crs = Crs::geographic(body, body.ellipsoid);
    info.body = &body;
    info.transform = GeoTransform::fromTerms({-180.0, 0.25, 0.0, 90.0, 0.0, -0.25}).value();
    return info;
}

QString textAt(const RasterInfo& info, CoordinateDisplay display, GridPoint grid)
{
    const Georeference georeference(info.columns, info.rows, *info.transform, info.crs);
    return coordinateText(display, info, georeference, grid);
}

TEST(CoordinateText, WritesLongitudesAsTheBodysTradeDoes)
{
    const GridPoint olympus{(-133.8 + 180.0) / 0.25 - 0.5, (90.0 - 18.65) / 0.25 - 0.5};
    EXPECT_EQ(textAt(globalMap(*bodyNamed("Mars")), CoordinateDisplay::Planetocentric, olympus),
              QStringLiteral("18.65° N 226.20° E"));
    EXPECT_EQ(textAt(globalMap(*bodyNamed("Earth")), CoordinateDisplay::Planetographic, olympus),
              QStringLiteral("18.65° N 133.80° W"));
}

TEST(CoordinateText, TellsTheKindsOfLatitudeApart)
{
    const RasterInfo mars = globalMap(*bodyNamed("Mars"));
    const GridPoint north{719.5, (90.0 - 45.0) / 0.25 - 0.5};
    EXPECT_EQ(textAt(mars, CoordinateDisplay::Planetocentric, north).left(5),
              QStringLiteral("45.00"));
    EXPECT_EQ(textAt(mars, CoordinateDisplay::Planetographic, north).left(5),
              QStringLiteral("45.34"));
}

TEST(CoordinateText, OffersWhatTheMapHas)
{
    using D = CoordinateDisplay;
    EXPECT_EQ(coordinateDisplays(globalMap(*bodyNamed("Mars"))),
              (std::vector{D::Planetocentric, D::Planetographic, D::Map}));
    EXPECT_EQ(coordinateDisplays(globalMap(*bodyNamed("Earth"))),
              (std::vector{D::Planetographic, D::Planetocentric, D::Map}));
    EXPECT_EQ(coordinateDisplays(globalMap(*bodyNamed("Moon"))),
              (std::vector{D::Planetocentric, D::Map}));
    EXPECT_EQ(coordinateDisplays(RasterInfo{}), (std::vector{D::Map}));
}

TEST(HeightText, NamesUnitAndDatum)
{
    RasterInfo info;
    EXPECT_EQ(heightText(info, {.minimum_m = 0.0, .maximum_m = 3000.0}, 1234.56),
              QStringLiteral("1235 m"));
    info.vertical_datum = "areoid";
    EXPECT_EQ(heightText(info, {.minimum_m = 0.0, .maximum_m = 10.0}, -0.004),
              QStringLiteral("0.00 m above areoid"));
}

} // namespace
} // namespace marsview
