// The overview map around a pole.
#include "core/globe/polar_plane.h"
#include "tests/ui/globe/globe_window.h"
#include "ui/controllers/session_controller.h"
#include "ui/overlay/body_overview.h"
#include "ui/overlay/globe_overlays.h"
#include "ui/overlay/minimap.h"

#include <QImage>
#include <QMouseEvent>
#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// PROJ 9: cct +proj=stere +lat_0=90 +R=1 at latitude 50°, the edge of the disc.
constexpr double kProjEdge = 0.727940469;

class PolarOverviewTest : public GlobeTest {
protected:
    Minimap& map() { return *globe().findChild<GlobeOverlays*>()->minimap(); }
    bool isDisc() { return map().width() == map().height(); }
    void look(double longitude_deg, double latitude_deg, double distance_m = 1e6)
    {
        globe().setCamera({.target = {.longitude = Angle::degrees(longitude_deg),
                                      .latitude = Angle::degrees(latitude_deg)},
                           .distance_m = distance_m});
    }
    bool showsPole(double latitude_deg)
    {
        look(20.0, latitude_deg);
        const QString pole =
            latitude_deg > 0.0 ? QStringLiteral("North pole") : QStringLiteral("South pole");
        return waitFor([&] {
            return map().isVisible() && isDisc() && map().accessibleDescription().startsWith(pole);
        });
    }
    bool showPole(double latitude_deg) { return showGlobe() && showsPole(latitude_deg); }
    // Of coordinates by PROJ on a sphere of radius 1, north up.
    QPointF pixelOf(double x, double y)
    {
        return map().positionOf({x / kProjEdge, y / kProjEdge, 0.0});
    }
    void send(QEvent::Type type, QPointF at)
    {
        const bool is_release = type == QEvent::MouseButtonRelease;
        QMouseEvent event(type, at, map().mapToGlobal(at),
                          type == QEvent::MouseMove ? Qt::NoButton : Qt::LeftButton,
                          is_release ? Qt::NoButton : Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&map(), &event);
    }
    void click(QPointF at)
    {
        send(QEvent::MouseButtonPress, at);
        send(QEvent::MouseButtonRelease, at);
    }
    void expectTarget(double longitude_deg, double latitude_deg, double within_deg = 1e-4)
    {
        const GeographicPoint& target = globe().camera().target;
        EXPECT_NEAR(target.latitude.degrees(), latitude_deg, within_deg);
        EXPECT_NEAR(std::remainder(target.longitude.degrees() - longitude_deg, 360.0), 0.0,
                    within_deg);
    }
};

TEST_F(PolarOverviewTest, IsShownNearAPoleWithHysteresis)
{
    ASSERT_TRUE(showGlobe());
    look(0.0, 65.0);
    ASSERT_TRUE(waitFor([this] { return map().isVisible(); }));
    EXPECT_FALSE(isDisc());
    ASSERT_TRUE(showsPole(72.0));
    look(0.0, 65.0);
    EXPECT_TRUE(isDisc());
    look(0.0, 59.0);
    EXPECT_TRUE(waitFor([this] { return !isDisc(); }));
    look(0.0, 65.0);
    EXPECT_FALSE(isDisc());
    // At once: it has been read.
    look(0.0, 72.0);
    EXPECT_TRUE(isDisc());
    ASSERT_TRUE(showsPole(-80.0));
}

TEST_F(PolarOverviewTest, AClickLeadsToThePlaceThatProjHasThere)
{
    ASSERT_TRUE(showPole(80.0));
    click(pixelOf(-0.127216068, 0.220344693 * -1.0));
    expectTarget(-30.0, 75.5);
    click(pixelOf(0.0, 0.174977327));
    expectTarget(180.0, 80.0);
    ASSERT_TRUE(showsPole(-80.0));
    click(pixelOf(-0.127216068, 0.220344693));
    expectTarget(-30.0, -75.5);
    // In pixels: 0° is at the bottom around the north pole and at the top around the south pole.
    const QPointF middle = QRectF(map().rect()).center();
    click(middle - QPointF(0.0, 20.0));
    expectTarget(0.0, globe().camera().target.latitude.degrees(), 0.5);
    ASSERT_TRUE(showsPole(80.0));
    click(middle + QPointF(0.0, 20.0));
    expectTarget(0.0, globe().camera().target.latitude.degrees(), 0.5);
    click(middle + QPointF(20.0, 0.0));
    expectTarget(90.0, globe().camera().target.latitude.degrees(), 0.5);
    // The corners are outside: its edge is the nearest.
    send(QEvent::MouseButtonPress, {2.0, 2.0});
    expectTarget(-135.0, 50.0, 0.5);
    send(QEvent::MouseButtonRelease, {2.0, 2.0});
}

