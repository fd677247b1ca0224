// Layers as the user sees them: opening, order, undo.

#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/panels/georeferencing_panel.h"
#include "ui/panels/layer_model.h"
#include "ui/panels/layers_panel.h"
#include "ui/window/status_readout.h"
#include "ui/window/window_actions.h"

#include <QActionGroup>
#include <QDropEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMimeData>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

namespace marsview {
namespace {

using testing::ElementsAre;

class LayersTest : public testing::Test {
protected:
    void SetUp() override
    {
        window_ = std::make_unique<MainWindow>(testWindowOptions());
        window_->resize(1280, 800);
        window_->show();
        ASSERT_TRUE(waitUntilSettled(*window_));
    }

    SessionController& controller() { return window_->controller(); }
    const std::vector<Layer>& layers() { return window_->session().layers; }
    LayerId id(std::size_t index) { return layers().at(index).id; }
    std::vector<std::string> names()
    {
        std::vector<std::string> names;
        for (const Layer& layer : layers()) {
            names.push_back(layer.name);
        }
        return names;
    }
    std::string shown()
    {
        return window_->view()->map() ? window_->view()->map()->spec().path : "";
    }
    bool settle() { return waitUntilSettled(*window_); }
    bool waitForLoads()
    {
        return QTest::qWaitFor([this] { return !controller().isBusy(); }, kTimeout);
    }

    TestMaps maps_;
    std::unique_ptr<MainWindow> window_;
};

TEST_F(LayersTest, AreAddedOnTopAndShown)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    ASSERT_TRUE(openAndWait(*window_, maps_.ring()));
    EXPECT_THAT(names(), ElementsAre("ring.asc", "hill.asc"));
    EXPECT_EQ(shown(), maps_.path(QStringLiteral("ring.asc")).toStdString());
    EXPECT_EQ(activeLayer(window_->session())->name, "ring.asc");
    EXPECT_TRUE(window_->windowTitle().contains(QStringLiteral("ring.asc")));
}

TEST_F(LayersTest, AViewWithoutVisibleLayersSaysThatTheyAreHidden)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    const auto* hint = window_->view()->findChild<QLabel*>(QStringLiteral("emptyHint"));
    EXPECT_FALSE(hint->isVisible());
    controller().setVisible(id(0), false);
    EXPECT_TRUE(hint->isVisible());
    EXPECT_TRUE(hint->text().contains(QStringLiteral("hidden"))) << hint->text().toStdString();
    controller().setVisible(id(0), true);
    controller().remove(id(0));
    EXPECT_TRUE(hint->text().contains(QStringLiteral("Ctrl+O"))) << hint->text().toStdString();
}

