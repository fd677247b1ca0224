// The overlays on the globe: those of the flat map, at the same places and by the same actions.
#include "core/globe/body_sight.h"
#include "core/measure/ground.h"
#include "tests/ui/globe/globe_window.h"
#include "ui/controllers/session_controller.h"
#include "ui/globe/globe_labels.h"
#include "ui/overlay/body_overview.h"
#include "ui/overlay/compass.h"
#include "ui/overlay/contour_labels_view.h"
#include "ui/overlay/crosshair.h"
#include "ui/overlay/gesture_hint.h"
#include "ui/overlay/globe_overlays.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/minimap.h"
#include "ui/overlay/place_mark.h"
#include "ui/overlay/scale_bar_view.h"
#include "ui/window/status_readout.h"

#include <QImage>
#include <QMouseEvent>
#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

class GlobeOverlaysTest : public GlobeTest {
protected:
    GlobeOverlays& overlays() { return *globe().findChild<GlobeOverlays*>(); }
    MapOverlays& flat() { return *window_->overlays(); }
    bool hasOverview()
    {
        return waitFor([this] { return overlays().minimap()->isVisible(); });
    }
    QAction* preference(const char* name)
    {
        for (QAction* action : flat().visibilityActions()) {
            if (action->objectName() == QLatin1String(name)) {
                return action;
            }
        }
        return nullptr;
    }
};

TEST_F(GlobeOverlaysTest, TheyLieWhereTheFlatMapHasThem)
{
    const QRect legend = flat().legend()->geometry();
    const QRect compass = flat().compass()->geometry();
    const QRect bar = flat().scaleBar()->geometry();
    const QRect map = flat().minimap()->geometry();
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(waitFor([this] { return overlays().legend()->isVisible(); }));
    EXPECT_EQ(overlays().legend()->geometry(), legend);
    EXPECT_EQ(overlays().compass()->geometry(), compass);
    EXPECT_EQ(overlays().scaleBar()->geometry(), bar);
    ASSERT_TRUE(hasOverview());
    EXPECT_EQ(overlays().minimap()->geometry().topRight(), map.topRight());
}

// Its elevations take a moment to be read.
TEST_F(GlobeOverlaysTest, TheOverviewIsNeverEmpty)
{
    Minimap& map = *overlays().minimap();
    int seen = 0;
    scene(2)->trigger();
    ASSERT_TRUE(waitFor([&] {
        if (map.isVisible()) {
            const QImage picture = map.grab().toImage();
            EXPECT_GT(qGray(picture.pixel(picture.rect().center() / 2)), 40) << seen;
            ++seen;
        }
        return seen > 2;
    }));
}

TEST_F(GlobeOverlaysTest, TheActionsOfTheFlatMapShowAndHideThem)
{
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(hasOverview());
    for (const auto& [name, part] :
         {std::pair<const char*, QWidget*>{"legend", overlays().legend()},
          {"minimap", overlays().minimap()},
          {"compass", overlays().compass()}}) {
        EXPECT_TRUE(part->isVisible()) << name;
        ASSERT_TRUE(preference(name)->isEnabled()) << name;
        preference(name)->trigger();
        EXPECT_FALSE(part->isVisible()) << name;
        preference(name)->trigger();
        EXPECT_TRUE(part->isVisible()) << name;
    }
}

TEST_F(GlobeOverlaysTest, TheLegendExplainsTheColorsAsOnTheFlatMap)
{
    ASSERT_TRUE(showGlobe());
    EXPECT_EQ(overlays().legend()->content(), flat().legend()->content());
    EXPECT_NE(overlays().legend()->content().ramp, nullptr);
    flat().setHeightUnit(HeightUnit::Feet);
    EXPECT_EQ(overlays().legend()->content().unit, HeightUnit::Feet);
    EXPECT_EQ(overlays().legend()->content(), flat().legend()->content());
}

TEST_F(GlobeOverlaysTest, NamesLieOnTheGlobeAndTheActionOfTheFlatMapHidesThem)
{
    ASSERT_TRUE(showGlobe());
    // Over Olympus Mons: it is named, what is on the other side of Mars is not.
    globe().setCamera(
        {.target = {.longitude = Angle::degrees(-133.8), .latitude = Angle::degrees(18.65)},
         .distance_m = 3e6});
    const auto has = [this](const char* name) {
        const auto& labels = overlays().labels()->labels();
        return std::any_of(labels.begin(), labels.end(), [name](const GlobeLabels::Label& label) {
            return label.text == QLatin1String(name);
        });
    };
    EXPECT_TRUE(waitFor([&] { return has("Olympus Mons"); }));
    EXPECT_FALSE(has("Hellas Planitia"));
    for (const GlobeLabels::Label& label : overlays().labels()->labels()) {
        EXPECT_FALSE(label.box.intersects(QRectF(overlays().legend()->geometry())));
    }
    QAction* names = nullptr;
    for (QAction* action : flat().terrainActions()) {
        names = action->objectName() == QStringLiteral("names") ? action : names;
    }
    ASSERT_NE(names, nullptr);
    ASSERT_TRUE(names->isEnabled());
    names->trigger();
    EXPECT_TRUE(overlays().labels()->labels().empty());
    names->trigger();
    EXPECT_TRUE(has("Olympus Mons"));
}

