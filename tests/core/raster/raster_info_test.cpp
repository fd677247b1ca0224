#include "core/geo/known_elevations.h"
#include "core/raster/raster_info.h"
#include "core/raster/sample_suggestions.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace marsview {
namespace {

RasterInfo mars()
{
    RasterInfo info;
    info.columns = 1440;
    info.rows = 720;
    info.transform = *GeoTransform::fromTerms({0, 0.25, 0, 90, 0, -0.25});
    info.crs = *Crs::fromText("IAU_2015:49900");
    info.body = info.crs->body();
    return info;
}

TEST(RasterInfo, AppliesScaleOffsetUnitAndReferenceInThatOrder)
{
    RasterInfo info;
    info.scale = 0.5;
    info.offset = 10.0;
    info.unit = {"ft", 0.3048};
    info.reference_radius_m = 3.0;
    EXPECT_DOUBLE_EQ(info.elevationScale().height(100.0), (100.0 * 0.5 + 10.0) * 0.3048 - 3.0);
}

TEST(RasterInfo, CountsTwoTrianglesPerCell)
{
    RasterInfo info;
    info.columns = std::size_t{1} << 24;
    info.rows = std::size_t{1} << 24;
    const std::uint64_t side = (std::uint64_t{1} << 24) - 1;
    EXPECT_EQ(info.triangleCount(), 2 * side * side);
}

TEST(HeightReference, AnOffsetNearTheRadiusMeansRadii)
{
    RasterInfo info = mars();
    info.scale = 0.5;
    info.offset = 3396000.0;
    deduceHeightReference(info);
    ASSERT_TRUE(info.reference_radius_m);
    EXPECT_EQ(*info.reference_radius_m, 3396000.0);
    EXPECT_EQ(info.elevationScale().height(0.0), 0.0);
    EXPECT_NE(info.vertical_datum.find("3396000"), std::string::npos);
}

TEST(HeightReference, ATypicalSampleNearTheRadiusMeansRadii)
{
    RasterInfo info = mars();
    info.typical_raw = 3389500.0;
    deduceHeightReference(info);
    ASSERT_TRUE(info.reference_radius_m);
    EXPECT_EQ(*info.reference_radius_m, 3396190.0);
}

TEST(HeightReference, RadiiInKilometersAreRecognized)
{
    RasterInfo info = mars();
    info.unit = {"km", 1000.0};
    info.typical_raw = 3389.5;
    deduceHeightReference(info);
    EXPECT_TRUE(info.reference_radius_m);
}

TEST(HeightReference, HeightsAreNotRadii)
{
    for (const double typical : {-8200.0, 0.0, 21229.0, 1e5}) {
        RasterInfo info = mars();
        info.typical_raw = typical;
        deduceHeightReference(info);
        EXPECT_FALSE(info.reference_radius_m) << typical;
    }
    RasterInfo nowhere; // without a CRS or a body there is nothing to compare with
    nowhere.typical_raw = 3389500.0;
    deduceHeightReference(nowhere);
    EXPECT_FALSE(nowhere.reference_radius_m);
}

TEST(HeightReference, IsDroppedWhenTheUnitNoLongerMakesRadii)
{
    RasterInfo info = mars();
    info.typical_raw = 3389.5;
    info.unit = {"km", 1000.0};
    deduceHeightReference(info);
    ASSERT_TRUE(info.reference_radius_m);
    info.unit = {"m", 1.0};
    deduceHeightReference(info);
    EXPECT_FALSE(info.reference_radius_m);
    EXPECT_EQ(info.vertical_datum, "");
}

TEST(Overrides, WithoutOverridesTheFileIsUnchanged)
{
    const auto info = withOverrides(mars(), {});
    ASSERT_TRUE(info);
    EXPECT_EQ(info->crs->name(), mars().crs->name());
    EXPECT_EQ(info->transform, mars().transform);
    EXPECT_TRUE(RasterOverrides{}.isEmpty());
}

TEST(Overrides, EachReplacesOnlyItsOwnField)
{
    RasterOverrides overrides;
    overrides.crs = "EPSG:32610";
    overrides.transform = GeoTransform::Terms{1, 2, 0, 3, 0, -4};
    overrides.vertical_unit = "ft";
    overrides.nodata = -5.0;
    EXPECT_FALSE(overrides.isEmpty());
    const auto info = withOverrides(mars(), overrides);
    ASSERT_TRUE(info) << info.error().message;
    EXPECT_EQ(info->crs->name(), "WGS 84 / UTM zone 10N");
    EXPECT_EQ(info->body->name, "Earth");
    EXPECT_EQ(info->transform->terms(), *overrides.transform);
    EXPECT_EQ(info->unit.name, "ft");
    EXPECT_TRUE(info->is_unit_declared);
    EXPECT_EQ(info->nodata, -5.0);
}

TEST(Overrides, RadiiReplaceTheEllipsoidOnly)
{
    RasterOverrides overrides;
    overrides.ellipsoid = Ellipsoid{3396000.0, 3396000.0};
    const auto info = withOverrides(mars(), overrides);
    ASSERT_TRUE(info) << info.error().message;
    EXPECT_EQ(*info->crs->ellipsoid(), *overrides.ellipsoid);
    EXPECT_EQ(info->body->name, "Mars");
}

TEST(Overrides, ABodyGivesItsEllipsoid)
{
    RasterOverrides overrides;
    overrides.body = "Moon";
    const auto info = withOverrides(mars(), overrides);
    ASSERT_TRUE(info) << info.error().message;
    EXPECT_EQ(info->body->name, "Moon");
    EXPECT_EQ(info->crs->ellipsoid()->equatorial_m, 1737400.0);
    EXPECT_EQ(info->crs->body()->name, "Moon");
}

TEST(Overrides, RadiiOfAnUnknownBodyTurnABareGlobalGridIntoDegrees)
{
    RasterInfo bare;
    bare.columns = 360;
    bare.rows = 180;
    bare.transform = *GeoTransform::fromTerms({0, 1, 0, 90, 0, -1});
    RasterOverrides overrides;
    overrides.ellipsoid = Ellipsoid{123456.0, 120000.0};
    const auto info = withOverrides(bare, overrides);
    ASSERT_TRUE(info) << info.error().message;
    ASSERT_TRUE(info->crs);
    EXPECT_EQ(info->crs->kind(), CrsKind::Geographic);
    EXPECT_NEAR(info->crs->ellipsoid()->equatorial_m, 123456.0, 1e-6);
    EXPECT_NEAR(info->crs->ellipsoid()->polar_m, 120000.0, 1e-6);
    EXPECT_EQ(info->body, nullptr);
}

// Without a CRS, radii would change nothing.
TEST(Overrides, RadiiAreRefusedForAGridThatIsNotInDegrees)
{
    RasterInfo bare;
    bare.columns = 360;
    bare.rows = 180;
    bare.transform = *GeoTransform::fromTerms({1000, 100, 0, 2000, 0, -100});
    RasterOverrides overrides;
    overrides.ellipsoid = Ellipsoid{123456.0, 120000.0};
    const auto info = withOverrides(bare, overrides);
    ASSERT_FALSE(info);
    EXPECT_TRUE(info.error().message.starts_with("radii: the raster has no CRS"));
    EXPECT_EQ(refusedField(info.error()), OverrideField::Radii);
}

TEST(Overrides, ABodyTurnsABareGlobalGridIntoDegrees)
{
    RasterInfo bare;
    bare.columns = 360;
    bare.rows = 180;
    bare.transform = *GeoTransform::fromTerms({0, 1, 0, 90, 0, -1});
    RasterOverrides overrides;
    overrides.body = "Vesta";
    const auto info = withOverrides(bare, overrides);
    ASSERT_TRUE(info) << info.error().message;
    ASSERT_TRUE(info->crs);
    EXPECT_EQ(info->crs->kind(), CrsKind::Geographic);
    EXPECT_EQ(info->crs->latitudeKind(), LatitudeKind::Planetocentric);
    EXPECT_FALSE(info->notices.empty());
    bare.transform = *GeoTransform::fromTerms({5e5, 30, 0, 4e6, 0, -30});
    const auto meters = withOverrides(bare, overrides);
    ASSERT_TRUE(meters);
    EXPECT_FALSE(meters->crs);
    EXPECT_EQ(meters->body->name, "Vesta");
}

TEST(Overrides, ScaleAndOffsetAreInTheVerticalUnit)
{
    RasterInfo file = mars();
    file.scale = 2.0;
    file.offset = 7.0;
    file.unit = {"km", 1000.0};
    RasterOverrides overrides;
    overrides.scale = 0.1;
    overrides.offset = -20.0;
    overrides.vertical_unit = "ft";
    const auto info = withOverrides(file, overrides);
    ASSERT_TRUE(info) << info.error().message;
    EXPECT_DOUBLE_EQ(info->elevationScale().height(1234.0), (1234.0 * 0.1 - 20.0) * 0.3048);
    // Each override replaces only its own number.
    overrides.offset.reset();
    EXPECT_DOUBLE_EQ(withOverrides(file, overrides)->elevationScale().height(100.0),
                     (100.0 * 0.1 + 7.0) * 0.3048);
    overrides.scale = -1.0; // depths
    EXPECT_DOUBLE_EQ(withOverrides(file, overrides)->elevationScale().height(100.0),
                     (100.0 * -1.0 + 7.0) * 0.3048);
}

TEST(Overrides, ScaleAndOffsetRedetermineHeightsOrRadii)
{
    RasterInfo file = mars();
    RasterOverrides overrides;
    overrides.offset = 3396000.0; // as in MOLA's labels of radii
    const auto radii = withOverrides(file, overrides);
    ASSERT_TRUE(radii);
    EXPECT_EQ(radii->reference_radius_m, 3396000.0);
    EXPECT_EQ(radii->elevationScale().height(100.0), 100.0);
    EXPECT_EQ(radii->vertical_datum, "sphere of radius 3396000 m");
    file.offset = 3396000.0;
    deduceHeightReference(file);
    overrides.offset = 0.0;
    const auto heights = withOverrides(file, overrides);
    ASSERT_TRUE(heights);
    EXPECT_FALSE(heights->reference_radius_m);
    EXPECT_EQ(heights->vertical_datum, "");
    file.offset = 0.0;
    file.typical_raw = 33895.0; // hundreds of meters
    overrides.offset.reset();
    overrides.scale = 100.0;
    EXPECT_EQ(withOverrides(file, overrides)->reference_radius_m, 3396190.0);
}

TEST(Overrides, TheUserNamesTheVerticalDatum)
{
    RasterInfo file = mars();
    file.vertical_datum = "mean sea level";
    RasterOverrides overrides;
    overrides.vertical_datum = "areoid";
    EXPECT_EQ(withOverrides(file, overrides)->vertical_datum, "areoid");
    overrides.offset = 3396000.0;
    EXPECT_EQ(withOverrides(file, overrides)->vertical_datum, "areoid");
}

TEST(Overrides, ErrorsNameTheField)
{
    const std::vector<std::pair<OverrideField, RasterOverrides>> bad{
        {OverrideField::Crs, {.crs = "EPSG:99999999"}},
        {OverrideField::Crs, {.crs = "EPSG:4978"}},
        {OverrideField::Body, {.body = "Vulcan"}},
        {OverrideField::Radii, {.ellipsoid = Ellipsoid{0.0, 0.0}}},
        {OverrideField::Transform, {.transform = GeoTransform::Terms{0, 0, 0, 0, 0, 0}}},
        {OverrideField::VerticalUnit, {.vertical_unit = "parsec"}},
        {OverrideField::Scale, {.scale = 0.0}},
        {OverrideField::Scale, {.scale = kNan}},
        {OverrideField::Scale, {.scale = -std::numeric_limits<double>::infinity()}},
        {OverrideField::Scale, {.vertical_unit = "km", .scale = 1e308}},
        {OverrideField::Offset, {.offset = kNan}},
        {OverrideField::Offset, {.offset = std::numeric_limits<double>::infinity()}},
        {OverrideField::VerticalDatum, {.vertical_datum = "  "}},
    };
    for (const auto& [field, overrides] : bad) {
        const auto info = withOverrides(mars(), overrides);
        ASSERT_FALSE(info) << static_cast<int>(field);
        const std::string& message = info.error().message;
        EXPECT_EQ(refusedField(info.error()), field) << message;
        EXPECT_EQ(refusedField({info.error().code, "/maps/scale: x/a.tif: " + message}), field);
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
    EXPECT_FALSE(refusedField({ErrorCode::NotFound, "a.tif: does not exist"}));
}

TEST(Overrides, UnusableValuesAreRefusedInOneSentence)
{
    std::vector<RasterOverrides> bad(8);
    bad[0].crs = "EPSG:99999999";
    bad[1].crs = "EPSG:4978"; // geocentric
    bad[2].body = "Vulcan";
    bad[3].ellipsoid = Ellipsoid{0.0, 0.0};
    bad[4].ellipsoid = Ellipsoid{3396190.0, kNan};
    bad[5].vertical_unit = "parsec";
    bad[6].transform = GeoTransform::Terms{0, 0, 0, 0, 0, 0};
    bad[7].transform = GeoTransform::Terms{kNan, 1, 0, 0, 0, -1};
    for (std::size_t i = 0; i < bad.size(); ++i) {
        const auto info = withOverrides(mars(), bad[i]);
        ASSERT_FALSE(info) << i;
        const std::string& message = info.error().message;
        EXPECT_FALSE(message.empty());
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_NE(message.back(), '.') << message;
    }
}

// Radii must always be checked: here no CRS would check them.
TEST(Overrides, BadRadiiAreRefusedEvenWithoutACrs)
{
    RasterInfo bare;
    bare.columns = 360;
    bare.rows = 180;
    for (const bool has_degrees : {false, true}) {
        if (has_degrees) {
            bare.transform = *GeoTransform::fromTerms({0, 1, 0, 90, 0, -1});
        }
        for (const char* body : {"", "Mars"}) {
            RasterOverrides overrides;
            if (*body != '\0') {
                overrides.body = body;
            }
            overrides.ellipsoid = Ellipsoid{-5.0, 0.0};
            EXPECT_FALSE(withOverrides(bare, overrides)) << has_degrees << " " << body;
        }
    }
}

TEST(UndeclaredNodata, ValuesThatUsuallyMarkItAreSuggested)
{
    const auto suggested = [](SampleType type, double low, double high) {
        RasterInfo info = mars();
        info.type = type;
        SampleStatistics statistics;
        statistics.sample_count = 4;
        statistics.raw_minimum = low;
        statistics.raw_maximum = high;
        noteSuspiciousSamples(info, statistics);
        const bool is_noted =
            info.nodata_suggestion && std::count(info.notices.begin(), info.notices.end(),
                                                 noticeOfNodata(*info.nodata_suggestion)) == 1;
        EXPECT_EQ(is_noted, info.nodata_suggestion.has_value());
        return info.nodata_suggestion;
    };
    EXPECT_EQ(suggested(SampleType::Int16, -32767.0, 2400.0), -32767.0);
    EXPECT_EQ(suggested(SampleType::Int16, -32768.0, 2400.0), -32768.0);
    EXPECT_EQ(suggested(SampleType::Float32, -9999.0, 2400.0), -9999.0);
    const double lowest = -std::numeric_limits<float>::max();
    EXPECT_EQ(suggested(SampleType::Float32, lowest, 2400.0), lowest);
    EXPECT_EQ(suggested(SampleType::Float32, -10.0, static_cast<double>(9.96921e36F)),
              static_cast<double>(9.96921e36F));
    EXPECT_EQ(suggested(SampleType::UInt16, 0.0, 65535.0), 65535.0);
    EXPECT_EQ(suggested(SampleType::Float32, 0.0, 65535.0), std::nullopt);
    EXPECT_EQ(suggested(SampleType::Int16, -8201.0, 21241.0), std::nullopt);
}

TEST(UndeclaredNodata, IsCertainBeyondAllElevations)
{
    RasterInfo info;
    EXPECT_FALSE(certainNodata(info));
    info.nodata_suggestion = -32767.0;
    EXPECT_EQ(certainNodata(info), -32767.0);
    info.scale = 0.1; // -3276.7 m
    EXPECT_FALSE(certainNodata(info));
    info.scale = 1.0;
    info.nodata_suggestion = -9999.0; // lower than any place on Mars or the Moon
    EXPECT_EQ(certainNodata(info), -9999.0);
    info.nodata_suggestion = 65535.0;
    EXPECT_EQ(certainNodata(info), 65535.0);
    info.scale = 0.01;
    EXPECT_FALSE(certainNodata(info));
    info.nodata_suggestion = -3.4028234663852886e38;
    EXPECT_EQ(certainNodata(info), -3.4028234663852886e38);
}

TEST(UndeclaredNodata, ADeclaredValueIsTrusted)
{
    RasterInfo info = mars();
    info.nodata = -32768.0;
    SampleStatistics statistics;
    statistics.sample_count = 4;
    statistics.raw_minimum = -9999.0;
    statistics.raw_maximum = 2400.0;
    noteSuspiciousSamples(info, statistics);
    EXPECT_EQ(info.nodata_suggestion, std::nullopt);
    EXPECT_TRUE(info.notices.empty());
}

RasterInfo earth(const char* crs = "EPSG:4326")
{
    RasterInfo info;
    info.crs = *Crs::fromText(crs);
    info.body = info.crs->body();
    return info;
}

// A unit name, and the elevation that is the reason, if there is one.
std::string suggestedUnit(const RasterInfo& info, double low, double high)
{
    SampleStatistics statistics;
    statistics.sample_count = 4;
    statistics.raw_minimum = low;
    statistics.raw_maximum = high;
    RasterInfo with_notices = info;
    noteSuspiciousSamples(with_notices, statistics);
    const bool is_noted = with_notices.unit_suggestion &&
                          std::count(with_notices.notices.begin(), with_notices.notices.end(),
                                     noticeOf(*with_notices.unit_suggestion)) == 1;
    EXPECT_EQ(is_noted, with_notices.unit_suggestion.has_value());
    if (!with_notices.unit_suggestion) {
        return "";
    }
    const auto reason = with_notices.unit_suggestion->implausible_m;
    return with_notices.unit_suggestion->unit.name + (reason ? fmt::format(" {}", *reason) : "");
}

// Culebra Peak, Colorado, is at 14,053 ft; Mount Everest at 8,849 m, which are 29,032 ft; the
// Challenger Deep at -35,876 ft.
TEST(UndeclaredUnit, ElevationsThatTheEarthDoesNotHaveInMetersAreInFeet)
{
    EXPECT_EQ(suggestedUnit(earth(), 4458.0, 14176.0), "ft 14176");
    EXPECT_EQ(suggestedUnit(earth(), 0.0, 29032.0), "ft 29032");
    EXPECT_EQ(suggestedUnit(earth(), -35876.0, 0.0), "ft -35876");
    EXPECT_EQ(suggestedUnit(earth(), -10935.0, 8849.0), "");
    EXPECT_EQ(suggestedUnit(earth(), 0.0, 32000.0), "") << "not in feet either";
    EXPECT_EQ(suggestedUnit(earth(), -32767.0, 2400.0), "") << "nodata that is not declared";
    EXPECT_EQ(suggestedUnit(earth(), -32767.0, 14176.0), "ft 14176");
    EXPECT_EQ(suggestedUnit(mars(), -8201.0, 21241.0), "") << "Olympus Mons";
    RasterInfo declared = earth();
    declared.is_unit_declared = true;
    EXPECT_EQ(suggestedUnit(declared, 4458.0, 14176.0), "");
    RasterInfo scaled = earth();
    scaled.scale = 0.1;
    EXPECT_EQ(suggestedUnit(scaled, 4458.0, 14176.0), "");
    EXPECT_EQ(suggestedUnit(RasterInfo{}, 4458.0, 14176.0), "") << "the body is unknown";
}

TEST(NoteSuspiciousSamples, NamesElevationsThatTheEarthDoesNotHave)
{
    const auto count = [](double low, double high) {
        RasterInfo info = earth();
        info.is_unit_declared = true;
        SampleStatistics statistics;
        statistics.sample_count = 4;
        statistics.raw_minimum = low;
        statistics.raw_maximum = high;
        noteSuspiciousSamples(info, statistics);
        return info.notices.size();
    };
    EXPECT_EQ(count(-10935.0, 8849.0), 0U);
    EXPECT_EQ(count(0.0, 12000.0), 1U);
    EXPECT_EQ(count(-12000.0, 0.0), 1U);
}

struct Ends {
    double low, next_low, next_high, high;
};

RasterInfo noted(const char* body, const Ends& ends, SampleType type = SampleType::Int32)
{
    RasterInfo info;
    info.body = bodyNamed(body);
    info.type = type;
    info.is_unit_declared = true;
    SampleStatistics statistics{.raw_minimum = ends.low,
                                .raw_maximum = ends.high,
                                .raw_next_minimum = ends.next_low,
                                .raw_next_maximum = ends.next_high,
                                .void_count = 0,
                                .sample_count = 1000};
    noteSuspiciousSamples(info, statistics);
    return info;
}

// LOLA and MOLA as published, twice and four times as high, and Mars as if it were the Earth.
TEST(ElevationMisfit, NamesElevationsThatTheBodyDoesNotHave)
{
    const RasterInfo doubled = noted("Moon", {-17757.0, -17750.0, 21000.0, 21008.0});
    EXPECT_EQ(doubled.notices,
              std::vector<std::string>{
                  "the elevations reach 21008 m, but the highest place on the Moon is at 10786 m; "
                  "a scale or a unit may be missing, or the map shows another body; set the scale, "
                  "the unit or the body"});
    ASSERT_TRUE(doubled.elevation_misfit);
    EXPECT_NE(optionNoticeOf(*doubled.elevation_misfit).find("set --scale, --unit or --body"),
              std::string::npos);
    EXPECT_TRUE(noted("Moon", {-17757.0, -17750.0, 9000.0, 9010.0}).elevation_misfit);
    EXPECT_TRUE(noted("Mars", {-32272.0, -32268.0, 84500.0, 84536.0}).elevation_misfit);
    EXPECT_TRUE(noted("Mercury", {-10764.0, -10760.0, 8990.0, 8994.0}).elevation_misfit);
    const RasterInfo other_body = noted("Earth", {-8068.0, -8060.0, 21101.0, 21134.0});
    EXPECT_TRUE(other_body.elevation_misfit);
    EXPECT_EQ(other_body.nodata_suggestion, std::nullopt);
    EXPECT_EQ(other_body.notices.size(), 1U);
}

TEST(ElevationMisfit, IsNotNotedForElevationsAboveAnyReferenceInUse)
{
    for (const auto& [body, ends] :
         {std::pair{"Moon", Ends{-9129.0, -9128.0, 10785.0, 10786.0}},
          {"Moon", {-9729.0, -9728.0, 10185.0, 10186.0}},    // above 1738 km
          {"Mars", {-8528.0, -8527.0, 21228.0, 21229.0}},    // above the areoid
          {"Mars", {-22800.0, -22700.0, 21228.0, 21229.0}},  // above 3396.19 km
          {"Mars", {-16000.0, -15900.0, 27000.0, 27100.0}},  // above 3389.5 km
          {"Mercury", {-5380.0, -5379.0, 4479.0, 4480.0}},   // above 2440 km
          {"Earth", {-10935.0, -10934.0, 8848.0, 8849.0}},   // above the sea
          {"Vesta", {-22300.0, -22200.0, 19000.0, 19100.0}}, // not known well enough
          {"Titan", {-60000.0, -59000.0, 59000.0, 60000.0}}}) {
        const RasterInfo info = noted(body, ends);
        EXPECT_TRUE(info.notices.empty()) << body << " " << info.notices.front();
    }
    RasterInfo radii = earth(); // near a pole, above the sphere of the equator
    radii.reference_radius_m = 6378137.0;
    EXPECT_TRUE(canBeOn(*radii.body, -21384.0, radii.reference_radius_m));
    EXPECT_FALSE(canBeOn(*radii.body, -21384.0));
}

TEST(ElevationMisfit, IsNotASingleValueFarFromTheRest)
{
    const RasterInfo fill = noted("Mars", {-8000.0, -7999.0, 21229.0, 32766.0});
    EXPECT_FALSE(fill.elevation_misfit);
    ASSERT_EQ(fill.notices.size(), 1U);
    EXPECT_NE(fill.notices[0].find("set it as nodata"), std::string::npos) << fill.notices[0];
    EXPECT_TRUE(noted("Mars", {-8000.0, -7999.0, 32700.0, 32766.0}).elevation_misfit);
    EXPECT_TRUE(noted("Earth", {0.0, 1.0, 8930.0, 9000.0}).elevation_misfit);
}

// Four times the heights of Mars in 16 bits: the largest fit no more.
TEST(UndeclaredNodata, IsNotTheEndOfTheTypeAtWhichElevationsAreCutOff)
{
    const RasterInfo high =
        noted("Mars", {-32272.0, -32268.0, 32764.0, 32767.0}, SampleType::Int16);
    EXPECT_EQ(high.nodata_suggestion, std::nullopt);
    EXPECT_TRUE(high.elevation_misfit);
    const RasterInfo both =
        noted("Mars", {-32768.0, -32765.0, 32764.0, 32767.0}, SampleType::Int16);
    EXPECT_EQ(both.nodata_suggestion, std::nullopt);
    EXPECT_TRUE(both.elevation_misfit);
    EXPECT_EQ(
        noted("Mars", {-8000.0, -7999.0, 21229.0, 32767.0}, SampleType::Int16).nodata_suggestion,
        32767.0);
    EXPECT_EQ(
        noted("Mars", {-32768.0, -32765.0, 21000.0, 21229.0}, SampleType::Int16).nodata_suggestion,
        -32768.0)
        << "smoothed into its surroundings";
}

TEST(UndeclaredUnit, MayBeThatOfTheCrs)
{
    const RasterInfo virginia = earth("EPSG:2924"); // in US survey feet
    EXPECT_EQ(suggestedUnit(virginia, 10.0, 500.0), "US survey ft");
    EXPECT_EQ(suggestedUnit(virginia, 10.0, 14000.0), "US survey ft 14000");
    EXPECT_EQ(suggestedUnit(earth("EPSG:2222"), 10.0, 500.0), "ft"); // Arizona, in feet
    EXPECT_EQ(suggestedUnit(earth("EPSG:32613"), 10.0, 500.0), "");
}

TEST(UndeclaredUnit, IsSetByAnOption)
{
    const UnitSuggestion survey{.unit = *verticalUnitFrom("US survey ft"),
                                .implausible_m = std::nullopt};
    EXPECT_NE(optionNoticeOf(survey).find("--unit \"US survey ft\""), std::string::npos);
}

} // namespace
} // namespace marsview
