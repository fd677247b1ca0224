// Names of places and the graticule on the map.
#pragma once

#include "core/geo/coordinate_format.h"
#include "core/graticule/flat_graticule.h"
#include "core/session/name_labels.h"
#include "ui/canvas/drawing_pace.h"
#include "ui/widgets/labels_overlay.h"
#include "ui/widgets/picture_part.h"

#include <memory>
#include <optional>
#include <vector>

namespace marsview {

class DrawnMarks;
class TerrainView;

/// Labels are white with a dark rim, so that they can be read over any color; none lies over
/// another, over another overlay, or names what the terrain hides. The lines of the graticule are
/// drawn by the view.
class MapLabels final : public LabelsOverlay {
    Q_OBJECT

public:
    explicit MapLabels(TerrainView& view);

    /// Null: none.
    void setNames(std::shared_ptr<const Gazetteer> names);
    const std::shared_ptr<const Gazetteer>& names() const noexcept { return gazetteer_; }
    void setNamesShown(bool is_shown);
    void setGraticuleShown(bool is_shown);
    void setCoordinateFormat(const CoordinateFormat& format);
    const CoordinateFormat& coordinateFormat() const noexcept { return format_; }
    /// Marks whose labels no name covers, or is covered by; they outlive this.
    void keepClearOf(const DrawnMarks& marks);
    /// Where the cursor of a touch is, in points; nothing while it is not seen. Names that would
    /// hide it are left out.
    void setCursorPlace(const std::optional<QPointF>& place);

    struct Label {
        QString text;
        QRectF box; // in points of the screen
    };
    /// As they are painted now.
    const std::vector<Label>& nameLabels() const noexcept { return names_shown_; }
    const std::vector<Label>& graticuleLabels() const noexcept { return values_shown_; }

    /// The labels of a picture of `size` pixels that `camera` has of what the view shows, as large
    /// as in the view where the picture is as high. They keep clear of `obstacles`, in pixels.
    std::vector<PicturePart>
    partsFor(const OrbitCamera& camera, const QSize& size, const std::vector<QRect>& obstacles);

Q_SIGNALS:
    /// Others are to be shown.
    void namesChanged();
    void formatChanged();

protected:
    void showSight() override;
    void paintEvent(QPaintEvent* event) override;

private:
    struct Mark {
        Label label;
        bool is_name = false; // or a value of the graticule
        LabelFont size = LabelFont::Small;
        std::optional<QPointF> point; // next to the label
    };
    // Of a picture of the view.
    struct Sight {
        OrbitCamera camera;
        Viewport viewport;
        double scale = 1.0; // pixels per point
    };

    void showScene();
    std::vector<QRectF> markedBoxes() const;
    bool isOnCursor(const Mark& mark) const;
    void drawGraticule();
    std::vector<Mark> marksOf(const Sight& sight, NameLabels* names, std::vector<LabelBox> taken);
    void placeValues(const Sight& sight, std::vector<LabelBox>& taken, std::vector<Mark>& marks);
    void placeNames(const Sight& sight,
                    NameLabels& names,
                    const std::vector<LabelBox>& taken,
                    std::vector<Mark>& marks);

    TerrainView& view_;
    std::shared_ptr<const Gazetteer> gazetteer_;
    std::unique_ptr<NameLabels> names_;          // on the terrain that is shown
    std::vector<std::weak_ptr<const Map>> maps_; // that it was made for
    CoordinateFormat format_;
    std::vector<const DrawnMarks*> marked_;
    std::vector<QRectF> marked_boxes_; // of the labels of these, as of the last showSight()
    std::optional<QPointF> cursor_;
    bool are_names_shown_ = true;
    bool is_graticule_shown_ = false;
    Graticule graticule_;
    DrawingPace pace_; // of its lines
    std::vector<Mark> marks_;
    std::vector<Label> names_shown_;
    std::vector<Label> values_shown_;
};

} // namespace marsview