TEST_F(LayersTest, DroppedFilesAreLoadedInOrderDespiteAFailure)
{
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(maps_.hill(QStringLiteral("one.asc"))),
                  QUrl::fromLocalFile(maps_.path(QStringLiteral("none.asc"))),
                  QUrl::fromLocalFile(maps_.hill(QStringLiteral("two.asc")))});
    const QSignalSpy failures(window_.get(), &MainWindow::openFailed);
    QDragEnterEvent enter({600, 400}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(window_.get(), &enter);
    QDropEvent drop(QPointF(600, 400), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(window_.get(), &drop);
    ASSERT_TRUE(settle());
    EXPECT_THAT(names(), ElementsAre("two.asc", "one.asc"));
    EXPECT_EQ(failures.count(), 1);
    EXPECT_EQ(window_->undoStack().count(), 2);
}

TEST_F(LayersTest, CancelAlsoDropsWaitingFiles)
{
    controller().open({maps_.hill(QStringLiteral("one.asc")), maps_.hill(QStringLiteral("two.asc")),
                       maps_.hill(QStringLiteral("three.asc"))});
    EXPECT_TRUE(controller().isBusy());
    window_->actionSet().cancel_loading->setEnabled(true);
    window_->actionSet().cancel_loading->trigger();
    EXPECT_FALSE(controller().isBusy());
    QTest::qWait(100);
    EXPECT_TRUE(layers().empty());
    EXPECT_FALSE(window_->undoStack().canUndo());
    // The next one opens as usual.
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    EXPECT_EQ(layers().size(), 1U);
}

TEST_F(LayersTest, TheSampleIsReplacedByTheFirstOpenedMap)
{
    window_->openSample(maps_.hill(QStringLiteral("sample.asc")));
    ASSERT_TRUE(settle());
    EXPECT_THAT(names(), ElementsAre("sample.asc"));
    EXPECT_FALSE(window_->undoStack().canUndo());
    ASSERT_TRUE(openAndWait(*window_, maps_.hill(QStringLiteral("mine.asc"))));
    EXPECT_THAT(names(), ElementsAre("mine.asc"));
    EXPECT_EQ(window_->undoStack().count(), 1);
    window_->undoStack().undo();
    EXPECT_THAT(names(), ElementsAre("sample.asc"));
    window_->undoStack().redo();
    EXPECT_THAT(names(), ElementsAre("mine.asc"));
    ASSERT_TRUE(openAndWait(*window_, maps_.hill(QStringLiteral("more.asc"))));
    EXPECT_THAT(names(), ElementsAre("more.asc", "mine.asc"));
}

TEST_F(LayersTest, TheSampleIsSkippedIfTheUserOpensAMapFirst)
{
    window_->openSample(maps_.hill(QStringLiteral("sample.asc")));
    window_->open(maps_.hill(QStringLiteral("mine.asc")));
    ASSERT_TRUE(settle());
    EXPECT_THAT(names(), ElementsAre("mine.asc"));
    window_->openSample(maps_.hill(QStringLiteral("sample.asc")));
    EXPECT_FALSE(controller().isBusy());
}

// Every kind of change, each undone and redone immediately and without loading.
TEST_F(LayersTest, EveryChangeIsUndoneAndRedoneImmediately)
{
    controller().open({maps_.hill(QStringLiteral("a.asc")), maps_.hill(QStringLiteral("b.asc")),
                       maps_.hill(QStringLiteral("c.asc"))});
    ASSERT_TRUE(settle());
    const WindowActions& actions = window_->actionSet();
    const auto override_crs = [this] {
        GeoreferencingPanel& panel = *window_->georeferencingPanel();
        panel.edit();
        panel.findChild<QLineEdit*>(QStringLiteral("crs"))->setText(QStringLiteral("EPSG:32611"));
        panel.findChild<QPushButton*>(QStringLiteral("apply"))->click();
    };
    const auto override_body = [this] {
        RasterOverrides overrides;
        overrides.crs = "+proj=eqc +R=3396190 +units=m";
        overrides.body = "Mars";
        controller().overrideGeoreferencing(id(1), overrides);
    };
    const std::vector<std::pair<const char*, std::function<void()>>> changes{
        {"add", [this] { window_->open(maps_.ring()); }},
        {"move down", [&] { actions.layer.move_down->trigger(); }},
        {"move up", [&] { actions.layer.move_up->trigger(); }},
        {"hide", [&] { actions.toggle_visibility->trigger(); }},
        {"hide by the model",
         [this] {
             LayerModel* model = window_->datasetPanel()->model();
             model->setData(model->index(2), Qt::Unchecked, Qt::CheckStateRole);
         }},
        {"ramp", [&] { actions.ramp_group->actions().last()->trigger(); }},
        {"stretch", [this] { controller().setStretch(id(1), fixedStretch(100.0, 200.0)); }},
        {"slope colors",
         [this] { controller().setSlopeRange(id(1), SlopeRange{.maximum = Angle::degrees(3.0)}); }},
        {"exaggeration", [this] { controller().setExaggeration(4.0); }},
        {"rename", [this] { controller().rename(id(1), QStringLiteral("Crater Rim")); }},
        {"shading", [&] { actions.shading_group->actions().last()->trigger(); }},
        {"contours", [&] { actions.contours->trigger(); }},
        {"light", [this] { controller().setLight(Angle::degrees(90.0), Angle::degrees(20.0)); }},
        {"sun", [this] { controller().setSubsolarPoint({}); }},
        {"subsolar point",
         [this] {
             controller().setSubsolarPoint(
                 {.longitude = Angle::degrees(9.0), .latitude = Angle::degrees(5.0)});
         }},
        {"light of the view", [this] { controller().fixLightInView(); }},
        {"crs", override_crs},
        {"body", override_body},
        {"remove", [&] { actions.layer.remove->trigger(); }},
    };
    std::vector<Session> history{window_->session()};
    const int count_before = window_->undoStack().count();
    for (const auto& [name, change] : changes) {
        change();
        ASSERT_TRUE(waitForLoads()) << name;
        const auto expected = count_before + static_cast<int>(history.size());
        ASSERT_EQ(window_->undoStack().count(), expected) << name;
        EXPECT_FALSE(window_->undoStack().undoText().isEmpty()) << name;
        history.push_back(window_->session());
        EXPECT_NE(history.back(), history[history.size() - 2]) << name;
    }
    const auto is_as = [this](const Session& then) {
        return window_->session().layers == then.layers && window_->session().look == then.look;
    };
    for (int round = 0; round < 2; ++round) {
        for (std::size_t i = history.size() - 1; i > 0; --i) {
            window_->undoStack().undo();
            EXPECT_FALSE(controller().isBusy());
            EXPECT_TRUE(is_as(history[i - 1])) << "undo of " << changes[i - 1].first;
        }
        for (std::size_t i = 1; i < history.size(); ++i) {
            window_->undoStack().redo();
            EXPECT_FALSE(controller().isBusy());
            EXPECT_TRUE(is_as(history[i])) << "redo of " << changes[i - 1].first;
        }
    }
    ASSERT_TRUE(settle());
    EXPECT_EQ(shown(), shownLayers(window_->session()).front()->map->spec().path);
}

TEST_F(LayersTest, ManyStepsOfTheLightAreOneUndoStep)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    const int count = window_->undoStack().count();
    for (int degrees = 0; degrees < 50; ++degrees) {
        controller().setLight(Angle::degrees(degrees), Angle::degrees(30.0));
    }
    EXPECT_EQ(window_->undoStack().count(), count + 1);
    window_->undoStack().undo();
    EXPECT_EQ(window_->session().look, TerrainLook{});
    EXPECT_EQ(window_->view()->look(), TerrainLook{});
}

