// Several layers of one body on the globe, each in a projection of its own.
#include "core/body/body_mesh.h"
#include "core/globe/body_camera.h"
#include "tests/ui/globe/globe_window.h"
#include "ui/dialogs/go_to_dialog.h"
#include "ui/overlay/globe_overlays.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/minimap.h"
#include "ui/panels/layer_model.h"
#include "ui/panels/layers_panel.h"
#include "ui/widgets/notice_bar.h"
#include "ui/window/status_readout.h"

#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMouseEvent>
#include <QSpinBox>
#include <QTest>
#include <QToolButton>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace marsview {
namespace {

class GlobeLayersTest : public GlobeTest {
protected:
    // 40 × 30 samples of 20 km around 80° N, 0° E, over the whole of Mars.
    QString nested()
    {
        return maps_.placed("polar", "IAU_2015:49930", {-400e3, 20e3, 0.0, -300e3, 0.0, -20e3});
    }
    bool openNested() { return openAndWait(*window_, nested()); }
    bool showBoth()
    {
        return openNested() && showGlobe() &&
               waitFor([this] { return globe().scene().maps().size() == 2; });
    }
    std::optional<std::size_t> layerAt(double longitude_deg, double latitude_deg)
    {
        globe().setCamera({.target = {.longitude = Angle::degrees(longitude_deg),
                                      .latitude = Angle::degrees(latitude_deg)},
                           .distance_m = 1e6});
        const auto ground = globe().groundAt(globeMiddle());
        return ground ? std::optional(ground->index) : std::nullopt;
    }
    MapOverlays& flat() { return *window_->overlays(); }
    LayerModel& list() { return *window_->datasetPanel()->findChild<LayerModel*>(); }
};

TEST_F(GlobeLayersTest, LayersInOtherProjectionsLieTogetherTheUpperOneOnTop)
{
    ASSERT_TRUE(openNested());
    EXPECT_EQ(view().shownLayers().size(), 1U); // the flat map has one CRS
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 2; }));
    EXPECT_EQ(globe().layers().front().map, view().map());
    EXPECT_EQ(layerAt(0.0, 80.0), 0U);
    EXPECT_EQ(layerAt(90.0, 80.0), 1U);
    EXPECT_EQ(layerAt(-120.0, 10.0), 1U);
}

