// The tool that draws items of one kind on the map, and their undoable state.
#pragma once

#include "ui/canvas/place_tool.h"
#include "ui/canvas/terrain_view.h"
#include "ui/drawing/draped_geometry.h"
#include "ui/drawing/drawing_base.h"
#include "ui/drawing/drawn_leg.h"
#include "ui/drawing/flat_scene.h"
#include "ui/drawing/item_handles.h"
#include "ui/widgets/posted_call.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <QUndoCommand>
#include <QUndoStack>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <unordered_set>
#include <utility>
#include <vector>

namespace marsview {

/// `Item` is a DrawnItem with isLine(), isClosed(), isSingle() and isComplete(): it is drawn as a
/// line, its line is closed, one point finishes it, it has all the points it needs.
template <typename Item>
class DrawingController : public DrawingBase, private PlaceTool {
public:
    using State = DrawnState<Item>;
    /// The vertex within some points of a position of the view.
    using Snap = std::function<std::optional<DrawnVertex>(QPointF position, double reach)>;

    /// Becomes the place tool of `view` for `tool`, and draws on it. View and undo stack outlive
    /// it.
    DrawingController(
        TerrainView& view, QUndoStack& undo_stack, Tool tool, LineSet lines, QObject* parent)
        : DrawingBase(parent)
        , view_(view)
        , undo_stack_(undo_stack)
        , flat_(view)
        , geometry_(flat_)
        , tool_(tool)
        , line_set_(lines)
    {
        joinScene();
        connect(&view_, &TerrainView::toolChanged, this, &DrawingBase::toolChanged);
    }
    ~DrawingController() override { scene_->setPlaceTool(tool_, nullptr); }

    /// Items are drawn, and points placed, on another scene from now on; null for that of the view.
    /// The scene outlives this, or is taken back before.
    void drawOn(DrawingScene* scene)
    {
        DrawingScene* next = scene != nullptr ? scene : &flat_;
        if (next == scene_) {
            return;
        }
        release(); // of a drag that is under way
        hover(std::nullopt);
        scene_->disconnect(this);
        scene_->setPlaceTool(tool_, nullptr);
        scene_->setLines({}, line_set_);
        scene_->setDots({}, line_set_);
        scene_ = next;
        geometry_.setScene(*next);
        joinScene();
        forgetPlaces();
        drawSoon();
    }

    const State& state() const noexcept { return state_; }
    const Item* current() const { return itemOf(state_.current); }
    const Item* itemOf(std::uint32_t id) const override { return state_.items.find(id); }
    const Layer* layerOf(const DrawnItem& item) const
    {
        return marsview::layerOf(session_, item.layer);
    }

    /// Of the project: a layer that is not open yet, or cannot be opened. Null if there is none.
    const MissingLayer* missingLayerOf(const DrawnItem& item) const
    {
        const auto missing =
            std::find_if(session_.missing.begin(), session_.missing.end(),
                         [&item](const MissingLayer& layer) { return layer.id == item.layer; });
        return missing != session_.missing.end() ? &*missing : nullptr;
    }

