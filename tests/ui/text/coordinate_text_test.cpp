#include "ui/text/coordinate_text.h"

#include <QGuiApplication>
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

Georeference georeferenceFor(const RasterInfo& info)
{
    return Georeference(info.columns, info.rows, *info.transform, info.crs);
}

QString textAt(const RasterInfo& info, const CoordinateFormat& format, GridPoint grid)
{
    return positionText(format, info, georeferenceFor(info), grid);
}

// The text for a position on the quarter-degree grid of globalMap().
GridPoint gridAt(double latitude, double longitude)
{
    return {(longitude + 180.0) / 0.25 - 0.5, (90.0 - latitude) / 0.25 - 0.5};
}

QString extentOf(const RasterInfo& info, const CoordinateFormat& format = {})
{
    const auto extent = geographicExtent(georeferenceFor(info));
    const ExtentText text = extentText(*extent, format, info);
    return text.latitudes + QStringLiteral("; ") + text.longitudes;
}

TEST(PositionText, WritesLongitudesAsIsUsualOnTheBody)
{
    const GridPoint olympus = gridAt(18.65, -133.8);
    EXPECT_EQ(textAt(globalMap(*bodyNamed("Mars")), {}, olympus),
              QStringLiteral("18.65° N, 226.20° E"));
    EXPECT_EQ(textAt(globalMap(*bodyNamed("Earth")), {}, olympus),
              QStringLiteral("18.65° N, 133.80° W"));
}

TEST(PositionText, WritesEachFormat)
{
    const RasterInfo mars = globalMap(*bodyNamed("Mars"));
    const GridPoint olympus = gridAt(18.65, -133.8);
    CoordinateFormat format{.longitudes = LongitudeNotation::West360};
    EXPECT_EQ(textAt(mars, format, olympus), QStringLiteral("18.65° N, 133.80° W"));
    format = {.angles = AngleNotation::DegreesMinutesSeconds,
              .longitudes = LongitudeNotation::EastWest180};
    EXPECT_EQ(textAt(mars, format, olympus), QStringLiteral("18° 39′ N, 133° 48′ W"));
    format.system = PositionSystem::Map;
    EXPECT_EQ(textAt(mars, format, olympus), QStringLiteral("−133.80°, 18.65°"));
}

TEST(PositionText, ResolvesATenthOfASampleOrOfAPixelOnScreen)
{
    const RasterInfo mars = globalMap(*bodyNamed("Mars"));
    const Georeference georeference = georeferenceFor(mars);
    const CoordinateFormat dms{.angles = AngleNotation::DegreesMinutesSeconds};
    const auto at = [&](const CoordinateFormat& format, double screen_pixel_m) {
        return positionText(format, mars, georeference, gridAt(18.65, 10.0), screen_pixel_m);
    };
    EXPECT_EQ(at({}, 1.0), QStringLiteral("18.65° N, 10.00° E")); // a sample is 15 km
    EXPECT_EQ(at({}, 600e3), QStringLiteral("19° N, 10° E"));     // a pixel is 10°
    RasterInfo fine = mars;
    fine.transform = GeoTransform::fromTerms({10.0, 1.2e-5, 0.0, 0.0, 0.0, -1.2e-5}).value();
    EXPECT_EQ(positionText({}, fine, georeferenceFor(fine), {-0.5, -0.5}),
              QStringLiteral("0.000000° N, 10.000000° E"));
    EXPECT_EQ(positionText(dms, fine, georeferenceFor(fine), {-0.5, -0.5}),
              QStringLiteral("0° 00′ 00.000″ N, 10° 00′ 00.000″ E"));
}

TEST(PositionText, DistinguishesTheKindsOfLatitudeOnTheirBodyOnly)
{
    CoordinateFormat format;
    format.setLatitudesOn(bodyNamed("Mars"), LatitudeKind::Planetographic);
    const GridPoint north = gridAt(45.0, 0.0);
    // tan(graphic) = tan(centric) (a / b)²
    EXPECT_EQ(textAt(globalMap(*bodyNamed("Mars")), {}, north).left(5), QStringLiteral("45.00"));
    EXPECT_EQ(textAt(globalMap(*bodyNamed("Mars")), format, north).left(5),
              QStringLiteral("45.34"));
    // The Earth grid is geodetic already.
    EXPECT_EQ(textAt(globalMap(*bodyNamed("Earth")), format, north).left(5),
              QStringLiteral("45.00"));
    format.setLatitudesOn(bodyNamed("Earth"), LatitudeKind::Planetocentric);
    EXPECT_EQ(textAt(globalMap(*bodyNamed("Earth")), format, north).left(5),
              QStringLiteral("44.81"));
}