// 20 km cells; the layer goes from -300 to 480 m from west to east.
TEST_F(GlobeLayersTest, EdgesAreBlendedIntoTheLayerBelowUntilThatIsUndone)
{
    ASSERT_TRUE(openNested());
    auto* cells = window_->datasetPanel()->findChild<QSpinBox*>(QStringLiteral("feather"));
    ASSERT_NE(cells, nullptr);
    EXPECT_TRUE(cells->isHidden()) << "the flat map has steps";
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 2; }));
    EXPECT_FALSE(cells->isHidden());
    const LayerId top = window_->session().active;
    const LayerId mars = window_->session().layers.back().id;
    window_->controller().activate(mars);
    EXPECT_TRUE(cells->isHidden()) << "nothing lies below";
    window_->controller().activate(top);
    const auto upper = [this]() -> const BodyTerrain& { return globe().scene().maps().front(); };
    ASSERT_EQ(upper().shown(), upper().map());

    cells->setValue(8);
    ASSERT_TRUE(waitFor([&] { return upper().shown() != upper().map(); }));
    ASSERT_TRUE(waitFor([this] { return globe().isPictureComplete(); }));
    EXPECT_EQ(layerOf(window_->session(), top)->feather_cells, 8U);
    const BodyTerrain& lower = globe().scene().maps().back();
    for (const GridPoint border : {GridPoint{0.0, 12.0}, GridPoint{39.0, 7.0}}) {
        const auto place = upper().map()->georeference().toGeographic(border);
        ASSERT_TRUE(place);
        EXPECT_NEAR(globe().scene().height(*place), lower.height(*place), 0.01);
        EXPECT_EQ(upper().elevationOnGrid(border), border.column * 20.0 - 300.0);
    }
    EXPECT_EQ(upper().heightOnGrid({20.0, 15.0}), 100.0) << "to the bit";
    // The status bar has the elevation of the data, at a border sample and where half is blended.
    const auto read_m = [&](const GridPoint& grid) {
        const auto place = upper().map()->georeference().toGeographic(grid);
        globe().setCamera({.target = *place,
                           .height_m = globe().scene().height(*place),
                           .distance_m = 3e5,
                           .azimuth = {},
                           .tilt = {}});
        move(globeMiddle());
        const auto reading = globe().reading();
        EXPECT_TRUE(reading && reading->index == 0);
        return std::pair(window_->readout()->heightLabel(), reading->hit.grid.column);
    };
    const auto [label, column] = read_m({4.0, 15.0});
    const double expected_m = column * 20.0 - 300.0;
    const double shown_m = upper().heightOnGrid({column, 15.0});
    EXPECT_GT(std::abs(shown_m - expected_m), 50.0) << "blended";
    EXPECT_NE(label.indexOf(QString::number(static_cast<int>(std::abs(expected_m)))), -1)
        << label.toStdString() << " for " << expected_m;
    // What is touched is the same surface.
    globe().setTool(Tool::Touch);
    ASSERT_TRUE(waitFor([this] { return globe().meshes().isComplete(); }));
    EXPECT_EQ(globe().meshes().ground()->scene.maps().front().shown(), upper().shown());

    EXPECT_TRUE(window_->controller().undoStack().undoText().startsWith(
        QStringLiteral("Blended Edges of")));
    window_->controller().undoStack().undo();
    ASSERT_TRUE(waitFor([&] { return upper().shown() == upper().map(); }));
    EXPECT_EQ(cells->value(), 0);
    window_->controller().undoStack().redo();
    ASSERT_TRUE(waitFor([&] { return upper().shown() != upper().map(); }));
    EXPECT_EQ(cells->value(), 8);
    // With another order of layers nothing lies below it.
    window_->controller().move(top, 1);
    ASSERT_TRUE(waitFor([this] {
        const auto& maps = globe().scene().maps();
        return maps.size() == 2 && maps.back().shown() == maps.back().map() &&
               globe().isPictureComplete();
    }));
}

TEST_F(GlobeLayersTest, TheFinestLayerCoversTheOthersOnRequest)
{
    ASSERT_TRUE(showBoth());
    const auto mars = window_->session().layers.back().map; // its samples are finer
    QAction* finest_first = window_->actionSet().layer.finest_first;
    finest_first->trigger();
    ASSERT_TRUE(waitFor([&] {
        EXPECT_EQ(globe().layers().size(), 2U);
        return globe().layers().size() == 2 && globe().layers().front().map == mars;
    }));
    EXPECT_EQ(layerAt(0.0, 80.0), 0U);
    EXPECT_EQ(globe().scene().maps().front().map(), mars); // read and touched in this order
    window_->controller().undoStack().undo();
    EXPECT_FALSE(finest_first->isChecked());
    // They are placed on another ellipsoid, that of the lowest layer, and stay in the picture.
    ASSERT_TRUE(waitFor([&] {
        EXPECT_EQ(globe().layers().size(), 2U);
        return globe().layers().size() == 2 && globe().layers().back().map == mars;
    }));
    EXPECT_EQ(layerAt(0.0, 80.0), 0U);
}

TEST_F(GlobeLayersTest, ALayerThatIsHiddenAndShownAgainKeepsItsPlaceInTheList)
{
    ASSERT_TRUE(showBoth());
    const LayerId mars = window_->session().layers.back().id;
    window_->controller().setVisible(mars, false);
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 1; }));
    window_->controller().setVisible(mars, true);
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 2; }));
    EXPECT_EQ(window_->session().layers.back().id, mars);
    EXPECT_EQ(layerAt(0.0, 80.0), 0U);
}

