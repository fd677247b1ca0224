// The status bar's readout: position and elevation under the pointer, the stylus or the crosshair.
#pragma once

#include "core/measure/closed_surface.h"
#include "core/terrain/ray_cast.h"
#include "ui/canvas/terrain_view.h"
#include "ui/text/coordinate_text.h"

#include <QWidget>

#include <memory>
#include <optional>

class QMenu;
class QToolButton;

namespace marsview {

class CoordinateField;
class Map;
class ReservedLabel;

/// A position that is read, and how exactly it can be pointed at.
struct ReadPlace {
    RayHit hit;                  // on the scene's grid
    double screen_pixel_m = 0.0; // meters on the terrain in one point of the screen; 0: unknown
};

/// Shows a position in the chosen format, the elevation there, and how sharp the picture is. Its
/// parts keep their width while numbers change.
class StatusReadout final : public QWidget {
    Q_OBJECT

public:
    explicit StatusReadout(QWidget* parent = nullptr);

    /// `scene` is the map that positions are on, null for none. `active` is the one whose
    /// elevations are shown, where it has any; it may be the same, or null for none. Both lie in
    /// one CRS.
    void setMaps(const std::shared_ptr<const Map>& scene, const std::shared_ptr<const Map>& active);
    /// Nothing where no position of the map is pointed at.
    void setPlace(const std::optional<ReadPlace>& place);
    /// What setPlace() is the place of; the pointer to begin with.
    void setSource(ReadingSource source);
    void setFormat(const CoordinateFormat& format);
    const CoordinateFormat& format() const noexcept { return format_; }
    void setHeightUnit(HeightUnit unit);
    /// The screen-space error of the picture, in pixels.
    void setDetail(double pixels);
    /// Whether pieces of the picture are loading.
    void setLoading(bool is_loading);
    /// Why pieces of the picture cannot be read; empty where all can.
    void setProblem(const QString& problem);

    QString sourceLabel() const;
    QString coordinateLabel() const;
    QString heightLabel() const;
    QString detailLabel() const;
    CoordinateField* coordinateField() const noexcept { return coordinate_; }

    /// The position for the clipboard; empty where none is shown.
    QString plainPosition() const;
    /// Puts the choices of the format, and `copy` below them, into an empty menu.
    void fillMenu(QMenu& menu);
    /// The action that copies the position: the last entry of the menu.
    void setCopyAction(QAction* copy) { copy_action_ = copy; }

Q_SIGNALS:
    /// By the user.
    void formatChosen(const CoordinateFormat& format);
    /// The position is shown on behalf of the keyboard: it has the focus, or no more.
    void focusChanged(bool has_focus);

private:
    void reserveWidths();
    void refresh();
    void showDetail();
    struct ReadHeight {
        QString text;
        QString why_rough{}; // empty: it is the elevation of the map
    };
    ReadHeight heightAt(const RayHit& hit) const;

    std::shared_ptr<const Map> scene_;
    std::shared_ptr<const Map> active_;
    std::optional<ClosedSurface> scene_surface_; // of those maps
    std::optional<ClosedSurface> active_surface_;
    std::optional<ReadPlace> place_;
    bool is_place_known_ = false; // not before setPlace() for these maps
    CoordinateFormat format_;
    HeightUnit unit_ = HeightUnit::Meters;
    std::optional<double> detail_px_; // none: not drawn yet
    bool is_loading_ = false;
    bool has_problem_ = false;
    ReservedLabel* source_ = nullptr;
    CoordinateField* coordinate_ = nullptr;
    QToolButton* format_button_ = nullptr;
    ReservedLabel* height_ = nullptr;
    ReservedLabel* detail_ = nullptr;
    QWidget* height_rule_ = nullptr;
    QWidget* detail_rule_ = nullptr;
    QAction* copy_action_ = nullptr;
};

} // namespace marsview
