#include "tests/ui/timeout.h"
#include "ui/plots/profile_plot.h"

#include <QImage>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// 20 km with a hill of 1000 m, no data between 8 and 10 km.
ProfileCurve hill()
{
    ProfileCurve curve{.name = QStringLiteral("Hill"),
                       .color = Qt::red,
                       .distance_m = {},
                       .elevation_m = {},
                       .vertices_m = {0.0, 12000.0, 20000.0}};
    for (int i = 0; i <= 200; ++i) {
        const double x = 100.0 * i;
        curve.distance_m.push_back(x);
        curve.elevation_m.push_back(x > 8000.0 && x < 10000.0
                                        ? std::numeric_limits<double>::quiet_NaN()
                                        : 1000.0 * std::sin(x / 20000.0 * 3.141592653589793));
    }
    return curve;
}

class ProfilePlotTest : public testing::Test {
protected:
    void SetUp() override
    {
        plot_.resize(800, 300);
        plot_.setCurves({hill()});
        plot_.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&plot_));
        canvas_ = plot_.findChild<QWidget*>();
    }

    // Where a mouse pointer is over a share of the width.
    QPoint at(double share) const
    {
        return {static_cast<int>(share * canvas_->width()), canvas_->height() / 2};
    }

    ProfilePlot plot_;
    QWidget* canvas_ = nullptr;
};

TEST_F(ProfilePlotTest, ThePointerMovesTheCursorAndTheArrowKeysMoveItOn)
{
    std::optional<double> cursor_m;
    QObject::connect(&plot_, &ProfilePlot::cursorMoved, &plot_,
                     [&](std::optional<double> distance_m) { cursor_m = distance_m; });
    QTest::mouseMove(canvas_, at(0.3));
    QTest::mouseMove(canvas_, at(0.6));
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return cursor_m && *cursor_m > 9000.0 && *cursor_m < 14000.0; }, kTimeout));
    const double before_m = *cursor_m;
    QTest::keyClick(&plot_, Qt::Key_Right);
    EXPECT_NEAR(*cursor_m, before_m + 100.0, 1.0) << "a 200th of what is shown";
    QTest::keyClick(&plot_, Qt::Key_End);
    EXPECT_EQ(*cursor_m, 20000.0);
    QTest::keyClick(&plot_, Qt::Key_Right);
    EXPECT_EQ(*cursor_m, 20000.0);
}

TEST_F(ProfilePlotTest, DraggingPicksAStretchAndAClickClearsIt)
{
    std::optional<DistanceRange> picked;
    QObject::connect(&plot_, &ProfilePlot::stretchPicked, &plot_,
                     [&](const std::optional<DistanceRange>& stretch) { picked = stretch; });
    QTest::mousePress(canvas_, Qt::LeftButton, {}, at(0.8));
    QTest::mouseMove(canvas_, at(0.6));
    QTest::mouseMove(canvas_, at(0.4));
    QTest::mouseRelease(canvas_, Qt::LeftButton, {}, at(0.4));
    ASSERT_TRUE(picked);
    EXPECT_LT(picked->begin_m, picked->end_m);
    EXPECT_GT(picked->end_m - picked->begin_m, 6000.0);
    QTest::mouseClick(canvas_, Qt::LeftButton, {}, at(0.5));
    EXPECT_FALSE(picked);
}

TEST_F(ProfilePlotTest, AnEqualScaleDrawsAKilometerUpAsLongAsAKilometerAlong)
{
    EXPECT_GT(plot_.drawnExaggeration(), 2.0) << "filled: 20 km by 1 km in 800 by 300 pixels";
    plot_.setExaggeration(1.0);
    EXPECT_NEAR(plot_.drawnExaggeration(), 1.0, 0.01);
    plot_.setExaggeration(5.0);
    EXPECT_NEAR(plot_.drawnExaggeration(), 5.0, 0.05);
    plot_.setHeightUnit(HeightUnit::Feet);
    EXPECT_NEAR(plot_.drawnExaggeration(), 5.0, 0.05);
}

// The share of columns of pixels in which the curve is drawn.
double redColumns(const QImage& picture)
{
    int columns = 0;
    for (int x = 0; x < picture.width(); ++x) {
        for (int y = 0; y < picture.height(); ++y) {
            const QColor color = picture.pixelColor(x, y);
            if (color.red() > 150 && color.green() < 90 && color.blue() < 90) {
                ++columns;
                break;
            }
        }
    }
    return static_cast<double>(columns) / picture.width();
}

