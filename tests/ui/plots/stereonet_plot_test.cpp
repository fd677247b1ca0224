#include "ui/plots/stereonet_plot.h"

#include <QFile>
#include <QImage>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace marsview {
namespace {

class StereonetPlotTest : public testing::Test {
protected:
    void SetUp() override
    {
        plot_.resize(300, 320);
        plot_.setPlanes(
            {{.id = 7, .name = QStringLiteral("east"), .plane = {0.0, 30.0}, .ellipse = {}},
             {.id = 9, .name = QStringLiteral("south"), .plane = {90.0, 60.0}, .ellipse = {}}},
            7);
        plot_.show();
    }

    StereonetPlot plot_;
};

// The pole of a plane that dips to the east lies to the west, that of a southward dip to the north.
TEST_F(StereonetPlotTest, PolesLieOppositeToTheDipAndCanBeClicked)
{
    const QPointF east = *plot_.placeOf(7);
    const QPointF south = *plot_.placeOf(9);
    // Both are measured from the middle of the same circle.
    const QPointF middle(south.x(), east.y());
    const double radius =
        (middle.x() - east.x()) / (std::sqrt(2.0) * std::sin(15.0 * std::numbers::pi / 180.0));
    EXPECT_GT(radius, 100.0);
    EXPECT_LT(radius, 150.0);
    EXPECT_NEAR(middle.y() - south.y(),
                radius * std::sqrt(2.0) * std::sin(30.0 * std::numbers::pi / 180.0), 1e-6);
    EXPECT_NEAR(middle.x(), 150.0, 1.0);
    EXPECT_FALSE(plot_.placeOf(8));
    const QSignalSpy chosen(&plot_, &StereonetPlot::planeChosen);
    QTest::mouseClick(&plot_, Qt::LeftButton, {}, south.toPoint());
    ASSERT_EQ(chosen.count(), 1);
    EXPECT_EQ(chosen.front().front().toUInt(), 9U);
    QTest::mouseClick(&plot_, Qt::LeftButton, {}, middle.toPoint() + QPoint(80, 60));
    EXPECT_EQ(chosen.count(), 1);
}

TEST_F(StereonetPlotTest, SavesPicturesThatShowThePlanes)
{
    const QTemporaryDir folder;
    const QString png = folder.filePath(QStringLiteral("net.png"));
    ASSERT_TRUE(plot_.savePicture(png));
    const QImage net(png);
    EXPECT_EQ(net.width(), net.height());
    const auto inked = [](const QImage& image) {
        int count = 0;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                count += image.pixelColor(x, y).lightness() < 128 ? 1 : 0;
            }
        }
        return count;
    };
    plot_.setDiagram(StereonetPlot::Diagram::Rose);
    ASSERT_TRUE(plot_.savePicture(png));
    EXPECT_NE(QImage(png), net);
    plot_.setDiagram(StereonetPlot::Diagram::Stereonet);
    plot_.setPlanes({}, 0);
    ASSERT_TRUE(plot_.savePicture(png));
    const QImage empty(png);
    EXPECT_GT(inked(net), inked(empty) + 2 * net.width()) << "two great circles from rim to rim";
    for (const char* name : {"net.svg", "net.pdf"}) {
        const QString path = folder.filePath(QLatin1String(name));
        ASSERT_TRUE(plot_.savePicture(path)) << name;
        EXPECT_GT(QFile(path).size(), 500) << name;
    }
    EXPECT_FALSE(plot_.savePicture(folder.filePath(QStringLiteral("none/net.png"))));
}

} // namespace
} // namespace marsview
