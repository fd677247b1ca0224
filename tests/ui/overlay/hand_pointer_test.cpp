// A proxy outside the picture, in a real window: the arrow at the edge that points to it.
#include "tests/ui/color_contrast.h"
#include "tests/ui/hand_window.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/overlay/hand_pointer.h"
#include "ui/overlay/map_overlays.h"

#include <QImage>
#include <QLineF>
#include <QPainter>
#include <QTest>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

bool isRed(QRgb color)
{
    return qRed(color) > 150 && qGreen(color) < 80 && qBlue(color) < 80;
}

// The middle of all red pixels.
QPointF middleOfRed(const QImage& picture)
{
    QPointF sum;
    int count = 0;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            if (isRed(picture.pixel(x, y))) {
                sum += QPointF(x + 0.5, y + 0.5);
                ++count;
            }
        }
    }
    return count > 20 ? sum / count : QPointF(-1e3, -1e3);
}

class HandPointerTest : public HandWindowTest {
protected:
    void SetUp() override
    {
        makeWindow(kSmall);
        ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
        window_->overlays()->setCovered(0); // no notices over the map
    }
    HandPointer& pointer() { return *window_->overlays()->handPointer(); }
    // Puts the proxy to the side of the picture's middle, in fractions of the distance to its
    // edges.
    void showHandAt(double right, double up)
    {
        const OrbitCamera& camera = view().camera();
        const CameraAxes axes = axesOf(camera);
        const Viewport viewport = view().viewport();
        const double half_m = camera.distance_m * std::tan(camera.field_of_view.radians() / 2.0);
        StylusPose pose;
        pose.proxy = eyeOf(camera) + axes.forward * camera.distance_m +
                     axes.right * (right * half_m * viewport.aspect()) + axes.up * (up * half_m);
        pose.goal = pose.proxy;
        view().showDevice(pose);
    }
    QPointF middleOfPointer() { return QRectF(pointer().geometry()).center(); }
};

TEST_F(HandPointerTest, IsVisibleOnlyWhileTheStylusIsOutsideThePicture)
{
    EXPECT_FALSE(pointer().isVisible());
    showHandAt(0.95, -0.95);
    EXPECT_FALSE(pointer().isVisible());
    showHandAt(1.05, 0.0);
    EXPECT_TRUE(pointer().isVisible());
    // The camera moves until the proxy is in the picture.
    OrbitCamera camera = view().camera();
    camera.distance_m *= 1.5;
    view().setCamera(camera);
    EXPECT_FALSE(pointer().isVisible());
    showHandAt(-1.5, 0.0);
    EXPECT_TRUE(pointer().isVisible());
    view().showDevice(std::nullopt);
    EXPECT_FALSE(pointer().isVisible());
}

TEST_F(HandPointerTest, IsAtTheEdgeNearestToTheStylusAndPointsToIt)
{
    const QSizeF size = view().size();
    const double in = HandPointer::kInset;
    struct Case {
        double right;
        double up;
        QPointF middle;
        const char* name;
    };
    for (const Case& c : {Case{1.5, 0.0, {size.width() - in, size.height() / 2.0}, "right"},
                          Case{-3.0, 0.0, {in, size.height() / 2.0}, "left"},
                          Case{0.0, 1.5, {size.width() / 2.0, in}, "above"},
                          Case{0.0, -1.5, {size.width() / 2.0, size.height() - in}, "below"}}) {
        showHandAt(c.right, c.up);
        ASSERT_TRUE(pointer().isVisible()) << c.name;
        EXPECT_LT(QLineF(middleOfPointer(), c.middle).length(), 1.0) << c.name;
        EXPECT_TRUE(view().rect().contains(pointer().geometry().adjusted(3, 3, -3, -3))) << c.name;
        EXPECT_TRUE(pointer().accessibleName().contains(QLatin1String(c.name))) << c.name;
        // The tip is in front: the red area is narrow there.
        const QImage picture = pointer().grab().toImage().convertToFormat(QImage::Format_RGB32);
        const QPointF middle = middleOfRed(picture);
        const QPointF way = c.middle - QPointF(size.width(), size.height()) / 2.0;
        const QPointF unit = way / std::hypot(way.x(), way.y());
        double width_ahead = 0.0;
        double width_behind = 0.0;
        for (int y = 0; y < picture.height(); ++y) {
            for (int x = 0; x < picture.width(); ++x) {
                const QPointF at =
                    (QPointF(x + 0.5, y + 0.5) - middle) / picture.devicePixelRatio();
                if (isRed(picture.pixel(x, y))) {
                    const double along = QPointF::dotProduct(at, unit);
                    const double across = std::abs(at.x() * unit.y() - at.y() * unit.x());
                    double& width = along > 0.0 ? width_ahead : width_behind;
                    if (std::abs(along) > 5.0) {
                        width = std::max(width, across);
                    }
                }
            }
        }
        EXPECT_GT(width_ahead, 0.0) << c.name;
        EXPECT_GT(width_behind, 2.0 * width_ahead) << c.name;
    }
}