TEST_F(LayersTest, AMapOfAnotherBodyIsHiddenWithTheReasonInItsRow)
{
    controller().open({maps_.mars(), maps_.moon()});
    ASSERT_TRUE(settle());
    EXPECT_EQ(shown(), layers()[0].map->spec().path); // the Moon, opened last
    const LayerModel& model = *window_->datasetPanel()->model();
    const auto reason = [&model, this](std::size_t layer) {
        return model.indexOfLayer(id(layer)).data(LayerModel::ReasonRole).toString();
    };
    EXPECT_EQ(reason(0), QString());
    EXPECT_EQ(reason(1), QStringLiteral("Hidden: on Mars; the view shows the Moon"));
    // With the Moon hidden, Mars is shown.
    controller().setVisible(id(0), false);
    ASSERT_TRUE(settle());
    EXPECT_EQ(shown(), layers()[1].map->spec().path);
    EXPECT_EQ(reason(1), QString());
    // The same if it is moved below.
    controller().setVisible(id(0), true);
    controller().move(id(1), 0);
    ASSERT_TRUE(settle());
    EXPECT_EQ(layers()[0].name, "mars.vrt");
    EXPECT_EQ(shown(), layers()[0].map->spec().path);
}

TEST_F(LayersTest, PanelsAndStatusBarDescribeTheActiveLayer)
{
    controller().open({maps_.mars(), maps_.hill()});
    ASSERT_TRUE(settle());
    const auto body_told = [this] {
        for (const QLabel* label : window_->georeferencingPanel()->findChildren<QLabel*>()) {
            if (label->accessibleName() == QStringLiteral("Body")) {
                return label->text();
            }
        }
        return QString();
    };
    EXPECT_EQ(body_told(), QStringLiteral("unknown"));
    window_->datasetPanel()->list()->setCurrentIndex(
        window_->datasetPanel()->model()->indexOfLayer(id(1)));
    EXPECT_EQ(activeLayer(window_->session())->name, "mars.vrt");
    EXPECT_EQ(body_told(), QStringLiteral("Mars"));
    EXPECT_FALSE(window_->windowTitle().contains(QStringLiteral("mars.vrt")))
        << "not in the picture";
    EXPECT_EQ(window_->undoStack().count(), 2); // activating another layer is not an undo step
}

