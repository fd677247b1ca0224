// The popup of the light over the globe: light of the view, or a sun over a place of the body.
#include "core/globe/sunlight.h"
#include "tests/ui/globe/globe_window.h"
#include "ui/controllers/session_controller.h"
#include "ui/dialogs/light_popup.h"
#include "ui/dialogs/sun_fields.h"
#include "ui/overlay/globe_overlays.h"
#include "ui/overlay/minimap.h"

#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRadioButton>
#include <QTest>
#include <QUndoStack>

#include <cmath>
#include <optional>

namespace marsview {
namespace {

class GlobeLightTest : public GlobeTest {
protected:
    bool openPopup()
    {
        window_->actionSet().light->trigger();
        return waitFor([this] { return popup().isVisible(); });
    }
    LightPopup& popup() { return *window_->findChild<LightPopup*>(); }
    template <typename Widget>
    Widget& part(const char* name)
    {
        return *popup().findChild<Widget*>(QString::fromLatin1(name));
    }
    QRadioButton& inView() { return part<QRadioButton>("light of the view"); }
    QRadioButton& onBody() { return part<QRadioButton>("light on the body"); }
    QLineEdit& latitude() { return part<QLineEdit>("subsolar latitude"); }
    QLineEdit& longitude() { return part<QLineEdit>("subsolar longitude"); }
    QLabel& problem() { return part<QLabel>("subsolar problem"); }
    void type(QLineEdit& field, const char* text)
    {
        field.setFocus();
        field.selectAll();
        field.del();
        field.insert(QString::fromUtf8(text)); // QTest has no keys for signs of degrees
        QTest::keyClick(&field, Qt::Key_Return);
    }
    const TerrainLook& look() { return window_->session().look; }
    void expectSun(double longitude_deg, double latitude_deg)
    {
        ASSERT_TRUE(look().subsolar);
        EXPECT_NEAR(std::remainder(look().subsolar->longitude.degrees() - longitude_deg, 360.0),
                    0.0, 1e-9);
        EXPECT_NEAR(look().subsolar->latitude.degrees(), latitude_deg, 1e-9);
    }
    static QString plain(const QLineEdit& field)
    {
        QString text = field.text();
        return text.remove(QChar(0x2066)).remove(QChar(0x2069));
    }
    // Of the middle of the picture.
    int gray()
    {
        EXPECT_TRUE(waitFor([this] { return globe().isPictureComplete(); }));
        const QImage picture = globe().grabFramebuffer();
        return qGray(picture.pixel(picture.rect().center()));
    }
};

TEST_F(GlobeLightTest, TheChoiceIsOneStepThatKeepsTheDirectionAtTheMiddleOfThePicture)
{
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(openPopup());
    EXPECT_TRUE(inView().isChecked());
    EXPECT_FALSE(latitude().isVisible());
    const int count = window_->undoStack().count();
    QTest::mouseClick(&onBody(), Qt::LeftButton, {}, QPoint(8, onBody().height() / 2));
    EXPECT_TRUE(onBody().isChecked());
    EXPECT_TRUE(latitude().isVisible());
    ASSERT_EQ(look().light_frame, LightFrame::Body);
    const GeographicPoint expected =
        subsolarPoint(globe().camera().target, look().light_azimuth, look().light_altitude, body());
    expectSun(expected.longitude.degrees(), expected.latitude.degrees());
    EXPECT_EQ(globe().look(), look());
    EXPECT_EQ(window_->undoStack().count(), count + 1);
    EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("Light Fixed on the Body"));
    window_->undoStack().undo();
    EXPECT_EQ(look().light_frame, LightFrame::View);
    EXPECT_TRUE(inView().isChecked());
    EXPECT_FALSE(latitude().isVisible());
    window_->undoStack().redo();
    EXPECT_TRUE(onBody().isChecked());
    QTest::mouseClick(&inView(), Qt::LeftButton, {}, QPoint(8, inView().height() / 2));
    EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("Light Fixed in the View"));
    EXPECT_TRUE(look().subsolar) << "for the next time";
}

