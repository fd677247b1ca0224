// Choosing over which elevations or slopes a layer's color ramp is spread.
#pragma once

#include "core/terrain/height_histogram.h"
#include "core/view/color_ramp.h"
#include "core/view/color_stretch.h"
#include "core/view/slope_range.h"
#include "ui/text/number_text.h"

#include <QDialog>
#include <QString>

#include <memory>
#include <optional>

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QPushButton;

namespace marsview {

class ElevationBox;
class StretchPlot;

struct StretchContent {
    QString layer; // its name; empty: there is none, and nothing can be chosen
    ColorStretch stretch{};
    HeightRange stretched{}; // the resulting range, in meters
    HeightRange all{};       // of the layer
    const ColorRamp* ramp = nullptr;
    std::shared_ptr<const HeightHistogram> histogram{}; // null while it is being counted
    bool is_in_picture = false;
    /// The colors show slopes: over which, whether that was chosen, and how those of the map are
    /// distributed. Elevations are left out.
    std::optional<SlopeRange> slopes{};
    bool are_slopes_chosen = false;
    SlopeHistogram slope_histogram{};
};

/// Stays open while people work with the map. Every choice takes effect at once and can be undone.
class StretchDialog final : public QDialog {
    Q_OBJECT

public:
    explicit StretchDialog(QWidget* parent = nullptr);

    void setContent(const StretchContent& content);
    void setHeightUnit(HeightUnit unit);
    /// Moves the keyboard focus to the first field of `kind`.
    void edit(StretchKind kind);

Q_SIGNALS:
    void stretchRequested(const ColorStretch& stretch);
    /// As stretchRequested(), while an end is dragged.
    void stretchDragged(const ColorStretch& stretch);
    /// A drag begins or has ended.
    void dragEnded();
    void stretchToViewRequested();
    /// Nothing for what suits the layer.
    void slopesRequested(const std::optional<SlopeRange>& slopes);
    /// As slopesRequested(), while an end is dragged.
    void slopesDragged(const SlopeRange& slopes);

private:
    void fill();
    void requestKind();
    void requestEnds();
    void drag(double low, double high);
    void requestSlopes();
    void fillSlopes();
    void fillHeights();

    StretchContent content_;
    bool was_slope_ = false;
    HeightUnit unit_ = HeightUnit::Meters;
    QFormLayout* form_ = nullptr;
    StretchPlot* plot_ = nullptr;
    QComboBox* kind_ = nullptr;
    QDoubleSpinBox* cut_ = nullptr;
    ElevationBox* low_ = nullptr;
    ElevationBox* high_ = nullptr;
    QPushButton* to_view_ = nullptr;
    QLabel* note_ = nullptr;
};

} // namespace marsview