// 2 km of Hellas, 7 km below elevation 0: flying there aimed at the ellipsoid.
TEST_F(GlobeLayersTest, FlyingToALayerInLowGroundFillsThePictureWithIt)
{
    const QString low = maps_.write(
        QStringLiteral("hellas.asc"),
        {.columns = 50, .rows = 50, .x_lower_left = 62.0, .y_lower_left = -32.0, .cell = 0.001},
        [](int column, int row) { return -7000.0 + column + 2.0 * row; });
    writeMarsCrs(QStringLiteral("hellas.prj"));
    ASSERT_TRUE(openAndWait(*window_, low));
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 2; }));
    const Session& session = window_->session();
    window_->controller().setExaggeration(10.0);
    ASSERT_TRUE(globe().flyToLayer(session.layers.front().map));
    ASSERT_TRUE(rests());
    int on_layer = 0;
    constexpr int kLooks = 11;
    for (int i = 0; i < kLooks; ++i) {
        const auto ground = globe().groundAt(
            globeMiddle() + QPointF((i - kLooks / 2) * 0.04 * globe().width(), 0.0));
        on_layer += ground && ground->index == 0 ? 1 : 0;
    }
    EXPECT_EQ(on_layer, kLooks); // the middle 40 % of the width
}

// Not that of a map on another side of the body.
TEST_F(GlobeLayersTest, TheOverviewOfLocalLayersIsThatOfTheOneInThePicture)
{
    const auto flat_map = [this](const char* name, const TestMaps::Shape& shape) {
        const QString base = QString::fromLatin1(name);
        writeMarsCrs(base + QStringLiteral(".prj"));
        return openAndWait(*window_, maps_.write(base + QStringLiteral(".asc"), shape,
                                                 [](int column, int) { return 100.0 + column; }));
    };
    const LayerId mars = window_->session().layers.back().id;
    ASSERT_TRUE(flat_map(
        "wide",
        {.columns = 60, .rows = 30, .x_lower_left = 10.0, .y_lower_left = 10.0, .cell = 0.1}));
    ASSERT_TRUE(flat_map(
        "tall",
        {.columns = 20, .rows = 40, .x_lower_left = 100.0, .y_lower_left = 10.0, .cell = 0.1}));
    window_->controller().setVisible(mars, false);
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 2; }));
    const Minimap& minimap = *window_->findChild<GlobeOverlays*>()->minimap();
    const auto is_wide_at = [&](double longitude_deg) {
        globe().setCamera({.target = {.longitude = Angle::degrees(longitude_deg),
                                      .latitude = Angle::degrees(11.5)},
                           .distance_m = 2e5});
        return minimap.sizeHint().width() > minimap.sizeHint().height();
    };
    EXPECT_FALSE(is_wide_at(101.0));
    EXPECT_TRUE(is_wide_at(13.0));
    EXPECT_TRUE(is_wide_at(50.0)); // outside of both
    EXPECT_FALSE(is_wide_at(101.0));
}

TEST_F(GlobeLayersTest, GoToPlaceReachesAllLayersOfTheScene)
{
    ASSERT_TRUE(showBoth()); // the nested one is topmost
    const auto typed = [this](const char* text) {
        window_->actionSet().go_to_place->trigger();
        auto* dialog = window_->findChild<GoToDialog*>();
        auto* field = dialog->findChild<QLineEdit*>(QStringLiteral("coordinate"));
        field->setText(QString::fromUtf8(text));
        QTest::keyClick(field, Qt::Key_Return);
        return waitFor([this] { return window_->findChild<GoToDialog*>() == nullptr; }) && rests();
    };
    ASSERT_TRUE(typed("40 S 100 E"));
    EXPECT_NEAR(globe().camera().target.latitude.degrees(), -40.0, 1e-6);
    EXPECT_NEAR(globe().camera().target.longitude.degrees(), 100.0, 1e-6);
    EXPECT_TRUE(flat().isPlaceMarked());
    EXPECT_NEAR(flat().markedPlace()->latitude.degrees(), -40.0, 1e-6);
    // As typed, not at the nearest sample.
    ASSERT_TRUE(typed("15.3 N 0 E"));
    EXPECT_NEAR(std::remainder(globe().camera().target.longitude.degrees(), 360.0), 0.0, 1e-6);
    ASSERT_TRUE(typed("90 S 0 E"));
    EXPECT_NEAR(globe().camera().target.latitude.degrees(), -90.0, 1e-6);
}

TEST_F(GlobeLayersTest, AMapThatIsOpenedOnTheGlobeIsInItsPictureOnceTheWindowHasSettled)
{
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(openNested()); // waits for MainWindow::isSettled()
    EXPECT_FALSE(globe().isHidden());
    EXPECT_TRUE(globe().isPictureComplete());
    EXPECT_EQ(globe().scene().maps().size(), 2U);
}

