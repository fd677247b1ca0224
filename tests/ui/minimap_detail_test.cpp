// The overview map shows no more detail than the view does of the same terrain.

#include "tests/ui/map_window.h"
#include "ui/overlay/overview_picture.h"

#include <QColor>
#include <QImage>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace marsview {
namespace {

// Brightness of places in rows and columns, 0 … 255; NaN where a place is not to be compared.
struct Brightness {
    int columns = 0;
    int rows = 0;
    std::vector<double> values;

    double at(int column, int row) const
    {
        return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(column)];
    }
};

double brightnessOf(const QImage& picture, int x, int y)
{
    const QColor color = picture.pixelColor(x, y);
    return 0.299 * color.red() + 0.587 * color.green() + 0.114 * color.blue();
}

// The root mean square of what differs between places `apart` pixels from each other.
double detailOf(const Brightness& brightness, int apart)
{
    double sum = 0.0;
    int count = 0;
    for (int row = 0; row + apart < brightness.rows; ++row) {
        for (int column = 0; column + apart < brightness.columns; ++column) {
            const double here = brightness.at(column, row);
            for (const double there :
                 {brightness.at(column + apart, row), brightness.at(column, row + apart)}) {
                if (std::isfinite(here) && std::isfinite(there)) {
                    sum += (here - there) * (here - there);
                    ++count;
                }
            }
        }
    }
    return count > 1000 ? std::sqrt(sum / count) : 0.0;
}

class MinimapDetailTest : public MapWindowTest {
protected:
    static constexpr int kApart = 3; // pixels of the overview, of waves that are 7.5 long

    // Waves of 15 samples, so low that the triangles may be large at exaggeration 1.
    void SetUp() override
    {
        makeWindow({1500, 950});
        TestMaps::Shape shape;
        shape.columns = 900;
        shape.rows = 600;
        shape.cell = 3000.0;
        ASSERT_TRUE(openAndWait(
            *window_, maps_.write(QStringLiteral("fine.asc"), shape, [](int column, int row) {
                return 300.0 * std::sin(column / 61.0) * std::cos(row / 47.0) +
                       300.0 * std::sin(column / 3.0 + row / 4.0);
            })));
    }
    OverviewPicture overview()
    {
        return overviewPicture(view().shownLayers(), view().ground(), view().look(),
                               view().exaggeration());
    }
    // From above, with most of the map in the picture, at rest.
    bool lookDown(double exaggeration)
    {
        view().setExaggeration(exaggeration);
        OrbitCamera camera = view().camera();
        camera.target = {0.0, 0.0, 0.0};
        camera.tilt = {};
        camera.azimuth = {};
        // A pixel of the overview, 6 km, is 1.2 pixels of the view.
        camera.distance_m *= 6000.0 / 1.2 / metersPerPixel(camera, view().viewport());
        view().setCamera(camera);
        return waitFor([this] { return view().isPictureComplete(); });
    }
    // Both pictures at the pixels of the overview: the view's where it shows these places.
    struct Pair {
        Brightness overview;
        Brightness view;
    };
    Pair compared(const OverviewPicture& overview, const QImage& picture)
    {
        const int columns = overview.image.width();
        const int rows = overview.image.height();
        Pair pair{.overview = {columns, rows, {}}, .view = {columns, rows, {}}};
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < columns; ++column) {
                const GridPoint grid{
                    (column + 0.5) * static_cast<double>(overview.columns) / columns - 0.5,
                    (row + 0.5) * static_cast<double>(overview.rows) / rows - 0.5};
                const auto position =
                    view().positionOfPlace(overview.frame.toScene(grid, 0.0)).value();
                const QPoint pixel = (position * picture.devicePixelRatio()).toPoint();
                const bool is_seen = picture.rect().adjusted(5, 5, -5, -5).contains(pixel);
                pair.view.values.push_back(is_seen ? brightnessOf(picture, pixel.x(), pixel.y())
                                                   : std::nan(""));
                pair.overview.values.push_back(is_seen ? brightnessOf(overview.image, column, row)
                                                       : std::nan(""));
            }
        }
        return pair;
    }
};

TEST_F(MinimapDetailTest, IsNoFinerThanTheViewAtAnyExaggeration)
{
    for (const double exaggeration : {1.0, 10.0}) {
        SCOPED_TRACE(exaggeration);
        ASSERT_TRUE(lookDown(exaggeration));
        const QImage picture = view().terrainPicture();
        const Pair pair = compared(overview(), picture);
        const double of_overview = detailOf(pair.overview, kApart);
        EXPECT_GT(of_overview, 10.0) << "nothing to compare";
        EXPECT_GT(detailOf(pair.view, kApart), 0.95 * of_overview);
    }
}

// Colors that are interpolated over triangles of 18 pixels would be noticed.
TEST_F(MinimapDetailTest, DetectsACoarseView)
{
    ASSERT_TRUE(lookDown(1.0));
    const QImage sharp = view().terrainPicture();
    const QImage coarse =
        sharp.scaled(sharp.size() / 18, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
            .scaled(sharp.size(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
    const Pair pair = compared(overview(), coarse);
    EXPECT_LT(detailOf(pair.view, kApart), 0.5 * detailOf(pair.overview, kApart));
}

} // namespace
} // namespace marsview
