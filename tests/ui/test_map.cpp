#include "tests/ui/test_map.h"

#include "tests/support/make_raster.h"
#include "tests/ui/timeout.h"

#include <QFile>
#include <QTest>
#include <QTextStream>

#include <cmath>
#include <vector>

namespace marsview {

QString TestMaps::write(const QString& name, const Shape& shape, const Height& height) const
{
    QFile file(path(name));
    if (!file.open(QIODevice::WriteOnly | QIODevice::Text)) {
        return {};
    }
    QTextStream out(&file);
    out.setRealNumberPrecision(12);
    out << "ncols " << shape.columns << "\nnrows " << shape.rows << "\nxllcorner "
        << shape.x_lower_left << "\nyllcorner " << shape.y_lower_left << "\ncellsize " << shape.cell
        << "\nNODATA_value -9999\n";
    for (int row = 0; row < shape.rows; ++row) {
        for (int column = 0; column < shape.columns; ++column) {
            const double value = height(column, row);
            out << (std::isnan(value) ? -9999.0 : value) << (column + 1 < shape.columns ? " " : "");
        }
        out << "\n";
    }
    return path(name);
}

QString TestMaps::hill(const QString& name) const
{
    return write(name, {}, [](int column, int row) {
        const double c = column - 20.0;
        const double r = row - 12.0;
        return 100.0 + std::round(2000.0 * std::exp(-(c * c + r * r) / 80.0)) / 10.0;
    });
}

QString TestMaps::waves() const
{
    Shape shape;
    shape.columns = 900;
    shape.rows = 600;
    return write(QStringLiteral("waves.asc"), shape, [](int c, int r) {
        return 900.0 * std::sin(c / 61.0) * std::cos(r / 47.0) + 25.0 * std::sin(c / 3.0 + r / 4.0);
    });
}

QString TestMaps::ring() const
{
    return write(QStringLiteral("ring.asc"), {}, [](int column, int row) {
        return std::hypot(column - 29.5, row - 19.5) < 8.0 ? std::nan("") : 100.0 + column;
    });
}

QString TestMaps::placed(const std::string& name,
                         const std::string& srs,
                         const std::array<double, 6>& transform) const
{
    constexpr std::size_t kColumns = 40;
    std::vector<float> samples(kColumns * 30);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<float>(i % kColumns) * 20.0F - 300.0F;
    }
    test::RasterRecipe recipe = test::recipeFor(kColumns, samples);
    recipe.srs = srs;
    recipe.transform = transform;
    return QString::fromStdString(test::writeVrt(rasters_, name, recipe));
}

WindowOptions testWindowOptions()
{
    // Without a GPU, smooth edges take half of the time of most tests.
    return {.geometry = WindowOptions::Geometry::Fixed,
            .preferences = {.has_antialiasing = false},
            .failures = WindowOptions::Failures::BySignalOnly,
            .scene = SceneChoice::Flat};
}

// By the state: the signal may have come before, while the caller waited for something else.
bool waitUntilSettled(MainWindow& window)
{
    return QTest::qWaitFor([&window] { return window.isSettled(); }, kTimeout);
}

bool openAndWait(MainWindow& window, const QString& file)
{
    window.open(file);
    return waitUntilSettled(window);
}

} // namespace marsview