TEST_F(GlobeLayersTest, AMapThatIsOpenedOutOfSightIsFlownTo)
{
    ASSERT_TRUE(showGlobe());
    globe().setCamera(
        {.target = {.longitude = Angle::degrees(100.0), .latitude = Angle::degrees(-40.0)},
         .distance_m = 1e6});
    ASSERT_TRUE(openNested());
    ASSERT_TRUE(rests());
    ASSERT_EQ(globe().scene().maps().size(), 2U);
    EXPECT_NEAR(globe().camera().target.latitude.degrees(), 80.0, 10.0);
    const auto ground = globe().groundAt(globeMiddle());
    ASSERT_TRUE(ground);
    EXPECT_EQ(ground->index, 0U);
}

TEST_F(GlobeLayersTest, AMapThatIsOpenedInSightLeavesTheCameraWhereItIs)
{
    ASSERT_TRUE(showGlobe());
    globe().setCamera(
        {.target = {.longitude = {}, .latitude = Angle::degrees(85.0)}, .distance_m = 1e6});
    const BodyCamera before = globe().camera();
    ASSERT_TRUE(openNested());
    ASSERT_TRUE(rests());
    ASSERT_EQ(globe().scene().maps().size(), 2U);
    EXPECT_NEAR(globe().camera().target.latitude.degrees(), before.target.latitude.degrees(), 1e-9);
    EXPECT_NEAR(globe().camera().target.longitude.degrees(), 0.0, 1e-9);
}

// The flat map hides the lower one; a notice offers the globe.
TEST_F(GlobeLayersTest, ANoticeOffersTheGlobeForLayersOfOtherCrss)
{
    ASSERT_TRUE(openNested());
    const auto& bar = *window_->findChild<NoticeBar*>();
    auto& button = *bar.findChild<QToolButton*>(QStringLiteral("noticeAction"));
    const auto offers = [&] {
        return bar.isVisible() && button.isVisible() &&
               button.text() == QStringLiteral("Show Globe");
    };
    ASSERT_TRUE(waitFor(offers));
    QTest::mouseClick(&button, Qt::LeftButton);
    ASSERT_TRUE(waitFor(
        [this] { return globe().terrain() != nullptr && globe().scene().maps().size() == 2; }));
    EXPECT_FALSE(offers());
    scene(1)->trigger();
    EXPECT_TRUE(waitFor(offers));
}

// Without a body it has no place on the globe, either.
TEST_F(GlobeLayersTest, ALayerWithoutABodyIsHiddenInBothScenes)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.placed("site", "LOCAL_CS[\"site\",UNIT[\"metre\",1]]",
                                                   {0.0, 20.0, 0.0, 600.0, 0.0, -20.0})));
    ASSERT_TRUE(openNested()); // on top of it
    const auto& bar = *window_->findChild<NoticeBar*>();
    const auto& button = *bar.findChild<QToolButton*>(QStringLiteral("noticeAction"));
    const auto reason = [this] {
        for (int row = 0; row < list().rowCount(); ++row) {
            const QModelIndex index = list().index(row, 0);
            if (index.data().toString().contains(QStringLiteral("site"))) {
                return index.data(LayerModel::ReasonRole).toString();
            }
        }
        return QString();
    };
    EXPECT_FALSE(reason().isEmpty());
    const QString offer = bar.findChild<QLabel*>(QStringLiteral("noticeText"))->text();
    EXPECT_FALSE(offer.contains(QStringLiteral("site")) &&
                 button.text() == QStringLiteral("Show Globe"))
        << offer.toStdString();
    ASSERT_TRUE(showGlobe());
    EXPECT_FALSE(reason().isEmpty());
}