TEST_F(GlobeLightTest, ThePlaceOfTheSunIsTypedInTheCoordinateFormat)
{
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(openPopup());
    onBody().click();
    type(latitude(), "18.65");
    type(longitude(), "133°48′ W");
    expectSun(-133.8, 18.65);
    EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("Subsolar Point"));
    EXPECT_EQ(plain(latitude()), QStringLiteral("18.65° N"));
    EXPECT_EQ(plain(longitude()), QStringLiteral("226.20° E"));
    type(latitude(), "S 4 30");
    expectSun(-133.8, -4.5);
    type(longitude(), "-10,5");
    expectSun(-10.5, -4.5);
    // Both at once, as they are copied from the status bar.
    type(latitude(), "12.5° N, 200.25° E");
    expectSun(200.25, 12.5);
    // Typing the latitude does not round the longitude.
    window_->controller().setSubsolarPoint(
        {.longitude = Angle::degrees(10.123456), .latitude = Angle::degrees(20.0)});
    type(latitude(), "30 N");
    expectSun(10.123456, 30.0);

    Preferences preferences = window_->preferences();
    preferences.coordinates.angles = AngleNotation::DegreesMinutesSeconds;
    preferences.coordinates.longitudes = LongitudeNotation::West360;
    window_->setPreferences(preferences);
    type(latitude(), "45");
    expectSun(10.123456, 45.0);
    EXPECT_EQ(plain(latitude()), QStringLiteral("45° 00′ 00″ N"));
    type(longitude(), "90");
    expectSun(-90.0, 45.0);
    EXPECT_EQ(plain(longitude()), QStringLiteral("90° 00′ 00″ W"));
}

TEST(SunFieldsTest, LatitudesAreOfTheKindOfTheCoordinateFormat)
{
    RasterInfo info;
    info.crs = Crs::fromText("IAU_2015:49901").value(); // an ellipsoid
    info.body = bodyNamed("Mars");
    const Ellipsoid mars = *info.crs->ellipsoid();
    ASSERT_FALSE(mars.isSphere());
    SunFields fields;
    fields.setBody(info);
    auto& latitude = *fields.findChild<QLineEdit*>(QStringLiteral("subsolar latitude"));
    std::optional<GeographicPoint> chosen;
    QObject::connect(&fields, &SunFields::pointChosen, &fields,
                     [&](const GeographicPoint& point) { chosen = point; });
    const auto type = [&](const char* text) {
        latitude.selectAll();
        latitude.del();
        latitude.insert(QString::fromLatin1(text));
        QTest::keyClick(&latitude, Qt::Key_Return);
    };
    type("45 N");
    ASSERT_TRUE(chosen);
    EXPECT_NEAR(chosen->latitude.degrees(), 45.0, 1e-12);
    EXPECT_TRUE(latitude.toolTip().contains(QStringLiteral("planetocentric")));
    CoordinateFormat format;
    format.setLatitudesOn(info.body, LatitudeKind::Planetographic);
    fields.setCoordinateFormat(format);
    EXPECT_TRUE(latitude.text().contains(QStringLiteral("45.34"))); // of 45° planetocentric
    EXPECT_TRUE(latitude.toolTip().contains(QStringLiteral("planetographic")));
    type("45 N");
    const double ratio = mars.polar_m / mars.equatorial_m;
    EXPECT_NEAR(std::tan(chosen->latitude.radians()), ratio * ratio, 1e-12);
}

TEST_F(GlobeLightTest, WhatIsNotAPlaceIsSaidAndChangesNothing)
{
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(openPopup());
    onBody().click();
    const Session before = window_->session();
    for (const char* text : {"95", "noon", "12 E", ""}) {
        type(latitude(), text);
        EXPECT_TRUE(problem().isVisible()) << text;
        EXPECT_TRUE(problem().text().contains(QStringLiteral("atitude"))) << text;
        EXPECT_EQ(window_->session(), before) << text;
    }
    type(longitude(), "361");
    EXPECT_TRUE(problem().isVisible());
    EXPECT_EQ(window_->session(), before);
    // Escape closes the popup, and nothing of this is left.
    QTest::keyClick(&longitude(), Qt::Key_Escape);
    EXPECT_FALSE(popup().isVisible());
    EXPECT_EQ(window_->session(), before);
    ASSERT_TRUE(openPopup());
    EXPECT_FALSE(problem().isVisible());
    type(latitude(), "10 S");
    EXPECT_NEAR(look().subsolar->latitude.degrees(), -10.0, 1e-9);
}