TEST_F(PolarOverviewTest, DoesNotChangeWhileItIsDragged)
{
    ASSERT_TRUE(showPole(80.0));
    send(QEvent::MouseButtonPress, pixelOf(0.0, -0.174977327));
    expectTarget(0.0, 80.0);
    send(QEvent::MouseMove, pixelOf(0.535898385, 0.0));
    expectTarget(90.0, 60.0);
    send(QEvent::MouseMove, pixelOf(0.7, 0.0));
    EXPECT_LT(globe().camera().target.latitude.degrees(), 53.0);
    EXPECT_TRUE(isDisc());
    send(QEvent::MouseButtonRelease, pixelOf(0.7, 0.0));
    EXPECT_TRUE(waitFor([this] { return !isDisc(); }));
    // Nor the map of the whole body.
    const QPointF polar = map().positionOf({0.0, 80.0, 0.0});
    send(QEvent::MouseButtonPress, polar);
    expectTarget(0.0, 80.0, 1e-4);
    EXPECT_FALSE(isDisc());
    send(QEvent::MouseButtonRelease, polar);
    EXPECT_TRUE(waitFor([this] { return isDisc(); }));
}

// North is on all sides of the pole.
TEST_F(PolarOverviewTest, TheViewDoesNotTurnOnIt)
{
    ASSERT_TRUE(showPole(80.0));
    const auto heading_deg = [this] {
        const BodyCamera& camera = globe().camera();
        return PolarPlane(BodyOverview::NorthPole)
            .heading(camera.azimuth, camera.target.longitude)
            .degrees();
    };
    const double before_deg = heading_deg();
    for (const QPointF& at : {QPointF(0.1, -0.05), {0.01, 0.0}, {-0.01, 0.01}, {-0.2, 0.1}}) {
        click(pixelOf(at.x(), at.y()));
        EXPECT_NEAR(std::remainder(heading_deg() - before_deg, 360.0), 0.0, 1e-6);
    }
}

TEST_F(PolarOverviewTest, ArrowKeysMoveOnIt)
{
    ASSERT_TRUE(showPole(80.0));
    const PolarPlane plane(BodyOverview::NorthPole);
    map().setFocus();
    look(0.0, 88.0);
    const PolarPoint before = plane.at(globe().camera().target);
    QTest::keyClick(&map(), Qt::Key_Right);
    QTest::keyClick(&map(), Qt::Key_Up);
    QTest::keyClick(&map(), Qt::Key_Up, Qt::ShiftModifier);
    const PolarPoint after = plane.at(globe().camera().target);
    EXPECT_NEAR(after.x - before.x, 2.0 / 20.0, 1e-6);
    EXPECT_NEAR(after.y - before.y, 2.0 / 20.0 + 2.0 / 100.0, 1e-6);
}

TEST_F(PolarOverviewTest, IsDescribed)
{
    ASSERT_TRUE(showPole(-80.0));
    const QString text = map().accessibleDescription();
    EXPECT_TRUE(text.startsWith(QStringLiteral("South pole."))) << text.toStdString();
    EXPECT_TRUE(text.contains(QStringLiteral("80.0° S"))) << text.toStdString();
}

// Around the target, and not elsewhere.
TEST_F(PolarOverviewTest, BrightensWhatThePictureShows)
{
    ASSERT_TRUE(showPole(80.0));
    const auto picture = [this] { return map().grab().toImage(); };
    look(-90.0, 62.0, 5e5);
    ASSERT_TRUE(isDisc());
    const QImage elsewhere = picture();
    look(60.0, 75.0, 1.2e6);
    const QImage here = picture();
    const double ratio = map().devicePixelRatioF();
    const PolarPoint at = PolarPlane(BodyOverview::NorthPole).at(globe().camera().target);
    const QPoint target = (map().positionOf({at.x, at.y, 0.0}) * ratio).toPoint();
    const auto changed = [&](QPoint pixel) {
        return std::abs(qGray(here.pixel(pixel)) - qGray(elsewhere.pixel(pixel))) > 6;
    };
    EXPECT_TRUE(changed(target + QPoint(7, 0)));
    EXPECT_TRUE(changed(target - QPoint(7, 0)));
    EXPECT_FALSE(changed(map().rect().center() + QPoint(-30, 30)));
}