    DrawnChanges changesSince(std::shared_ptr<const void>& known) const override
    {
        DrawnChanges changes;
        const ItemList<Item> none;
        const auto* before = static_cast<const ItemList<Item>*>(known.get());
        ItemList<Item>::forEachChange(before != nullptr ? *before : none, state_.items,
                                      [&changes](const Item* was, const Item* is) {
                                          if (was == nullptr) {
                                              changes.added.push_back(is->id);
                                          } else if (is == nullptr) {
                                              changes.removed.push_back(was->id);
                                          } else {
                                              changes.changed.push_back(is->id);
                                          }
                                      });
        known = std::make_shared<const ItemList<Item>>(state_.items);
        return changes;
    }
    std::uint32_t currentId() const override { return state_.current; }
    void select(std::uint32_t id) override
    {
        State state = state_; // not a step of undo
        state.current = itemOf(id) != nullptr ? id : 0;
        if (!(state == state_)) {
            setState(std::move(state));
        }
    }
    bool selectAt(QPointF position) override
    {
        const auto handle = handleAt(position);
        const Leg* leg = handle ? nullptr : legNear(legs_, *scene_, position, kReach);
        if (handle || leg != nullptr) {
            select(handle ? handle->item : leg->item);
            return true;
        }
        return false;
    }
    void remove(std::uint32_t id) { removeItems({id}); }
    void removeItems(const std::vector<std::uint32_t>& ids) override
    {
        State state = state_;
        const std::unordered_set<std::uint32_t> meant(ids.begin(), ids.end());
        const auto is_meant = [&meant](std::uint32_t id) { return meant.contains(id); };
        std::vector<QString> names;
        for (const std::uint32_t id : ids) {
            if (const Item* item = itemOf(id)) {
                names.push_back(item->name);
            }
        }
        state.items.eraseIf([&](const Item& item) { return is_meant(item.id); });
        if (is_meant(state.current)) {
            state.current = state.items.empty() ? 0 : state.items.back().id;
        }
        if (!names.empty()) {
            //: A step of undo; %1 is a name
            push(std::move(state),
                 names.size() == 1
                     ? text(QT_TRANSLATE_NOOP("Drawing", "Remove %1")).arg(names.front())
                     //: A step of undo; %1 is a number above 1
                     : text(QT_TRANSLATE_NOOP("Drawing", "Remove %1 Items")).arg(names.size()));
        }
    }
    void rename(std::uint32_t id, const QString& name) override
    {
        if (const QString plain = name.trimmed(); !plain.isEmpty()) {
            edit(id, text(QT_TRANSLATE_NOOP("Drawing", "Rename")),
                 [&](Item& item) { item.name = plain; });
        }
    }
    void setNote(std::uint32_t id, const QString& note) override
    {
        edit(id, text(QT_TRANSLATE_NOOP("Drawing", "Edit Note")),
             [&](Item& item) { item.note = note.trimmed(); });
    }
    void setColor(std::uint32_t id, const std::optional<Rgb8>& color) { setColors({id}, color); }
    void setColors(const std::vector<std::uint32_t>& ids, const std::optional<Rgb8>& color) override
    {
        const Item* first = ids.empty() ? nullptr : itemOf(ids.front());
        if (first != nullptr) {
            editAll(ids,
                    ids.size() == 1
                        ? text(QT_TRANSLATE_NOOP("Drawing", "Color of %1")).arg(first->name)
                        //: A step of undo; %1 is a number above 1
                        : text(QT_TRANSLATE_NOOP("Drawing", "Color of %1 Items")).arg(ids.size()),
                    [&](Item& item) { item.color = color; });
        }
    }
    bool isToolChosen() const override { return view_.tool() == tool_; }
    /// Adds a point of the topmost map, as a click there does. Nothing beyond its projection.
    void addPointAt(GridPoint grid)
    {
        view_.setTool(tool_);
        geometry_.update();
        RayHit hit;
        hit.grid = grid;
        if (const auto place = placeOf(hit)) {
            addPoint(*place);
        }
    }
    /// Adds a point at a place that the scene has.
    void addPlace(const DrawingScene::Place& place)
    {
        view_.setTool(tool_);
        geometry_.update();
        if (const auto on_layer = onLayer(place)) {
            addPoint(*on_layer);
        }
    }
    /// Adds a point where the view reads one: at the crosshair, or under the stylus of a device.
    /// The same place again finishes the item.
    void addPointRead()
    {
        constexpr double kSamePlace = 3.0; // points
        if (const auto place = placeRead()) {
            addOrFinish(*place, kSamePlace);
        }
    }
    void removeLastPoint()
    {
        const Item* item = current();
        if (item != nullptr) {
            removePoint(item->id, item->vertices.size() - 1);
        }
    }
    /// Removes the item with its last point.
    void removePoint(std::uint32_t id, std::size_t index)
    {
        const Item* item = itemOf(id);
        if (item == nullptr || index >= item->vertices.size()) {
            return;
        }
        if (item->vertices.size() <= 1) {
            remove(id);
            return;
        }
        edit(id, text(QT_TRANSLATE_NOOP("Drawing", "Remove Point")), [&](Item& changed) {
            changed.vertices.erase(changed.vertices.begin() + static_cast<std::ptrdiff_t>(index));
        });
    }
    /// Without effect while the current item lacks points.
    void finish()
    {
        const std::uint32_t id = state_.current;
        if (const Item* item = current(); item == nullptr || !item->isComplete()) {
            return;
        }
        if (endCurrent()) {
            Q_EMIT placed(id);
        }
    }
    /// Moves a point to a typed place. Ignored where the item has no such point.
    void movePoint(std::uint32_t id, std::size_t index, const DrawnVertex& vertex)
    {
        if (const Item* item = itemOf(id); item != nullptr && index < item->vertices.size()) {
            edit(id, text(QT_TRANSLATE_NOOP("Drawing", "Move Point")),
                 [&](Item& changed) { changed.vertices[index] = vertex; });
        }
    }
    void show(std::uint32_t id) override
    {
        select(id);
        const Item* item = itemOf(id);
        if (item == nullptr) {
            return;
        }
        std::vector<ScenePoint> places;
        for (const DrawnVertex& vertex : item->vertices) {
            if (const auto point = geometry_.scenePoint(vertex)) {
                places.push_back(*point);
            }
        }
        if (!places.empty()) {
            scene_->flyToAll(places);
        }
    }

