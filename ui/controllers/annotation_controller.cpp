#include "ui/controllers/annotation_controller.h"

#include <algorithm>
#include <unordered_set>

namespace marsview {
namespace {

AnnotationItem itemOf(const Annotation& annotation)
{
    AnnotationItem item;
    item.shape = annotation.shape;
    item.name = QString::fromStdString(annotation.name);
    item.note = QString::fromStdString(annotation.note);
    item.color = annotation.color;
    item.symbol = annotation.symbol;
    item.body = annotation.body;
    item.vertices = annotation.vertices;
    item.is_finished = true;
    item.time = annotation.time;
    return item;
}

} // namespace

Annotation annotationOf(const AnnotationItem& item)
{
    return {.shape = item.shape,
            .name = item.name.toStdString(),
            .note = item.note.toStdString(),
            .color = item.color,
            .symbol = item.symbol,
            .body = item.body,
            .vertices = item.vertices,
            .time = item.time};
}

AnnotationController::AnnotationController(TerrainView& view,
                                           QUndoStack& undo_stack,
                                           QObject* parent)
    : DrawingController(view, undo_stack, Tool::Annotate, LineSet::Annotations, parent)
{}

void AnnotationController::begin(FeatureShape shape)
{
    finishCurrent();
    shape_ = shape;
    view().setTool(Tool::Annotate);
    Q_EMIT shapeChanged(shape);
}

AnnotationItem AnnotationController::newItem(std::uint32_t id) const
{
    AnnotationItem item;
    item.shape = shape_;
    item.body = bodyShown();
    switch (shape_) {
    case FeatureShape::Point:
        item.name = tr("Point %1").arg(id);
        break;
    case FeatureShape::Line:
        item.name = tr("Line %1").arg(id);
        break;
    case FeatureShape::Polygon:
        item.name = tr("Polygon %1").arg(id);
        break;
    }
    return item;
}

const DrawnBody& AnnotationController::bodyShown() const
{
    const auto& map = geometry().map();
    if (map_shown_.lock() != map || !map) {
        map_shown_ = map;
        body_shown_ = map ? drawnBody(map->georeference(), map->info().body) : DrawnBody();
    }
    return body_shown_;
}

bool AnnotationController::isShown(const AnnotationItem& item) const
{
    if (geometry().isEmpty() || !isSameBody(item.body, bodyShown())) {
        return false;
    }
    const Layer* layer = layerOf(item);
    return item.body.ellipsoid || (layer != nullptr && layer->is_visible);
}

// Points are their own handles; corners of lines are shown while they are edited.
bool AnnotationController::hasHandles(const AnnotationItem& item) const
{
    return item.isSingle() || item.id == state().current;
}

void AnnotationController::setSymbols(const std::vector<std::uint32_t>& ids, MarkSymbol symbol)
{
    editAll(ids, tr("Change Symbol"), [symbol](AnnotationItem& item) {
        if (item.shape == FeatureShape::Point) {
            item.symbol = symbol;
        }
    });
}

std::vector<Annotation> AnnotationController::annotations() const
{
    std::vector<Annotation> all;
    for (const AnnotationItem& item : state().items) {
        if (item.isComplete()) {
            all.push_back(annotationOf(item));
        }
    }
    return all;
}

std::vector<Annotation>
AnnotationController::annotations(const std::vector<std::uint32_t>& ids) const
{
    const std::unordered_set<std::uint32_t> wanted(ids.begin(), ids.end());
    std::vector<Annotation> some;
    for (const AnnotationItem& item : state().items) {
        if (item.isComplete() && wanted.contains(item.id)) {
            some.push_back(annotationOf(item));
        }
    }
    return some;
}

void AnnotationController::open(const std::vector<ProjectAnnotation>& saved,
                                const std::vector<LayerId>& layers)
{
    std::vector<AnnotationItem> items;
    for (const ProjectAnnotation& drawn : saved) {
        AnnotationItem item = marsview::itemOf(drawn.annotation);
        item.layer =
            drawn.layer && *drawn.layer < layers.size() ? layers[*drawn.layer] : LayerId::None;
        items.push_back(std::move(item));
    }
    replaceAll(std::move(items));
}

void AnnotationController::add(const std::vector<Annotation>& annotations, const QString& step)
{
    const std::vector<const Layer*> shown = shownLayers(session());
    AnnotationState after = state();
    for (const Annotation& annotation : annotations) {
        AnnotationItem item = marsview::itemOf(annotation);
        item.id = after.next_id++;
        item.layer = shown.empty() ? LayerId::None : shown.front()->id;
        after.items.push_back(std::move(item));
    }
    push(std::move(after), step);
}

void AnnotationController::setSession(const Session& session)
{
    const auto stateOf = [](const Session& of) {
        std::vector<std::pair<LayerId, bool>> layers;
        for (const Layer& layer : of.layers) {
            layers.emplace_back(layer.id, layer.is_visible);
        }
        return layers;
    };
    const bool is_same = stateOf(session) == stateOf(this->session());
    noteSession(session);
    if (!is_same) {
        Q_EMIT changed(); // what is shown
    }
}

std::optional<QPointF> AnnotationController::labelPlace(const AnnotationItem& item) const
{
    if (!isShown(item) || item.vertices.empty()) {
        return std::nullopt;
    }
    // In the middle of a line or border, where it does not hide an end.
    const std::size_t index = item.isSingle() ? 0 : item.vertices.size() / 2;
    const auto point = geometry().scenePoint(item.vertices[index]);
    const auto place = point ? scene().positionOf(*point) : std::nullopt;
    return place && sightRect().contains(*place) && !geometry().isHidden(*point) ? place
                                                                                 : std::nullopt;
}

} // namespace marsview
