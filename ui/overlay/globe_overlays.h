// The overlays on the globe, as those on the flat map.
#pragma once

#include "core/base/job_monitor.h"
#include "core/globe/polar_plane.h"
#include "core/session/map.h"
#include "ui/controllers/detached_jobs.h"
#include "ui/overlay/minimap.h"

#include <QImage>
#include <QList>
#include <QObject>
#include <QRectF>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

class AnnotationMarks;
class Compass;
class ContourLabelsView;
class Crosshair;
class DrawnMarks;
class FocusFrame;
class ForceMeter;
class GestureHint;
class GlobeLabels;
class GlobeView;
class HandPointer;
class Legend;
class MapOverlays;
class MeasureMarks;
class OverlayLayout;
class PlaceMark;
class ScaleBarView;

/// Creates the overlays of a globe at the places that they have on the flat map, shows and hides
/// them by the same actions, and passes their requests to the globe. The overview map shows the
/// whole body, or the surroundings of a pole that the view is near to (overviewFor), or, of layers
/// that are not seen as a ball, the widest one. It does not change while it is dragged. A child of
/// the globe; `flat` outlives it.
class GlobeOverlays final : public QObject {
    Q_OBJECT

public:
    GlobeOverlays(GlobeView& globe, MapOverlays& flat);

    Minimap* minimap() const noexcept { return minimap_; }
    Compass* compass() const noexcept { return compass_; }
    ScaleBarView* scaleBar() const noexcept { return scale_bar_; }
    Legend* legend() const noexcept { return legend_; }
    ForceMeter* forceMeter() const noexcept { return force_meter_; }
    HandPointer* handPointer() const noexcept { return hand_pointer_; }
    GestureHint* hint() const noexcept { return hint_; }
    Crosshair* crosshair() const noexcept { return crosshair_; }
    GlobeLabels* labels() const noexcept { return labels_; }
    ContourLabelsView* contourLabels() const noexcept { return contour_labels_; }
    FocusFrame* focusFrame() const noexcept { return focus_frame_; }
    PlaceMark* placeMark() const noexcept { return place_mark_; }

    /// Marks on the globe, which keep clear of its overlays and of `others`. Names of places keep
    /// clear of them.
    void addMarks(MeasureMarks& measurements,
                  AnnotationMarks& annotations,
                  const QList<QWidget*>& others);

    /// Those that were added.
    std::vector<const DrawnMarks*> marks() const;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void connectParts();
    void showSettings();
    void readOverview();
    void readBodyOverview(BodyOverview overview);
    BodyOverview wantedOverview() const;
    std::vector<std::vector<float>>& heightsOf(BodyOverview overview);
    void showOverview();
    void showBodyOverview();
    MinimapDisc discOf(BodyOverview overview) const;
    std::optional<std::size_t> localLayer() const;
    void showBodySight();
    void showLocalSight(const Map& map);
    void lookAt(const ScenePoint& place);
    void showScene();
    void showSight();
    void showLegend();
    std::size_t explainedLayer() const;
    void showTouch();
    void showHand();
    void placeCrosshair();
    void showMark();

    GlobeView& globe_;
    MapOverlays& flat_;
    MeasureMarks* measure_marks_ = nullptr;
    AnnotationMarks* annotation_marks_ = nullptr;
    ContourLabelsView* contour_labels_ = nullptr; // below all others
    Minimap* minimap_ = nullptr;
    Compass* compass_ = nullptr;
    GlobeLabels* labels_ = nullptr;  // below those that follow
    Crosshair* crosshair_ = nullptr; // also
    PlaceMark* place_mark_ = nullptr;
    ScaleBarView* scale_bar_ = nullptr;
    Legend* legend_ = nullptr;
    ForceMeter* force_meter_ = nullptr;
    HandPointer* hand_pointer_ = nullptr; // over all of them
    GestureHint* hint_ = nullptr;
    FocusFrame* focus_frame_ = nullptr;
    OverlayLayout* layout_ = nullptr;
    std::shared_ptr<JobMonitor> reading_; // of the overview
    BodyOverview being_read_ = BodyOverview::Whole;
    // Elevations, a map, of each kind of overview that has been shown.
    std::array<std::vector<std::vector<float>>, 3> overviews_m_;
    BodyOverview shown_ = BodyOverview::Whole;
    QImage overview_;                // the latest; null until there is one
    std::weak_ptr<const Map> local_; // whose overview it is; empty for the body's
    DetachedJobs jobs_;
};

} // namespace marsview