TEST_F(HandPointerTest, IsLegibleOnLightAndDarkTerrain)
{
    showHandAt(1.5, 0.4);
    for (const QColor ground : {QColor(Qt::white), QColor(Qt::black), QColor(128, 128, 128),
                                QColor(219, 26, 20), QColor(176, 106, 60)}) {
        QImage picture(pointer().size(), QImage::Format_RGB32);
        picture.fill(ground);
        QPainter painter(&picture);
        pointer().render(&painter, {}, {}, QWidget::DrawChildren);
        painter.end();
        // From the outside to the red: a rim that contrasts with the terrain, and the red that
        // contrasts with the rim.
        double rim = 1.0;
        int red = 0;
        for (int y = 0; y < picture.height(); ++y) {
            for (int x = 0; x < picture.width(); ++x) {
                rim = std::max(rim, contrast(picture.pixelColor(x, y), ground));
                red += isRed(picture.pixel(x, y)) ? 1 : 0;
            }
        }
        EXPECT_GT(rim, 3.0) << ground.name().toStdString();
        EXPECT_GT(red, 100) << ground.name().toStdString();
    }
    EXPECT_GT(contrast(QColor(219, 26, 20), Qt::white), 3.0);
}

TEST_F(HandPointerTest, IsTransparentToTheMouse)
{
    showHandAt(1.5, 0.0);
    ASSERT_TRUE(pointer().isVisible());
    EXPECT_EQ(view().childAt(pointer().geometry().center()), nullptr);
}

TEST_F(HandPointerTest, StaysBelowOtherOverlays)
{
    showHandAt(0.0, 3.0);
    const double before = middleOfPointer().y();
    window_->overlays()->setCovered(60);
    EXPECT_NEAR(middleOfPointer().y() - before, 60.0, 1.0);
    // A covered point counts as not visible, although it is in the picture.
    showHandAt(0.0, 0.98);
    EXPECT_TRUE(pointer().isVisible());
    window_->overlays()->setCovered(0);
    EXPECT_FALSE(pointer().isVisible());
}

// The workspace is a box around the visible terrain, whose near corners are outside the picture.
TEST_F(HandPointerTest, PointsToTheHandOfADevice)
{
    window_->haptics().device().connectTo(QStringLiteral("hand:"));
    OrbitCamera camera = view().camera();
    camera.distance_m /= 2.0;
    camera.tilt = Angle::degrees(65.0);
    view().setCamera(camera);
    const auto pointer_is = [&](bool is_visible) {
        return QTest::qWaitFor(
            [&] { return view().shownStylus() && pointer().isVisible() == is_visible; }, kTimeout);
    };
    hand_->moveTo({0.075, -0.055, 0.0});
    ASSERT_TRUE(pointer_is(true));
    const auto place = view().positionOfPlace(view().shownStylus()->proxy);
    EXPECT_TRUE(!place || !view().rect().contains(place->toPoint()));
    EXPECT_GT(middleOfPointer().x(), view().width() / 2.0);
    hand_->moveTo({0.0, 0.0, 0.0});
    EXPECT_TRUE(pointer_is(false));
}

} // namespace
} // namespace marsview
