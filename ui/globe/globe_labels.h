// Names of places and the graticule on the globe.
#pragma once

#include "core/geo/coordinate_format.h"
#include "core/graticule/body_graticule.h"
#include "core/session/name_labels.h"
#include "ui/canvas/drawing_pace.h"
#include "ui/widgets/labels_overlay.h"

#include <QRect>
#include <QRectF>
#include <QSize>

#include <memory>
#include <vector>

namespace marsview {

class GlobeView;

/// No label lies over another, over an overlay or the stylus, or names what the terrain or the
/// horizon hides. The lines of the graticule are drawn by the globe.
class GlobeLabels final : public LabelsOverlay {
    Q_OBJECT

public:
    explicit GlobeLabels(GlobeView& globe);

    /// Null: none.
    void setNames(std::shared_ptr<const Gazetteer> names);
    void setNamesShown(bool is_shown);
    void setGraticuleShown(bool is_shown);
    void setCoordinateFormat(const CoordinateFormat& format);
    /// What labels keep clear of, next to overlays: boxes in points.
    void setTaken(std::vector<QRectF> boxes);

    /// The labels of a picture of `size` pixels that `camera` has of what the globe shows, as large
    /// as in the window where the picture is as high. They keep clear of `obstacles`, in pixels.
    std::vector<PicturePart>
    partsFor(const BodyCamera& camera, const QSize& size, const std::vector<QRect>& obstacles);

    using Label = PlacedName;
    const std::vector<Label>& labels() const noexcept { return labels_; }
    const std::vector<Label>& graticuleLabels() const noexcept { return values_; }

protected:
    void showSight() override;
    void paintEvent(QPaintEvent* event) override;

private:
    void showScene();
    void drawGraticule();
    // What labels are placed in.
    struct Sight {
        BodyCamera camera;
        Viewport viewport;
        double scale = 1.0; // pixels per point
    };
    Sight sight() const;
    BodyGraticule graticuleIn(const Sight& sight) const;
    std::vector<Label> valuesOf(const BodyGraticule& graticule,
                                const Sight& sight,
                                std::vector<LabelBox>& taken) const;
    std::vector<Label>
    namesOf(const Sight& sight, const std::vector<LabelBox>& taken, NameLabels& names) const;
    void paintLabels(const std::vector<Label>& labels, const QRectF& cursor, QPainter& painter);
    QRectF aroundStylus() const;

    GlobeView& globe_;
    std::shared_ptr<const Gazetteer> gazetteer_;
    std::unique_ptr<NameLabels> names_;          // on the terrain that is shown
    std::vector<std::weak_ptr<const Map>> maps_; // that it was made for
    bool are_names_shown_ = true;
    std::vector<QRectF> taken_;
    bool is_graticule_shown_ = false;
    CoordinateFormat format_;
    BodyGraticule graticule_;
    DrawingPace pace_;          // of its lines
    std::vector<Label> labels_; // names
    std::vector<Label> values_; // of the graticule
};

} // namespace marsview