    std::optional<QPointF> namePlace(std::uint32_t id) const override
    {
        const Item* item = itemOf(id);
        if (item == nullptr || item->vertices.empty() || !isShown(*item)) {
            return std::nullopt;
        }
        // In the middle of a line or border, where it does not hide an end.
        const std::size_t index = item->isSingle() ? 0 : item->vertices.size() / 2;
        const auto place = geometry_.screenPoint(item->vertices[index]);
        return place && sightRect().contains(*place) ? place : std::nullopt;
    }

    const std::vector<DrawnHandle>& handles() const override
    {
        return handles_.handles(handlesOf());
    }
    /// Where they are in the scene.
    const std::vector<ScenePoint>& handlePlaces() const
    {
        handles();
        return handles_.places();
    }
    /// Draws dots on the terrain in the picture of the scene.
    void showDots(DotSet dots) { scene_->setDots(std::move(dots), line_set_); }
    std::uint64_t handlesRevision() const override
    {
        handles();
        return handles_.revision();
    }
    std::vector<QRectF> lineBoxes() const override
    {
        return boxesAround(legs_, *scene_, [this](const Leg& leg) {
            const Item* item = itemOf(leg.item); // without its line to the pointer
            return item != nullptr && (item->is_finished || leg.index + 1 < item->vertices.size());
        });
    }
    /// Those that are more than a point.
    const std::vector<std::uint32_t>& lineItems() const { return handles_.lineItems(handlesOf()); }
    /// Points that are placed or dragged near a vertex that `snap` finds take its position.
    void addSnap(Snap snap) { snaps_.push_back(std::move(snap)); }
    /// The vertex of an item that is shown within `reach` points of a position of the view. Not of
    /// the item that is being drawn or has a point dragged.
    std::optional<DrawnVertex> vertexNear(QPointF position, double reach) const
    {
        std::optional<DrawnVertex> nearest;
        const auto look = [&](const std::optional<QPointF>& place, const DrawnVertex& vertex) {
            if (place && distanceBetween(*place, position) <= reach) {
                reach = distanceBetween(*place, position);
                nearest = vertex;
            }
        };
        const auto is_changing = [this](const Item& item) {
            return (grabbed_ && grabbed_->item == item.id) ||
                   (item.id == state_.current && !item.is_finished);
        };
        if (const auto near = dotNear(position, reach)) {
            if (const Item& item = *itemOf(near->dot.id); !is_changing(item)) {
                reach = near->away;
                nearest = item.vertices.front();
            }
        }
        for (const std::uint32_t id : lineItems()) {
            const Item& item = *itemOf(id);
            for (std::size_t i = 0; !is_changing(item) && isShown(item) && i < item.vertices.size();
                 ++i) {
                look(geometry_.screenPoint(item.vertices[i]), item.vertices[i]);
            }
        }
        return nearest;
    }

protected:
    /// A place on the terrain as the pointer finds it.
    struct Place {
        DrawnVertex vertex;
        LayerId layer = LayerId::None;
    };
    using Leg = DrawnLeg;
    static constexpr double kReach = 9.0; // points from a vertex or line, in which it is grabbed

