// The page of the preferences on coordinates.
#pragma once

#include "core/geo/coordinate_format.h"

#include <QWidget>

#include <array>

class QComboBox;
class QLabel;
class QGridLayout;

namespace marsview {

/// Chooses the format of positions, with an example of each notation. The kind of latitude is
/// chosen for one body at a time.
class CoordinatesPage final : public QWidget {
    Q_OBJECT

public:
    explicit CoordinatesPage(QWidget* parent = nullptr);

    void fill(const CoordinateFormat& format);
    /// The body whose kind of latitude and examples are shown first; null for Mars.
    void setBody(const Body* body);
    const CoordinateFormat& format() const noexcept { return format_; }

Q_SIGNALS:
    /// By the user.
    void changed();

private:
    void addExamples(QGridLayout& grid);
    void showLatitudes();
    void showExamples();

    CoordinateFormat format_;
    QComboBox* notation_ = nullptr;
    QComboBox* longitudes_ = nullptr;
    QComboBox* body_ = nullptr;
    QComboBox* latitudes_ = nullptr;
    struct Example {
        QLabel* name = nullptr;
        QLabel* text = nullptr;
    };
    std::array<Example, 3> examples_; // of the notations
};

} // namespace marsview
