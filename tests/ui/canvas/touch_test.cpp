// The stylus on the map, in a real window: its effects, and when it is drawn.
#include "core/view/color_ramp.h"
#include "tests/support/map_maker.h"
#include "tests/support/shared_data.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/graphics_check.h"

#include <QApplication>
#include <QBoxLayout>
#include <QImage>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {
namespace {

using test::MapMaker;

// Counts the paint events of a widget.
class PaintCounter final : public QObject {
public:
    explicit PaintCounter(QWidget& widget) { widget.installEventFilter(this); }
    int count() const { return count_; }
    bool eventFilter(QObject* /*watched*/, QEvent* event) override
    {
        count_ += event->type() == QEvent::Paint || event->type() == QEvent::UpdateRequest ? 1 : 0;
        return false;
    }

private:
    int count_ = 0;
};

std::shared_ptr<const Map> hills(MapMaker& maker, double base_m = 0.0)
{
    return maker.make({.columns = 120, .rows = 90}, [=](std::size_t c, std::size_t r) {
        const double x = static_cast<double>(c);
        const double y = static_cast<double>(r);
        return base_m + 150.0 * std::sin(x / 11.0) * std::cos(y / 9.0) + 2.0 * y;
    });
}

bool isRed(QRgb color)
{
    return qRed(color) > 60 && qRed(color) > 2 * qGreen(color) && qRed(color) > 2 * qBlue(color);
}

int redPixels(const QImage& picture)
{
    int count = 0;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            count += isRed(picture.pixel(x, y)) ? 1 : 0;
        }
    }
    return count;
}

// The apex of the red cone, computed from its rows of pixels; in pixels from the picture's corner.
std::optional<QPointF> coneTip(const QImage& picture)
{
    struct Row {
        double y;
        double left;
        double right;
    };
    std::vector<Row> rows; // from below
    for (int y = picture.height() - 1; y >= 0; --y) {
        int first = picture.width();
        int last = -1;
        for (int x = 0; x < picture.width(); ++x) {
            if (isRed(picture.pixel(x, y))) {
                first = std::min(first, x);
                last = std::max(last, x);
            }
        }
        if (last >= 0) {
            rows.push_back({y + 0.5, static_cast<double>(first), last + 1.0});
        }
    }
    if (rows.size() < 14) {
        return std::nullopt;
    }
    // Straight lines through the sides, as x = a + b y, away from the blunt tip and the lid.
    const auto line = [&](double Row::*side) {
        double n = 0.0;
        double sy = 0.0;
        double sx = 0.0;
        double syy = 0.0;
        double sxy = 0.0;
        for (std::size_t i = 2; i < 12; ++i) {
            const double y = rows[i].y - rows[0].y;
            n += 1.0;
            sy += y;
            sx += rows[i].*side;
            syy += y * y;
            sxy += y * rows[i].*side;
        }
        const double b = (n * sxy - sy * sx) / (n * syy - sy * sy);
        return std::pair{(sx - b * sy) / n, b};
    };
    const auto [left, left_slope] = line(&Row::left);
    const auto [right, right_slope] = line(&Row::right);
    const double y = (right - left) / (left_slope - right_slope);
    return QPointF(left + left_slope * y, rows[0].y + y);
}

double largestDifference(const QImage& a, const QImage& b, double share_left_out)
{
    std::vector<int> differences;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const QRgb p = a.pixel(x, y);
            const QRgb q = b.pixel(x, y);
            differences.push_back(
                std::max({std::abs(qRed(p) - qRed(q)), std::abs(qGreen(p) - qGreen(q)),
                          std::abs(qBlue(p) - qBlue(q))}));
        }
    }
    const auto place = static_cast<std::ptrdiff_t>((1.0 - share_left_out) *
                                                   static_cast<double>(differences.size() - 1));
    std::nth_element(differences.begin(), differences.begin() + place, differences.end());
    return differences[static_cast<std::size_t>(place)];
}