// It has samples beyond a quarter of a turn from its central meridian.
TEST_F(GlobeLayersTest, ALayerThatCannotBePlacedSaysSoInItsRowAndInANotice)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.placed("wide", "+proj=tmerc +R=3396190 +type=crs",
                                                   {-2e7, 1e6, 0.0, 1.5e7, 0.0, -1e6})));
    const auto& bar = *window_->findChild<NoticeBar*>();
    const auto& text = *bar.findChild<QLabel*>(QStringLiteral("noticeText"));
    const auto is_noticed = [&] {
        return bar.isVisible() && text.text().contains(QStringLiteral("wide")) &&
               text.text().contains(QStringLiteral("cannot be placed on the globe"));
    };
    const QModelIndex row = list().indexOfLayer(window_->session().layers.front().id);
    ASSERT_TRUE(row.data().toString().contains(QStringLiteral("wide")));
    const auto reason = [&] { return row.data(LayerModel::ReasonRole).toString(); };
    EXPECT_EQ(reason(), QString());
    ASSERT_TRUE(showGlobe());
    EXPECT_TRUE(waitFor(is_noticed)) << text.text().toStdString();
    EXPECT_EQ(globe().scene().maps().size(), 1U);
    EXPECT_EQ(reason(), QStringLiteral("Hidden: it has samples beyond a pole or outside its "
                                       "projection; crop it"));
    EXPECT_TRUE(row.data(Qt::ToolTipRole).toString().startsWith(reason()));
    EXPECT_TRUE(row.data(Qt::AccessibleTextRole).toString().contains(reason()));
    EXPECT_EQ(row.data(Qt::CheckStateRole).toInt(), Qt::PartiallyChecked);
    EXPECT_FALSE(row.data(LayerModel::IsShownRole).toBool());
    EXPECT_FALSE(row.data(LayerModel::CanShowRole).toBool()); // not even alone
    // Its box hides it, and requests it again.
    auto& rows = *window_->datasetPanel()->list();
    const QPoint box = rows.visualRect(row).topLeft() + QPoint(12, 14);
    QTest::mouseClick(rows.viewport(), Qt::LeftButton, {}, box);
    EXPECT_TRUE(waitFor([&] { return !is_noticed() && reason().isEmpty(); }));
    EXPECT_EQ(row.data(Qt::CheckStateRole).toInt(), Qt::Unchecked);
    QTest::mouseClick(rows.viewport(), Qt::LeftButton, {}, box);
    EXPECT_TRUE(waitFor([&] { return is_noticed() && !reason().isEmpty(); }));
    // The flat map shows it.
    scene(1)->trigger();
    EXPECT_TRUE(waitFor([&] { return !is_noticed() && reason().isEmpty(); }));
}

TEST_F(GlobeLayersTest, TheElevationReadIsThatOfTheLayerInThePicture)
{
    ASSERT_TRUE(showBoth());
    for (const auto& [longitude, latitude] :
         {std::pair{0.0, 80.0}, {1.0, 81.0}, {60.0, 75.0}, {-133.0, 18.0}}) {
        ASSERT_TRUE(layerAt(longitude, latitude));
        const auto ground = *globe().groundAt(globeMiddle());
        const Map& map = *globe().layers()[ground.index].map;
        EXPECT_NEAR(ground.hit.height_m,
                    map.height(*map.georeference().toGeographic(ground.hit.grid)), 0.5);
        move(globeMiddle());
        ASSERT_TRUE(globe().reading());
        EXPECT_EQ(globe().reading()->index, ground.index);
        EXPECT_FALSE(window_->readout()->heightLabel().isEmpty());
    }
}