    /// An item without points and id, for a point on a layer.
    virtual Item newItem(std::uint32_t id) const = 0;
    /// Whether it is in the picture.
    virtual bool isShown(const Item& item) const = 0;
    virtual bool hasHandles(const Item& /*item*/) const { return true; }
    /// The corners of the line that is drawn for an item; `next` is where the pointer would place
    /// the next one.
    virtual std::vector<GroundPosition> cornersOf(const Item& item,
                                                  const std::optional<GroundPosition>& next) const
    {
        std::vector<GroundPosition> corners;
        for (const DrawnVertex& vertex : item.vertices) {
            if (const auto position = geometry_.positionOf(vertex)) {
                corners.push_back(*position);
            }
        }
        if (next) {
            corners.push_back(*next);
        }
        return corners;
    }
    /// Lines in addition to those between the corners.
    virtual void addLines(std::vector<DrapedLine>& /*lines*/) const {}
    virtual void stateChanged(const State& /*before*/) {}
    virtual void hovered(const std::optional<QPointF>& /*position*/) {}

    void setState(State state)
    {
        const State before = std::exchange(state_, std::move(state));
        ++content_;
        stateChanged(before);
        drawLines();
        Q_EMIT changed();
    }
    void push(State after, const QString& step)
    {
        if (!(after == state_)) {
            undo_stack_.push(new Command(*this, state_, std::move(after), step));
        }
    }
    template <typename Change>
    void edit(std::uint32_t id, const QString& step, Change change)
    {
        editAll({id}, step, change);
    }
    template <typename Change>
    void editAll(const std::vector<std::uint32_t>& ids, const QString& step, Change change)
    {
        State state = state_;
        for (const std::uint32_t id : ids) {
            if (Item* item = editable(state, id)) {
                change(*item);
            }
        }
        push(std::move(state), step);
    }
    static Item* editable(State& state, std::uint32_t id) { return state.items.edit(id); }
    /// Replaces everything by items that are finished. Not a step of undo.
    void replaceAll(std::vector<Item> items)
    {
        State state;
        for (Item& item : items) {
            item.id = state.next_id++;
            item.is_finished = true;
            state.items.push_back(std::move(item));
        }
        grabbed_.reset();
        handles_.forgetPlaces();
        // What is known of items that have the same numbers is not true of these.
        setState({});
        setState(std::move(state));
    }
    void noteSession(const Session& session)
    {
        session_ = session;
        forgetPlaces();
        drawSoon();
    }
    void drawSoon() { draw_soon_.request(); }
    /// Marks other than handles moved.
    void noteMoved()
    {
        ++content_;
        Q_EMIT moved();
    }
    void finishCurrent()
    {
        if (const Item* item = current(); item != nullptr && !item->is_finished) {
            endCurrent(); // something else has begun
        }
    }
    Rgb8 colorOf(const Item& item) const
    {
        return item.color.value_or(item.id == state_.current ? kCurrentDrawnColor : kDrawnColor);
    }
    static double distanceBetween(QPointF a, QPointF b)
    {
        return std::hypot(a.x() - b.x(), a.y() - b.y());
    }
    static QString text(const char* source)
    {
        return QCoreApplication::translate("Drawing", source);
    }

    const DrapedGeometry& geometry() const noexcept { return geometry_; }
    const std::vector<Leg>& legs() const noexcept { return legs_; }
    TerrainView& view() const noexcept { return view_; }
    const DrawingScene& scene() const noexcept { return *scene_; }
    QRectF sightRect() const { return QRectF(scene_->view().rect()); }
    const Session& session() const noexcept { return session_; }

private:
    void joinScene()
    {
        connect(scene_, &DrawingScene::sightChanged, this, [this] {
            is_moving_ = true;
            drawSoon();
        });
        connect(scene_, &DrawingScene::exaggerationChanged, this, &DrawingController::drawSoon);
        connect(scene_, &DrawingScene::mapsChanged, this, [this] {
            forgetPlaces();
            drawSoon();
        });
        connect(scene_, &DrawingScene::pictureCompleted, this, [this] {
            is_moving_ = false;
            if (geometry_.map() && geometry_.map()->heightfield().isTiled()) {
                forgetPlaces(); // finer ground may have come
            }
            drawSoon();
        });
        scene_->setPlaceTool(tool_, this);
    }
    // True if the current item is finished now, false if it was, or lacks points and is removed.
    bool endCurrent()
    {
        State state = state_;
        Item* item = editable(state, state.current);
        if (item == nullptr || item->is_finished) {
            return false;
        }
        if (!item->isComplete()) {
            remove(item->id);
            return false;
        }
        item->is_finished = true;
        setState(std::move(state)); // with the last point, not a step of undo of its own
        return true;
    }

