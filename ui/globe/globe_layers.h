// The layers of a globe: those to show, and where they lie on their body.
#pragma once

#include "core/base/job_monitor.h"
#include "core/session/body_terrain.h"
#include "ui/canvas/shown_layer.h"
#include "ui/controllers/detached_jobs.h"
#include "ui/controllers/unplaced_layer.h"

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// Places layers on a worker thread, one after the other, on the ellipsoid of the lowest one. A
/// layer is shown as soon as it is placed. Edges that are to be blended are blended there next,
/// from the lowest layer up; until all of them are, the picture stays as it is. GUI thread.
class GlobeLayers final : public QObject {
    Q_OBJECT

public:
    explicit GlobeLayers(QObject* parent = nullptr);
    ~GlobeLayers() override;

    /// The layers to show, top first, all of one body; none for an empty globe.
    void set(const std::vector<ShownLayer>& top_first);
    bool isWanted(const std::shared_ptr<const Map>& map) const;
    /// Those that are placed, and their terrain.
    const std::vector<ShownLayer>& shown() const noexcept { return shown_; }
    const BodyScene& scene() const noexcept { return scene_; }
    /// Or blending.
    bool isPlacing() const noexcept { return placing_ != nullptr; }
    /// Of those that were tried.
    std::vector<UnplacedLayer> unplaced() const;

Q_SIGNALS:
    /// The look of a layer.
    void lookChanged();
    void placingStarted();
    void blendingStarted();
    /// Why the edges of a layer are not blended.
    void blendingFailed(const QString& problem);
    /// shown(), by another list or when a layer was placed. On another body, or without layers,
    /// nothing stays of what was shown.
    void shownChanged(bool is_other_body);
    /// Nothing is left to be placed or blended.
    void placingFinished();

private:
    // A map on its body, or why it has no place there.
    struct Placed {
        std::shared_ptr<const Map> map;
        std::shared_ptr<const BodyGrid> grid;
        QString problem;
    };

    // A layer with blended edges. It depends on the layers below it as they are shown.
    struct Blended {
        BodyTerrain terrain;
        std::size_t cells = 0;
        std::vector<BodyTerrain> below;
    };
    // Those that are placed, the lowest first, with the edges that are blended so far, and the
    // first one whose edges are still to be blended.
    struct Pile {
        std::vector<BodyTerrain> maps;
        std::optional<Blended> next{};
    };

    std::optional<Ellipsoid> ellipsoid() const;
    Pile pile() const;
    void blendNext();
    void showPile(const Pile& pile, bool is_other_body);
    // What is shown stays wanted, and a part of it is being placed on another ellipsoid. Until all
    // of it is placed, the picture stays as it is.
    bool isReplacing() const;
    const Placed* placedOf(const ShownLayer& layer) const;
    void cancel();
    void placeNext();
    void showPlaced(bool is_other_body);

    std::vector<ShownLayer> wanted_; // top first
    std::vector<Placed> placed_;
    std::vector<Blended> blended_;        // also where that failed: as they are
    std::vector<ShownLayer> shown_;       // of those that are wanted
    BodyScene scene_;                     // of these
    std::shared_ptr<JobMonitor> placing_; // or blending
    DetachedJobs jobs_;
};

} // namespace marsview