TEST_F(GlobeLightTest, TheSunOverTheMiddleMakesItBrightAndStaysWhenTheCameraMoves)
{
    ASSERT_TRUE(showGlobe());
    globe().setCamera(
        {.target = {.longitude = Angle::degrees(-60.0), .latitude = Angle::degrees(20.0)},
         .distance_m = 8e6});
    ASSERT_TRUE(openPopup());
    onBody().click();
    part<QPushButton>("sun overhead").click();
    expectSun(-60.0, 20.0);
    const int noon = gray();
    globe().setCamera(
        {.target = {.longitude = Angle::degrees(120.0), .latitude = Angle::degrees(-20.0)},
         .distance_m = 8e6});
    expectSun(-60.0, 20.0);
    const int midnight = gray();
    EXPECT_GT(noon, 60);
    EXPECT_LT(midnight, 25);
    EXPECT_GT(midnight, 1) << "not black";
}

TEST_F(GlobeLightTest, TheFlatMapHasTheLightOfTheViewAndThePopupSaysWhy)
{
    scene(1)->trigger();
    ASSERT_TRUE(openPopup());
    EXPECT_FALSE(onBody().isEnabled());
    EXPECT_TRUE(inView().isChecked());
    QLabel& why = part<QLabel>("light of the flat map");
    EXPECT_TRUE(why.isVisible());
    EXPECT_TRUE(why.text().contains(QStringLiteral("flat map")));
    popup().close();
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(openPopup());
    EXPECT_TRUE(onBody().isEnabled());
    EXPECT_FALSE(why.isVisible());
    onBody().click();
    popup().close();
    // What the globe has is kept.
    scene(1)->trigger();
    ASSERT_TRUE(openPopup());
    EXPECT_TRUE(inView().isChecked());
    EXPECT_FALSE(latitude().isVisible());
    EXPECT_TRUE(why.text().contains(QStringLiteral("fixed on the body")));
    EXPECT_EQ(look().light_frame, LightFrame::Body);
}

TEST_F(GlobeLightTest, TheKeyboardReachesEverything)
{
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(openPopup());
    inView().setFocus();
    QTest::keyClick(&inView(), Qt::Key_Down);
    EXPECT_EQ(look().light_frame, LightFrame::Body);
    ASSERT_TRUE(onBody().hasFocus());
    QList<QWidget*> met;
    for (int i = 0; i < 4; ++i) {
        QTest::keyClick(popup().focusWidget(), Qt::Key_Tab);
        met.append(popup().focusWidget());
    }
    EXPECT_TRUE(met.contains(&latitude()));
    EXPECT_TRUE(met.contains(&longitude()));
    EXPECT_TRUE(met.contains(&part<QPushButton>("sun overhead")));
    for (QWidget* widget :
         {static_cast<QWidget*>(&latitude()), static_cast<QWidget*>(&longitude())}) {
        EXPECT_FALSE(widget->accessibleName().isEmpty());
        EXPECT_FALSE(widget->toolTip().isEmpty());
    }
}

TEST_F(GlobeLightTest, TheOverviewOfTheBodyIsDarkInTheNight)
{
    ASSERT_TRUE(showGlobe());
    Minimap& map = *globe().findChild<GlobeOverlays*>()->minimap();
    ASSERT_TRUE(waitFor([&] { return map.isVisible(); }));
    const auto mean = [&](double from, double to) { // shares of the width
        const QImage picture = map.grab().toImage();
        double sum = 0.0;
        int count = 0;
        for (int y = picture.height() / 4; y < 3 * picture.height() / 4; ++y) {
            for (int x = static_cast<int>(from * picture.width());
                 x < static_cast<int>(to * picture.width()); ++x, ++count) {
                sum += qGray(picture.pixel(x, y));
            }
        }
        return sum / count;
    };
    const auto night = [&] { return mean(0.05, 0.2) + mean(0.8, 0.95); };
    const auto day = [&] { return mean(0.3, 0.7); };
    ASSERT_TRUE(waitFor([&] { return day() > 60.0; }));
    const double night_before = night();
    const double day_before = day();
    window_->controller().setSubsolarPoint({});
    EXPECT_LT(night(), 0.6 * night_before);
    EXPECT_NEAR(day(), day_before, 0.05 * day_before);
    window_->undoStack().undo();
    EXPECT_NEAR(night(), night_before, 1.0);
}

} // namespace
} // namespace marsview
