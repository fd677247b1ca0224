// How the area of terrain is distributed over elevations, as a diagram.
#pragma once

#include "core/measure/hypsometry.h"
#include "ui/text/number_text.h"

#include <QString>
#include <QWidget>

#include <memory>
#include <optional>

namespace marsview {

/// Elevation upward: a bar for the area of each class of elevations, and the hypsometric curve, the
/// share of the area that lies above an elevation. The pointer or the arrow keys read the curve.
class HypsometryPlot final : public QWidget {
    Q_OBJECT

public:
    explicit HypsometryPlot(QWidget* parent = nullptr);
    ~HypsometryPlot() override;

    void setHypsometry(const Hypsometry& hypsometry, bool is_approximate);
    void setHeightUnit(HeightUnit unit);
    /// Of the bars: those of the last setHypsometry(), fewer and with a round width.
    const Hypsometry& classes() const noexcept { return classes_; }

    /// Reads the curve there, or nowhere.
    void setCursorAt(std::optional<double> elevation_m);
    /// What is read: elevation and share. Empty for nothing.
    QString cursorText() const;

    /// Of the picture that savePicture() draws, in units; its labels have the font of the widget.
    static QSize pictureSize();
    /// The plot's image in the format that the suffix names: png, svg or pdf. False where the file
    /// cannot be written.
    bool savePicture(const QString& path);

protected:
    void changeEvent(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    struct Parts;

    void fill();
    void applyColors();
    void placeCursor();

    std::unique_ptr<Parts> parts_;
    Hypsometry hypsometry_;
    Hypsometry classes_;
    HeightUnit unit_ = HeightUnit::Meters;
    bool is_approximate_ = false;
    std::optional<double> cursor_m_;
};

} // namespace marsview
