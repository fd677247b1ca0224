#include "core/view/footprint.h"
#include "tests/support/random.h"
#include "tests/ui/timeout.h"
#include "ui/overlay/compass.h"
#include "ui/overlay/force_meter.h"
#include "ui/overlay/gesture_hint.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/minimap.h"
#include "ui/overlay/overlay_layout.h"
#include "ui/overlay/scale_bar_view.h"
#include "ui/text/overlay_text.h"

#include <QAccessible>
#include <QApplication>
#include <QKeyEvent>
#include <QLocale>
#include <QSignalSpy>
#include <QTest>
#include <QVBoxLayout>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr Viewport kViewport{1280, 800};

// The four orientations of rasters, and two rotated ones.
struct Raster {
    const char* name;
    double east_per_column;
    double east_per_row;
    double north_per_column;
    double north_per_row;
};
constexpr std::array kRasters{
    Raster{"north up", 1000.0, 0.0, 0.0, -1000.0},
    Raster{"south up", 1000.0, 0.0, 0.0, 1000.0},
    Raster{"mirrored", -1000.0, 0.0, 0.0, -1000.0},
    Raster{"transposed", 0.0, 1000.0, 1000.0, 0.0},
    Raster{"turned by 30°", 866.0, 500.0, 500.0, -866.0},
    Raster{"sheared", 1000.0, 300.0, -200.0, -700.0},
};
constexpr std::size_t kColumns = 200;
constexpr std::size_t kRows = 120;

SceneFrame frameOf(const Raster& raster)
{
    return {.origin = {(kColumns - 1) / 2.0, (kRows - 1) / 2.0},
            .east_per_column = raster.east_per_column,
            .east_per_row = raster.east_per_row,
            .north_per_column = raster.north_per_column,
            .north_per_row = raster.north_per_row};
}

// Black except for one white block of 20 × 20 samples around a place of the raster.
QImage previewWithMark(GridPoint mark)
{
    QImage image(static_cast<int>(kColumns), static_cast<int>(kRows), QImage::Format_RGBA8888);
    image.fill(Qt::black);
    for (int y = -10; y < 10; ++y) {
        for (int x = -10; x < 10; ++x) {
            image.setPixelColor(static_cast<int>(mark.column) + x, static_cast<int>(mark.row) + y,
                                Qt::white);
        }
    }
    return image;
}

OrbitCamera someCamera()
{
    return {.target = {5000.0, -3000.0, 700.0},
            .distance_m = 20000.0,
            .azimuth = Angle::degrees(-28.0),
            .tilt = Angle::degrees(50.0)};
}

class MinimapTest : public testing::Test {
protected:
    void show(const SceneFrame& frame, const QImage& preview = {})
    {
        minimap_.setMap(preview, frame, kColumns, kRows);
        minimap_.setLargestSize({220, 160});
        minimap_.resize(minimap_.sizeHint());
        QObject::connect(&minimap_, &Minimap::placeRequested, &minimap_,
                         [this](const ScenePoint& place) {
                             asked_ = place;
                             ++asked_count_;
                         });
        minimap_.show();
    }
    void send(QEvent::Type type, QPointF at, Qt::MouseButton button, Qt::MouseButtons held)
    {
        QMouseEvent event(type, at, minimap_.mapToGlobal(at), button, held, Qt::NoModifier);
        QApplication::sendEvent(&minimap_, &event);
    }
    void press(QPointF at) { send(QEvent::MouseButtonPress, at, Qt::LeftButton, Qt::LeftButton); }
    void move(QPointF at) { send(QEvent::MouseMove, at, Qt::NoButton, Qt::LeftButton); }
    void release(QPointF at) { send(QEvent::MouseButtonRelease, at, Qt::LeftButton, Qt::NoButton); }

    Minimap minimap_;
    std::optional<ScenePoint> asked_;
    int asked_count_ = 0;
};

TEST_F(MinimapTest, AClickRequestsTheClickedPlace)
{
    for (const Raster& raster : kRasters) {
        const SceneFrame frame = frameOf(raster);
        const GridPoint mark{150.0, 30.0};
        show(frame, previewWithMark(mark));
        // Located in the image, without a query to the widget: the middle of the white pixels.
        const QImage picture = minimap_.grab().toImage();
        double x = 0.0;
        double y = 0.0;
        double weight = 0.0;
        for (int py = 8; py < picture.height() - 8; ++py) {
            for (int px = 8; px < picture.width() - 8; ++px) {
                const double bright = picture.pixelColor(px, py).lightness() / 255.0;
                if (bright > 0.6) {
                    x += (px + 0.5) * bright;
                    y += (py + 0.5) * bright;
                    weight += bright;
                }
            }
        }
        ASSERT_GT(weight, 50.0) << raster.name;
        const double ratio = minimap_.devicePixelRatioF();
        press(QPointF(x, y) / weight / ratio);
        ASSERT_TRUE(asked_) << raster.name;
        const GridPoint grid = frame.toGrid(*asked_);
        EXPECT_NEAR(grid.column, mark.column - 0.5, 1.5) << raster.name;
        EXPECT_NEAR(grid.row, mark.row - 0.5, 1.5) << raster.name;
    }
}

