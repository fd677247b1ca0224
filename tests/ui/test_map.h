// Small maps on disk, and windows for them.
#pragma once

#include "tests/support/temp_folder.h"
#include "ui/main_window.h"

#include <QString>
#include <QTemporaryDir>

#include <array>
#include <functional>
#include <string>

namespace marsview {

/// A folder of maps that is removed with the object.
class TestMaps {
public:
    struct Shape {
        int columns = 60;
        int rows = 40;
        double x_lower_left = 500000.0;
        double y_lower_left = 4000000.0;
        double cell = 30.0;
    };
    using Height = std::function<double(int column, int row)>; // NaN for void

    /// Writes an ESRI ASCII grid without a CRS.
    QString write(const QString& name, const Shape& shape, const Height& height) const;
    /// A map with a hill north-west of its middle.
    QString hill(const QString& name = QStringLiteral("hill.asc")) const;
    /// A map with a hole around its middle.
    QString ring() const;
    /// Wide waves with narrow ones on them, 900 × 600 samples: 4 × 3 tiles.
    QString waves() const;
    /// A slope of 40 × 30 samples in any CRS.
    QString placed(const std::string& name,
                   const std::string& srs,
                   const std::array<double, 6>& transform) const;
    QString mars(const std::string& name = "mars") const
    {
        return placed(name, "IAU_2015:49900", {10.0, 0.25, 0.0, 20.0, 0.0, -0.25});
    }
    QString moon(const std::string& name = "moon") const
    {
        return placed(name, "IAU_2015:30100", {10.0, 0.25, 0.0, 20.0, 0.0, -0.25});
    }
    QString path(const QString& name) const { return folder_.filePath(name); }

private:
    QTemporaryDir folder_;
    test::TempFolder rasters_;
};

/// Options of a window that neither stores settings nor opens dialogs.
WindowOptions testWindowOptions();

/// Processes events until the window has settled. False after half a minute.
bool waitUntilSettled(MainWindow& window);

/// Opens a file and waits.
bool openAndWait(MainWindow& window, const QString& file);

} // namespace marsview