// 2026-11: from far away, with an overview of the whole body that had a dot on it.
TEST_F(GlobeLayersTest, ALocalMapAloneIsSeenAsOnTheFlatMap)
{
    ASSERT_TRUE(openNested());
    window_->controller().remove(window_->session().layers.back().id);
    ASSERT_EQ(window_->session().layers.size(), 1U);
    view().goHome();
    ASSERT_TRUE(waitFor([this] { return !view().isMoving(); }));
    const double flat_m = view().camera().distance_m;
    ASSERT_TRUE(showGlobe());
    EXPECT_NEAR(globe().camera().distance_m / flat_m, 1.0, 1e-6);
    globe().goHome();
    ASSERT_TRUE(rests());
    EXPECT_NEAR(globe().camera().distance_m / flat_m, 1.0, 0.25);
    // The overview map is that of the layer.
    Minimap& map = *globe().findChild<GlobeOverlays*>()->minimap();
    ASSERT_TRUE(waitFor([&] { return map.isVisible(); }));
    const Georeference& georeference = view().map()->georeference();
    const auto on_map = [&](GridPoint grid) {
        return map.positionOf(georeference.sceneFrame().toScene(grid, 0.0));
    };
    EXPECT_GT(on_map({39.0, 15.0}).x() - on_map({0.0, 15.0}).x(), 0.8 * map.width());
    const GridPoint there{10.0, 20.0};
    QTest::mouseClick(&map, Qt::LeftButton, Qt::NoModifier, on_map(there).toPoint());
    const auto target = georeference.toGrid(globe().camera().target);
    ASSERT_TRUE(target);
    EXPECT_NEAR(target->column, there.column, 0.5);
    EXPECT_NEAR(target->row, there.row, 0.5);
    // Together with the whole planet, the overview is that of the planet.
    window_->open(QString::fromStdString(test::bundledMars()));
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 2; }));
    EXPECT_NEAR(map.positionOf({180.0, 0.0, 0.0}).x() - map.positionOf({-180.0, 0.0, 0.0}).x(),
                map.width(), 12.0);
}

TEST_F(GlobeLayersTest, GoToLayerFliesToWhereAllOfItIsInThePicture)
{
    ASSERT_TRUE(openNested());
    const LayerId mars = window_->session().layers.back().id;
    const LayerId polar = window_->session().layers.front().id;
    ASSERT_TRUE(showGlobe());
    globe().setCamera({.target = {.longitude = Angle::degrees(100.0), .latitude = {}},
                       .distance_m = 3e6,
                       .azimuth = Angle::degrees(20.0),
                       .tilt = Angle::degrees(30.0)});
    window_->controller().activate(polar);
    window_->actionSet().layer.go_to->trigger();
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 2; }));
    ASSERT_TRUE(rests());
    const BodyGrid& grid = *globe().terrain()->grid();
    const CameraPose pose = poseOf(globe().camera(), body());
    double farthest = 0.0; // from the middle of the picture, 1 at its edge
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        for (std::size_t column = 0; column < grid.columns(); ++column) {
            const double height_m = 20.0 * static_cast<double>(column) - 300.0;
            const auto pixel = project(pose, globe().viewport(),
                                       grid.at(column, row, height_m * globe().exaggeration()));
            ASSERT_TRUE(pixel);
            farthest =
                std::max({farthest, std::abs(2.0 * pixel->x / globe().viewport().width - 1.0),
                          std::abs(2.0 * pixel->y / globe().viewport().height - 1.0)});
        }
    }
    EXPECT_LE(farthest, 1.0);
    EXPECT_GE(farthest, 0.8);
    EXPECT_NEAR(globe().camera().tilt.degrees(), 30.0, 1e-6) << "from the same side";
    // A hidden layer is shown; the other one keeps its place.
    window_->controller().setVisible(mars, false);
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 1; }));
    window_->controller().activate(mars);
    window_->actionSet().layer.go_to->trigger();
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 2; }));
    ASSERT_TRUE(rests());
    EXPECT_EQ(window_->session().layers.front().id, polar);
    EXPECT_GT(globe().camera().distance_m, body().equatorial_m);
}

