// Maps in tiles on the globe, touched with the mouse and with a device.
#include "core/globe/body_camera.h"
#include "tests/support/map_maker.h"
#include "tests/ui/globe/globe_window.h"
#include "tests/ui/large_maps.h"
#include "tests/ui/test_device.h"
#include "ui/controllers/haptics/haptics_controller.h"

#include <cmath>
#include <limits>
#include <memory>

namespace marsview {
namespace {

class GlobeTiledTouchTest : public GlobeTest {
protected:
    void SetUp() override
    {
        WindowOptions options = testWindowOptions();
        options.opener = large_.opener();
        options.make_drivers = testDrivers(hand_);
        makeWindow(kSmall, options);
        large_.finishPreparing();
        ASSERT_TRUE(openAndWait(*window_, QString::fromStdString(test::bundledMars())));
        ASSERT_TRUE(waitFor([this] {
            return view().map() && view().map()->heightfield().isTiled() &&
                   !window_->controller().isBusy();
        }));
        truth_ = test::loadedMap(test::bundledMars());
    }
    void TearDown() override { window_.reset(); }

    bool showGlobe(double longitude_deg, double latitude_deg)
    {
        if (!GlobeTest::showGlobe()) {
            return false;
        }
        globe().setCamera({.target = {.longitude = Angle::degrees(longitude_deg),
                                      .latitude = Angle::degrees(latitude_deg)},
                           .distance_m = 1e6});
        return true;
    }
    // The proxy is on the terrain of the map in memory: no coarser level is touched any more.
    bool isOnTruth()
    {
        const auto& pose = globe().shownStylus();
        if (!pose || !pose->is_in_contact) {
            return false;
        }
        const BodyPlace proxy = placeOf(pose->proxy, body());
        return std::abs(proxy.height_m - truth_->height(proxy.foot) * globe().exaggeration()) <
               0.02 * truth_->georeference().pixelHeightMeters();
    }

    LargeMaps large_;
    std::shared_ptr<TestHand> hand_ = std::make_shared<TestHand>();
    std::shared_ptr<const Map> truth_;
};

TEST_F(GlobeTiledTouchTest, TheMousePressesIntoTheTerrainOfTheMapInMemory)
{
    // Next to the seam between the last column and the first.
    ASSERT_TRUE(showGlobe(0.05, 12.0));
    window_->actionSet().tools->actions().at(static_cast<int>(Tool::Touch))->trigger();
    ASSERT_TRUE(waitFor([this] { return globe().isTouchReady(); }));
    const auto send = [this](QEvent::Type type, Qt::MouseButtons buttons) {
        QMouseEvent event(type, globeMiddle(), globe().mapToGlobal(globeMiddle()), Qt::LeftButton,
                          buttons, Qt::NoModifier);
        QApplication::sendEvent(&globe(), &event);
    };
    send(QEvent::MouseButtonPress, Qt::LeftButton);
    EXPECT_TRUE(waitFor([this] { return isOnTruth(); }));
    for (int x = -60; x <= 60; x += 20) {
        move(globeMiddle() + QPointF(x, 5.0), Qt::LeftButton);
        EXPECT_TRUE(waitFor([this] { return isOnTruth(); })) << x;
    }
    send(QEvent::MouseButtonRelease, Qt::NoButton);
}

TEST_F(GlobeTiledTouchTest, ADeviceTouchesTheTerrainOfTheMapInMemory)
{
    ASSERT_TRUE(showGlobe(-112.0, 2.0));
    DeviceSession& device = window_->haptics().device();
    device.connectTo(QStringLiteral("hand:"));
    ASSERT_TRUE(waitFor([&] { return device.isRunning() && globe().shownStylus(); }));
    EXPECT_TRUE(window_->haptics().whyApart().isEmpty());
    hand_->moveTo({0.0, 0.0, -0.055});
    EXPECT_TRUE(waitFor([&] { return hand_->force_n > 0.5 && isOnTruth(); }));
    device.disconnectDevice();
}

enum class InTiles { Fine, Mars, Both };
enum class FineVoids { None, One };

// Cells of 400 m, 2 km above all of Mars.
class GlobeNestedTilesTest : public GlobeTest {
protected:
    void open(InTiles in_tiles, FineVoids voids = FineVoids::None)
    {
        is_fine_in_tiles_ = in_tiles != InTiles::Mars;
        is_mars_in_tiles_ = in_tiles != InTiles::Fine;
        mars_ = test::loadedMap(test::bundledMars());
        const test::MapMaker::Place place{
            300,
            280,
            {-60000, 400, 0, 56000, 0, -400},
            "+proj=tmerc +lat_0=-9 +lon_0=-70 +a=3396190 +b=3376200 +units=m"};
        const Georeference georeference(place.columns, place.rows,
                                        *GeoTransform::fromTerms(place.transform),
                                        *Crs::fromText(place.srs));
        fine_ = maker_.make(place, [&](std::size_t column, std::size_t row) {
            if (voids == FineVoids::One && column == 100 && row == 100) {
                return std::numeric_limits<double>::quiet_NaN();
            }
            const GridPoint at{static_cast<double>(column), static_cast<double>(row)};
            return mars_->height(*georeference.toGeographic(at)) + 2000.0;
        });
        WindowOptions options = testWindowOptions();
        options.opener = large_.opener();
        options.opener.open = [this, large = options.opener.open](const RasterSpec& spec,
                                                                  const MapResources& resources,
                                                                  JobMonitor& monitor) {
            const bool is_large =
                spec.path == test::bundledMars() ? is_mars_in_tiles_ : is_fine_in_tiles_;
            return is_large ? large(spec, resources, monitor)
                            : openMapOrPreview(spec, resources, monitor);
        };
        options.make_drivers = testDrivers(hand_);
        makeWindow(kSmall, options);
        large_.finishPreparing();
        ASSERT_TRUE(openAndWait(*window_, QString::fromStdString(test::bundledMars())));
        ASSERT_TRUE(openAndWait(*window_, QString::fromStdString(fine_->spec().path)));
        ASSERT_TRUE(waitFor([this] {
            const auto& layers = window_->session().layers;
            return layers.size() == 2 &&
                   layers.front().map->heightfield().isTiled() == is_fine_in_tiles_ &&
                   layers.back().map->heightfield().isTiled() == is_mars_in_tiles_ &&
                   !window_->controller().isBusy();
        }));
        ASSERT_TRUE(showGlobe());
        // The middle of the eastern border.
        border_ = *georeference.toGeographic({299.0, 139.5});
        globe().setCamera({.target = border_, .distance_m = 3e5});
    }
    void TearDown() override { window_.reset(); }

