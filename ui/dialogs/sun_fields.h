// Chooses where the sun is overhead.
#pragma once

#include "core/geo/coordinate_format.h"
#include "core/geo/frames.h"
#include "core/raster/raster_info.h"

#include <QWidget>

#include <optional>

class QLabel;
class QLineEdit;
class QPushButton;

namespace marsview {

/// Two fields for the latitude and longitude of the subsolar point, in the coordinate format that
/// the user chose, and a button.
class SunFields final : public QWidget {
    Q_OBJECT

public:
    explicit SunFields(QWidget* parent = nullptr);

    void setCoordinateFormat(const CoordinateFormat& format);
    /// A map of the body: its name and ellipsoid count.
    void setBody(const RasterInfo& info);
    void setPoint(const GeographicPoint& point);
    /// Forgets what was typed and not entered.
    void restore();
    QLineEdit* firstField() const noexcept { return latitude_; }

Q_SIGNALS:
    void pointChosen(const GeographicPoint& point);
    /// The sun is to stand over the middle of the picture.
    void overheadRequested();

private:
    void show();
    void enter();

    CoordinateFormat format_;
    RasterInfo info_;
    GeographicPoint point_;
    QLineEdit* latitude_ = nullptr;
    QLineEdit* longitude_ = nullptr;
    QLabel* problem_ = nullptr;
    QPushButton* overhead_ = nullptr;
};

} // namespace marsview
