// Layers on several bodies in the list: groups, hidden layers with their reasons, and showing them.

#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/panels/layer_delegate.h"
#include "ui/panels/layer_model.h"
#include "ui/panels/layers_panel.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"

#include <QApplication>
#include <QDockWidget>
#include <QListView>
#include <QMimeData>
#include <QTest>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace marsview {
namespace {

using testing::ElementsAre;

class LayerListTest : public testing::Test {
protected:
    void SetUp() override
    {
        window_ = std::make_unique<MainWindow>(testWindowOptions());
        window_->resize(1280, 900);
        window_->show();
        QApplication::setActiveWindow(window_.get()); // without a window manager
        // From the top: the Moon, a map without CRS, and two of Mars.
        window_->controller().open(
            {maps_.mars("m1"), maps_.mars("m2"), maps_.hill(), maps_.moon()});
        ASSERT_TRUE(waitUntilSettled(*window_));
        list().setFocus();
    }

    QListView& list() { return *window_->datasetPanel()->list(); }
    LayerModel& model() { return *window_->datasetPanel()->model(); }
    std::vector<std::string> rows()
    {
        std::vector<std::string> rows;
        for (int row = 0; row < model().rowCount(); ++row) {
            rows.push_back(model().index(row).data().toString().toStdString());
        }
        return rows;
    }
    QModelIndex rowOf(const char* name)
    {
        for (int row = 0; row < model().rowCount(); ++row) {
            if (model().index(row).data().toString() == QLatin1String(name)) {
                return model().index(row);
            }
        }
        return {};
    }
    int check(const char* name) { return rowOf(name).data(Qt::CheckStateRole).toInt(); }
    QString reason(const char* name) { return rowOf(name).data(LayerModel::ReasonRole).toString(); }
    QRect showButton(const char* name)
    {
        const QModelIndex index = rowOf(name);
        QStyleOptionViewItem option;
        option.initFrom(&list());
        option.widget = &list();
        option.rect = list().visualRect(index);
        return qobject_cast<LayerDelegate*>(list().itemDelegate())->showButtonOf(option, index);
    }
    std::string scene()
    {
        return shownLayers(window_->session()).empty()
                   ? std::string()
                   : shownLayers(window_->session()).front()->name;
    }