TEST(PositionText, FollowsTheLocaleAndIsolatesItselfFromRightToLeft)
{
    const RasterInfo mars = globalMap(*bodyNamed("Mars"));
    const GridPoint olympus = gridAt(18.65, -133.8);
    QLocale::setDefault(QLocale(QLocale::German));
    EXPECT_EQ(textAt(mars, {}, olympus), QStringLiteral("18,65° N, 226,20° E"));
    QLocale::setDefault(QLocale::c());
    QGuiApplication::setLayoutDirection(Qt::RightToLeft);
    EXPECT_EQ(textAt(mars, {}, olympus), QStringLiteral("\u206618.65° N, 226.20° E\u2069"));
    QGuiApplication::setLayoutDirection(Qt::LeftToRight);
}

TEST(PositionText, UsesMapCoordinatesWhereThereAreNoLongitudes)
{
    RasterInfo plain;
    plain.columns = 10;
    plain.rows = 10;
    plain.transform = GeoTransform::fromTerms({500000.0, 30.0, 0.0, 4e6, 0.0, -30.0}).value();
    EXPECT_EQ(textAt(plain, {}, {0.5, 0.5}), QStringLiteral("500030, 3999970"));
    EXPECT_EQ(formatName({}, plain), QStringLiteral("map, no CRS"));
}

TEST(FormatName, NamesTheKindOfLatitude)
{
    EXPECT_EQ(formatName({}, globalMap(*bodyNamed("Mars"))), QStringLiteral("planetocentric"));
    EXPECT_EQ(formatName({}, globalMap(*bodyNamed("Earth"))), QStringLiteral("geodetic"));
}

TEST(ExtentText, NamesTheHemispheres)
{
    RasterInfo mars = globalMap(*bodyNamed("Mars"));
    EXPECT_EQ(extentOf(mars), QStringLiteral("90° S – 90° N; 0° E – 360° E"));
    EXPECT_EQ(extentOf(mars, {.longitudes = LongitudeNotation::EastWest180}),
              QStringLiteral("90° S – 90° N; 180° W – 180° E"));
    RasterInfo tile = globalMap(*bodyNamed("Earth"));
    tile.columns = tile.rows = 1201;
    constexpr double kStep = 1.0 / 1200.0; // as SRTM tiles extend half a sample beyond the degree
    tile.transform =
        GeoTransform::fromTerms({-72.0 - kStep / 2.0, kStep, 0.0, -17.0 + kStep / 2.0, 0.0, -kStep})
            .value();
    EXPECT_EQ(extentOf(tile), QStringLiteral("18° S – 17° S; 72° W – 71° W"));
}

TEST(HeightText, NamesUnitAndDatum)
{
    RasterInfo info;
    EXPECT_EQ(heightText(info, {.minimum_m = 0.0, .maximum_m = 3000.0}, 1234.56),
              QStringLiteral("1235 m"));
    info.vertical_datum = "areoid";
    EXPECT_EQ(heightText(info, {.minimum_m = 0.0, .maximum_m = 10.0}, -0.004),
              QStringLiteral("0.00 m (areoid)"));
}

TEST(DatumText, WritesTheRadiusOfASphereInGroups)
{
    const QLocale before;
    QLocale::setDefault(QLocale(QLocale::English));
    RasterInfo info;
    EXPECT_EQ(datumText(info), QString());
    info.reference_radius_m = 1737400.0;
    info.vertical_datum = "sphere of radius 1737400 m"; // as commands print it
    EXPECT_EQ(datumText(info), QStringLiteral("sphere of radius 1,737,400 m"));
    info.vertical_datum = "of the user";
    EXPECT_EQ(datumText(info), QStringLiteral("of the user"));
    QLocale::setDefault(before);
}

TEST(PixelAngleText, UsesTheUnitThatNeedsTheFewestDigits)
{
    const QLocale before;
    QLocale::setDefault(QLocale::c());
    EXPECT_EQ(pixelAngleText(0.25), QStringLiteral("0.25°"));
    EXPECT_EQ(pixelAngleText(0.015625), QStringLiteral("0.015625°"));
    EXPECT_EQ(pixelAngleText(5.0 / 60.0), QStringLiteral("5′"));
    EXPECT_EQ(pixelAngleText(0.000833333333), QStringLiteral("3″"));
    EXPECT_EQ(pixelAngleText(0.0008333333535119891), QStringLiteral("3″")) << "from floats";
    EXPECT_EQ(pixelAngleText(1.0 / 3600.0 / 3.0), QStringLiteral("0.33333″"));
    EXPECT_EQ(pixelAngleText(0.0019538483), QStringLiteral("7.0339″"));
    QLocale::setDefault(before);
}

} // namespace
} // namespace marsview