    // Between two states.
    class Command final : public QUndoCommand {
    public:
        Command(DrawingController& controller, State before, State after, const QString& step)
            : QUndoCommand(step)
            , controller_(controller)
            , before_(std::move(before))
            , after_(std::move(after))
        {}
        void undo() override { controller_.setState(before_); }
        void redo() override { controller_.setState(after_); }

    private:
        DrawingController& controller_;
        State before_;
        State after_;
    };
    struct Grabbed {
        std::uint32_t item = 0;
        std::size_t index = 0;
        State before;
    };

    typename ItemHandles<Item>::Of handlesOf() const
    {
        return {
            .state = state_,
            .scene = *scene_,
            .geometry = geometry_,
            .has_handles = [this](const Item& item) { return isShown(item) && hasHandles(item); },
            .is_moving = is_moving_,
            .content = content_};
    }
    void forgetPlaces()
    {
        handles_.forgetPlaces();
        ++content_;
    }
    // Within reach of a position of the view.
    std::optional<DotIndex::Near> dotNear(QPointF position, double reach) const
    {
        return handles_.dotNear(handlesOf(), position, reach);
    }

    // Places ----------------------------------------------------------------------------------

    std::optional<Place> placeOf(const RayHit& hit) const
    {
        if (geometry_.isEmpty()) {
            return std::nullopt;
        }
        const auto vertex = vertexAt(geometry_.map()->georeference(), hit.grid);
        return vertex ? onLayer(DrawingScene::Place{*vertex, geometry_.map()}) : std::nullopt;
    }
    // Nothing while the scene shows another map than the session has.
    std::optional<Place> onLayer(const std::optional<DrawingScene::Place>& place) const
    {
        if (!place || geometry_.isEmpty() || geometry_.map() != scene_->map()) {
            return std::nullopt;
        }
        for (const Layer& layer : session_.layers) {
            if (layer.map == place->map) {
                return Place{place->vertex, layer.id};
            }
        }
        return std::nullopt;
    }
    // On the layer that is seen there, whatever layer is selected.
    std::optional<Place> placeAt(QPointF position) const
    {
        return onLayer(scene_->placeAt(position));
    }
    // The same at a vertex that is near.
    std::optional<Place> snappedAt(QPointF position) const
    {
        std::optional<Place> place = placeAt(position);
        if (place) {
            snap(*place, position);
        }
        return place;
    }
    void snap(Place& place, QPointF position) const
    {
        for (const Snap& snap : snaps_) {
            if (const auto vertex = snap(position, kReach);
                vertex && geometry_.positionOf(*vertex)) {
                place.vertex = *vertex;
                return;
            }
        }
    }
    // By crosshair, stylus or hand.
    std::optional<Place> placeRead() const { return onLayer(scene_->placeRead()); }
    // On the layer that is seen there.
    std::optional<Place> placeBelow(const RayHit& hit) const
    {
        std::optional<Place> place = placeOf(hit);
        if (const auto position = place ? geometry_.screenPoint(place->vertex) : std::nullopt) {
            const auto seen = placeAt(*position);
            place->layer = seen ? seen->layer : place->layer;
        }
        return place;
    }
    // The last point again, within `reach` points of the screen, finishes the item. Where that has
    // been done, with a click for example, no other item of the kind begins.
    void addOrFinish(const Place& place, double reach)
    {
        const Item* item = current();
        const auto here = geometry_.screenPoint(place.vertex);
        const auto last =
            item != nullptr ? geometry_.screenPoint(item->vertices.back()) : std::nullopt;
        const bool is_last = here && last && distanceBetween(*here, *last) <= reach;
        if (is_last && !item->is_finished) {
            finish();
        } else if (!is_last || !isLikeNext(*item)) {
            addPoint(place);
        }
    }
    bool isLikeNext(const Item& item) const
    {
        const Item next = newItem(state_.next_id);
        return item.isSingle() == next.isSingle() && item.isLine() == next.isLine() &&
               item.isClosed() == next.isClosed();
    }
    void addPoint(const Place& place)
    {
        State state = state_;
        Item* item = editable(state, state.current);
        if (item == nullptr || item->is_finished) {
            Item fresh = newItem(state.next_id);
            fresh.id = state.next_id++;
            fresh.layer = place.layer;
            fresh.time =
                std::chrono::floor<std::chrono::milliseconds>(std::chrono::system_clock::now());
            item = &state.items.push_back(std::move(fresh));
            state.current = item->id;
        }
        item->vertices.push_back(place.vertex);
        item->is_finished = item->isSingle();
        //: A step of undo; %1 is a name
        const QString step = text(QT_TRANSLATE_NOOP("Drawing", "Add Point to %1")).arg(item->name);
        const std::uint32_t id = item->id;
        const bool is_placed = item->is_finished;
        push(std::move(state), step);
        if (is_placed) {
            Q_EMIT placed(id);
        }
    }