TEST_F(ProfilePlotTest, SavedPicturesShowTheCurveWithItsGap)
{
    const QTemporaryDir folder;
    for (const char* suffix : {"png", "svg", "pdf"}) {
        const QString path = folder.filePath(QStringLiteral("profile.") + QLatin1String(suffix));
        ASSERT_TRUE(plot_.savePicture(path)) << suffix;
        EXPECT_GT(QFileInfo(path).size(), 2000) << suffix;
    }
    const double with_gap = redColumns(QImage(folder.filePath(QStringLiteral("profile.png"))));
    ProfileCurve whole = hill();
    for (double& elevation : whole.elevation_m) {
        elevation = std::isnan(elevation) ? 980.0 : elevation;
    }
    plot_.setCurves({whole});
    ASSERT_TRUE(plot_.savePicture(folder.filePath(QStringLiteral("whole.png"))));
    const double without = redColumns(QImage(folder.filePath(QStringLiteral("whole.png"))));
    EXPECT_NEAR(with_gap / without, 0.9, 0.01) << "2 of 20 km are missing";
    EXPECT_FALSE(plot_.savePicture(folder.filePath(QStringLiteral("missing/profile.png"))));
}

// First and last column of the row that has most of a color, if the columns between have it, too.
std::optional<std::pair<int, int>> longestRow(const QImage& picture, bool is_red)
{
    const auto has_color = [&](int x, int y) {
        const QColor color = picture.pixelColor(x, y);
        return (is_red ? color.red() : color.blue()) > 150 && color.green() < 110 &&
               (is_red ? color.blue() : color.red()) < 110;
    };
    int count = 0;
    std::pair<int, int> ends;
    for (int y = 0; y < picture.height(); ++y) {
        std::vector<int> columns;
        for (int x = 0; x < picture.width(); ++x) {
            if (has_color(x, y)) {
                columns.push_back(x);
            }
        }
        if (static_cast<int>(columns.size()) > count) {
            count = static_cast<int>(columns.size());
            ends = {columns.front(), columns.back()};
        }
    }
    return count == ends.second - ends.first + 1 ? std::optional(ends) : std::nullopt;
}

TEST_F(ProfilePlotTest, NamesOfSeveralCurvesCoverNone)
{
    const auto level = [](const QString& name, const QColor& color, double elevation_m) {
        return ProfileCurve{.name = name,
                            .color = color,
                            .distance_m = {0.0, 10000.0, 20000.0},
                            .elevation_m = {elevation_m, elevation_m, elevation_m},
                            .vertices_m = {}};
    };
    const QTemporaryDir folder;
    const auto saved = [&](const char* name) {
        const QString path = folder.filePath(QLatin1String(name));
        EXPECT_TRUE(plot_.savePicture(path));
        return QImage(path);
    };
    std::vector<ProfileCurve> curves{
        level(QStringLiteral("Upper"), Qt::red, 1000.0),
        level(QStringLiteral("A section with a name that is much too long for a legend"), Qt::blue,
              0.0)};
    plot_.setCurves(curves);
    const QImage two = saved("two.png");
    const auto upper = longestRow(two, true);
    const auto lower = longestRow(two, false);
    ASSERT_TRUE(upper && lower) << "there are gaps";
    EXPECT_EQ(*upper, *lower) << "one of them is covered at an end";
    EXPECT_GT(upper->second - upper->first, two.width() / 2);
    for (int i = 0; i < 40; ++i) { // more than fit below each other
        curves.push_back(level(QStringLiteral("More %1").arg(i), Qt::black, 500.0));
    }
    plot_.setCurves(curves);
    const QImage many = saved("many.png");
    ASSERT_TRUE(longestRow(many, true) && longestRow(many, false));
    EXPECT_EQ(*longestRow(many, true), *longestRow(many, false));
    EXPECT_GT(longestRow(many, true)->second - longestRow(many, true)->first, many.width() / 4);
    plot_.setCurves({curves.front()}); // alone, it has the whole width
    const auto alone = longestRow(saved("one.png"), true);
    ASSERT_TRUE(alone);
    EXPECT_GT(alone->second, upper->second + 20);
}

TEST_F(ProfilePlotTest, SamePlaceAgainKeepsTheStretch)
{
    plot_.setStretch(DistanceRange{2000.0, 5000.0});
    plot_.setCurves({hill()}); // as when a finer profile arrives
    EXPECT_EQ(plot_.stretch(), (DistanceRange{2000.0, 5000.0}));
}

} // namespace
} // namespace marsview
