// Pictures of the globe: files, reports, saved views.
#include "tests/ui/globe/globe_window.h"
#include "ui/commands/picture_saver.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/session_controller.h"
#include "ui/globe/globe_labels.h"
#include "ui/overlay/globe_overlays.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/scale_bar_view.h"
#include "ui/pictures/globe_pictures.h"
#include "ui/report/report_exporter.h"

#include <QDockWidget>
#include <QFile>
#include <QImage>
#include <QSignalSpy>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

class GlobePicturesTest : public GlobeTest {
protected:
    bool showWholeGlobe()
    {
        if (!showGlobe()) {
            return false;
        }
        globe().setHomeCamera();
        return waitFor([this] { return globe().isPictureComplete(); });
    }
    QImage saved(const PictureChoice& choice)
    {
        auto* saver = window_->findChild<PictureSaver*>();
        const QString file = maps_.path(QStringLiteral("globe.png"));
        QFile::remove(file);
        saver->save(file, globe().camera(), choice);
        EXPECT_TRUE(waitFor([&] { return !saver->isSaving(); }));
        return QImage(file);
    }
    QImage bare(const QSize& size)
    {
        return saved({.size = size, .has_legend = false, .has_scale = false, .has_labels = false});
    }
    QSize windowSize() { return {globe().viewport().width, globe().viewport().height}; }
    static int differences(const QImage& a, const QImage& b, const QRect& area)
    {
        int count = 0;
        for (int y = area.top(); y <= area.bottom(); ++y) {
            for (int x = area.left(); x <= area.right(); ++x) {
                const QColor one = a.pixelColor(x, y);
                const QColor other = b.pixelColor(x, y);
                count += std::abs(one.red() - other.red()) > 3 ||
                                 std::abs(one.green() - other.green()) > 3 ||
                                 std::abs(one.blue() - other.blue()) > 3
                             ? 1
                             : 0;
            }
        }
        return count;
    }
    GlobeOverlays& overlays() { return *globe().findChild<GlobeOverlays*>(); }
};

TEST_F(GlobePicturesTest, FilesShowWhatTheWindowShowsAtAnySize)
{
    ASSERT_TRUE(showWholeGlobe());
    const QImage shown = globe().grabFramebuffer();
    const QImage once = bare(windowSize());
    ASSERT_EQ(once.size(), shown.size());
    EXPECT_LT(differences(once, shown, once.rect()), once.width() * once.height() / 500);
    // Wider and lower than the window: the ball ends where rays of that picture miss it.
    const QSize wide(900, 300);
    const QImage picture = bare(wide);
    ASSERT_EQ(picture.size(), wide);
    const CameraPose pose = poseOf(globe().camera(), body());
    int ball = 0;
    for (int y = 4; y < wide.height(); y += 20) {
        for (int x = 4; x < wide.width(); x += 20) {
            const auto hits = [&](double right, double down) {
                return globe()
                    .scene()
                    .cast(pickRay(pose, {wide.width(), wide.height()}, {x + right, y + down}),
                          globe().exaggeration())
                    .has_value();
            };
            const bool is_ball = hits(0.5, 0.5);
            if (is_ball == hits(-4.0, -4.0) && is_ball == hits(5.0, 5.0)) { // not at its edge
                ball += is_ball ? 1 : 0;
                EXPECT_EQ(picture.pixelColor(x, y).red() > 45, is_ball) << x << ", " << y;
            }
        }
    }
    EXPECT_GT(ball, 100);
}

TEST_F(GlobePicturesTest, FilesHaveTheOverlaysAndLabelsOfTheWindow)
{
    ASSERT_TRUE(showWholeGlobe());
    const QSize twice = 2 * windowSize();
    const QImage without = bare(twice);
    const QImage with =
        saved({.size = twice, .has_legend = true, .has_scale = true, .has_labels = true});
    ASSERT_EQ(with.size(), twice);
    const auto is_drawn = [&](const QRectF& box) {
        const QRect pixels(2 * box.topLeft().toPoint(), 2 * box.size().toSize());
        return differences(with, without, pixels & with.rect()) >
               pixels.width() * pixels.height() / 20;
    };
    EXPECT_TRUE(is_drawn(overlays().legend()->geometry()));
    EXPECT_TRUE(is_drawn(overlays().scaleBar()->geometry()));
    // At the same aspect, names are where the window has them.
    ASSERT_FALSE(overlays().labels()->labels().empty());
    for (const auto& label : overlays().labels()->labels()) {
        EXPECT_TRUE(is_drawn(label.box)) << label.text.toStdString();
    }
}

TEST_F(GlobePicturesTest, ReportsStateTheScaleOfTheirPicture)
{
    ASSERT_TRUE(showGlobe());
    globe().setCamera(
        {.target = {.longitude = Angle::degrees(10.0), .latitude = Angle::degrees(5.0)},
         .distance_m = 1e6,
         .azimuth = Angle::degrees(30.0)});
    ASSERT_TRUE(waitFor([this] { return globe().isPictureComplete(); }));
    const QSize size(2000, 1500);
    const PictureFacts facts = window_->commands().reports.scene().facts(size);
    // Between two places on the ground, twenty pixels apart in such a picture.
    const CameraPose pose = poseOf(globe().camera(), body());
    const auto at = [&](double right) {
        const Ray ray = pickRay(pose, {size.width(), size.height()},
                                {0.5 * size.width() + right, 0.5 * size.height()});
        return ray.at(globe().scene().cast(ray, globe().exaggeration())->hit.distance_m);
    };
    EXPECT_NEAR(facts.pixel_m, length(at(10.0) - at(-10.0)) / 20.0, 0.02 * facts.pixel_m);
    EXPECT_NEAR(facts.heading.degrees(), 30.0, 1e-9);
    EXPECT_TRUE(facts.is_on_body);
    const QString file = maps_.path(QStringLiteral("globe.html"));
    QSignalSpy written(&window_->commands().reports, &ReportExporter::saved);
    window_->commands().reports.exportTo(file, {.title = QStringLiteral("Globe")});
    ASSERT_TRUE(waitFor([&] { return written.count() == 1; }));
    QFile page(file);
    ASSERT_TRUE(page.open(QIODevice::ReadOnly));
    const QString html = QString::fromUtf8(page.readAll());
    EXPECT_TRUE(html.contains(QStringLiteral("10.0")) && html.contains(QStringLiteral("5.0")));
    EXPECT_TRUE(html.contains(QStringLiteral("data:image/")));
}

TEST_F(GlobePicturesTest, SavedViewsOfTheGlobeHaveItsPicture)
{
    ASSERT_TRUE(showWholeGlobe());
    window_->commands().views.save(); // shows the panel
    ViewThumbnails& thumbnails = window_->commands().views.thumbnails();
    const ViewId id = window_->session().views.front().id;
    ASSERT_TRUE(waitFor([&] { return !thumbnails.thumbnail(id).isNull(); }));
    const auto brightness = [&](double x, double y) {
        const QImage picture = thumbnails.thumbnail(id).toImage();
        return qGray(picture.pixel(static_cast<int>(x * picture.width()),
                                   static_cast<int>(y * picture.height())));
    };
    EXPECT_GT(brightness(0.5, 0.5), 60);
    EXPECT_LT(brightness(0.02, 0.03), 60);
    EXPECT_LT(brightness(0.98, 0.95), 60);
    // On the flat map it stays.
    scene(1)->trigger();
    ASSERT_TRUE(waitFor([&] { return view().isPictureComplete() && thumbnails.isComplete(); }));
    EXPECT_LT(brightness(0.02, 0.03), 60);
}

} // namespace
} // namespace marsview