    // The tool --------------------------------------------------------------------------------

    // The current item's first, otherwise the nearest one.
    std::optional<DrawnHandle> handleAt(QPointF position) const
    {
        const Item* selected = current();
        std::optional<DrawnHandle> nearest;
        double reach = kReach;
        const auto look = [&](const std::optional<QPointF>& place, std::uint32_t item,
                              std::size_t index) {
            if (place && distanceBetween(*place, position) <= reach) {
                reach = distanceBetween(*place, position);
                nearest = DrawnHandle{.place = *place, .item = item, .index = index};
            }
        };
        const auto look_at = [&](const Item& item) {
            for (std::size_t i = 0; i < item.vertices.size(); ++i) {
                look(geometry_.screenPoint(item.vertices[i]), item.id, i);
            }
        };
        if (selected != nullptr && isShown(*selected) && hasHandles(*selected)) {
            look_at(*selected);
        }
        // While an item is being drawn, points of others are places to snap to.
        if (nearest || (selected != nullptr && !selected->is_finished)) {
            return nearest;
        }
        if (const auto near = dotNear(position, reach)) {
            reach = near->away;
            nearest = DrawnHandle{.place = near->place, .item = near->dot.id, .index = 0};
        }
        for (const std::uint32_t id : lineItems()) {
            if (const Item& item = *itemOf(id); isShown(item) && hasHandles(item)) {
                look_at(item);
            }
        }
        return nearest;
    }
    // With the tool, vertices of other items are places to snap to. A point on a point would be of
    // no use, and the symbol of an annotation is there to be clicked: these are picked up instead.
    bool isGrabbedWithTool(const DrawnHandle& handle) const
    {
        return handle.item == state_.current ||
               (itemOf(handle.item)->isSingle() &&
                (tool_ == Tool::Annotate || newItem(state_.next_id).isSingle()));
    }
    bool grabHandle(QPointF position)
    {
        if (const auto handle = handleAt(position); handle && isGrabbedWithTool(*handle)) {
            select(handle->item);
            grabbed_ = Grabbed{handle->item, handle->index, state_};
            return true;
        }
        return false;
    }
    bool grab(QPointF position) override
    {
        if (grabHandle(position)) {
            return true;
        }
        // Between two points of the current item, once it is finished, a drag inserts one.
        const Item* item = current();
        if (item == nullptr || !item->is_finished || (!item->isLine() && !item->isClosed())) {
            return false;
        }
        for (const Leg& leg : legs_) {
            if (leg.item != item->id) {
                continue;
            }
            for (const ScenePoint& point : leg.run.points) {
                const auto place = scene_->positionOf(point);
                const auto there = place && distanceBetween(*place, position) <= kReach
                                       ? placeAt(position)
                                       : std::nullopt;
                if (there) {
                    grabbed_ = Grabbed{item->id, leg.index + 1, state_};
                    State state = state_;
                    auto& vertices = editable(state, item->id)->vertices;
                    vertices.insert(vertices.begin() + static_cast<std::ptrdiff_t>(leg.index + 1),
                                    there->vertex);
                    setState(std::move(state));
                    return true;
                }
            }
        }
        return false;
    }
    void drag(QPointF position) override
    {
        pointer_ = position;
        dragTo(snappedAt(position));
    }
    void dragTo(const std::optional<Place>& place)
    {
        State state = state_;
        Item* item = grabbed_ ? editable(state, grabbed_->item) : nullptr;
        if (place && item != nullptr && grabbed_->index < item->vertices.size()) {
            item->vertices[grabbed_->index] = place->vertex;
            setState(std::move(state));
        }
    }
    void release() override
    {
        if (!grabbed_) {
            return;
        }
        const Grabbed grabbed = *std::exchange(grabbed_, std::nullopt);
        State after = std::exchange(state_, grabbed.before);
        const Item* was = itemOf(grabbed.item);
        if (after == state_) {
            // Back at its first point, a border is closed.
            if (was != nullptr && !was->is_finished && was->isClosed() && grabbed.index == 0 &&
                was->isComplete()) {
                finish();
            }
            return;
        }
        const bool is_inserted =
            was != nullptr && editable(after, grabbed.item) != nullptr &&
            editable(after, grabbed.item)->vertices.size() != was->vertices.size();
        push(std::move(after), is_inserted ? text(QT_TRANSLATE_NOOP("Drawing", "Insert Point"))
                                           : text(QT_TRANSLATE_NOOP("Drawing", "Move Point")));
    }
    void click(QPointF position) override
    {
        if (const auto place = snappedAt(position)) {
            addPoint(*place);
        }
    }
    void doubleClick(QPointF /*position*/) override { finish(); }
    // As a click or a drag of the mouse. A hand in the air is less steady than one on a table:
    // every press within reach of the last point finishes the item, and one at the first point of
    // a border closes it.
    void pressStylus(const RayHit& hit) override
    {
        geometry_.update();
        std::optional<Place> place = placeBelow(hit);
        const auto position = place ? geometry_.screenPoint(place->vertex) : std::nullopt;
        if (!position || grabbed_) {
            return;
        }
        const Item* item = current();
        const bool is_open = item != nullptr && !item->is_finished;
        if (!is_open && grabHandle(*position)) {
            is_stylus_holding_ = true;
            return;
        }
        const auto first =
            is_open ? geometry_.screenPoint(item->vertices.front()) : std::optional<QPointF>();
        if (first && item->isClosed() && item->isComplete() &&
            distanceBetween(*first, *position) <= kReach) {
            finish();
            return;
        }
        snap(*place, *position);
        addOrFinish(*place, kReach);
    }
    void moveStylus(const RayHit& hit) override
    {
        if (is_stylus_holding_) {
            std::optional<Place> place = placeBelow(hit);
            const auto position = place ? geometry_.screenPoint(place->vertex) : std::nullopt;
            if (position) {
                snap(*place, *position);
            }
            dragTo(place);
        } else if (const Item* item = current(); item != nullptr && !item->is_finished) {
            drawSoon(); // the line to the stylus
        }
    }
    void releaseStylus() override
    {
        if (std::exchange(is_stylus_holding_, false)) {
            release();
        }
    }
    void hover(std::optional<QPointF> position) override
    {
        pointer_ = position;
        const Item* item = current();
        if (item != nullptr && !item->is_finished) {
            drawSoon(); // the line to the pointer
            return;
        }
        hovered(position);
    }
    bool key(const QKeyEvent& event) override
    {
        const Item* item = current();
        const bool is_open = item != nullptr && !item->is_finished;
        // The point under the pointer, otherwise the last one or the whole item.
        const auto pointed = pointer_ ? handleAt(*pointer_) : std::nullopt;
        const bool is_point = pointed && item != nullptr && pointed->item == item->id;
        switch (event.key()) {
        case Qt::Key_Return:
        case Qt::Key_Enter:
            addPointRead();
            return true;
        case Qt::Key_Backspace:
            if (is_point) {
                removePoint(item->id, pointed->index);
            } else {
                removeLastPoint();
            }
            return true;
        case Qt::Key_Delete:
            if (item == nullptr) {
                return false;
            }
            if (is_point && item->vertices.size() > 1) {
                removePoint(item->id, pointed->index);
            } else {
                remove(item->id);
            }
            return true;
        case Qt::Key_Escape:
            if (is_open) {
                remove(item->id);
                return true;
            }
            if (item != nullptr) {
                select(0);
                return true;
            }
            return false;
        default:
            return false;
        }
    }