class TouchTest : public testing::Test {
protected:
    void SetUp() override
    {
        start();
        show({hills(maker_)});
        look();
        ASSERT_TRUE(rest());
    }
    void start()
    {
        view_ = std::make_unique<TerrainView>();
        view_->setTool(Tool::Touch);
        view_->resize(800, 600);
        view_->show();
        QApplication::setActiveWindow(view_.get()); // possibly without a window manager
        view_->setFocus();
        ASSERT_TRUE(
            QTest::qWaitFor([this] { return view_->isReady() && view_->hasFocus(); }, kTimeout));
    }
    void show(const std::vector<std::shared_ptr<const Map>>& maps)
    {
        std::vector<ShownLayer> layers;
        for (const std::shared_ptr<const Map>& map : maps) {
            layers.push_back({.map = map, .ramp = colorRampNamed("grey")});
        }
        view_->setLayers(layers);
    }
    // From a side from which cones appear as triangles.
    void look()
    {
        OrbitCamera camera = view_->camera();
        camera.target = {100.0, -80.0, 0.0};
        camera.distance_m = 2600.0;
        camera.azimuth = Angle::degrees(25.0);
        camera.tilt = Angle::degrees(58.0);
        view_->setCamera(camera);
    }
    bool rest()
    {
        return QTest::qWaitFor([this] { return view_->isPictureComplete(); }, kTimeout);
    }
    void send(QEvent::Type type, QPointF at, Qt::MouseButton button, Qt::MouseButtons held)
    {
        QMouseEvent event(type, at, view_->mapToGlobal(at), button, held, Qt::NoModifier);
        QApplication::sendEvent(view_.get(), &event);
    }
    void hover(QPointF at) { send(QEvent::MouseMove, at, Qt::NoButton, Qt::NoButton); }
    void press(QPointF at) { send(QEvent::MouseButtonPress, at, Qt::LeftButton, Qt::LeftButton); }
    void drag(QPointF at) { send(QEvent::MouseMove, at, Qt::NoButton, Qt::LeftButton); }
    void release(QPointF at) { send(QEvent::MouseButtonRelease, at, Qt::LeftButton, Qt::NoButton); }
    void wheel(QPointF at, int angle)
    {
        QWheelEvent event(at, view_->mapToGlobal(at), {}, {0, angle}, Qt::LeftButton,
                          Qt::NoModifier, Qt::NoScrollPhase, false);
        QApplication::sendEvent(view_.get(), &event);
    }
    void holdSpace() { QTest::keyPress(view_.get(), Qt::Key_Space); }
    void letSpaceGo() { QTest::keyRelease(view_.get(), Qt::Key_Space); }
    StylusMode mode() const { return view_->stylus()->mode; }

