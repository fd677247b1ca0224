// Annotating the map: the points, lines and polygons, and the tool that draws them.
#pragma once

#include "core/annotations/annotation.h"
#include "core/session/project.h"
#include "ui/drawing/drawing_controller.h"

#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// An annotation as the user drew it.
struct AnnotationItem : DrawnItem {
    FeatureShape shape = FeatureShape::Point;
    MarkSymbol symbol = MarkSymbol::Circle; // of a point
    DrawnBody body;

    bool operator==(const AnnotationItem&) const = default;
    bool isClosed() const noexcept { return shape == FeatureShape::Polygon; }
    bool isLine() const noexcept { return shape == FeatureShape::Line; }
    /// One point is enough.
    bool isSingle() const noexcept { return shape == FeatureShape::Point; }
    bool isComplete() const { return vertices.size() >= verticesNeeded(shape); }
};

/// As files have it. Any thread.
Annotation annotationOf(const AnnotationItem& item);

using AnnotationState = DrawnState<AnnotationItem>;

/// Lives in the GUI thread.
class AnnotationController final : public DrawingController<AnnotationItem> {
    Q_OBJECT

public:
    /// View and undo stack outlive it.
    AnnotationController(TerrainView& view, QUndoStack& undo_stack, QObject* parent = nullptr);

    /// What the next annotation will be; chooses the tool.
    void begin(FeatureShape shape);
    FeatureShape shape() const noexcept { return shape_; }
    /// Of points; other shapes keep theirs.
    void setSymbols(const std::vector<std::uint32_t>& ids, MarkSymbol symbol);

    /// Those that have all the points they need.
    std::vector<Annotation> annotations() const;
    /// The same of single items.
    std::vector<Annotation> annotations(const std::vector<std::uint32_t>& ids) const;
    /// Replaces everything by the annotations of a project, whose layers are those of `layers`. Not
    /// a step of undo.
    void open(const std::vector<ProjectAnnotation>& saved, const std::vector<LayerId>& layers);
    /// Adds annotations of a file in one step of undo with that text. Without a body they are on
    /// the topmost layer.
    void add(const std::vector<Annotation>& annotations, const QString& step);

    void setSession(const Session& session);

    /// Whether its body is that of the picture.
    bool isShown(const AnnotationItem& item) const override;
    /// Where the label of an item belongs, in the view; empty if nowhere.
    std::optional<QPointF> labelPlace(const AnnotationItem& item) const;
    using DrawingController::colorOf;

Q_SIGNALS:
    void shapeChanged(FeatureShape shape);

private:
    AnnotationItem newItem(std::uint32_t id) const override;
    bool hasHandles(const AnnotationItem& item) const override;
    const DrawnBody& bodyShown() const;

    mutable std::weak_ptr<const Map> map_shown_; // that body_shown_ is of
    mutable DrawnBody body_shown_;
    FeatureShape shape_ = FeatureShape::Point;
};

} // namespace marsview
