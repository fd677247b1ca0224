// The page of the preferences on coordinates.
#pragma once

#include "core/geo/coordinate_format.h"

#include <QWidget>

class QComboBox;
class QLabel;

namespace marsview {

/// Chooses the format of positions. The kind of latitude is chosen for one body at a time.
class CoordinatesPage final : public QWidget {
    Q_OBJECT

public:
    explicit CoordinatesPage(QWidget* parent = nullptr);

    void fill(const CoordinateFormat& format);
    const CoordinateFormat& format() const noexcept { return format_; }

Q_SIGNALS:
    /// By the user.
    void changed();

private:
    void showLatitudes();
    void showExample();

    CoordinateFormat format_;
    QComboBox* notation_ = nullptr;
    QComboBox* longitudes_ = nullptr;
    QComboBox* body_ = nullptr;
    QComboBox* latitudes_ = nullptr;
    QLabel* example_ = nullptr;
};

} // namespace marsview