TEST_F(GlobeOverlaysTest, IndexContoursHaveTheirElevations)
{
    ASSERT_TRUE(showGlobe());
    globe().setCamera({.target = {.longitude = Angle::degrees(-134.0), // Olympus Mons
                                  .latitude = Angle::degrees(18.7)},
                       .height_m = 2e4,
                       .distance_m = 1.2e6,
                       .tilt = Angle::degrees(30.0)});
    const ContourLabelsView& labels = *overlays().contourLabels();
    window_->controller().setContours(true);
    ASSERT_TRUE(waitFor([&] { return globe().isPictureComplete() && !labels.labels().empty(); }));
    for (const ContourLabel& label : labels.labels()) {
        const double scale = globe().devicePixelRatioF();
        const auto hit = globe().hitAt({label.middle.x / scale, label.middle.y / scale});
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->height_m, label.elevation_m, 100.0);
    }
    window_->controller().setContours(false);
    EXPECT_TRUE(labels.labels().empty());
}

TEST_F(GlobeOverlaysTest, TheScaleBarIsALengthOnTheGroundInTheMiddle)
{
    ASSERT_TRUE(showGlobe());
    const Ground ground = Ground::onEllipsoid(body());
    constexpr Angle kHeading = Angle::degrees(30.0);
    // Lowland, a volcano of 21 km and the floor of a basin; targets off the ground, tilted too.
    for (const auto& [longitude, latitude, tilt] :
         {std::array{-120.0, 50.0, 0.0}, {-133.3, 18.3, 0.0}, {70.0, -42.0, 50.0}}) {
        for (const double exaggeration : {1.0, 8.0}) {
            view().setExaggeration(exaggeration);
            globe().setCamera({.target = {.longitude = Angle::degrees(longitude),
                                          .latitude = Angle::degrees(latitude)},
                               .distance_m = 4e5,
                               .azimuth = kHeading,
                               .tilt = Angle::degrees(tilt)});
            ASSERT_TRUE(overlays().scaleBar()->bar());
            const ScaleBar bar = *overlays().scaleBar()->bar();
            // Between two places close to the middle, across the view: the terrain between them
            // may fall away from it.
            const QPointF half(0.05 * bar.width_px, 0.0);
            const GroundLine line = ground.line(ground.position(placeAt(globeMiddle() - half)),
                                                ground.position(placeAt(globeMiddle() + half)));
            const Angle off = Angle::degrees(line.azimuthDeg() - 90.0 - kHeading.degrees());
            const double across_m = line.lengthM() * std::cos(off.radians());
            EXPECT_NEAR(10.0 * across_m, bar.length_m, 0.01 * bar.length_m)
                << longitude << ", " << latitude << ", ×" << exaggeration;
        }
    }
}

TEST_F(GlobeOverlaysTest, TheCompassTurnsNorthUp)
{
    ASSERT_TRUE(showGlobe());
    globe().setCamera({.target = {}, .distance_m = 4e6, .azimuth = Angle::degrees(75.0)});
    EXPECT_TRUE(overlays().compass()->accessibleName().contains(QStringLiteral("75")));
    QTest::mouseClick(overlays().compass(), Qt::LeftButton);
    ASSERT_TRUE(rests());
    EXPECT_NEAR(globe().camera().azimuth.degrees(), 0.0, 1e-9);
}

TEST_F(GlobeOverlaysTest, TheOverviewShowsTheWholeBodyAndLeadsToAnyPlace)
{
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(hasOverview());
    Minimap& map = *overlays().minimap();
    const GeographicPoint place{.longitude = Angle::degrees(100.0),
                                .latitude = Angle::degrees(-45.0)};
    const QPointF at = map.positionOf({100.0, -45.0, 0.0});
    EXPECT_TRUE(QRectF(map.rect()).contains(at));
    EXPECT_NEAR(
        map.positionOf({180.0, 0.0, 0.0}).x() - map.positionOf({-180.0, 0.0, 0.0}).x(),
        2.0 * (map.positionOf({0.0, -90.0, 0.0}).y() - map.positionOf({0.0, 90.0, 0.0}).y()), 1.0);
    const double distance_m = globe().camera().distance_m;
    QTest::mouseClick(&map, Qt::LeftButton, Qt::NoModifier, at.toPoint());
    EXPECT_NEAR(globe().camera().target.longitude.degrees(), place.longitude.degrees(), 2.0);
    EXPECT_NEAR(globe().camera().target.latitude.degrees(), place.latitude.degrees(), 2.0);
    EXPECT_DOUBLE_EQ(globe().camera().distance_m, distance_m);
    map.setFocus();
    globe().setCamera(
        {.target = {.longitude = Angle::degrees(179.0), .latitude = Angle()}, .distance_m = 4e6});
    QTest::keyClick(&map, Qt::Key_Right);
    EXPECT_NEAR(std::remainder(globe().camera().target.longitude.degrees() + 163.0, 360.0), 0.0,
                0.5);
}

