// The elevations along lines on the map, as a diagram.
#pragma once

#include "ui/text/number_text.h"

#include <QColor>
#include <QString>
#include <QWidget>

#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// Elevations along a line. Distances ascend; elevations in meters, NaN in gaps.
struct ProfileCurve {
    QString name;
    QColor color;
    std::vector<double> distance_m;
    std::vector<double> elevation_m;
    std::vector<double> vertices_m; // distances at which the line bends
    bool is_approximate = false;
};

/// A part of a profile, begin_m < end_m.
struct DistanceRange {
    double begin_m = 0.0;
    double end_m = 0.0;
    bool operator==(const DistanceRange&) const = default;
};

/// A diagram of one or several profiles, distance to the right and elevation upward, with a cursor.
/// Dragging along it picks a stretch; the wheel zooms; a double click shows everything.
class ProfilePlot final : public QWidget {
    Q_OBJECT

public:
    explicit ProfilePlot(QWidget* parent = nullptr);
    ~ProfilePlot() override;

    /// The first curve is the one that cursor and slope refer to. Several are listed with their
    /// names. Keeps the part that is shown where the extent of the profiles stays the same.
    void setCurves(std::vector<ProfileCurve> curves);
    const std::vector<ProfileCurve>& curves() const noexcept { return curves_; }
    void setHeightUnit(HeightUnit unit);
    /// How many times larger elevations are drawn than distances; empty to fill the plot with both.
    void setExaggeration(std::optional<double> factor);
    /// The exaggeration of the plot as it is drawn; 1 where nothing is.
    double drawnExaggeration() const;
    /// Shows the slope between neighboring points, in degrees, on an axis of its own.
    void setSlopeShown(bool is_shown);
    void showEverything();

    /// Moves the cursor. Emits nothing.
    void setCursorAt(std::optional<double> distance_m);
    const std::optional<double>& cursorAt() const noexcept { return cursor_m_; }
    const std::optional<DistanceRange>& stretch() const noexcept { return stretch_; }
    void setStretch(const std::optional<DistanceRange>& stretch);

    /// Of the picture that savePicture() draws, in units; its labels have the font of the widget.
    static QSize pictureSize();
    /// The plot's image in the format that the suffix names: png, svg or pdf. False where the file
    /// cannot be written.
    bool savePicture(const QString& path);

Q_SIGNALS:
    /// By the pointer or the arrow keys; empty when the pointer leaves.
    void cursorMoved(std::optional<double> distance_m);
    /// By the user.
    void stretchPicked(std::optional<DistanceRange> stretch);

protected:
    void changeEvent(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    struct Parts;

    void fillGraphs();
    void applyColors();
    void applyScale();
    void fitAxes(int height);
    void placeLegend();
    void fitLegend(int height);
    void placeCursor();
    void placeStretch();
    void moveCursor(std::optional<double> distance_m);
    double elevationAt(double distance_m) const;

    std::unique_ptr<Parts> parts_;
    std::vector<ProfileCurve> curves_;
    HeightUnit unit_ = HeightUnit::Meters;
    std::optional<double> exaggeration_;
    bool is_slope_shown_ = false;
    std::optional<double> cursor_m_;
    std::optional<DistanceRange> stretch_;
    std::optional<double> dragged_from_m_;
};

} // namespace marsview