    TestMaps maps_;
    std::unique_ptr<MainWindow> window_;
};

TEST_F(LayerListTest, IsGroupedByBody)
{
    EXPECT_EQ(window_->docks()->datasets()->windowTitle(), QStringLiteral("Layers"));
    EXPECT_THAT(rows(), ElementsAre("Moon", "moon.vrt", "Unknown body", "hill.asc", "Mars",
                                    "m2.vrt", "m1.vrt"));
    EXPECT_EQ(model().flags(rowOf("Mars")) & (Qt::ItemIsSelectable | Qt::ItemIsDragEnabled),
              Qt::NoItemFlags);
    // A single body needs no headings.
    window_->undoStack().undo();
    window_->undoStack().undo();
    EXPECT_THAT(rows(), ElementsAre("m2.vrt", "m1.vrt"));
}

TEST_F(LayerListTest, ExplainsWhyALayerIsHiddenAndUnchecksIt)
{
    EXPECT_EQ(check("moon.vrt"), Qt::Checked);
    EXPECT_EQ(check("m2.vrt"), Qt::PartiallyChecked);
    EXPECT_EQ(reason("m2.vrt"), QStringLiteral("Hidden: on Mars; the view shows the Moon"));
    EXPECT_EQ(check("hill.asc"), Qt::PartiallyChecked);
    EXPECT_EQ(reason("hill.asc"),
              QStringLiteral("Hidden: no CRS, so its position in the view is unknown"));
    // Layers hidden by the user have no reason.
    window_->controller().setVisible(model().idAt(rowOf("m1.vrt")), false);
    EXPECT_EQ(check("m1.vrt"), Qt::Unchecked);
    EXPECT_EQ(reason("m1.vrt"), QString());
    EXPECT_TRUE(showButton("m1.vrt").isEmpty());
    EXPECT_FALSE(showButton("m2.vrt").isEmpty());
    EXPECT_TRUE(rowOf("m2.vrt")
                    .data(Qt::AccessibleTextRole)
                    .toString()
                    .contains(QStringLiteral("Press Space to show it")));
}

TEST_F(LayerListTest, TheShowButtonShowsALayerInAStepThatCanBeUndone)
{
    const QRect button = showButton("m1.vrt");
    ASSERT_TRUE(list().viewport()->rect().contains(button));
    const int steps = window_->undoStack().count();
    QTest::mouseClick(list().viewport(), Qt::LeftButton, {}, button.center());
    EXPECT_EQ(scene(), "m1.vrt");
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_EQ(window_->view()->map()->info().body, bodyNamed("Mars"));
    EXPECT_EQ(activeLayer(window_->session())->name, "m1.vrt");
    EXPECT_EQ(check("m1.vrt"), Qt::Checked);
    EXPECT_EQ(check("m2.vrt"), Qt::Checked); // on the same body and in the same CRS
    EXPECT_EQ(reason("moon.vrt"), QStringLiteral("Hidden: on the Moon; the view shows Mars"));
    EXPECT_EQ(window_->undoStack().count(), steps + 1);
    window_->undoStack().undo();
    EXPECT_EQ(scene(), "moon.vrt");
}

TEST_F(LayerListTest, SpaceAndTheTickBoxShowALayerToo)
{
    list().setCurrentIndex(rowOf("m2.vrt"));
    QTest::keyClick(&list(), Qt::Key_Space);
    EXPECT_EQ(scene(), "m2.vrt");
    const QRect row = list().visualRect(rowOf("hill.asc"));
    QTest::mouseClick(list().viewport(), Qt::LeftButton, {}, row.topLeft() + QPoint(12, 14));
    EXPECT_EQ(scene(), "hill.asc");
    // The same check box hides it again.
    const QRect now = list().visualRect(rowOf("hill.asc"));
    QTest::mouseClick(list().viewport(), Qt::LeftButton, {}, now.topLeft() + QPoint(12, 14));
    EXPECT_EQ(scene(), "m2.vrt");
    EXPECT_EQ(check("hill.asc"), Qt::Unchecked);
    // The menu agrees with the check boxes.
    QAction* toggle = window_->actionSet().toggle_visibility;
    list().setCurrentIndex(rowOf("moon.vrt"));
    EXPECT_FALSE(toggle->isChecked());
    toggle->trigger();
    EXPECT_EQ(scene(), "moon.vrt");
    EXPECT_TRUE(toggle->isChecked());
}

TEST_F(LayerListTest, ArrowKeysPassOverTheHeadings)
{
    list().setCurrentIndex(rowOf("moon.vrt"));
    std::vector<std::string> met;
    for (int i = 0; i < 4; ++i) {
        met.push_back(activeLayer(window_->session())->name);
        QTest::keyClick(&list(), Qt::Key_Down);
    }
    EXPECT_THAT(met, ElementsAre("moon.vrt", "hill.asc", "m2.vrt", "m1.vrt"));
    QTest::keyClick(&list(), Qt::Key_Home);
    QCoreApplication::processEvents();
    EXPECT_NE(window_->session().active, LayerId::None);
    EXPECT_FALSE(model().isHeader(list().currentIndex()));
}

TEST_F(LayerListTest, LayersMoveWithinTheirGroup)
{
    list().setCurrentIndex(rowOf("m1.vrt"));
    EXPECT_FALSE(window_->actionSet().layer.move_down->isEnabled());
    QTest::keyClick(&list(), Qt::Key_Up, Qt::AltModifier);
    EXPECT_THAT(rows(), ElementsAre("Moon", "moon.vrt", "Unknown body", "hill.asc", "Mars",
                                    "m1.vrt", "m2.vrt"));
    EXPECT_FALSE(window_->actionSet().layer.move_up->isEnabled());
    const std::unique_ptr<QMimeData> data(model().mimeData({rowOf("m2.vrt")}));
    const int first = rowOf("m1.vrt").row();
    EXPECT_FALSE(model().canDropMimeData(data.get(), Qt::MoveAction, 0, 0, {}));
    EXPECT_FALSE(model().dropMimeData(data.get(), Qt::MoveAction, first - 2, 0, {}));
    ASSERT_TRUE(model().canDropMimeData(data.get(), Qt::MoveAction, first, 0, {}));
    ASSERT_TRUE(model().dropMimeData(data.get(), Qt::MoveAction, first, 0, {}));
    QCoreApplication::processEvents();
    EXPECT_THAT(rows(), ElementsAre("Moon", "moon.vrt", "Unknown body", "hill.asc", "Mars",
                                    "m2.vrt", "m1.vrt"));
}

} // namespace
} // namespace marsview