    // The range of distances along the view axis in the terrain's depth buffer around a position.
    std::pair<double, double> drawnDepths(QPointF at)
    {
        view_->terrainPicture();
        view_->makeCurrent();
        QOpenGLFunctions& gl = *view_->context()->functions();
        gl.glBindFramebuffer(GL_FRAMEBUFFER, view_->defaultFramebufferObject());
        std::array<float, 9> depths{};
        const Viewport viewport = view_->viewport();
        gl.glReadPixels(static_cast<int>(at.x()) - 1,
                        viewport.height - 1 - static_cast<int>(at.y()) - 1, 3, 3,
                        GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
        view_->doneCurrent();
        const ClipRange clip =
            clipRange(view_->camera(), view_->ground().box(view_->exaggeration()));
        std::pair range{std::numeric_limits<double>::infinity(), 0.0};
        for (const float depth : depths) {
            const double ndc = 2.0 * static_cast<double>(depth) - 1.0;
            const double m = 2.0 * clip.near_m * clip.far_m /
                             (clip.far_m + clip.near_m - ndc * (clip.far_m - clip.near_m));
            range = {std::min(range.first, m), std::max(range.second, m)};
        }
        return range;
    }

    MapMaker maker_;
    std::unique_ptr<TerrainView> view_;
};

TEST_F(TouchTest, PressesWhileTheLeftButtonIsDown)
{
    QSignalSpy moved(view_.get(), &TerrainView::stylusMoved);
    hover({400.0, 300.0});
    ASSERT_TRUE(view_->stylus());
    EXPECT_EQ(mode(), StylusMode::Hover);
    EXPECT_FALSE(view_->stylus()->is_in_contact);
    press({400.0, 300.0});
    EXPECT_EQ(mode(), StylusMode::Press);
    EXPECT_TRUE(view_->stylus()->is_in_contact);
    EXPECT_GT(length(view_->stylus()->force_n), 0.0);
    const ScenePoint before = view_->stylus()->proxy;
    const OrbitCamera camera = view_->camera();
    drag({430.0, 310.0});
    EXPECT_EQ(mode(), StylusMode::Press);
    EXPECT_NE(view_->stylus()->proxy, before);
    EXPECT_EQ(view_->camera(), camera);
    EXPECT_EQ(moved.count(), 3);
    release({430.0, 310.0});
    EXPECT_EQ(mode(), StylusMode::Hover);
    EXPECT_FALSE(view_->stylus()->is_in_contact);
    EXPECT_EQ(length(view_->stylus()->force_n), 0.0);
    EXPECT_EQ(moved.count(), 4);
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(view_.get(), &leave);
    EXPECT_FALSE(view_->stylus());
    EXPECT_EQ(moved.count(), 5);
}

TEST_F(TouchTest, ReleasingTheLeftButtonEndsTheTouchEvenIfAnotherIsDown)
{
    press({400.0, 300.0});
    send(QEvent::MouseButtonPress, {400.0, 300.0}, Qt::RightButton,
         Qt::LeftButton | Qt::RightButton);
    EXPECT_EQ(mode(), StylusMode::Press);
    send(QEvent::MouseButtonRelease, {400.0, 300.0}, Qt::LeftButton, Qt::RightButton);
    EXPECT_EQ(mode(), StylusMode::Hover);
    send(QEvent::MouseButtonRelease, {400.0, 300.0}, Qt::RightButton, Qt::NoButton);
    EXPECT_EQ(mode(), StylusMode::Hover);
}

TEST_F(TouchTest, TheConeStandsOnTheSurfaceThatIsDrawn)
{
    int seen = 0;
    for (const double exaggeration : {0.5, 1.0}) {
        view_->setExaggeration(exaggeration);
        look();
        ASSERT_TRUE(rest());
        for (const QPointF at : {QPointF{400, 300}, QPointF{250, 380}, QPointF{560, 260},
                                 QPointF{330, 250}, QPointF{480, 450}}) {
            press(at);
            const StylusPose pose = *view_->stylus();
            ASSERT_TRUE(pose.is_in_contact);
            const QPointF where = view_->positionOfPlace(pose.proxy).value();
            const QImage with = view_->grabFramebuffer();
            const QImage without = view_->terrainPicture();
            EXPECT_EQ(redPixels(without), 0);
            const ScenePoint eye = eyeOf(view_->camera());
            const Vec3 forward = axesOf(view_->camera()).forward;
            const double depth_m = dot(pose.proxy - eye, forward);
            const double pixel_m = metersPerPixel(view_->camera(), view_->viewport(), pose.proxy);
            // If the proxy has slid behind a ridge, its tip is hidden, as it should be.
            const auto hit = view_->surfaceAt(where);
            const bool is_hidden = !hit || hit->t < length(pose.proxy - eye) - 3.0 * pixel_m;
            if (!is_hidden) {
                const auto [nearest_m, farthest_m] = drawnDepths(where);
                EXPECT_GT(depth_m, nearest_m - pixel_m);
                EXPECT_LT(depth_m, farthest_m + pixel_m);
                const auto tip = coneTip(with);
                ASSERT_TRUE(tip);
                EXPECT_NEAR(tip->x(), where.x(), 1.0);
                EXPECT_NEAR(tip->y(), where.y(), 1.0);
                ++seen;
            }
            release(at);
        }
    }
    std::printf("%d cones\n", seen);
    EXPECT_GE(seen, 5);
}

TEST_F(TouchTest, TheSphereHoversUnderThePointersGround)
{
    const QPointF at{400.0, 300.0};
    hover(at);
    const QImage with = view_->grabFramebuffer();
    EXPECT_GT(redPixels(with), 100);
    double x = 0.0;
    double y = 0.0;
    for (int row = 0; row < with.height(); ++row) {
        for (int column = 0; column < with.width(); ++column) {
            if (isRed(with.pixel(column, row))) {
                x += column + 0.5;
                y += row + 0.5;
            }
        }
    }
    const QPointF where = view_->positionOfPlace(view_->stylus()->proxy).value();
    EXPECT_NEAR(x / redPixels(with), where.x(), 1.0);
    EXPECT_NEAR(y / redPixels(with), where.y(), 1.0);
    EXPECT_NEAR(where.x(), at.x(), 0.5);
    EXPECT_LT(where.y(), at.y());
}

TEST_F(TouchTest, SpaceWithTheButtonDownMovesTheMapWithTheHand)
{
    const QPointF from{400.0, 300.0};
    press(from);
    drag(from + QPointF(3.0, 2.0));
    const QPointF grabbed_at = from + QPointF(3.0, 2.0);
    holdSpace();
    EXPECT_EQ(mode(), StylusMode::Pan);
    const auto grabbed = view_->surfaceAt(grabbed_at);
    ASSERT_TRUE(grabbed);
    const StylusPose held = *view_->stylus();
    const OrbitCamera before = view_->camera();
    for (int i = 1; i <= 12; ++i) {
        const QPointF at = grabbed_at + QPointF(9.0, -4.0) * i;
        drag(at);
        EXPECT_EQ(mode(), StylusMode::Pan);
        EXPECT_EQ(view_->stylus()->proxy, held.proxy) << "the map moves, not the place on it";
        const auto now = view_->positionOf(grabbed->grid);
        ASSERT_TRUE(now);
        EXPECT_NEAR(now->x(), at.x(), 0.05);
        EXPECT_NEAR(now->y(), at.y(), 0.05);
    }
    EXPECT_EQ(view_->camera().azimuth, before.azimuth);
    EXPECT_EQ(view_->camera().distance_m, before.distance_m);
    letSpaceGo();
    EXPECT_EQ(mode(), StylusMode::Press);
    const OrbitCamera after = view_->camera();
    drag(grabbed_at);
    EXPECT_EQ(view_->camera(), after);
    release(grabbed_at);
}

TEST_F(TouchTest, SpaceAloneZoomsAboutTheGrabbedPlace)
{
    const QPointF at{420.0, 280.0};
    hover(at);
    const StylusPose before = *view_->stylus();
    holdSpace();
    EXPECT_EQ(mode(), StylusMode::Zoom);
    const QPointF where = view_->positionOfPlace(before.proxy).value();
    double distance_m = view_->camera().distance_m;
    for (int i = 1; i <= 10; ++i) {
        hover(at - QPointF(0.0, 6.0 * i)); // away from the user: closer
        EXPECT_LT(view_->camera().distance_m, distance_m);
        distance_m = view_->camera().distance_m;
        EXPECT_EQ(mode(), StylusMode::Zoom);
        EXPECT_EQ(view_->stylus()->proxy, before.proxy);
        const QPointF now = view_->positionOfPlace(before.proxy).value();
        EXPECT_NEAR(now.x(), where.x(), 0.1);
        EXPECT_NEAR(now.y(), where.y(), 0.1);
    }
    hover(at);
    EXPECT_GT(view_->camera().distance_m, distance_m);
    press(at); // a grab keeps the mode in which it started
    EXPECT_EQ(mode(), StylusMode::Zoom);
    release(at);
    letSpaceGo();
    EXPECT_EQ(mode(), StylusMode::Hover);
}

TEST_F(TouchTest, AGrabLastsUntilTheKeyIsReleasedWhereverTheFocusIs)
{
    hover({400.0, 300.0});
    holdSpace();
    EXPECT_EQ(mode(), StylusMode::Zoom);
    view_->clearFocus();
    EXPECT_EQ(mode(), StylusMode::Zoom);
    letSpaceGo();
    EXPECT_EQ(mode(), StylusMode::Hover);
    const OrbitCamera before = view_->camera();
    hover({400.0, 200.0});
    EXPECT_EQ(view_->camera(), before);
}

TEST_F(TouchTest, TheWheelPressesDeeperWithoutMovingTheCamera)
{
    press({400.0, 300.0});
    const OrbitCamera before = view_->camera();
    const auto depth_m = [this] {
        const ScenePoint goal = view_->stylus()->goal;
        return view_->ground().height(goal.x, goal.y) * view_->exaggeration() - goal.z;
    };
    const double first_m = depth_m();
    EXPECT_GT(first_m, 0.0);
    wheel({400.0, 300.0}, -240);
    EXPECT_NEAR(depth_m(), first_m * 1.15 * 1.15, 1e-6 * first_m);
    wheel({400.0, 300.0}, 120);
    EXPECT_NEAR(depth_m(), first_m * 1.15, 1e-6 * first_m);
    for (int i = 0; i < 50; ++i) {
        wheel({400.0, 300.0}, -480);
    }
    EXPECT_NEAR(depth_m(), first_m / 30.0 * kStylusDepthMax, 1e-6 * first_m);
    EXPECT_EQ(view_->camera(), before);
    EXPECT_FALSE(view_->isMoving());
    release({400.0, 300.0});
    wheel({400.0, 300.0}, 120);
    EXPECT_TRUE(view_->isMoving()) << "without the button it zooms";
}

TEST_F(TouchTest, ExaggerationWhilePressedKeepsTheStylusOnTheTerrain)
{
    press({400.0, 300.0});
    for (const double exaggeration : {2.0, 10.0, 0.5, 5.0}) {
        view_->setExaggeration(exaggeration);
        const StylusPose& pose = *view_->stylus();
        EXPECT_TRUE(pose.is_in_contact);
        EXPECT_NEAR(pose.proxy.z, view_->ground().height(pose.proxy.x, pose.proxy.y) * exaggeration,
                    1e-3);
    }
    holdSpace();
    ASSERT_EQ(mode(), StylusMode::Pan);
    view_->setExaggeration(8.0);
    const StylusPose& pose = *view_->stylus();
    EXPECT_NEAR(pose.proxy.z, view_->ground().height(pose.proxy.x, pose.proxy.y) * 8.0, 1e-3);
}

TEST_F(TouchTest, TheCursorMovesWithoutTheTerrainBeingDrawnAgain)
{
    hover({300.0, 300.0});
    ASSERT_TRUE(rest());
    QSignalSpy terrain(view_.get(), &TerrainView::detailChanged); // with every picture of it
    const PaintCounter paints(*view_);
    QImage last = view_->grabFramebuffer();
    for (int i = 1; i <= 20; ++i) {
        hover({300.0 + 5.0 * i, 300.0});
        const int before = paints.count();
        ASSERT_TRUE(QTest::qWaitFor([&] { return paints.count() > before; }, kTimeout));
        const QImage picture = view_->grabFramebuffer();
        EXPECT_NE(picture, last);
        last = picture;
    }
    press({400.0, 300.0});
    drag({410.0, 320.0});
    wheel({410.0, 320.0}, -120);
    release({410.0, 320.0});
    view_->grabFramebuffer();
    EXPECT_EQ(terrain.count(), 0);
    EXPECT_TRUE(view_->isPictureComplete());
    view_->step(NavigationStep::TurnLeft);
    EXPECT_TRUE(rest());
    EXPECT_GT(terrain.count(), 0) << "the counter works";
}

TEST_F(TouchTest, AnIdleWindowPaintsNothing)
{
    hover({300.0, 300.0});
    ASSERT_TRUE(rest());
    const auto turn = [] {
        QCoreApplication::sendPostedEvents();
        QCoreApplication::processEvents();
    };
    PaintCounter settling(*view_);
    int quiet = 0;
    for (int i = 0; i < 10000 && quiet < 50; ++i) {
        const int before = settling.count();
        turn();
        quiet = settling.count() == before ? quiet + 1 : 0;
    }
    ASSERT_EQ(quiet, 50);
    QSignalSpy composed(view_.get(), &QOpenGLWidget::aboutToCompose);
    const PaintCounter paints(*view_);
    for (int i = 0; i < 2000; ++i) {
        turn();
    }
    EXPECT_EQ(paints.count(), 0);
    EXPECT_EQ(composed.count(), 0);
    view_->update();
    turn();
    EXPECT_GT(paints.count(), 0) << "the counters work";
}

TEST_F(TouchTest, SavingAPictureDoesNotAffectTheStylus)
{
    press({400.0, 300.0});
    drag({420.0, 310.0});
    holdSpace();
    drag({440.0, 320.0});
    const StylusPose before = *view_->stylus();
    ASSERT_EQ(before.mode, StylusMode::Pan);
    ASSERT_TRUE(rest());
    QSignalSpy moved(view_.get(), &TerrainView::stylusMoved);
    EXPECT_GT(redPixels(view_->grabFramebuffer()), 50);
    EXPECT_EQ(redPixels(view_->terrainPicture()), 0);
    EXPECT_GT(redPixels(view_->grabFramebuffer()), 50);
    EXPECT_EQ(moved.count(), 0);
    EXPECT_EQ(view_->stylus()->mode, before.mode);
    EXPECT_EQ(view_->stylus()->proxy, before.proxy);
}

TEST_F(TouchTest, TheFirstMapMayOpenUnderThePointer)
{
    show({});
    EXPECT_FALSE(view_->stylus());
    hover({400.0, 300.0});
    press({400.0, 300.0});
    EXPECT_FALSE(view_->stylus());
    release({400.0, 300.0});
    show({hills(maker_), hills(maker_, -100.0)});
    ASSERT_TRUE(view_->stylus());
    EXPECT_EQ(mode(), StylusMode::Hover);
    show({hills(maker_)});
    EXPECT_TRUE(view_->stylus());
    EXPECT_TRUE(rest());
    show({});
    EXPECT_FALSE(view_->stylus());
    EXPECT_EQ(redPixels(view_->grabFramebuffer()), 0);
}

TEST_F(TouchTest, LayersThatChangeBelowKeepTheStylusOverTheGround)
{
    const std::shared_ptr<const Map> top = hills(maker_);
    show({top});
    hover({400.0, 300.0});
    ASSERT_TRUE(view_->stylus());
    show({top, hills(maker_, -100.0)});
    EXPECT_TRUE(view_->stylus());
    press({400.0, 300.0});
    show({top});
    ASSERT_TRUE(view_->stylus());
    EXPECT_EQ(mode(), StylusMode::Press);
    EXPECT_TRUE(view_->stylus()->is_in_contact);
}

// A widget in another window has a different graphics context.
TEST_F(TouchTest, AnotherWindowShowsTheSamePicture)
{
    show({hills(maker_), hills(maker_, 50.0)});
    look();
    ASSERT_TRUE(rest());
    const QImage before = view_->terrainPicture();
    const OrbitCamera camera = view_->camera();
    for (int i = 0; i < 3; ++i) {
        QSignalSpy ready(view_.get(), &TerrainView::ready);
        auto window = std::make_unique<QWidget>();
        auto* layout = new QHBoxLayout(window.get());
        layout->setContentsMargins({});
        layout->addWidget(view_.get());
        window->resize(800, 600);
        window->show();
        ASSERT_TRUE(QTest::qWaitFor([&] { return ready.count() > 0; }, kTimeout));
        ASSERT_TRUE(rest());
        const QImage after = view_->terrainPicture();
        ASSERT_EQ(after.size(), before.size());
        EXPECT_EQ(view_->camera(), camera);
        EXPECT_EQ(view_->ground().maps().size(), 2U);
        EXPECT_LE(largestDifference(before, after, 0.001), 3.0);
        hover({400.0, 300.0});
        EXPECT_GT(redPixels(view_->grabFramebuffer()), 50);
        QEvent leave(QEvent::Leave);
        QApplication::sendEvent(view_.get(), &leave);
        layout->removeWidget(view_.get());
        view_->setParent(nullptr); // before its window is destroyed
        if (i == 1) {              // once as a separate window in between
            view_->show();
            ASSERT_TRUE(QTest::qWaitFor([&] { return ready.count() > 1; }, kTimeout));
            ASSERT_TRUE(rest());
        }
    }
}

TEST_F(TouchTest, SurvivesTheSmallestAndTheLargestWindows)
{
    const QImage before = view_->terrainPicture();
    const OrbitCamera camera = view_->camera();
    view_->setMinimumSize(1, 1);
    for (const QSize size : {QSize(1, 1), QSize(1, 700), QSize(8000, 4000), QSize(900, 1)}) {
        // The largest pictures take four times as long with anti-aliasing, and gain nothing from
        // it.
        view_->setAntialiasing(size.width() * size.height() < 10'000'000);
        view_->resize(size);
        QCoreApplication::processEvents();
        ASSERT_TRUE(rest()) << size.width() << " x " << size.height();
        EXPECT_EQ(view_->viewport().width, size.width());
        EXPECT_EQ(view_->viewport().height, size.height());
        const QPointF middle(size.width() / 2.0, size.height() / 2.0);
        press(middle);
        release(middle);
        QEvent leave(QEvent::Leave);
        QApplication::sendEvent(view_.get(), &leave);
        EXPECT_EQ(view_->grabFramebuffer().size(), size);
    }
    view_->resize(800, 600);
    QCoreApplication::processEvents();
    ASSERT_TRUE(rest());
    EXPECT_EQ(view_->camera(), camera);
    EXPECT_LE(largestDifference(before, view_->terrainPicture(), 0.001), 3.0);
}

TEST(TerrainViewWithoutContext, SaysThatItIsUnavailable)
{
    QSurfaceFormat none = mapSurfaceFormat();
    none.setRenderableType(QSurfaceFormat::OpenVG); // no driver supports it
    QSurfaceFormat embedded = mapSurfaceFormat();
    embedded.setRenderableType(QSurfaceFormat::OpenGLES);
    embedded.setVersion(2, 0);
    embedded.setProfile(QSurfaceFormat::NoProfile);
    MapMaker maker;
    const std::shared_ptr<const Map> map = hills(maker);
    for (const QSurfaceFormat& format : {none, embedded}) {
        TerrainView view;
        QSignalSpy unavailable(&view, &TerrainView::unavailable);
        QSignalSpy ready(&view, &TerrainView::ready);
        view.setFormat(format);
        view.resize(300, 200);
        view.show();
        ASSERT_TRUE(QTest::qWaitFor([&] { return unavailable.count() > 0; }, kTimeout));
        EXPECT_FALSE(unavailable[0][0].toString().isEmpty());
        EXPECT_FALSE(view.isReady());
        // The view can still be used without it.
        view.setLayers({{.map = map, .ramp = &colorRamps().front()}});
        view.setExaggeration(3.0);
        QTest::mouseClick(&view, Qt::LeftButton, {}, {150, 100});
        view.resize(400, 300);
        view.grabFramebuffer();
        QCoreApplication::processEvents();
        EXPECT_EQ(unavailable.count(), 1);
        EXPECT_EQ(ready.count(), 0);
    }
}

} // namespace
} // namespace marsview