TEST_F(MinimapTest, HasNorthUpAndEastToTheRight)
{
    for (const Raster& raster : kRasters) {
        show(frameOf(raster));
        const QPointF middle = minimap_.positionOf({0.0, 0.0, 0.0});
        const QPointF east = minimap_.positionOf({10000.0, 0.0, 0.0});
        const QPointF north = minimap_.positionOf({0.0, 10000.0, 0.0});
        EXPECT_GT(east.x(), middle.x()) << raster.name;
        EXPECT_NEAR(east.y(), middle.y(), 1e-9) << raster.name;
        EXPECT_LT(north.y(), middle.y()) << raster.name;
        EXPECT_NEAR(north.x(), middle.x(), 1e-9) << raster.name;
        EXPECT_NEAR(east.x() - middle.x(), middle.y() - north.y(), 1e-9) << "one scale";
        EXPECT_LT(
            std::hypot(middle.x() - minimap_.width() / 2.0, middle.y() - minimap_.height() / 2.0),
            1.0);
    }
}

TEST_F(MinimapTest, ShowsTheWholeMapWithinItsLargestSize)
{
    for (const Raster& raster : kRasters) {
        const SceneFrame frame = frameOf(raster);
        show(frame);
        EXPECT_LE(minimap_.width(), 220);
        EXPECT_LE(minimap_.height(), 160);
        EXPECT_TRUE(minimap_.width() > 210 || minimap_.height() > 150) << raster.name;
        for (const double column : {0.0, kColumns - 1.0}) {
            for (const double row : {0.0, kRows - 1.0}) {
                EXPECT_TRUE(QRectF(minimap_.rect())
                                .contains(minimap_.positionOf(frame.toScene({column, row}, 0.0))))
                    << raster.name;
            }
        }
    }
}

TEST_F(MinimapTest, RequestsPlacesOnlyDuringADrag)
{
    const SceneFrame frame = frameOf(kRasters[4]);
    show(frame);
    minimap_.setCamera(someCamera(), kViewport);
    move({50.0, 50.0});
    EXPECT_EQ(asked_count_, 0) << "no button is down";
    const QPointF middle(minimap_.width() / 2.0, minimap_.height() / 2.0);
    press(middle);
    for (int i = 1; i <= 5; ++i) {
        const QPointF at = middle + QPointF(3.0, -2.0) * i;
        move(at);
        const QPointF back = minimap_.positionOf(*asked_);
        EXPECT_NEAR(back.x(), at.x(), 1e-6);
        EXPECT_NEAR(back.y(), at.y(), 1e-6);
        EXPECT_EQ(asked_->z, 700.0) << "level with the target";
    }
    EXPECT_EQ(asked_count_, 6);
    release(middle);
    move(middle);
    EXPECT_EQ(asked_count_, 6);
}

TEST_F(MinimapTest, ClampsADragOutsideTheMapToItsEdge)
{
    for (const Raster& raster : kRasters) {
        const SceneFrame frame = frameOf(raster);
        show(frame);
        press({5.0, 5.0});
        for (const QPointF at : {QPointF(-500, 30), QPointF(900, 900), QPointF(40, -1e6)}) {
            move(at);
            const GridPoint grid = frame.toGrid(*asked_);
            EXPECT_GE(grid.column, -1e-6) << raster.name;
            EXPECT_LE(grid.column, kColumns - 1.0 + 1e-6) << raster.name;
            EXPECT_GE(grid.row, -1e-6) << raster.name;
            EXPECT_LE(grid.row, kRows - 1.0 + 1e-6) << raster.name;
        }
        release({});
    }
}

TEST_F(MinimapTest, IgnoresOtherButtons)
{
    show(frameOf(kRasters[0]));
    QMouseEvent event(QEvent::MouseButtonPress, QPointF(60, 40),
                      minimap_.mapToGlobal(QPointF(60, 40)), Qt::RightButton, Qt::RightButton,
                      Qt::NoModifier);
    QApplication::sendEvent(&minimap_, &event);
    EXPECT_EQ(asked_count_, 0);
    EXPECT_TRUE(event.isAccepted()) << "the map behind must not get it";
}

