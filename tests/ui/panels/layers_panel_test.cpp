#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/panels/layer_model.h"
#include "ui/panels/layers_panel.h"
#include "ui/window/window_actions.h"

#include <QApplication>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMimeData>
#include <QTest>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace marsview {
namespace {

using testing::ElementsAre;

class LayersPanelTest : public testing::Test {
protected:
    void SetUp() override
    {
        window_ = std::make_unique<MainWindow>(testWindowOptions());
        window_->resize(1280, 800);
        window_->show();
        QApplication::setActiveWindow(window_.get()); // without a window manager
        window_->controller().open({maps_.hill(QStringLiteral("a.asc")),
                                    maps_.hill(QStringLiteral("b.asc")),
                                    maps_.hill(QStringLiteral("c.asc"))});
        ASSERT_TRUE(waitUntilSettled(*window_));
        list().setFocus();
    }

    LayersPanel& panel() { return *window_->datasetPanel(); }
    QListView& list() { return *panel().list(); }
    LayerModel& model() { return *panel().model(); }
    std::string names()
    {
        std::string names;
        for (const Layer& layer : window_->session().layers) {
            names += layer.name.substr(0, layer.name.find('.'));
        }
        return names;
    }

    TestMaps maps_;
    std::unique_ptr<MainWindow> window_;
};

TEST_F(LayersPanelTest, ShowsSizeRangeAndHistogram)
{
    const QModelIndex top = model().index(0);
    EXPECT_EQ(top.data().toString(), QStringLiteral("c.asc"));
    EXPECT_EQ(top.data(LayerModel::SizeRole).toString(), QStringLiteral("60 × 40"));
    EXPECT_EQ(top.data(LayerModel::RangeRole).toString(), QStringLiteral("100 … 300 m"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return model().histogramAt(top) != nullptr; }, kTimeout));
    const auto& counts = model().histogramAt(top)->counts;
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}), 2400U);
    panel().setHeightUnit(HeightUnit::Feet);
    EXPECT_EQ(top.data(LayerModel::RangeRole).toString(), QStringLiteral("328 … 984 ft"));
}

TEST_F(LayersPanelTest, CanBeUsedWithTheKeyboardAlone)
{
    EXPECT_EQ(names(), "cba");
    QTest::keyClick(&list(), Qt::Key_Down);
    EXPECT_EQ(activeLayer(window_->session())->name, "b.asc");
    QTest::keyClick(&list(), Qt::Key_Down, Qt::AltModifier);
    EXPECT_EQ(names(), "cab");
    QTest::keyClick(&list(), Qt::Key_Up, Qt::AltModifier);
    QTest::keyClick(&list(), Qt::Key_Up, Qt::AltModifier);
    EXPECT_EQ(names(), "bca");
    EXPECT_EQ(activeLayer(window_->session())->name, "b.asc");
    QTest::keyClick(&list(), Qt::Key_Space);
    EXPECT_FALSE(window_->session().layers[0].is_visible);
    QTest::keyClick(&list(), Qt::Key_Space);
    EXPECT_TRUE(window_->session().layers[0].is_visible);
    QTest::keyClick(&list(), Qt::Key_Delete);
    EXPECT_EQ(names(), "ca");
    EXPECT_EQ(activeLayer(window_->session())->name, "c.asc");
    EXPECT_TRUE(list().hasFocus());
}

TEST_F(LayersPanelTest, KeysOfLayersStayInTheList)
{
    window_->activateWindow();
    window_->view()->setFocus();
    QTest::keyClick(window_->view(), Qt::Key_Delete);
    EXPECT_EQ(names(), "cba");
}

TEST_F(LayersPanelTest, RenamesInPlace)
{
    window_->actionSet().layer.rename->trigger();
    auto* editor = list().findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    editor->setText(QStringLiteral("Rim"));
    QTest::keyClick(editor, Qt::Key_Return);
    QCoreApplication::processEvents(); // Qt commits the typed text a moment later
    EXPECT_EQ(window_->session().layers[0].name, "Rim");
    window_->undoStack().undo();
    EXPECT_EQ(window_->session().layers[0].name, "c.asc");
}

TEST_F(LayersPanelTest, TogglesByItsCheckboxOnly)
{
    const QRect top = list().visualRect(model().index(0));
    QTest::mouseClick(list().viewport(), Qt::LeftButton, {}, top.topLeft() + QPoint(12, 14));
    EXPECT_FALSE(window_->session().layers[0].is_visible);
    const Session before = window_->session();
    const QRect row = list().visualRect(model().index(2));
    QTest::mouseClick(list().viewport(), Qt::LeftButton, {}, row.center());
    EXPECT_EQ(window_->session().layers, before.layers);
    EXPECT_EQ(activeLayer(window_->session())->name, "a.asc");
}

TEST_F(LayersPanelTest, ReordersByDropping)
{
    const auto drop = [this](int from, int gap) {
        const std::unique_ptr<QMimeData> data(model().mimeData({model().index(from)}));
        EXPECT_TRUE(model().dropMimeData(data.get(), Qt::MoveAction, gap, 0, {}));
        QCoreApplication::processEvents();
    };
    drop(0, 3); // below the last
    EXPECT_EQ(names(), "bac");
    drop(2, 0);
    EXPECT_EQ(names(), "cba");
    drop(0, 2); // between b and a
    EXPECT_EQ(names(), "bca");
    drop(1, 1); // its current place
    EXPECT_EQ(names(), "bca");
    drop(0, -1); // on the empty area below
    EXPECT_EQ(names(), "cab");
}

TEST_F(LayersPanelTest, ChoosesTheRampOfTheActiveLayer)
{
    auto* ramps = panel().findChild<QComboBox*>(QStringLiteral("ramp"));
    EXPECT_EQ(ramps->currentIndex(), 0);
    ramps->setFocus();
    QTest::keyClick(ramps, Qt::Key_Down);
    EXPECT_EQ(window_->session().layers[0].ramp, colorRamps()[0].name);
    list().setCurrentIndex(model().index(1));
    EXPECT_EQ(ramps->currentIndex(), 0); // the ramp of the other layer is unchanged
    window_->undoStack().undo();
    EXPECT_EQ(window_->session().layers[0].ramp, "");
}

TEST_F(LayersPanelTest, HasRoomForTwenty)
{
    for (int i = 0; i < 17; ++i) {
        window_->controller().open({maps_.hill(QStringLiteral("more%1.asc").arg(i))});
    }
    ASSERT_TRUE(waitUntilSettled(*window_));
    ASSERT_EQ(model().rowCount(), 20);
    list().setFocus();
    QTest::keyClick(&list(), Qt::Key_End);
    EXPECT_EQ(activeLayer(window_->session())->name, "a.asc");
    EXPECT_TRUE(list().viewport()->rect().intersects(list().visualRect(model().index(19))));
    for (int row = 0; row < 20; ++row) {
        EXPECT_LT(list().visualRect(model().index(row)).height(), 110) << row;
    }
}

TEST_F(LayersPanelTest, ExplainsWhatToDoWithoutLayers)
{
    while (!window_->session().layers.empty()) {
        QTest::keyClick(&list(), Qt::Key_Delete);
    }
    EXPECT_FALSE(list().isVisible());
    bool is_hint_visible = false;
    for (const QLabel* label : panel().findChildren<QLabel*>()) {
        is_hint_visible |= label->isVisible() && label->text().contains(QStringLiteral("Ctrl+O"));
    }
    EXPECT_TRUE(is_hint_visible);
    EXPECT_FALSE(window_->actionSet().layer.remove->isEnabled());
}

} // namespace
} // namespace marsview
