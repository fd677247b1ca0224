// Names and the graticule on the map, in a window.
#include "tests/support/shared_data.h"
#include "tests/ui/map_window.h"
#include "ui/commands/picture_saver.h"
#include "ui/controllers/measure_controller.h"
#include "ui/globe/globe_view.h"
#include "ui/overlay/force_meter.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/map_labels.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/minimap.h"
#include "ui/pictures/flat_pictures.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QElapsedTimer>
#include <QTest>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <iterator>

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

TEST_F(MapLabelsTest, NamesMakeWayForLinesAndPointsThatAreMeasured)
{
    openMars();
    const auto is_named = [this](QPointF place) {
        const std::vector<MapLabels::Label>& names = labels().nameLabels();
        return std::any_of(names.begin(), names.end(), [place](const MapLabels::Label& name) {
            return name.box.contains(place);
        });
    };
    ASSERT_FALSE(labels().nameLabels().empty());
    const QPointF middle = labels().nameLabels().front().box.center();
    MeasureController& measuring = *window_->measuring();
    measuring.begin(MeasurementKind::Distance);
    const QPointF half(labels().nameLabels().front().box.width(), 0.0);
    for (const QPointF end : {middle - half, middle + half}) {
        const auto hit = view().surfaceAt(end);
        ASSERT_TRUE(hit);
        measuring.addPointAt(hit->grid);
    }
    measuring.finish();
    ASSERT_TRUE(waitFor([&] { return view().isPictureComplete() && !is_named(middle); }));
    EXPECT_FALSE(labels().nameLabels().empty());
    for (const DrawnHandle& handle : measuring.handles()) {
        EXPECT_FALSE(is_named(handle.place));
    }
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

// Where the view has a label, a saved picture differs from the bare terrain.
TEST_F(MapLabelsTest, SavedPicturesHaveTheLabelsAndLinesOfTheView)
{
    openMars();
    action("graticule").trigger();
    ASSERT_TRUE(waitFor([this] { return view().isPictureComplete(); }));
    FlatPictures pictures(view(), *window_->overlays());
    PictureSaver saver({.flat = pictures, .globe = pictures, .globe_view = *window_->globe()},
                       PictureSaver::Memory::WindowOnly, window_.get());
    const QSize size{view().viewport().width, view().viewport().height};
    const auto picture = [&](const QSize& pixels, bool has_labels) {
        const QString file = maps_.path(QStringLiteral("labels.png"));
        saver.save(
            file, view().camera(),
            {.size = pixels, .has_legend = false, .has_scale = false, .has_labels = has_labels});
        EXPECT_TRUE(waitFor([&] { return !saver.isSaving(); }));
        return QImage(file);
    };
    for (const int factor : {1, 2}) {
        const QImage without = picture(size * factor, false);
        const QImage with = picture(size * factor, true);
        const auto share_changed = [&](const QRectF& box) {
            const QRect pixels =
                QRectF(box.topLeft() * factor, box.size() * factor).toAlignedRect();
            int changed = 0;
            for (int y = pixels.top(); y <= pixels.bottom(); ++y) {
                for (int x = pixels.left(); x <= pixels.right(); ++x) {
                    changed += with.valid(x, y) && with.pixel(x, y) != without.pixel(x, y) ? 1 : 0;
                }
            }
            return static_cast<double>(changed) / (pixels.width() * pixels.height());
        };
        // Some find another place where no legend and no minimap is in their way.
        const auto& labels_shown = labels().graticuleLabels();
        const auto found = std::count_if(
            labels_shown.begin(), labels_shown.end(),
            [&](const MapLabels::Label& label) { return share_changed(label.box) > 0.2; });
        EXPECT_GE(4 * found, 3 * std::ssize(labels_shown)) << factor;
        const double everywhere = share_changed(QRectF(QPointF(0.0, 0.0), size));
        EXPECT_GT(everywhere, 0.02);
        EXPECT_LT(everywhere, 0.3);
    }
}

// The force meter appears only while the terrain is touched.
TEST_F(MapLabelsTest, NamesMakeWayForAnOverlayThatAppears)
{
    openMars();
    ForceMeter& meter = *window_->overlays()->forceMeter();
    meter.setForce({0.0, 0.0, 1.0}, 3.0);
    ASSERT_TRUE(waitFor([&] { return meter.isVisible(); }));
    const QRectF plate = meter.geometry();
    // A view with names on both sides of it.
    const auto is_clear = [&] {
        const auto& names = labels().nameLabels();
        return std::none_of(names.begin(), names.end(), [&](const MapLabels::Label& name) {
            return name.box.intersects(plate);
        });
    };
    EXPECT_TRUE(waitFor(is_clear));
    bool was_covered = false;
    for (int turn = 0; turn < 24 && !was_covered; ++turn) {
        OrbitCamera camera = view().camera();
        camera.azimuth = Angle::degrees(15.0 * turn);
        meter.release();
        view().setCamera(camera);
        was_covered = waitFor([&] { return meter.isHidden(); }) && !is_clear();
    }
    ASSERT_TRUE(was_covered) << "no name ever lies where the force meter appears";
    meter.setForce({0.0, 0.0, 1.0}, 3.0);
    EXPECT_TRUE(waitFor(is_clear));
}

TEST_F(MapLabelsTest, ANameNeverHidesTheCursorOfATouch)
{
    openMars();
    ASSERT_FALSE(labels().nameLabels().empty());
    const QRect name = labels().nameLabels().front().box.toAlignedRect();
    const auto picture = [&] {
        QImage image(name.size(), QImage::Format_ARGB32_Premultiplied);
        image.fill(Qt::transparent);
        labels().render(&image, {}, name, QWidget::RenderFlags());
        return image;
    };
    QImage empty(name.size(), QImage::Format_ARGB32_Premultiplied);
    empty.fill(Qt::transparent);
    const QImage drawn = picture();
    ASSERT_NE(drawn, empty);
    labels().setCursorPlace(QRectF(name).center());
    EXPECT_EQ(picture(), empty);
    labels().setCursorPlace(std::nullopt);
    EXPECT_EQ(picture(), drawn);
}

} // namespace
} // namespace marsview