TEST_F(MinimapTest, MovesByTheArrowKeys)
{
    show(frameOf(kRasters[1]));
    minimap_.setCamera(someCamera(), kViewport);
    EXPECT_NE(minimap_.focusPolicy() & Qt::TabFocus, 0);
    const auto after = [this](int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QTest::keyClick(&minimap_, static_cast<Qt::Key>(key), modifiers);
        return *asked_ - someCamera().target;
    };
    const double step = 10000.0; // a twentieth of 200 km
    EXPECT_LT(length(after(Qt::Key_Right) - Vec3{step, 0.0, 0.0}), 1e-6);
    EXPECT_LT(length(after(Qt::Key_Left) - Vec3{-step, 0.0, 0.0}), 1e-6);
    EXPECT_LT(length(after(Qt::Key_Up) - Vec3{0.0, step, 0.0}), 1e-6);
    EXPECT_LT(length(after(Qt::Key_Down) - Vec3{0.0, -step, 0.0}), 1e-6);
    EXPECT_LT(length(after(Qt::Key_Up, Qt::ShiftModifier) - Vec3{0.0, step / 5.0, 0.0}), 1e-6);
    EXPECT_EQ(asked_count_, 5);
    QTest::keyClick(&minimap_, Qt::Key_A);
    EXPECT_EQ(asked_count_, 5);
}

TEST_F(MinimapTest, TakesArrowKeysBeforeTheWindowsShortcuts)
{
    show(frameOf(kRasters[0]));
    QKeyEvent arrow(QEvent::ShortcutOverride, Qt::Key_Left, Qt::NoModifier);
    arrow.ignore();
    QApplication::sendEvent(&minimap_, &arrow);
    EXPECT_TRUE(arrow.isAccepted());
    QKeyEvent letter(QEvent::ShortcutOverride, Qt::Key_N, Qt::NoModifier);
    letter.ignore();
    QApplication::sendEvent(&minimap_, &letter);
    EXPECT_FALSE(letter.isAccepted());
}

TEST_F(MinimapTest, DescribesThePositionOfTheView)
{
    show(frameOf(kRasters[0]));
    OrbitCamera camera{.target = {50000.0, -30000.0, 0.0}, .distance_m = 1e6};
    minimap_.setCamera(camera, kViewport);
    EXPECT_EQ(minimap_.accessibleName(), QStringLiteral("Overview map"));
    const QString text = minimap_.accessibleDescription();
    EXPECT_TRUE(text.contains(QStringLiteral("75%"))) << text.toStdString();
    EXPECT_TRUE(text.contains(QStringLiteral("25%"))) << text.toStdString();
    EXPECT_TRUE(text.contains(QStringLiteral("100%"))) << text.toStdString();
}

TEST_F(MinimapTest, DrawsTheFootprintWhereTheCameraLooks)
{
    show(frameOf(kRasters[0]), previewWithMark({20.0, 20.0}));
    const QImage before = minimap_.grab().toImage();
    OrbitCamera camera = someCamera();
    minimap_.setCamera(camera, kViewport);
    const QImage after = minimap_.grab().toImage();
    const QPointF target = minimap_.positionOf(camera.target) * minimap_.devicePixelRatioF();
    EXPECT_NE(before.pixelColor(target.toPoint()), after.pixelColor(target.toPoint()));
    const QPointF far =
        minimap_.positionOf({-90000.0, -50000.0, 0.0}) * minimap_.devicePixelRatioF();
    EXPECT_EQ(before.pixelColor(far.toPoint()), after.pixelColor(far.toPoint()));
}

TEST_F(MinimapTest, RepaintsOnlyForAnotherView)
{
    struct Counter : QObject {
        int paints = 0;
        bool eventFilter(QObject*, QEvent* event) override
        {
            paints += event->type() == QEvent::Paint ? 1 : 0;
            return false;
        }
    } counter;
    show(frameOf(kRasters[0]));
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&minimap_));
    minimap_.setCamera(someCamera(), kViewport);
    QCoreApplication::processEvents();
    minimap_.installEventFilter(&counter);
    minimap_.setCamera(someCamera(), kViewport);
    QCoreApplication::processEvents();
    EXPECT_EQ(counter.paints, 0);
    OrbitCamera other = someCamera();
    other.azimuth = Angle::degrees(10.0);
    minimap_.setCamera(other, kViewport);
    EXPECT_TRUE(QTest::qWaitFor([&] { return counter.paints > 0; }, kTimeout));
    minimap_.removeEventFilter(&counter);
}