    // Where the next point of an open item would be; nothing if none is drawn.
    std::optional<Place> placePointed() const
    {
        const Item* item = current();
        if (view_.tool() != tool_ || item == nullptr || item->is_finished || grabbed_) {
            return std::nullopt;
        }
        return scene_->isReadByStylus() ? placeRead()
               : pointer_               ? snappedAt(*pointer_)
                                        : std::nullopt;
    }

    // The picture -----------------------------------------------------------------------------

    void drawLines()
    {
        draw_soon_.cancel();
        const auto map = geometry_.map();
        geometry_.update();
        if (map != geometry_.map()) {
            forgetPlaces();
        }
        legs_.clear();
        if (geometry_.isEmpty()) {
            scene_->setLines({}, line_set_);
            Q_EMIT moved();
            return;
        }
        const Ground& ground = geometry_.ground();
        const auto pointed = grabbed_ ? std::nullopt : placePointed();
        for (const std::uint32_t id : lineItems()) { // the rest has no lines
            const Item& item = *itemOf(id);
            if (!isShown(item)) {
                continue;
            }
            const bool is_open = item.id == state_.current && !item.is_finished;
            const std::vector<GroundPosition> corners = cornersOf(
                item, is_open && pointed ? geometry_.positionOf(pointed->vertex) : std::nullopt);
            const bool is_closed = !item.isLine() && corners.size() > 2;
            double begin_m = 0.0;
            for (std::size_t i = 0; i + (is_closed ? 0 : 1) < corners.size(); ++i) {
                const GroundLine line = ground.line(corners[i], corners[(i + 1) % corners.size()]);
                for (DrapedRun& run : geometry_.draped(line)) {
                    legs_.push_back(
                        {.item = item.id, .index = i, .begin_m = begin_m, .run = std::move(run)});
                }
                begin_m += line.lengthM();
            }
        }
        std::vector<DrapedLine> lines;
        for (const bool is_current : {false, true}) { // the current one over the others
            for (const Leg& leg : legs_) {
                if ((leg.item == state_.current) == is_current) {
                    const Item* item = itemOf(leg.item);
                    lines.push_back({.points = leg.run.points,
                                     .color = item != nullptr ? colorOf(*item) : kDrawnColor,
                                     .width_points = is_current ? 2.5 : 1.8});
                }
            }
        }
        addLines(lines);
        scene_->setLines(std::move(lines), line_set_);
        Q_EMIT moved();
        if (map != geometry_.map() && !state_.items.empty()) {
            Q_EMIT changed(); // which items are shown
        }
    }

    TerrainView& view_; // has the chosen tool
    QUndoStack& undo_stack_;
    FlatScene flat_;
    DrawingScene* scene_ = &flat_;
    DrapedGeometry geometry_;
    Tool tool_;
    LineSet line_set_;
    State state_;
    Session session_;
    std::vector<Leg> legs_;
    std::vector<Snap> snaps_;
    std::optional<QPointF> pointer_;
    std::optional<Grabbed> grabbed_;
    bool is_stylus_holding_ = false;    // what is grabbed
    mutable ItemHandles<Item> handles_; // of the last picture
    std::uint64_t content_ = 0;         // grows when items or maps change
    bool is_moving_ = false;            // the camera has moved since the picture was complete
    PostedCall draw_soon_{[this] { drawLines(); }}; // gathers reasons to draw the lines again
};

} // namespace marsview