TEST_F(LayersTest, ElevationsAreThoseOfTheActiveLayerWhereBothAreShown)
{
    // Two slopes in one CRS, the upper shifted by ten pixels east: a difference of 200 m
    // everywhere.
    const QString lower = maps_.placed("lower", "EPSG:32611", {5e5, 30, 0, 4e6, 0, -30});
    const QString upper = maps_.placed("upper", "EPSG:32611", {5e5 + 300, 30, 0, 4e6, 0, -30});
    controller().open({lower, upper});
    ASSERT_TRUE(settle());
    const GridPoint middle{15.0, 15.0};
    StatusReadout& readout = *window_->readout();
    RayHit hit;
    hit.grid = middle;
    hit.height_m = layers()[0].map->heightfield().height(middle);
    readout.setPlace(ReadPlace{.hit = hit});
    const auto shown_m = [&readout] {
        QString text = readout.heightLabel().section(QLatin1Char(' '), 0, 0);
        return text.replace(QChar(0x2212), QLatin1Char('-')).toDouble();
    };
    EXPECT_NEAR(shown_m(), 0.0, 1.0); // 15 · 20 − 300
    controller().activate(id(1));
    readout.setPlace(ReadPlace{.hit = hit});
    EXPECT_NEAR(shown_m(), 200.0, 1.0);
}

TEST_F(LayersTest, ALayerMayBeRemovedWhileAnotherIsLoading)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    window_->open(maps_.ring());
    ASSERT_TRUE(controller().isBusy());
    window_->actionSet().layer.remove->trigger();
    EXPECT_TRUE(layers().empty());
    ASSERT_TRUE(settle());
    EXPECT_THAT(names(), ElementsAre("ring.asc"));
    window_->undoStack().undo();
    EXPECT_TRUE(layers().empty());
    window_->undoStack().undo();
    EXPECT_THAT(names(), ElementsAre("hill.asc"));
    ASSERT_TRUE(settle());
    EXPECT_EQ(shown(), layers()[0].map->spec().path);
}

TEST_F(LayersTest, ALayerMayBeRemovedWhileItsOwnOverrideIsLoading)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    RasterOverrides overrides;
    overrides.nodata = 100.0; // the samples must be read again
    controller().overrideGeoreferencing(id(0), overrides);
    controller().overrideGeoreferencing(id(0), {});
    ASSERT_TRUE(controller().isBusy());
    const QSignalSpy ended(&controller(), &SessionController::loadingEnded);
    controller().remove(id(0));
    EXPECT_FALSE(controller().isBusy());
    EXPECT_EQ(ended.count(), 1);
    QTest::qWait(100);
    EXPECT_TRUE(layers().empty());
    EXPECT_EQ(window_->undoStack().count(), 2); // opened, removed
}

TEST_F(LayersTest, UndoWhileLoadingKeepsThePositionOfTheLoadingLayer)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    window_->open(maps_.ring());
    window_->undoStack().undo();
    EXPECT_TRUE(layers().empty());
    ASSERT_TRUE(settle());
    EXPECT_THAT(names(), ElementsAre("ring.asc"));
    EXPECT_FALSE(window_->undoStack().canRedo());
}