TEST_F(MinimapTest, HandlesTheSmallestMapAndNone)
{
    minimap_.setMap(QImage(), {.origin = {0.5, 0.5}}, 2, 2);
    minimap_.resize(minimap_.sizeHint());
    minimap_.setCamera({.distance_m = 3.0, .tilt = Angle::degrees(85.0)}, {1, 1});
    EXPECT_FALSE(minimap_.grab().isNull());
    minimap_.resize(1, 1);
    EXPECT_FALSE(minimap_.grab().isNull());
    // Even for a narrow strip, the minimap is large enough to be seen and clicked.
    minimap_.setMap(QImage(), {.origin = {0.5, 49999.5}}, 2, 100000);
    EXPECT_GE(minimap_.sizeHint().width(), 20);
    minimap_.clear();
    EXPECT_TRUE(minimap_.sizeHint().isEmpty());
    EXPECT_EQ(minimap_.accessibleDescription(), QStringLiteral("No map"));
    QTest::mouseClick(&minimap_, Qt::LeftButton);
}

TEST(Compass, NamesTheDirectionOfTheView)
{
    Compass compass;
    OrbitCamera camera;
    const auto name = [&](double degrees) {
        camera.azimuth = Angle::degrees(degrees);
        compass.setCamera(camera);
        return compass.accessibleName().toStdString();
    };
    EXPECT_EQ(name(-28.0), "Looking toward 332° (north-north-west)");
    EXPECT_EQ(name(-0.2), "Looking toward 0° (north)");
    EXPECT_EQ(name(359.7), "Looking toward 0° (north)");
    EXPECT_EQ(name(90.0), "Looking toward 90° (east)");
    EXPECT_EQ(name(-135.0), "Looking toward 225° (south-west)");
    EXPECT_EQ(name(720.0 + 180.0), "Looking toward 180° (south)");
}

TEST(Compass, PointsNorthWhereNorthIsInThePicture)
{
    Compass compass;
    compass.resize(60, 60);
    test::Random random;
    for (int i = 0; i < 200; ++i) {
        OrbitCamera camera = someCamera();
        camera.azimuth = Angle::degrees(random.uniform(-180.0, 180.0));
        camera.tilt = {};
        compass.setCamera(camera);
        const auto middle = project(camera, kViewport, camera.target);
        const auto north = project(camera, kViewport, camera.target + Vec3{0.0, 100.0, 0.0});
        const QPointF tip = compass.northTip() - QPointF(30.0, 30.0);
        EXPECT_NEAR(std::remainder(std::atan2(tip.y(), tip.x()) -
                                       std::atan2(north->y - middle->y, north->x - middle->x),
                                   2.0 * std::numbers::pi),
                    0.0, 1e-6);
    }
}

TEST(Compass, TurnsNorthUpByMouseKeyAndScreenReader)
{
    Compass compass;
    compass.resize(compass.sizeHint());
    QSignalSpy asked(&compass, &Compass::northRequested);
    QTest::mouseClick(&compass, Qt::LeftButton, {}, compass.rect().center());
    EXPECT_EQ(asked.size(), 1);
    QTest::mouseClick(&compass, Qt::LeftButton, {}, QPoint(1, 1));
    EXPECT_EQ(asked.size(), 1) << "the corner is not part of the rose";
    QTest::keyClick(&compass, Qt::Key_Space);
    EXPECT_EQ(asked.size(), 2);
    QAccessibleInterface* spoken = QAccessible::queryAccessibleInterface(&compass);
    ASSERT_NE(spoken, nullptr);
    EXPECT_EQ(spoken->role(), QAccessible::Button);
    spoken->actionInterface()->doAction(QAccessibleActionInterface::pressAction());
    EXPECT_TRUE(QTest::qWaitFor([&] { return asked.size() == 3; }, kTimeout)) << "shown as a press";
}

TEST(ScaleBarView, ReportsItsLengthToScreenReaders)
{
    ScaleBarView view;
    EXPECT_TRUE(view.sizeHint().isEmpty()) << "before the first camera";
    view.setLongestBar(130);
    OrbitCamera camera{.distance_m = 4e6 / std::tan(Angle::degrees(20.0).radians()) / 2.0};
    // 4 000 km high in 1 000 widget pixels: 520 km in 130.
    const double ratio = view.devicePixelRatioF();
    view.setCamera(camera, {static_cast<int>(1600 * ratio), static_cast<int>(1000 * ratio)});
    ASSERT_TRUE(view.bar());
    EXPECT_EQ(view.bar()->length_m, 500e3);
    EXPECT_NEAR(view.bar()->width_px, 125.0, 1e-9);
    EXPECT_EQ(view.accessibleName(), QStringLiteral("Scale 500 km"));
    EXPECT_TRUE(view.testAttribute(Qt::WA_TransparentForMouseEvents));
    view.clear();
    EXPECT_TRUE(view.sizeHint().isEmpty());
}

