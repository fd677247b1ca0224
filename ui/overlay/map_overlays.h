// The overlays on the map, updated with the view.
#pragma once

#include "core/geo/frames.h"
#include "core/session/session.h"
#include "ui/text/number_text.h"

#include <QList>
#include <QObject>
#include <QPoint>
#include <QTimer>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

class QAction;
class QMouseEvent;

namespace marsview {

class Compass;
class ContourLabelsView;
class Crosshair;
class FocusFrame;
class ForceMeter;
class GestureHint;
class HandPointer;
class Legend;
class MapLabels;
class Minimap;
class OverlayLayout;
class PlaceMark;
class ScaleBarView;
class TerrainView;

/// Creates the overlays of a view, updates them when the view changes, and passes their requests to
/// it. A child of the view.
class MapOverlays final : public QObject {
    Q_OBJECT

public:
    explicit MapOverlays(TerrainView& view);

    Minimap* minimap() const noexcept { return minimap_; }
    Compass* compass() const noexcept { return compass_; }
    ScaleBarView* scaleBar() const noexcept { return scale_bar_; }
    Legend* legend() const noexcept { return legend_; }
    ForceMeter* forceMeter() const noexcept { return force_meter_; }
    Crosshair* crosshair() const noexcept { return crosshair_; }
    HandPointer* handPointer() const noexcept { return hand_pointer_; }
    FocusFrame* focusFrame() const noexcept { return focus_frame_; }

    GestureHint* hint() const noexcept { return hint_; }
    MapLabels* labels() const noexcept { return labels_; }
    ContourLabelsView* contourLabels() const noexcept { return contour_labels_; }
    /// The overlays in the corners, on translucent plates: text on the map keeps clear of them.
    QList<QWidget*> plates() const;

    /// Shows the gestures to a newcomer, from the first map on, until they are dismissed.
    void offerHint();
    bool isHintOffered() const noexcept { return is_hint_offered_; }
    /// Offered, and not in the way of a tool that draws.
    bool isHintWanted() const;
    void dismissHint();

    /// Puts a pin at a place of the topmost layer, in place of the one before. It stays until it is
    /// cleared, the map is clicked, or another map is topmost. On the globe the pin is at `place`,
    /// which may be beyond that layer and its projection.
    void markPlace(const std::optional<GridPoint>& grid,
                   const std::optional<GeographicPoint>& place = {});
    bool isPlaceMarked() const noexcept { return marked_.has_value(); }
    /// On its body; empty if no place is marked, or one without a known body.
    std::optional<GeographicPoint> markedPlace() const;
    void clearMark();
    /// What a press and a release of the mouse on the map mean for the mark.
    void clearMarkOnClick(const QMouseEvent& event);
    PlaceMark* placeMark() const noexcept { return place_mark_; }

    /// Names of layers, and which one is active. After the view shows them.
    void setSession(const Session& session);
    const Session& session() const noexcept { return session_; }
    void setHeightUnit(HeightUnit unit);
    HeightUnit heightUnit() const noexcept { return height_unit_; }

    /// So much of the view's upper edge is covered by something else.
    void setCovered(int height);
    int coveredHeight() const noexcept { return covered_height_; }

    /// Checkable actions that show and hide optional overlays; each has an
    /// object name to be remembered by.
    const QList<QAction*>& visibilityActions() const noexcept { return actions_; }
    /// The same for what lies on the terrain: names and graticule.
    const QList<QAction*>& terrainActions() const noexcept { return terrain_actions_; }

Q_SIGNALS:
    /// By the user.
    void hintDismissed();
    /// markedPlace() may have changed.
    void markChanged();
    /// The session, the unit of elevations, what is covered, or whether the hint is offered.
    void settingsChanged();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void findSeenLayers();
    std::size_t explainedLayer() const;
    void makeAction(const QString& text, const QString& name, const QList<QWidget*>& parts);
    void showMap();
    void showSight();
    void showLegend();
    void showTouch();
    void showHand();
    void placeCrosshair();
    void showMark();

    TerrainView& view_;
    ContourLabelsView* contour_labels_ = nullptr; // below all others
    MapLabels* labels_ = nullptr;                 // below those that follow
    Minimap* minimap_ = nullptr;
    Compass* compass_ = nullptr;
    Crosshair* crosshair_ = nullptr; // below those that follow
    PlaceMark* place_mark_ = nullptr;
    ScaleBarView* scale_bar_ = nullptr;
    Legend* legend_ = nullptr;
    ForceMeter* force_meter_ = nullptr;
    HandPointer* hand_pointer_ = nullptr; // over all of them
    GestureHint* hint_ = nullptr;
    FocusFrame* focus_frame_ = nullptr;
    OverlayLayout* layout_ = nullptr;
    bool is_hint_offered_ = false;
    Session session_;
    HeightUnit height_unit_ = HeightUnit::Meters;
    std::vector<bool> seen_; // which of the view's layers, top first; empty: not known yet
    QTimer probe_timer_;
    struct MarkedPlace {
        std::weak_ptr<const Map> map;
        std::optional<GridPoint> grid; // of it
        std::optional<GeographicPoint> place;
    };
    std::optional<MarkedPlace> marked_;
    QPoint pressed_at_; // by the left button
    int covered_height_ = 0;
    QList<QAction*> actions_;
    QList<QAction*> terrain_actions_;
};

} // namespace marsview
