// Messages of the core in the language of the window: real ones, so that a sentence that the core
// changes is noticed here.
#include "core/measure/attitude.h"
#include "core/raster/open_raster.h"
#include "core/raster/sample_suggestions.h"
#include "tests/support/make_raster.h"
#include "tests/support/temp_folder.h"
#include "ui/text/language.h"
#include "ui/text/sentence.h"

#include <QCoreApplication>
#include <QLocale>
#include <QScopeGuard>
#include <QTranslator>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace marsview {
namespace {

class GermanMessagesTest : public testing::Test {
protected:
    void SetUp() override
    {
        if (languages().size() == 1) {
            GTEST_SKIP() << "built without Qt's LinguistTools";
        }
        translators_ = translateTo(QStringLiteral("de"));
    }

    // The text behind the path.
    static std::string opening(const std::string& path)
    {
        const Result<OpenRaster> raster = openRaster({.path = path});
        EXPECT_FALSE(raster);
        const std::string text =
            translatedMessage(QString::fromStdString(raster.error().message)).toStdString();
        EXPECT_TRUE(text.starts_with(path + " ")) << text;
        return text.substr(std::min(text.size(), path.size() + 1));
    }
    static std::string refusal(const RasterOverrides& overrides)
    {
        RasterInfo info;
        info.columns = 36;
        info.rows = 18;
        const Result<RasterInfo> refused = withOverrides(info, overrides);
        EXPECT_FALSE(refused);
        return translatedMessage(QString::fromStdString(refused.error().message)).toStdString();
    }

    static std::string german(const char* sentence, const char* word = "")
    {
        const QString text = QCoreApplication::translate("CoreMessage", sentence);
        EXPECT_NE(text, QString::fromUtf8(sentence));
        return text.contains(QStringLiteral("%1")) ? text.arg(QString::fromUtf8(word)).toStdString()
                                                   : text.toStdString();
    }

    std::vector<std::unique_ptr<QTranslator>> translators_;
};

TEST_F(GermanMessagesTest, SayWhyAFileCannotBeOpened)
{
    const test::TempFolder folder;
    EXPECT_EQ(opening(folder.file("100%1.tif")), german("does not exist"));
    EXPECT_EQ(opening(folder.write("broken.tif", "not a TIFF")),
              german("is not a raster that GDAL can read, or is damaged; convert it to GeoTIFF or "
                     "fetch it again"));
}

TEST_F(GermanMessagesTest, SayWhyAnOverrideIsRefused)
{
    EXPECT_EQ(
        refusal({.crs = "foo"}),
        "CRS: " +
            german("unknown CRS \"%1\"; enter an EPSG or IAU code, a PROJ string or WKT", "foo"));
    EXPECT_EQ(refusal({.vertical_unit = "parsec"}),
              "vertical unit: " +
                  german("\"%1\" is unknown; use m, km, ft or \"US survey ft\"", "parsec"));
    EXPECT_EQ(refusal({.scale = 0.0}),
              "scale: " +
                  german("%1 cannot scale elevations; use a finite number other than 0", "0"));
}

TEST_F(GermanMessagesTest, SayWhyAMeasurementHasNoResult)
{
    const auto plane = [](std::vector<TerrainPoint> points) {
        const auto attitude = fitAttitude(Ground::onPlane(), points, {});
        EXPECT_FALSE(attitude);
        return attitude ? std::string() : attitude.error().message;
    };
    const std::vector<std::string> messages{
        plane({{{0.0, 0.0}, 0.0}, {{0.0, 0.0}, 0.0}, {{0.0, 0.0}, 0.0}}),
        plane({{{0.0, 0.0}, 0.0}, {{100.0, 0.0}, 5.0}, {{200.0, 0.1}, 10.0}}),
        plane({{{0.0, 0.0}, 0.0}, {{100.0, 0.0}, 80.0}, {{200.0, 0.1}, 10.0}}),
        plane(
            {{{0.0, 0.0}, 90.0}, {{100.0, 0.0}, 0.0}, {{0.0, 100.0}, 0.0}, {{99.0, 99.0}, 90.0}})};
    for (const std::string& message : messages) {
        EXPECT_NE(translatedMessage(QString::fromStdString(message)).toStdString(), message);
    }
}

TEST_F(GermanMessagesTest, DescribeAMap)
{
    RasterInfo info;
    info.columns = 36;
    info.rows = 18;
    info.transform = GeoTransform::fromTerms({5e5, 30.0, 0.0, 4e6, 0.0, -30.0}).value();
    notePlacement(info);
    ASSERT_EQ(info.notices.size(), 1U);
    EXPECT_EQ(translatedMessage(QString::fromStdString(info.notices[0])).toStdString(),
              german("no CRS: map units are read as meters; set its CRS or body to get longitude "
                     "and latitude"));
    for (const auto& reason : {std::optional(14176.0), std::optional<double>()}) {
        const std::string notice =
            noticeOf(UnitSuggestion{.unit = *verticalUnitFrom("ft"), .implausible_m = reason});
        EXPECT_NE(translatedMessage(QString::fromStdString(notice)).toStdString(), notice);
    }
}

TEST_F(GermanMessagesTest, DescribeElevationsAndCrssThatDoNotFit)
{
    for (const char* body : {"Moon", "Earth", "Mars", "Mercury"}) {
        for (const double elevation_m : {-99999.0, 99999.0}) {
            const std::string notice = noticeOf(
                ElevationMisfit{.elevation_m = elevation_m, .limit_m = 9000.0, .body = body});
            const QString text = translatedMessage(QString::fromStdString(notice));
            EXPECT_TRUE(text.startsWith(QStringLiteral("die Höhen reichen bis"))) << notice;
            EXPECT_TRUE(text.contains(QStringLiteral("Ort auf"))) << text.toStdString();
        }
    }
    RasterInfo grid;
    grid.columns = 100;
    grid.rows = 100;
    grid.transform = *GeoTransform::fromTerms({376313.65, 30, 0, 3350820, 0, -30});
    grid.crs = *Crs::fromText("IAU_2015:49900");
    const std::string unused = noticeOfUnusedCrs(grid);
    EXPECT_NE(translatedMessage(QString::fromStdString(unused)).toStdString(), unused);
    grid.transform = *GeoTransform::fromTerms({-180, 3.6, 0, 90, 0, -1.8});
    grid.crs = *Crs::fromText("IAU_2015:49910");
    const auto suggestion = suggestDegreesInstead(grid);
    ASSERT_TRUE(suggestion);
    const std::string notice = noticeOf(*suggestion);
    EXPECT_NE(translatedMessage(QString::fromStdString(notice)).toStdString(), notice);
}

// A TIFF of 100 strips, the last of which is incomplete.
TEST_F(GermanMessagesTest, SayWhereAGeotiffIsDamaged)
{
    const test::TempFolder folder;
    const std::string path = test::writeRaster(
        folder, "cut.tif", "GTiff", test::recipeFor(100, std::vector<std::int16_t>(10000, 7)),
        {"-co", "BLOCKYSIZE=1"});
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 50);
    const std::string text = opening(path);
    EXPECT_NE(text.find("Block 100 von 100 endet bei Byte"), std::string::npos) << text;
}