TEST(ScaleBarView, DrawsABarOfThatLength)
{
    ScaleBarView view;
    view.setLongestBar(130);
    view.setCamera({.distance_m = 1e5}, {1280, 800});
    view.resize(view.sizeHint());
    const QImage picture = view.grab().toImage();
    const int bottom = picture.height() - static_cast<int>(8 * view.devicePixelRatioF());
    int bright = 0;
    for (int x = 0; x < picture.width(); ++x) {
        bright += picture.pixelColor(x, bottom).lightness() > 178 ? 1 : 0;
    }
    EXPECT_NEAR(bright / view.devicePixelRatioF(), view.bar()->width_px, 1.5);
}

TEST(ScaleBarView, ReadsTheSameInLayoutsFromRightToLeft)
{
    ScaleBarView view;
    view.setCamera({.distance_m = 1e5}, {1280, 800});
    view.resize(view.sizeHint());
    const QImage usual = view.grab().toImage();
    QGuiApplication::setLayoutDirection(Qt::RightToLeft);
    const QImage mirrored = view.grab().toImage();
    QGuiApplication::setLayoutDirection(Qt::LeftToRight);
    EXPECT_EQ(mirrored, usual) << "the unit stays after the number";
}

TEST(OverlayText, WritesLengthsWithTheDigitsTheyHave)
{
    EXPECT_EQ(lengthText(500e3), QStringLiteral("500 km"));
    EXPECT_EQ(lengthText(1000.0), QStringLiteral("1 km"));
    EXPECT_EQ(lengthText(200.0), QStringLiteral("200 m"));
    EXPECT_EQ(lengthText(0.5), QStringLiteral("0.5 m"));
    EXPECT_EQ(lengthText(0.002), QStringLiteral("0.002 m"));
    const QLocale before;
    QLocale::setDefault(QLocale(QLocale::German));
    EXPECT_EQ(lengthText(2e7), QStringLiteral("20.000 km"));
    EXPECT_EQ(lengthText(0.5), QStringLiteral("0,5 m"));
    QLocale::setDefault(before);
    EXPECT_EQ(numberText(-0.004, 0.1), QStringLiteral("0.0"));
}

TEST(Legend, ExplainsColorsAndLines)
{
    Legend legend;
    EXPECT_TRUE(legend.sizeHint().isEmpty());
    const ColorRamp* ramp = colorRampNamed("rust");
    const HeightRange mars{.minimum_m = -8068.0, .maximum_m = 21171.0};
    const auto name = [&](const LegendContent& content) {
        legend.setContent(content);
        return legend.accessibleName().toStdString();
    };
    EXPECT_EQ(name({.ramp = ramp, .range = mars, .contour_interval_m = 500.0}),
              "Legend: elevation from −8068 m to 21171 m, contour lines every 500 m");
    EXPECT_FALSE(legend.sizeHint().isEmpty());
    EXPECT_EQ(name({.mode = ShadingMode::Slope,
                    .ramp = ramp,
                    .range = mars,
                    .slopes = {.minimum = {}, .maximum = Angle::degrees(1.5)}}),
              "Legend: slope from 0.0° to 1.5°");
    EXPECT_EQ(name({.mode = ShadingMode::Hillshade, .ramp = ramp, .contour_interval_m = 2000.0}),
              "Legend: contour lines every 2 km");
    EXPECT_FALSE(legend.sizeHint().isEmpty());
    EXPECT_EQ(name({.mode = ShadingMode::Hillshade, .ramp = ramp}), "Legend");
    EXPECT_TRUE(legend.sizeHint().isEmpty()) << "hillshade alone needs no legend";
    EXPECT_EQ(name({.ramp = ramp, .range = {5.0, 5.0}}), "Legend");
    EXPECT_TRUE(legend.sizeHint().isEmpty()) << "one elevation has one color";
    EXPECT_TRUE(legend.testAttribute(Qt::WA_TransparentForMouseEvents));
}

TEST(Legend, UsesTheUnitOfThePreferences)
{
    Legend legend;
    const LegendContent content{.ramp = colorRampNamed("rust"),
                                .range = {.minimum_m = -3048.0, .maximum_m = 6096.0},
                                .unit = HeightUnit::Feet,
                                .datum = QStringLiteral("areoid")};
    legend.setContent(content);
    EXPECT_EQ(legend.accessibleName(),
              QStringLiteral("Legend: elevation from −10000 ft to 20000 ft (areoid)"));
    EXPECT_FALSE(legend.hasLower());
    EXPECT_FALSE(legend.hasHigher());
}