    bool areJoined()
    {
        return waitFor([this] {
            const auto& ground = globe().meshes().ground();
            return globe().meshes().isComplete() && ground->surfaces.size() == 2 &&
                   (ground->surfaces[0].tiled != nullptr) == is_fine_in_tiles_ &&
                   (ground->surfaces[1].tiled != nullptr) == is_mars_in_tiles_ &&
                   ground->surfaces[0].joined &&
                   ground->surfaces[1].joined == ground->surfaces[0].joined;
        });
    }
    // The proxy is on the terrain of that map at full resolution.
    bool isOn(const Map& map)
    {
        const auto& pose = globe().shownStylus();
        if (!pose || !pose->is_in_contact) {
            return false;
        }
        const BodyPlace proxy = placeOf(pose->proxy, body());
        return std::abs(proxy.height_m / globe().exaggeration() - map.height(proxy.foot)) < 300.0;
    }

    LargeMaps large_;
    std::shared_ptr<TestHand> hand_ = std::make_shared<TestHand>();
    test::MapMaker maker_;
    std::shared_ptr<const Map> mars_;
    std::shared_ptr<const Map> fine_;
    GeographicPoint border_;
    bool is_fine_in_tiles_ = true;
    bool is_mars_in_tiles_ = false;
};

class GlobeJoinedTilesTest : public GlobeNestedTilesTest,
                             public testing::WithParamInterface<InTiles> {
protected:
    void SetUp() override { open(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Maps,
                         GlobeJoinedTilesTest,
                         testing::Values(InTiles::Fine, InTiles::Mars, InTiles::Both),
                         [](const auto& tested) {
                             return tested.param == InTiles::Fine   ? "TheUpper"
                                    : tested.param == InTiles::Mars ? "TheLower"
                                                                    : "Both";
                         });

TEST_P(GlobeJoinedTilesTest, TheMousePressesIntoBothAsOneSurface)
{
    window_->actionSet().tools->actions().at(static_cast<int>(Tool::Touch))->trigger();
    ASSERT_TRUE(waitFor([this] { return globe().isTouchReady(); }));
    ASSERT_TRUE(areJoined());
    EXPECT_TRUE(globe().meshes().ground()->why_apart.isEmpty());
    const auto send = [this](QEvent::Type type, QPointF at, Qt::MouseButtons buttons) {
        QMouseEvent event(type, at, globe().mapToGlobal(at), Qt::LeftButton, buttons,
                          Qt::NoModifier);
        QApplication::sendEvent(&globe(), &event);
    };
    const QPointF west = globeMiddle() - QPointF(60, 0);
    const QPointF east = globeMiddle() + QPointF(60, 0);
    send(QEvent::MouseButtonPress, west, Qt::LeftButton);
    EXPECT_TRUE(waitFor([this] { return isOn(*fine_); }));
    move(east, Qt::LeftButton);
    EXPECT_TRUE(waitFor([this] { return isOn(*mars_); }));
    move(west, Qt::LeftButton);
    EXPECT_TRUE(waitFor([this] { return isOn(*fine_); }));
    send(QEvent::MouseButtonRelease, west, Qt::NoButton);
}

TEST_P(GlobeJoinedTilesTest, ADeviceStrokesOverTheBorderOnOneSurface)
{
    DeviceSession& device = window_->haptics().device();
    device.connectTo(QStringLiteral("hand:"));
    ASSERT_TRUE(waitFor([&] { return device.isRunning() && globe().shownStylus(); }));
    const auto is_one = [&] {
        const auto& map = device.settings().map;
        const std::size_t in_tiles = (is_fine_in_tiles_ ? 1U : 0U) + (is_mars_in_tiles_ ? 1U : 0U);
        return map && map->below.size() == 1 && map->tiles.size() == in_tiles &&
               map->frame.georeference().columns() == 300 &&
               map->frame.exaggeration() == globe().exaggeration();
    };
    ASSERT_TRUE(waitFor(is_one));
    EXPECT_TRUE(window_->haptics().whyApart().isEmpty());
    const std::uint64_t id = device.settings().map->map_id;
    const auto move_to = [&](double x) { // slower than a jump
        const WorkspacePoint begin = device.loop()->state().hand;
        const int steps = 1 + static_cast<int>(std::abs(x - begin.x) / 0.005);
        for (int i = 1; i <= steps; ++i) {
            const WorkspacePoint next{begin.x + (x - begin.x) * i / steps, 0.0, -0.055};
            hand_->moveTo(next);
            if (!waitFor([&] { return length(device.loop()->state().hand - next) < 1e-9; })) {
                return false;
            }
        }
        return true;
    };
    hand_->moveTo({0.0, 0.0, 0.0});
    ASSERT_TRUE(move_to(-0.02));
    EXPECT_TRUE(waitFor([&] { return hand_->force_n > 0.1 && isOn(*fine_); }));
    ASSERT_TRUE(move_to(0.03));
    EXPECT_TRUE(waitFor([&] { return hand_->force_n > 0.1 && isOn(*mars_); }));
    EXPECT_EQ(device.settings().map->map_id, id) << "the same surface";

    view().setExaggeration(2.0 * view().exaggeration());
    EXPECT_TRUE(waitFor(is_one));
    EXPECT_EQ(device.settings().map->map_id, id) << "the same surface, raised";
    window_->controller().setVisible(window_->session().layers.front().id, false);
    EXPECT_TRUE(waitFor([&] {
        const auto& map = device.settings().map;
        return map->below.empty() && map->tiles.size() == (is_mars_in_tiles_ ? 1U : 0U) &&
               map->map_id != id;
    }));
    device.disconnectDevice();
}

TEST_F(GlobeNestedTilesTest, AMapInTilesThatIsCoveredIsJoinedToo)
{
    open(InTiles::Fine);
    const auto& layers = window_->session().layers;
    window_->controller().move(layers.back().id, 0);
    window_->actionSet().tools->actions().at(static_cast<int>(Tool::Touch))->trigger();
    ASSERT_TRUE(waitFor([this] {
        const auto& ground = globe().meshes().ground();
        return globe().meshes().isComplete() && ground->surfaces.size() == 2 &&
               ground->surfaces[1].tiled;
    }));
    const auto& ground = globe().meshes().ground();
    EXPECT_TRUE(ground->why_apart.isEmpty());
    EXPECT_TRUE(ground->surfaces[0].joined);
    EXPECT_EQ(ground->surfaces[0].joined, ground->surfaces[1].joined);
}

// The reason is stated.
TEST_F(GlobeNestedTilesTest, AMapInTilesWithNodataAboveOthersIsTouchedByItself)
{
    open(InTiles::Both, FineVoids::One);
    window_->actionSet().tools->actions().at(static_cast<int>(Tool::Touch))->trigger();
    ASSERT_TRUE(waitFor([this] {
        const auto& ground = globe().meshes().ground();
        return globe().meshes().isComplete() && ground->surfaces.size() == 2;
    }));
    const auto& ground = globe().meshes().ground();
    EXPECT_FALSE(ground->why_apart.isEmpty());
    EXPECT_FALSE(ground->surfaces[0].joined);
    EXPECT_FALSE(ground->surfaces[1].joined);
}

} // namespace
} // namespace marsview