TEST(TranslatedMessage, LeavesWhatItDoesNotKnow)
{
    for (const char* message :
         {"", ": ", "out of memory", "/a: b: the moon is full", "CRS: unknown"}) {
        EXPECT_EQ(translatedMessage(QString::fromUtf8(message)), QString::fromUtf8(message));
    }
}

TEST(TranslatedMessage, ShowsNumbersAsTheWindowDoes)
{
    const QLocale before;
    QLocale::setDefault(QLocale(QLocale::English));
    const auto restore = qScopeGuard([before] { QLocale::setDefault(before); });
    const auto shown = [](const char* message) {
        return translatedMessage(QString::fromUtf8(message)).toStdString();
    };
    EXPECT_EQ(
        shown("\"WGS 84\" (unit degree) cannot place a grid that covers x 376313.6554542635 to "
              "410000 and y -1.25 to 0.5; choose a projected CRS, or set a geotransform in "
              "degrees"),
        "\"WGS 84\" (unit degree) cannot place a grid that covers x 376,313.655 to 410,000 and "
        "y −1.25 to 0.5; choose a projected CRS, or set a geotransform in degrees");
    EXPECT_EQ(shown("\"376313.6554542635\" is unknown; use m, km, ft or \"US survey ft\""),
              "\"376313.6554542635\" is unknown; use m, km, ft or \"US survey ft\"")
        << "as it was typed";
}

TEST(TranslatedMessage, HasNoColonBetweenAFileAndItsVerb)
{
    for (const auto& [message, sentence] :
         {std::pair{"/%1/%2.tif: does not exist", "/%1/%2.tif does not exist"},
          {"/a: b.tif: is a picture; see: it", "/a: b.tif is a picture; see: it"},
          {"/a.tif: isolated", "/a.tif: isolated"}}) {
        EXPECT_EQ(translatedMessage(QString::fromUtf8(message)), QString::fromUtf8(sentence));
    }
}

} // namespace
} // namespace marsview