TEST(Legend, MarksElevationsBeyondTheEndsOfTheRamp)
{
    Legend legend;
    LegendContent content{.ramp = colorRampNamed("rust"),
                          .range = {.minimum_m = -5000.0, .maximum_m = 8000.0}};
    content.all = content.range;
    legend.setContent(content);
    const QSize size = legend.sizeHint();
    legend.resize(size);
    const QImage plain = legend.grab().toImage();
    content.all.maximum_m = 21171.0;
    legend.setContent(content);
    EXPECT_TRUE(legend.hasHigher());
    EXPECT_FALSE(legend.hasLower());
    EXPECT_EQ(legend.accessibleName(),
              QStringLiteral("Legend: elevation from −5000 m to 8000 m, highest 21171 m"));
    EXPECT_EQ(legend.sizeHint(), size) << "arrows take no extra space";
    const QImage marked = legend.grab().toImage();
    EXPECT_NE(marked, plain);
    content.all.minimum_m = -8200.0;
    legend.setContent(content);
    EXPECT_TRUE(legend.hasLower());
    EXPECT_NE(legend.grab().toImage(), marked);
}

TEST(Legend, HasTheHighestColorOnTop)
{
    Legend legend;
    const ColorRamp* ramp = colorRampNamed("grey");
    legend.setContent({.ramp = ramp, .range = {.minimum_m = 0.0, .maximum_m = 3000.0}});
    legend.resize(legend.sizeHint());
    for (const Qt::LayoutDirection direction : {Qt::LeftToRight, Qt::RightToLeft}) {
        legend.setLayoutDirection(direction);
        const QImage picture = legend.grab().toImage();
        const double ratio = legend.devicePixelRatioF();
        const int x =
            static_cast<int>((direction == Qt::LeftToRight ? 12.0 : legend.width() - 12.0) * ratio);
        const QColor upper = picture.pixelColor(x, picture.height() * 4 / 10);
        const QColor lower = picture.pixelColor(x, picture.height() * 8 / 10);
        EXPECT_GT(upper.lightness(), lower.lightness() + 40);
    }
}

TEST(ForceMeter, IsVisibleOnlyWhileTouching)
{
    ForceMeter meter;
    QSignalSpy changes(&meter, &ForceMeter::roomChanged);
    EXPECT_TRUE(meter.sizeHint().isEmpty());
    meter.setForce({0.0, 0.6, 0.8}, 3.0);
    EXPECT_FALSE(meter.sizeHint().isEmpty());
    EXPECT_EQ(meter.text(), QStringLiteral("1.00 N"));
    EXPECT_EQ(meter.accessibleName(), QStringLiteral("Force 1.0 N"));
    EXPECT_EQ(changes.size(), 1);
    meter.setForce({}, 3.0);
    EXPECT_EQ(meter.text(), QStringLiteral("0.00 N")) << "free space within a touch";
    EXPECT_EQ(changes.size(), 1) << "nothing moves while numbers change";
    meter.setForce({std::nan(""), 0.0, 0.0}, 3.0);
    EXPECT_EQ(meter.text(), QStringLiteral("0.00 N"));
    meter.release();
    EXPECT_EQ(changes.size(), 2);
    EXPECT_TRUE(meter.sizeHint().isEmpty());
    EXPECT_TRUE(meter.testAttribute(Qt::WA_TransparentForMouseEvents));
}

TEST(ForceMeter, FillsItsBarInProportionToTheMaximum)
{
    ForceMeter meter;
    const auto filled = [&](double newtons) {
        meter.setForce({0.0, 0.0, newtons}, 2.0);
        meter.resize(meter.sizeHint());
        const QImage picture = meter.grab().toImage();
        int count = 0;
        // To the right of the small image, halfway up, blue or amber.
        for (int x = picture.width() / 4; x < picture.width() * 3 / 4; ++x) {
            count += picture.pixelColor(x, picture.height() / 2).saturation() > 100 ? 1 : 0;
        }
        return count;
    };
    const int none = filled(0.0);
    const int half = filled(1.0);
    const int full = filled(2.0);
    EXPECT_EQ(none, 0);
    EXPECT_GT(half, 20);
    EXPECT_GT(full, half + 30);
    EXPECT_EQ(filled(9.0), full);
}

