// Fly-throughs on the globe: along saved views and lines, played and recorded.
#include "core/flight/camera_path.h"
#include "tests/ui/globe/globe_window.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/measure_controller.h"
#include "ui/views/fly_through_tools.h"

#include <QComboBox>
#include <QImage>
#include <QSignalSpy>
#include <QSlider>

#include <chrono>
#include <cmath>

namespace marsview {
namespace {

class GlobeFlightsTest : public GlobeTest {
protected:
    // At 130° W and at 60° W on the equator, and between them the limb of Tharsis.
    void saveTwoViews()
    {
        first_ = saved(-130.0, 1e6);
        second_ = saved(-60.0, 6e5);
    }
    BodyCamera saved(double longitude_deg, double distance_m)
    {
        globe().setCamera({.target = {.longitude = Angle::degrees(longitude_deg), .latitude = {}},
                           .distance_m = distance_m,
                           .tilt = Angle::degrees(30.0)});
        window_->commands().views.save();
        return globe().camera();
    }
    FlyThroughDialog& openDialog()
    {
        window_->commands().views.actions().fly_through->trigger();
        return *window_->commands().fly_through.dialog();
    }
    static void expectNear(const BodyCamera& a, const BodyCamera& b)
    {
        EXPECT_NEAR(a.target.longitude.degrees(), b.target.longitude.degrees(), 1e-5);
        EXPECT_NEAR(a.target.latitude.degrees(), b.target.latitude.degrees(), 1e-5);
        EXPECT_NEAR(a.distance_m / b.distance_m, 1.0, 1e-6);
        EXPECT_NEAR(a.tilt.degrees(), b.tilt.degrees(), 1e-3);
    }

    BodyCamera first_;
    BodyCamera second_;
};

TEST_F(GlobeFlightsTest, PlaysAlongTheSavedViewsAndStopsForTheUser)
{
    ASSERT_TRUE(showGlobe());
    saveTwoViews();
    FlyThroughDialog& dialog = openDialog();
    ASSERT_TRUE(dialog.path());
    ASSERT_TRUE(dialog.path()->isOnBody());
    dialog.slider()->setValue(1);
    dialog.slider()->setValue(0);
    expectNear(globe().camera(), first_);
    dialog.slider()->setValue(dialog.slider()->maximum() / 2);
    EXPECT_GT(globe().camera().distance_m, 1.2e6) << "it climbs on the way";
    EXPECT_NEAR(globe().camera().target.latitude.degrees(), 0.0, 1e-6) << "along the equator";
    QSignalSpy finished(&dialog.flight(), &CameraFlight::finished);
    dialog.flight().play(*dialog.path(), std::chrono::milliseconds(60));
    ASSERT_TRUE(waitFor([&] { return finished.count() == 1; }));
    expectNear(globe().camera(), second_);
    QSignalSpy interrupted(&dialog.flight(), &CameraFlight::interrupted);
    dialog.flight().play(*dialog.path(), std::chrono::minutes(1));
    wheel(globeMiddle(), 1);
    ASSERT_TRUE(waitFor([&] { return interrupted.count() == 1; }));
    EXPECT_FALSE(dialog.flight().isPlaying());
}

TEST_F(GlobeFlightsTest, FollowsAMeasuredLine)
{
    ASSERT_TRUE(showGlobe());
    globe().setCamera({.target = {.longitude = Angle::degrees(-90.0), .latitude = {}},
                       .distance_m = 4e5,
                       .tilt = Angle::degrees(50.0)});
    MeasureController& measure = *window_->measuring();
    const Map& map = *globe().terrain()->map();
    const auto at = [&](double longitude_deg, double latitude_deg) {
        return *map.georeference().toGrid(GeographicPoint{
            .longitude = Angle::degrees(longitude_deg), .latitude = Angle::degrees(latitude_deg)});
    };
    measure.begin(MeasurementKind::Distance);
    measure.addPointAt(at(-100.0, -5.0));
    measure.addPointAt(at(-80.0, -5.0));
    measure.finish();
    FlyThroughDialog& dialog = openDialog();
    ASSERT_EQ(dialog.source()->currentIndex(), 1) << "there are no views";
    ASSERT_TRUE(dialog.path());
    const BodyCamera begin = dialog.path()->bodyCameraAt(0.0);
    const BodyCamera end = dialog.path()->bodyCameraAt(1.0);
    EXPECT_NEAR(begin.target.longitude.degrees(), -100.0, 0.01);
    EXPECT_NEAR(begin.target.latitude.degrees(), -5.0, 0.01);
    EXPECT_NEAR(end.target.longitude.degrees(), -80.0, 0.01);
    EXPECT_NEAR(begin.distance_m, 4e5, 1.0);
    EXPECT_NEAR(begin.tilt.degrees(), 50.0, 1.0);
    EXPECT_NEAR(dialog.path()->bodyCameraAt(0.5).azimuth.degrees(), 90.0, 1.0);
    // The same line on the flat map, when that returns.
    scene(1)->trigger();
    ASSERT_TRUE(waitFor([&] { return dialog.path() && !dialog.path()->isOnBody(); }));
    const GridPoint flat =
        view().map()->georeference().sceneFrame().toGrid(dialog.path()->at(0.0).target);
    EXPECT_NEAR(flat.column, at(-100.0, -5.0).column, 0.1);
}

TEST_F(GlobeFlightsTest, RecordsPicturesOfTheGlobe)
{
    ASSERT_TRUE(showGlobe());
    saveTwoViews();
    FlyThroughDialog& dialog = openDialog();
    FlyThroughRecorder& recorder = window_->commands().fly_through.recorder();
    const QString file = maps_.path(QStringLiteral("flight.png"));
    QSignalSpy done(&recorder, &FlyThroughRecorder::saved);
    recorder.start(*dialog.path(), file,
                   {.size = {96, 64}, .frames_per_s = 25, .frame_count = 3, .has_legend = false});
    ASSERT_TRUE(waitFor([&] { return done.count() == 1; }));
    const QImage last(FlyThroughRecorder::frameFile(file, 3));
    ASSERT_EQ(last.size(), QSize(96, 64));
    QImage expected(last.size(), QImage::Format_RGB888);
    ASSERT_TRUE(waitFor([&] {
        const auto drawn = globe().drawPart(second_, globe().style(), expected.rect(),
                                            {.lines = PictureLines::Omitted}, expected);
        return drawn && *drawn;
    }));
    int differing = 0;
    for (int y = 0; y < last.height(); ++y) {
        for (int x = 0; x < last.width(); ++x) {
            differing +=
                std::abs(last.pixelColor(x, y).red() - expected.pixelColor(x, y).red()) > 3 ? 1 : 0;
        }
    }
    EXPECT_LT(differing, 60);
}

} // namespace
} // namespace marsview
