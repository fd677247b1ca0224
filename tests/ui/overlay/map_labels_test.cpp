// Names and the graticule on the map, in a window.
#include "tests/support/shared_data.h"
#include "tests/ui/map_window.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/map_labels.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/minimap.h"
#include "ui/window_actions.h"

#include <QAction>
#include <QElapsedTimer>
#include <QTest>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace marsview {
namespace {

class MapLabelsTest : public MapWindowTest {
protected:
    void openMars()
    {
        makeWindow(kWithPanels);
        ASSERT_TRUE(openAndWait(*window_, QString::fromStdString(test::bundledMars())));
    }
    MapLabels& labels() { return *window_->overlays()->labels(); }
    QAction& action(const char* name)
    {
        const QList<QAction*>& actions = window_->overlays()->terrainActions();
        return **std::find_if(actions.begin(), actions.end(), [name](const QAction* action) {
            return action->objectName() == QLatin1String(name);
        });
    }
    static QStringList texts(const std::vector<MapLabels::Label>& labels)
    {
        QStringList texts;
        for (const MapLabels::Label& label : labels) {
            texts.append(label.text);
        }
        return texts;
    }
};

TEST_F(MapLabelsTest, NamesKeepClearOfEachOtherAndOfTheOtherOverlays)
{
    openMars();
    const std::vector<MapLabels::Label>& names = labels().nameLabels();
    EXPECT_GT(names.size(), 5U);
    for (std::size_t i = 0; i < names.size(); ++i) {
        EXPECT_TRUE(QRectF(view().rect()).contains(names[i].box));
        for (const QWidget* part : {static_cast<const QWidget*>(window_->overlays()->minimap()),
                                    static_cast<const QWidget*>(window_->overlays()->legend())}) {
            EXPECT_FALSE(part->isVisible() && names[i].box.intersects(part->geometry()))
                << names[i].text.toStdString();
        }
        for (std::size_t k = 0; k < i; ++k) {
            EXPECT_FALSE(names[i].box.intersects(names[k].box));
        }
    }
    action("names").trigger();
    EXPECT_TRUE(labels().nameLabels().empty());
    action("names").trigger();
    EXPECT_GT(labels().nameLabels().size(), 5U);
}

TEST_F(MapLabelsTest, TheGraticuleIsLabeledInTheChosenFormat)
{
    openMars();
    EXPECT_TRUE(labels().graticuleLabels().empty());
    action("graticule").trigger();
    const QStringList degrees = texts(labels().graticuleLabels());
    EXPECT_GE(degrees.size(), 4);
    EXPECT_TRUE(degrees.contains(QStringLiteral("0° N"))) << degrees.join(u'|').toStdString();
    Preferences preferences = window_->preferences();
    preferences.coordinates.angles = AngleNotation::DegreesMinutesSeconds;
    window_->setPreferences(preferences);
    // Over a few kilometers the lines are minutes apart.
    view().flyTo(GridPoint{900.0, 300.0}, 2e5);
    ASSERT_TRUE(waitFor([this] { return !view().isMoving() && view().isPictureComplete(); }));
    const QStringList minutes = texts(labels().graticuleLabels());
    EXPECT_GE(minutes.size(), 4);
    EXPECT_TRUE(std::all_of(minutes.begin(), minutes.end(), [](const QString& text) {
        return text.contains(QChar(0x2032));
    })) << minutes.join(u'|').toStdString();
    action("graticule").trigger();
    EXPECT_TRUE(labels().graticuleLabels().empty());
}

TEST_F(MapLabelsTest, LinesOfTheGraticuleAreInThePicture)
{
    openMars();
    const QImage without = view().terrainPicture();
    action("graticule").trigger();
    ASSERT_TRUE(waitFor([this] { return view().isPictureComplete(); }));
    const QImage with = view().terrainPicture();
    ASSERT_EQ(with.size(), without.size());
    int changed = 0;
    for (int y = 0; y < with.height(); ++y) {
        for (int x = 0; x < with.width(); ++x) {
            changed += with.pixel(x, y) != without.pixel(x, y) ? 1 : 0;
        }
    }
    // Some lines of three pixels, and nothing else.
    EXPECT_GT(changed, with.height() * 3);
    EXPECT_LT(changed, with.width() * with.height() / 5);
}

} // namespace
} // namespace marsview