TEST_F(GlobeLayersTest, StretchToViewTakesTheElevationsOfTheLayerInThePicture)
{
    ASSERT_TRUE(showBoth());
    window_->controller().activate(window_->session().layers.front().id);
    // Columns of the slope 20 m apart; the picture has the middle of it, and Mars beside it.
    globe().setCamera({.target = {.longitude = {}, .latitude = Angle::degrees(80.0)},
                       .distance_m = 1e6,
                       .azimuth = Angle::degrees(90.0)});
    HeightRange seen{.minimum_m = 1e9, .maximum_m = -1e9};
    for (double y = 0.0; y <= globe().height(); y += 7.0) {
        for (double x = 0.0; x <= globe().width(); x += 7.0) {
            const auto ground = globe().groundAt({x, y});
            if (ground && ground->index == 0) {
                seen.minimum_m = std::min(seen.minimum_m, ground->hit.height_m);
                seen.maximum_m = std::max(seen.maximum_m, ground->hit.height_m);
            }
        }
    }
    window_->actionSet().stretch_to_view->trigger();
    const ColorStretch taken = window_->session().layers.front().stretch;
    const double tolerance_m = 0.03 * (seen.maximum_m - seen.minimum_m);
    EXPECT_EQ(taken.kind, StretchKind::Fixed);
    EXPECT_NEAR(taken.low, seen.minimum_m, tolerance_m);
    EXPECT_NEAR(taken.high, seen.maximum_m, tolerance_m);
    EXPECT_EQ(colorRangeOf(globe().layers().front()).minimum_m, taken.low);
    // The flat map leaves out the lower one.
    window_->controller().activate(window_->session().layers.back().id);
    ASSERT_TRUE(window_->actionSet().stretch_to_view->isEnabled());
    window_->actionSet().stretch_to_view->trigger();
    EXPECT_EQ(window_->session().layers.back().stretch.kind, StretchKind::Fixed);
    window_->controller().activate(window_->session().layers.front().id);
    // Where the picture shows none of a layer, its colors stay.
    globe().setCamera({.target = {.longitude = {}, .latitude = {}}, .distance_m = 1e6});
    window_->actionSet().stretch_to_view->trigger();
    EXPECT_EQ(window_->session().layers.front().stretch, taken);
}

TEST_F(GlobeLayersTest, LayersOfAnotherBodyAndHiddenOnesAreLeftOut)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    ASSERT_TRUE(openNested());
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 2; }));
    const Session& session = window_->session();
    ASSERT_EQ(session.layers.size(), 3U);
    window_->controller().setVisible(session.layers.front().id, false);
    // The Moon is topmost now.
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 1; }));
    EXPECT_EQ(globe().terrain()->map()->info().body->name, "Moon");
    window_->controller().setVisible(session.layers.front().id, true);
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 2; }));
    EXPECT_EQ(globe().terrain()->map()->info().body->name, "Mars");
}

TEST_F(GlobeLayersTest, TheListOfLayersCountsThemAsShown)
{
    ASSERT_TRUE(openNested());
    const auto shown = [this] {
        int count = 0;
        for (int row = 0; row < list().rowCount(); ++row) {
            count += list().index(row).data(LayerModel::IsShownRole).toBool() ? 1 : 0;
        }
        return count;
    };
    EXPECT_EQ(shown(), 1);
    ASSERT_TRUE(showGlobe());
    EXPECT_EQ(shown(), 2);
    scene(1)->trigger();
    EXPECT_EQ(shown(), 1);
}

TEST_F(GlobeLayersTest, TheLegendNamesTheLayerInTheMiddle)
{
    ASSERT_TRUE(showBoth());
    const auto* legend = globe().findChild<GlobeOverlays*>()->legend();
    ASSERT_TRUE(layerAt(0.0, 80.0));
    EXPECT_EQ(legend->content().layer.toStdString(), window_->session().layers.front().name);
    ASSERT_TRUE(layerAt(-120.0, 10.0));
    EXPECT_EQ(legend->content().layer.toStdString(), window_->session().layers.back().name);
}

// The whole of Mars is up to 20 km away from the slope: it must not show through.
TEST_F(GlobeLayersTest, ThePictureShowsTheUpperLayerAlone)
{
    ASSERT_TRUE(showBoth());
    ASSERT_TRUE(layerAt(0.0, 80.0));
    globe().setCamera(
        {.target = {.longitude = Angle::degrees(0.0), .latitude = Angle::degrees(80.0)},
         .distance_m = 2e5});
    ASSERT_TRUE(waitFor([this] { return globe().isPictureComplete(); }));
    const QImage both = globe().grabFramebuffer();
    window_->controller().setVisible(window_->session().layers.back().id, false);
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 1; }));
    ASSERT_TRUE(waitFor([this] { return globe().isPictureComplete(); }));
    const QImage upper = globe().grabFramebuffer();
    ASSERT_EQ(both.size(), upper.size());
    int different = 0;
    for (int y = 0; y < both.height(); ++y) {
        for (int x = 0; x < both.width(); ++x) {
            different += std::abs(qGray(both.pixel(x, y)) - qGray(upper.pixel(x, y))) > 8 ? 1 : 0;
        }
    }
    EXPECT_LT(different, both.width() * both.height() / 1000);
}