TEST_F(LayersTest, AllHiddenIsAnEmptyView)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    controller().setVisible(id(0), false);
    ASSERT_TRUE(QTest::qWaitFor([this] { return !window_->view()->map(); }, kTimeout));
    EXPECT_FALSE(window_->actionSet().home->isEnabled());
    EXPECT_FALSE(window_->actionSet().go_to_place->isEnabled());
    controller().setVisible(id(0), true);
    ASSERT_TRUE(settle());
    EXPECT_TRUE(window_->actionSet().home->isEnabled());
}

TEST_F(LayersTest, AddingAMapOnTopKeepsTheView)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    TerrainView& view = *window_->view();
    controller().setExaggeration(2.0);
    view.flyTo({.column = 30.0, .row = 20.0}, 4e5);
    ASSERT_TRUE(settle());
    const GeographicPoint place =
        *view.map()->georeference().toGeographic({.column = 30.0, .row = 20.0});
    const QPointF before = *view.positionOf(GridPoint{.column = 30.0, .row = 20.0});
    // Overlaps the lower right of the first, and takes over its scene.
    ASSERT_TRUE(openAndWait(
        *window_, maps_.placed("corner", "IAU_2015:49900", {15.0, 0.1, 0.0, 16.0, 0.0, -0.1})));
    EXPECT_EQ(view.exaggeration(), 2.0);
    const QPointF after = *view.positionOf(*view.map()->georeference().toGrid(place));
    // The heights of the two differ there; sideways nothing moves.
    EXPECT_NEAR(after.x(), before.x(), 2.0);
}

TEST_F(LayersTest, AMapShownBeforeKeepsItsView)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    TerrainView& view = *window_->view();
    controller().setExaggeration(3.0);
    view.flyTo({.column = 10.0, .row = 8.0}, 3e5);
    ASSERT_TRUE(settle());
    const OrbitCamera left = view.camera();
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    ASSERT_NE(view.camera(), left);
    window_->undoStack().undo();
    ASSERT_TRUE(settle());
    EXPECT_EQ(view.exaggeration(), 3.0);
    EXPECT_NEAR(length(view.camera().target - left.target), 0.0, 1.0);
    EXPECT_NEAR(view.camera().distance_m, left.distance_m, 1.0);
}

TEST_F(LayersTest, GoingToAHiddenLayerShowsIt)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    const LayerId mars = id(1);
    controller().goTo(mars);
    ASSERT_TRUE(settle());
    EXPECT_EQ(shown(), maps_.mars().toStdString());
    EXPECT_EQ(id(0), mars);
    window_->undoStack().undo();
    ASSERT_TRUE(settle());
    EXPECT_EQ(shown(), maps_.moon().toStdString());
}

TEST_F(LayersTest, SettingNodataAdaptsTheExaggerationToTheRest)
{
    const QString file = maps_.write(QStringLiteral("pit.asc"), {}, [](int column, int row) {
        return column < 5 ? -32767.0 : 100.0 + column + row;
    });
    ASSERT_TRUE(openAndWait(*window_, file));
    const TerrainView& view = *window_->view();
    controller().overrideGeoreferencing(id(0), {}); // as the file declares it
    ASSERT_TRUE(waitForLoads());
    ASSERT_TRUE(settle());
    const double flat = view.exaggeration();
    EXPECT_FALSE(view.map()->info().notices.empty());
    RasterOverrides overrides;
    overrides.nodata = -32767.0;
    controller().overrideGeoreferencing(id(0), overrides);
    ASSERT_TRUE(waitForLoads());
    ASSERT_TRUE(settle());
    EXPECT_EQ(view.map()->heightfield().range()->minimum_m, 105.0);
    EXPECT_GT(view.exaggeration(), flat);
}

} // namespace
} // namespace marsview