class OverlayLayoutTest : public testing::Test {
protected:
    void SetUp() override
    {
        // The X server confirms sizes late: an earlier one would replace the next.
        host_.setAttribute(Qt::WA_DontShowOnScreen);
        minimap_->setMap(QImage(), frameOf(kRasters[0]), kColumns, kRows);
        minimap_->setCamera(someCamera(), kViewport);
        scale_bar_->setCamera(someCamera(), kViewport);
        legend_->setContent({.ramp = colorRampNamed("rust"),
                             .range = {.minimum_m = -8068.0, .maximum_m = 21171.0},
                             .contour_interval_m = 200.0});
        force_meter_->setForce({0.0, 0.0, 1.0}, 3.0);
    }
    std::vector<QWidget*> parts()
    {
        return {minimap_, legend_, compass_, scale_bar_, hint_, force_meter_};
    }
    // The number of visible ones; fails if two overlap or one extends beyond the view.
    int checkedCount()
    {
        int count = 0;
        const auto all = parts();
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (all[i]->isHidden()) {
                continue;
            }
            ++count;
            EXPECT_TRUE(host_.rect().contains(all[i]->geometry()));
            EXPECT_EQ(all[i]->size(), all[i]->sizeHint());
            for (std::size_t k = i + 1; k < all.size(); ++k) {
                EXPECT_TRUE(all[k]->isHidden() ||
                            !all[i]->geometry().intersects(all[k]->geometry()))
                    << host_.width() << " × " << host_.height();
            }
        }
        return count;
    }
    void resize(int width, int height)
    {
        host_.resize(width, height);
        QCoreApplication::processEvents();
    }

    QWidget host_;
    Minimap* minimap_ = new Minimap(&host_);
    Legend* legend_ = new Legend(&host_);
    Compass* compass_ = new Compass(&host_);
    ScaleBarView* scale_bar_ = new ScaleBarView(&host_);
    ForceMeter* force_meter_ = new ForceMeter(&host_);
    GestureHint* hint_ = new GestureHint(&host_);
    OverlayLayout* layout_ = new OverlayLayout(&host_,
                                               {.minimap = minimap_,
                                                .legend = legend_,
                                                .compass = compass_,
                                                .scale_bar = scale_bar_,
                                                .force_meter = force_meter_,
                                                .hint = hint_});
};

TEST_F(OverlayLayoutTest, NeverOverlapsInWindowsOfAnySize)
{
    host_.setUpdatesEnabled(false); // painting takes almost all of the time
    host_.show();
    test::Random random;
    std::array<int, 7> seen{};
    for (int i = 0; i < 1500; ++i) {
        const int width = 1 + static_cast<int>(random.below(i % 3 == 0 ? 2000 : 500));
        const int height = 1 + static_cast<int>(random.below(i % 3 == 0 ? 1200 : 400));
        host_.setLayoutDirection(random.chance(0.5) ? Qt::RightToLeft : Qt::LeftToRight);
        random.chance(0.5) ? force_meter_->setForce({0.0, 1.0, 0.0}, 3.0) : force_meter_->release();
        resize(width, height);
        ++seen[static_cast<std::size_t>(checkedCount())];
    }
    for (const int count : seen) {
        EXPECT_GT(count, 0) << "every number of parts occurs";
    }
    resize(1, 1);
    EXPECT_EQ(checkedCount(), 0);
}

TEST_F(OverlayLayoutTest, PlacesThePartsInTheirCorners)
{
    host_.show();
    resize(1000, 700);
    EXPECT_EQ(checkedCount(), 6);
    EXPECT_EQ(hint_->geometry().topLeft(), QPoint(10, 10));
    EXPECT_EQ(minimap_->geometry().right(), 1000 - 10 - 1);
    EXPECT_EQ(minimap_->geometry().top(), 10);
    EXPECT_EQ(scale_bar_->geometry().bottomRight(), QPoint(989, 689));
    EXPECT_LT(compass_->geometry().right(), scale_bar_->geometry().left());
    EXPECT_EQ(compass_->geometry().bottom(), 689);
    EXPECT_EQ(legend_->geometry().bottomLeft(), QPoint(10, 689));
    EXPECT_NEAR(force_meter_->geometry().center().x(), 500, 1);
    EXPECT_EQ(force_meter_->geometry().bottom(), 689);
}