// To the nearest triangle, for a point near it.
double distanceM(const ScenePoint& point, const BodyMesh& mesh)
{
    constexpr double kAroundM = 10.0;
    const Vec3 around{kAroundM, kAroundM, kAroundM};
    double nearest_m = kAroundM;
    mesh.tree().inBox(point - around, point + around, [&](BodyIndex face) {
        const auto [a, b, c] = mesh.points(face);
        const Vec3 normal = normalized(cross(b - a, c - a));
        const double above_m = dot(point - a, normal);
        const Vec3 foot = point - normal * above_m;
        double outside_m = 0.0;
        for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
            const Vec3 inward = normalized(cross(normal, to - from));
            outside_m = std::max(outside_m, -dot(foot - from, inward));
        }
        nearest_m = std::min(nearest_m, std::hypot(above_m, outside_m));
    });
    return nearest_m;
}

TEST_F(GlobeLayersTest, ATouchStrokesFromOneLayerOntoAnother)
{
    ASSERT_TRUE(showBoth());
    window_->actionSet().tools->actions().at(static_cast<int>(Tool::Touch))->trigger();
    globe().setCamera(
        {.target = {.longitude = Angle::degrees(35.0), .latitude = Angle::degrees(80.0)},
         .distance_m = 2e6});
    ASSERT_TRUE(waitFor([this] { return globe().isTouchReady(); }));
    const auto send = [this](QEvent::Type type, QPointF at) {
        QMouseEvent event(type, at, globe().mapToGlobal(at),
                          type == QEvent::MouseMove ? Qt::NoButton : Qt::LeftButton, Qt::LeftButton,
                          Qt::NoModifier);
        QApplication::sendEvent(&globe(), &event);
    };
    std::array<std::shared_ptr<const BodyMesh>, 2> meshes;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const Map& map = *globe().layers()[i].map;
        JobMonitor monitor;
        meshes.at(i) = BodyMesh::build(map.filled(), map.georeference(), globe().exaggeration(),
                                       monitor, body())
                           .value();
    }
    send(QEvent::MouseButtonPress, globeMiddle() - QPointF(250.0, 0.0));
    std::array<int, 2> touched{};
    for (int x = -250; x <= 250; x += 5) {
        const QPointF at = globeMiddle() + QPointF(x, 0.0);
        send(QEvent::MouseMove, at);
        const auto ground = globe().groundAt(at);
        ASSERT_TRUE(ground && globe().stylus()) << x;
        ASSERT_TRUE(globe().stylus()->is_in_contact) << x;
        // On a triangle of the layer under the pointer.
        EXPECT_LT(distanceM(globe().stylus()->proxy, *meshes.at(ground->index)), 1e-3) << x;
        ++touched.at(ground->index);
    }
    EXPECT_GT(touched[0], 10);
    EXPECT_GT(touched[1], 10);
}

// Its CRS has a sphere that is larger by 190 m.
TEST_F(GlobeLayersTest, LayersInCrssWithOtherRadiiLieOnTheEllipsoidOfTheLowest)
{
    ASSERT_TRUE(showGlobe());
    const Ellipsoid before = body();
    const BodyCamera camera{
        .target = {.longitude = Angle::degrees(0.0), .latitude = Angle::degrees(80.0)},
        .distance_m = 1e6};
    globe().setCamera(camera);
    window_->open(nested());
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 2; }));
    ASSERT_NE(globe().layers()[0].map->georeference().crs()->ellipsoid(), before);
    for (const BodyTerrain& terrain : globe().scene().maps()) {
        EXPECT_EQ(terrain.grid()->ellipsoid(), before);
    }
    // Without it the nested layer lies on its own ellipsoid, below the same camera.
    window_->controller().setVisible(window_->session().layers.back().id, false);
    ASSERT_TRUE(waitFor([this] { return globe().scene().maps().size() == 1; }));
    EXPECT_EQ(body(), globe().layers()[0].map->georeference().crs()->ellipsoid());
    EXPECT_EQ(globe().camera().target, camera.target);
    EXPECT_NEAR(globe().camera().distance_m, camera.distance_m, 1.0);
}

} // namespace
} // namespace marsview
