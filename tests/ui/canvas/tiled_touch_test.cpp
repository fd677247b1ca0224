// Contact with a tiled map, compared with the same map in memory.

#include "core/view/color_ramp.h"
#include "tests/support/map_maker.h"
#include "tests/ui/large_maps.h"
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"

#include <QApplication>
#include <QDeadlineTimer>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <QThread>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

namespace marsview {
namespace {

class TiledTouchTest : public testing::Test {
protected:
    void SetUp() override
    {
        const RasterSpec spec{.path = maps_.waves().toStdString()};
        const std::shared_ptr<const Map> held = test::loadedMap(spec.path);
        const MapOpener opener = large_.opener();
        JobMonitor monitor;
        auto tiled = large_.openTiled(spec, opener.resources, monitor);
        ASSERT_TRUE(tiled) << tiled.error().message;
        ASSERT_TRUE((*tiled)->heightfield().isTiled());
        ASSERT_FALSE(held->heightfield().isTiled());
        held_ = show(held);
        tiled_ = show(*tiled);
    }
    void TearDown() override { large_.holdTiles(false); }

    static std::unique_ptr<TerrainView> show(const std::shared_ptr<const Map>& map)
    {
        auto view = std::make_unique<TerrainView>();
        view->setTool(Tool::Touch);
        view->resize(500, 400);
        view->show();
        EXPECT_TRUE(QTest::qWaitFor([&] { return view->isReady(); }, kTimeout));
        view->setLayers({{.map = map, .ramp = colorRampNamed("grey")}});
        view->setExaggeration(2.0);
        OrbitCamera camera = view->camera();
        camera.target = {200.0, -150.0, 0.0};
        camera.distance_m = 9000.0;
        camera.azimuth = Angle::degrees(25.0);
        camera.tilt = Angle::degrees(50.0);
        view->setCamera(camera);
        EXPECT_TRUE(QTest::qWaitFor([&] { return view->isPictureComplete(); }, kTimeout));
        return view;
    }
    static void send(TerrainView& view, QEvent::Type type, QPointF at, Qt::MouseButton button)
    {
        const Qt::MouseButtons held = type == QEvent::MouseButtonRelease || button == Qt::NoButton
                                          ? Qt::NoButton
                                          : Qt::LeftButton;
        QMouseEvent event(type, at, view.mapToGlobal(at),
                          type == QEvent::MouseMove ? Qt::NoButton : button, held, Qt::NoModifier);
        QApplication::sendEvent(&view, &event);
    }
    void press(QPointF at)
    {
        for (TerrainView* view : {held_.get(), tiled_.get()}) {
            send(*view, QEvent::MouseButtonPress, at, Qt::LeftButton);
        }
    }
    void drag(QPointF at)
    {
        for (TerrainView* view : {held_.get(), tiled_.get()}) {
            send(*view, QEvent::MouseMove, at, Qt::LeftButton);
        }
    }
    void release(QPointF at)
    {
        for (TerrainView* view : {held_.get(), tiled_.get()}) {
            send(*view, QEvent::MouseButtonRelease, at, Qt::LeftButton);
        }
    }
    // The distance between the proxies; infinite if only one is in contact.
    double apartM() const
    {
        const auto& a = held_->stylus();
        const auto& b = tiled_->stylus();
        return a && b && a->is_in_contact && b->is_in_contact
                   ? length(a->proxy - b->proxy)
                   : std::numeric_limits<double>::infinity();
    }
    // Waits until the terrain below the stylus is resident.
    bool comeTogether() const
    {
        return QTest::qWaitFor([this] { return apartM() < kTogetherM; }, kTimeout);
    }

    static constexpr double kTogetherM = 1e-5;