TEST_F(PolarOverviewTest, AMapOfTheWholeBodyHasNoOutlineAroundThePole)
{
    for (const BodyOverview overview : {BodyOverview::NorthPole, BodyOverview::SouthPole}) {
        EXPECT_TRUE(outlineOf(view().map()->georeference(), overview).empty());
    }
}

// The elevations of its pixels are those of the places there.
TEST_F(PolarOverviewTest, ItsPixelsHaveTheElevationsOfTheirPlaces)
{
    ASSERT_TRUE(showGlobe());
    const BodyTerrain& terrain = *globe().terrain();
    JobMonitor monitor;
    for (const BodyOverview overview : {BodyOverview::NorthPole, BodyOverview::SouthPole}) {
        const PolarPlane plane(overview);
        const std::vector<float> heights_m = overviewHeights(terrain, monitor, overview);
        ASSERT_EQ(heights_m.size(), kPolarOverviewSide * kPolarOverviewSide);
        double square = 0.0;
        double square_mirrored = 0.0;
        int count = 0;
        for (double poleward_deg = 52.0; poleward_deg < 90.0; poleward_deg += 3.0) {
            for (double longitude_deg = -180.0; longitude_deg < 180.0; longitude_deg += 10.0) {
                const GeographicPoint place{
                    .longitude = Angle::degrees(longitude_deg),
                    .latitude = Angle::degrees(plane.isNorth() ? poleward_deg : -poleward_deg)};
                const PolarPoint at = plane.at(place);
                const auto pixel = [](double along) {
                    return static_cast<std::size_t>((1.0 + along) / 2.0 * kPolarOverviewSide);
                };
                const auto off = [&](double x) {
                    const double height_m = static_cast<double>(
                        heights_m[pixel(-at.y) * kPolarOverviewSide + pixel(x)]);
                    return (height_m - terrain.height(place)) * (height_m - terrain.height(place));
                };
                square += off(at.x);
                square_mirrored += off(-at.x);
                ++count;
            }
        }
        const double rms_m = std::sqrt(square / count);
        EXPECT_LT(rms_m, 150.0);
        EXPECT_LT(rms_m, 0.2 * std::sqrt(square_mirrored / count));
    }
}

// 40 × 30 samples of 20 km on the plane of the pole, on which its outline is a rectangle.
TEST_F(PolarOverviewTest, TheOutlineOfAPolarLayerIsWhereItsSamplesAre)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.placed("polar", "IAU_2015:49930",
                                                   {-400e3, 20e3, 0.0, -300e3, 0.0, -20e3})));
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 2; }));
    look(0.0, 80.0, 2e5);
    ASSERT_TRUE(waitFor([this] { return map().isVisible() && isDisc(); }));
    const Georeference& georeference = globe().scene().maps().front().map()->georeference();
    constexpr double kMarsM = 3396190.0;
    const double left = -390e3;
    const double right = left + 20e3 * static_cast<double>(georeference.columns() - 1);
    const double top = -310e3;
    const double bottom = top - 20e3 * static_cast<double>(georeference.rows() - 1);
    const auto pieces = outlineOf(georeference, BodyOverview::NorthPole);
    ASSERT_EQ(pieces.size(), 1U);
    const QRectF extent = pieces.front().boundingRect();
    const double unit_m = kMarsM * kProjEdge;
    EXPECT_NEAR(extent.left(), left / unit_m, 1e-6);
    EXPECT_NEAR(extent.right(), right / unit_m, 1e-6);
    EXPECT_NEAR(extent.top(), bottom / unit_m, 1e-6); // y is up
    EXPECT_NEAR(extent.bottom(), top / unit_m, 1e-6);
    const QImage picture = map().grab().toImage();
    const auto is_line_near = [&](double x_m, double y_m) {
        const QPointF at = pixelOf(x_m / kMarsM, y_m / kMarsM) * map().devicePixelRatioF();
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const QColor color = picture.pixelColor(at.toPoint() + QPoint(dx, dy));
                if (color.blue() > color.red() + 25 && color.blue() > 110) {
                    return true;
                }
            }
        }
        return false;
    };
    const double across = (left + right) / 2.0;
    const double down = (top + bottom) / 2.0;
    EXPECT_TRUE(is_line_near(across, top));
    EXPECT_TRUE(is_line_near(across, bottom));
    EXPECT_TRUE(is_line_near(left, down));
    EXPECT_TRUE(is_line_near(right, down));
    EXPECT_FALSE(is_line_near(right + 4e5, down));
    EXPECT_FALSE(is_line_near(-right, -down));
}

} // namespace
} // namespace marsview