TEST_F(GlobeOverlaysTest, TheOutlineOfAMapAroundTheBodyHasNoSeam)
{
    for (const QPolygonF& piece : outlineOf(view().map()->georeference())) {
        for (const QPointF& point : piece) {
            EXPECT_GT(std::abs(point.y()), 89.0) << point.x();
        }
    }
}

TEST_F(GlobeOverlaysTest, APinMarksAPlaceWhereItIsSeen)
{
    ASSERT_TRUE(showGlobe());
    const GeographicPoint place{.longitude = Angle::degrees(-133.0),
                                .latitude = Angle::degrees(18.0)};
    globe().setCamera({.target = place, .distance_m = 2e6, .tilt = Angle::degrees(30.0)});
    flat().markPlace(*view().map()->georeference().toGrid(place));
    PlaceMark& pin = *overlays().placeMark();
    ASSERT_TRUE(pin.isVisible());
    const auto pixel =
        project(poseOf(globe().camera(), body()), globe().viewport(),
                targetOf({.target = place,
                          .height_m = globe().terrain()->height(place) * globe().exaggeration()},
                         body()));
    EXPECT_NEAR(pin.tip().x(), pixel->x, 1.0);
    EXPECT_NEAR(pin.tip().y(), pixel->y, 1.0);
    globe().setCamera(
        {.target = {.longitude = Angle::degrees(47.0), .latitude = {}}, .distance_m = 2e6});
    EXPECT_FALSE(pin.isVisible()) << "behind the horizon";
    globe().setCamera({.target = place, .distance_m = 3e6});
    EXPECT_TRUE(pin.isVisible());
    QTest::mouseClick(&globe(), Qt::LeftButton, Qt::NoModifier, globeMiddle().toPoint());
    EXPECT_FALSE(pin.isVisible());
    EXPECT_FALSE(flat().isPlaceMarked());
}

TEST_F(GlobeOverlaysTest, TheHintIsOfferedAndDismissedAsOnTheFlatMap)
{
    ASSERT_TRUE(showGlobe());
    EXPECT_FALSE(overlays().hint()->isVisible());
    flat().offerHint();
    EXPECT_TRUE(overlays().hint()->isVisible());
    for (const Tool tool : {Tool::Measure, Tool::Annotate}) {
        view().setTool(tool);
        EXPECT_FALSE(overlays().hint()->isVisible()) << "clicks do something else";
        view().setTool(Tool::Pan);
        EXPECT_TRUE(overlays().hint()->isVisible());
    }
    wheel(globeMiddle(), 1);
    EXPECT_TRUE(overlays().hint()->isDone(MapAction::Zoom));
    Q_EMIT overlays().hint()->dismissed();
    EXPECT_FALSE(overlays().hint()->isVisible());
    EXPECT_FALSE(flat().isHintOffered());
}

TEST_F(GlobeOverlaysTest, NothingIsReadUnderALegend)
{
    ASSERT_TRUE(showGlobe());
    globe().setCamera({.target = {}, .distance_m = 1e6}); // ground everywhere
    view().clearFocus();
    globe().clearFocus();
    move(globeMiddle());
    EXPECT_TRUE(globe().reading());
    move(overlays().legend()->geometry().center());
    EXPECT_FALSE(globe().reading());
}

TEST_F(GlobeOverlaysTest, TheCrosshairShowsWhatTheKeyboardReads)
{
    ASSERT_TRUE(showGlobe());
    globe().setFocus(Qt::OtherFocusReason);
    ASSERT_TRUE(waitFor([this] { return globe().hasFocus(); }));
    globe().forgetPointer();
    globe().goHome();
    ASSERT_TRUE(rests());
    EXPECT_TRUE(overlays().crosshair()->isVisible());
    EXPECT_EQ(overlays().crosshair()->geometry().center(), globe().rect().center());
    EXPECT_TRUE(globe().reading());
    EXPECT_EQ(window_->readout()->sourceLabel(), QStringLiteral("Center"));
}

TEST_F(GlobeOverlaysTest, AFlatMapSeenWholeBecomesAWholeGlobe)
{
    view().goHome();
    ASSERT_TRUE(waitFor([this] { return !view().isMoving(); }));
    ASSERT_TRUE(showGlobe());
    EXPECT_EQ(globe().camera(), homeCamera(globe().limits(), globe().viewport()));
    // The limb, seen from the middle of the ball, is most of the half height away.
    const CameraPose pose = poseOf(globe().camera(), body());
    const double limb = std::asin(body().equatorial_m / length(pose.eye));
    EXPECT_GT(std::tan(limb) / std::tan(0.5 * pose.field_of_view.radians()), 0.8);
    // And back and forth nothing changes.
    const OrbitCamera flat_before = view().camera();
    globe().setCamera(
        {.target = {.longitude = Angle::degrees(20.0), .latitude = Angle()}, .distance_m = 9e6});
    const BodyCamera before = globe().camera();
    scene(1)->trigger();
    EXPECT_NE(view().camera(), flat_before);
    ASSERT_TRUE(showGlobe());
    EXPECT_EQ(globe().camera(), before);
}

} // namespace
} // namespace marsview