    LargeMaps large_;
    TestMaps maps_;
    std::unique_ptr<TerrainView> held_;
    std::unique_ptr<TerrainView> tiled_;
};

// From a cold start: the first contact is with coarser terrain.
TEST_F(TiledTouchTest, PressesAsOnTheMapInMemoryOnceTilesAreLoaded)
{
    for (const QPointF at : {QPointF{150, 120}, QPointF{260, 210}, QPointF{380, 300}}) {
        large_.forgetTiles();
        press(at);
        EXPECT_TRUE(comeTogether()) << apartM();
        EXPECT_NEAR(length(tiled_->stylus()->force_n), length(held_->stylus()->force_n), 1e-5);
        release(at);
    }
}

// The tile below the pointer arrives after the stylus was aimed and before the press has been
// dealt with.
TEST_F(TiledTouchTest, AimsAgainWhenTilesArriveDuringThePress)
{
    const QPointF at{150.0, 120.0};
    const auto truth = held_->surfaceAt(at);
    ASSERT_TRUE(truth);
    const Heightfield& tiles = tiled_->map()->heightfield();
    large_.holdTiles(true);
    large_.forgetTiles();
    ASSERT_FALSE(tiles.isExact(truth->grid));
    const auto waitForTile = [&] {
        large_.holdTiles(false);
        const QDeadlineTimer deadline(kTimeout);
        while (!tiles.isExact(truth->grid) && !deadline.hasExpired()) {
            QThread::msleep(1);
        }
    };
    QObject::connect(tiled_.get(), &TerrainView::stylusMoved, tiled_.get(), waitForTile,
                     Qt::SingleShotConnection);
    press(at);
    ASSERT_TRUE(tiles.isExact(truth->grid));
    EXPECT_TRUE(comeTogether()) << apartM();
    release(at);
}

TEST_F(TiledTouchTest, DragsAsOnTheMapInMemory)
{
    const QPointF from{150.0, 120.0};
    press(from);
    ASSERT_TRUE(comeTogether()) << apartM();
    for (int i = 1; i <= 25; ++i) {
        const QPointF at = from + QPointF(9.0, 6.0) * i;
        drag(at);
        ASSERT_TRUE(comeTogether()) << i << ": " << apartM();
        const StylusPose& pose = *tiled_->stylus();
        EXPECT_NEAR(length(pose.force_n), length(held_->stylus()->force_n), 1e-5);
        EXPECT_GT(length(pose.force_n), 0.0);
        // On the surface itself, whatever is drawn.
        EXPECT_NEAR(pose.proxy.z,
                    held_->ground().height(pose.proxy.x, pose.proxy.y) * held_->exaggeration(),
                    1e-3);
    }
    release(from);
    EXPECT_FALSE(tiled_->stylus()->is_in_contact);
}

TEST_F(TiledTouchTest, ReadsTheHeightsOfTheMapInMemory)
{
    large_.forgetTiles();
    for (const QPointF at :
         {QPointF{100, 150}, QPointF{250, 200}, QPointF{400, 260}, QPointF{320, 350}}) {
        for (TerrainView* view : {held_.get(), tiled_.get()}) {
            send(*view, QEvent::MouseMove, at, Qt::NoButton);
        }
        const auto truth = held_->surfaceAt(at);
        ASSERT_TRUE(truth);
        ASSERT_TRUE(QTest::qWaitFor(
            [&] {
                const auto read = tiled_->surfaceAt(at);
                return read && std::abs(read->height_m - truth->height_m) < 1e-9;
            },
            kTimeout));
        const auto read = tiled_->surfaceAt(at);
        EXPECT_NEAR(read->grid.column, truth->grid.column, 1e-9);
        EXPECT_NEAR(read->grid.row, truth->grid.row, 1e-9);
    }
}

// A disk that returns no data: contact is with coarser terrain and the window continues. When the
// tiles arrive, the proxy is exact.
TEST_F(TiledTouchTest, NeverWaitsForTiles)
{
    large_.holdTiles(true);
    large_.forgetTiles();
    const QPointF from{150.0, 120.0};
    QSignalSpy moved(tiled_.get(), &TerrainView::stylusMoved);
    press(from);
    ASSERT_TRUE(tiled_->stylus());
    EXPECT_TRUE(tiled_->stylus()->is_in_contact);
    for (int i = 1; i <= 20; ++i) {
        const auto before = moved.count();
        drag(from + QPointF(9.0, 6.0) * i);
        EXPECT_GT(moved.count(), before);
        ASSERT_TRUE(tiled_->stylus()->is_in_contact);
        EXPECT_TRUE(std::isfinite(length(tiled_->stylus()->force_n)));
        QCoreApplication::processEvents();
    }
    EXPECT_GT(apartM(), kTogetherM) << "the tiles that are held back make a difference";
    large_.holdTiles(false);
    EXPECT_TRUE(comeTogether()) << apartM();
    release(from);
}

// While the stylus rests on fully resident terrain, nothing is drawn.
TEST_F(TiledTouchTest, IdlesOnceAllTilesAreLoaded)
{
    press({250.0, 200.0});
    ASSERT_TRUE(comeTogether()) << apartM();
    QSignalSpy moved(tiled_.get(), &TerrainView::stylusMoved);
    const auto is_quiet = [&] {
        moved.clear();
        QTest::qWait(200);
        return moved.count() == 0;
    };
    EXPECT_TRUE(QTest::qWaitFor(is_quiet, kTimeout));
    release({250.0, 200.0});
}

} // namespace
} // namespace marsview