// As when a panel closes with the tool for which the hint was hidden.
TEST_F(OverlayLayoutTest, FollowsTheSizeThatTheHostGetsWhileAPartIsShown)
{
    layout_->setWanted(hint_, false);
    QWidget window;
    window.setAttribute(Qt::WA_DontShowOnScreen);
    auto* layout = new QVBoxLayout(&window);
    layout->setContentsMargins({});
    auto* panel = new QWidget;
    panel->setFixedHeight(300);
    layout->addWidget(&host_, 1);
    layout->addWidget(panel);
    new QVBoxLayout(&host_); // Qt finishes layouts up to the first widget without one
    window.resize(1000, 800);
    window.show();
    QCoreApplication::processEvents();
    const int before = host_.height();
    panel->hide();
    layout_->setWanted(hint_, true);
    EXPECT_TRUE(hint_->isVisible());
    QCoreApplication::processEvents();
    EXPECT_GT(host_.height(), before + 200);
    EXPECT_GT(scale_bar_->geometry().bottom(), host_.height() - 30);
    EXPECT_GT(legend_->geometry().bottom(), host_.height() - 30);
    host_.setParent(nullptr); // not the window's to delete
}

TEST_F(OverlayLayoutTest, IsMirroredFromRightToLeft)
{
    host_.show();
    resize(1000, 700);
    std::vector<QRect> usual;
    for (QWidget* part : parts()) {
        usual.push_back(part->geometry());
    }
    host_.setLayoutDirection(Qt::RightToLeft);
    QCoreApplication::processEvents();
    for (std::size_t i = 0; i < usual.size(); ++i) {
        const QRect& before = usual[i];
        EXPECT_EQ(parts()[i]->geometry(),
                  QRect(1000 - before.right() - 1, before.top(), before.width(), before.height()));
    }
}

TEST_F(OverlayLayoutTest, KeepsTheScaleLongestInASmallWindow)
{
    host_.show();
    resize(340, 210);
    EXPECT_FALSE(scale_bar_->isHidden());
    EXPECT_FALSE(compass_->isHidden());
    EXPECT_FALSE(minimap_->isHidden());
    resize(200, 110);
    EXPECT_FALSE(scale_bar_->isHidden());
    EXPECT_TRUE(minimap_->isHidden());
    EXPECT_TRUE(legend_->isHidden());
    resize(90, 60);
    EXPECT_FALSE(scale_bar_->isHidden());
    EXPECT_TRUE(compass_->isHidden());
    resize(1000, 700);
    EXPECT_EQ(checkedCount(), 6) << "all come back";
}

TEST_F(OverlayLayoutTest, TheHintGetsShorterBeforeItIsHidden)
{
    host_.show();
    resize(1000, 700);
    const QSize full = hint_->size();
    // A little less room than all lines with mouse and keys need.
    resize(10 + full.width() - 1 + 10, 700);
    ASSERT_FALSE(hint_->isHidden());
    EXPECT_LT(hint_->width(), full.width());
    // The map of a window of 1280 × 800 pixels that is scaled to twice its size.
    resize(432, 294);
    EXPECT_FALSE(hint_->isHidden());
    EXPECT_FALSE(legend_->isHidden());
    EXPECT_FALSE(minimap_->isHidden());
    checkedCount();
    resize(1000, 700);
    EXPECT_EQ(hint_->size(), full);
}

TEST_F(OverlayLayoutTest, TouchingMovesNothing)
{
    host_.show();
    for (const QSize size : {QSize(1000, 700), QSize(420, 300), QSize(300, 200)}) {
        force_meter_->release();
        resize(size.width(), size.height());
        std::vector<std::pair<QRect, bool>> before;
        for (QWidget* part : parts()) {
            before.emplace_back(part->geometry(), part->isHidden());
        }
        EXPECT_TRUE(force_meter_->isHidden());
        force_meter_->setForce({0.0, 0.0, 2.0}, 3.0);
        checkedCount();
        for (std::size_t i = 0; i + 1 < before.size(); ++i) {
            EXPECT_EQ(parts()[i]->geometry(), before[i].first);
            EXPECT_EQ(parts()[i]->isHidden(), before[i].second);
        }
    }
    resize(420, 300);
    EXPECT_FALSE(force_meter_->isHidden()) << "above the bottom overlays";
    EXPECT_LT(force_meter_->geometry().bottom(), scale_bar_->geometry().top());
    EXPECT_GT(force_meter_->geometry().left(), legend_->geometry().right());
}

TEST_F(OverlayLayoutTest, HidesDisabledParts)
{
    host_.show();
    resize(1000, 700);
    layout_->setWanted(minimap_, false);
    EXPECT_TRUE(minimap_->isHidden());
    resize(900, 600);
    EXPECT_TRUE(minimap_->isHidden());
    layout_->setWanted(minimap_, true);
    EXPECT_FALSE(minimap_->isHidden());
    minimap_->clear();
    EXPECT_TRUE(minimap_->isHidden()) << "no map";
}

} // namespace
} // namespace marsview
