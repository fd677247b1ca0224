// The status bar's account of the place under the pointer.
#pragma once

#include "core/terrain/ray_cast.h"
#include "ui/coordinate_text.h"

#include <QWidget>

#include <memory>
#include <optional>

class QActionGroup;
class QLabel;
class QToolButton;

namespace marsview {

class Dataset;
class ReservedLabel;

/// Shows a position, in the terms that the user picks, the height there, and how sharp the picture
/// is. Its parts keep their width while numbers change.
class StatusReadout final : public QWidget {
    Q_OBJECT

public:
    explicit StatusReadout(QWidget* parent = nullptr);

    /// `scene` is the map that positions are on, null for none. `active` is the one whose heights
    /// are told, where it has any; it may be the same, or null for none. Both lie in one CRS.
    void setDatasets(const std::shared_ptr<const Dataset>& scene,
                     const std::shared_ptr<const Dataset>& active);
    /// On the scene's grid; nothing where the pointer is off the map.
    void setHit(const std::optional<RayHit>& hit);
    void setDisplay(CoordinateDisplay display);
    CoordinateDisplay display() const noexcept { return display_; }
    /// Between map coordinates and the usual longitude and latitude. Nothing where there is but
    /// one.
    void toggleDisplay();
    void setHeightUnit(HeightUnit unit);
    /// The screen-space error of the picture, in pixels.
    void setDetail(double pixels);
    /// Whether pieces of the picture are on their way.
    void setLoading(bool is_loading);
    /// Why pieces of the picture cannot be read; empty where all can.
    void setProblem(const QString& problem);

    QString coordinateLabel() const;
    QString heightLabel() const;
    QString detailLabel() const;

Q_SIGNALS:
    /// By the user.
    void displayChosen(CoordinateDisplay display);

private:
    void fillMenu();
    void reserveWidths();
    void refresh();
    void showDetail();
    struct ReadHeight {
        QString text;
        QString why_rough{}; // empty: it is the height of the map
    };
    ReadHeight heightAt(const RayHit& hit) const;

    std::shared_ptr<const Dataset> scene_;
    std::shared_ptr<const Dataset> active_;
    std::optional<RayHit> hit_;
    CoordinateDisplay wanted_ = CoordinateDisplay::Planetocentric; // where the map has it
    bool is_display_wanted_ = false;                               // otherwise the map's usual one
    CoordinateDisplay display_ = CoordinateDisplay::Map;
    HeightUnit unit_ = HeightUnit::Metres;
    double detail_px_ = 0.0;
    bool is_loading_ = false;
    bool has_problem_ = false;
    ReservedLabel* coordinate_ = nullptr;
    QToolButton* toggle_button_ = nullptr;
    QToolButton* display_button_ = nullptr;
    QActionGroup* display_group_ = nullptr;
    ReservedLabel* height_ = nullptr;
    ReservedLabel* detail_ = nullptr;
};

} // namespace marsview
