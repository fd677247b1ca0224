// Measuring on the map: the measurements, the tool that places their points, and their results.
#pragma once

#include "core/session/measurement.h"
#include "core/session/measurement_features.h"
#include "core/session/project.h"
#include "core/session/session.h"
#include "ui/canvas/place_tool.h"
#include "ui/canvas/terrain_view.h"

#include <QDateTime>
#include <QObject>
#include <QString>
#include <QThreadPool>
#include <QTimer>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

class QUndoStack;

namespace marsview {

/// A measurement as the user placed it. Its result follows from it and from the layer.
struct MeasureItem {
    std::uint32_t id = 0;
    MeasurementKind kind = MeasurementKind::Profile;
    QString name;
    LayerId layer = LayerId::None; // that it is measured on
    std::vector<MeasuredVertex> vertices;
    bool is_finished = false; // clicks begin another one
    QDateTime time;           // at which it was begun
    QString note;
    std::optional<Rgb8> color; // of its lines; empty: the usual one

    bool operator==(const MeasureItem&) const = default;
    /// Of lines that are closed: an area's border.
    bool isClosed() const noexcept { return kind == MeasurementKind::Area; }
    bool isLine() const noexcept
    {
        return kind == MeasurementKind::Distance || kind == MeasurementKind::Profile;
    }
};

/// What the user did; undo returns to earlier ones.
struct MeasureState {
    std::vector<MeasureItem> items; // in the order in which they were begun
    std::uint32_t current = 0;      // shown in detail; 0: none
    std::uint32_t next_id = 1;

    bool operator==(const MeasureState&) const = default;
};

/// The result of an item; null while it has too few points.
struct MeasureOutcome {
    std::shared_ptr<const MeasurementResult> result;
    bool is_running = false; // a result, or a more exact one, follows

    /// Null where there is none of that type.
    template <typename T>
    const T* as() const
    {
        return result && result->values ? std::get_if<T>(&*result->values) : nullptr;
    }
};

/// The least number of points that a measurement needs.
std::size_t verticesNeeded(MeasurementKind kind);

/// A point of an item on the screen.
struct MeasureHandle {
    QPointF place; // in the view
    std::uint32_t item = 0;
    std::size_t index = 0;
    bool is_hidden = false; // by terrain in front of it
};

/// Lives in the GUI thread; measures on a thread of its own.
class MeasureController final : public QObject, private PlaceTool {
    Q_OBJECT

public:
    /// Becomes the place tool of `view`, which outlives it.
    MeasureController(TerrainView& view, QUndoStack& undo_stack, QObject* parent = nullptr);
    ~MeasureController() override;

    const MeasureState& state() const noexcept { return state_; }
    const MeasureItem* current() const { return itemOf(state_.current); }
    const MeasureItem* itemOf(std::uint32_t id) const;
    const MeasureOutcome& outcome(std::uint32_t id) const;

    /// What the next measurement will be; chooses the tool.
    void begin(MeasurementKind kind);
    MeasurementKind kind() const noexcept { return kind_; }
    void select(std::uint32_t id);
    void remove(std::uint32_t id);
    void rename(std::uint32_t id, const QString& name);
    void setNote(std::uint32_t id, const QString& note);
    /// Empty for the usual color.
    void setColor(std::uint32_t id, const std::optional<Rgb8>& color);
    void removeAll();
    /// Adds a point of the topmost map, as a click there does. Nothing beyond its projection.
    void addPointAt(GridPoint grid);
    void removeLastPoint();
    void finish();
    /// Flies to where the whole item can be seen.
    void show(std::uint32_t id);

    /// What a project keeps of the measurements that have all the points they need.
    std::vector<ProjectMeasurement> saved() const;
    /// The same with their results and what is known of their layers, for other programs.
    std::vector<NamedMeasurement> named() const;
    /// The same for one; empty if it has too few points.
    std::optional<NamedMeasurement> named(std::uint32_t id) const;
    /// Replaces everything by the measurements of a project, whose layers are those of `layers`.
    /// Not a step of undo.
    void open(const std::vector<ProjectMeasurement>& saved, const std::vector<LayerId>& layers);

    /// Follows the layers: measures again what lies on a layer that changed.
    void setSession(const Session& session);

    /// On the screen now.
    std::vector<MeasureHandle> handles() const;
    /// Where the label of an item belongs, in the view; empty if nowhere.
    std::optional<QPointF> labelPlace(std::uint32_t id) const;
    /// Marks a place along the current line, or nothing.
    void setProfileCursor(std::optional<double> distance_m);
    std::optional<QPointF> profileCursorPlace() const;
    const Layer* layerOf(const MeasureItem& item) const;
    /// Points of the scene along an item that is a line, as it lies on the terrain. Fewer than two
    /// if it is not on the layers shown.
    std::vector<ScenePoint> pathOf(const MeasureItem& item) const;
    /// Moves a point to a typed place. Ignored where the item has no such point.
    void movePoint(std::uint32_t id, std::size_t index, const MeasuredVertex& vertex);

Q_SIGNALS:
    /// Items or the selection.
    void changed();
    void measured(std::uint32_t id);
    /// What is on the screen moved: handles and labels.
    void moved();
    void kindChanged(MeasurementKind kind);
    /// The pointer is over the current line, so far from its start; or over none.
    void lineHovered(std::optional<double> distance_m);

private:
    bool grab(QPointF position) override;
    void drag(QPointF position) override;
    void release() override;
    void click(QPointF position) override;
    void doubleClick(QPointF position) override;
    void hover(std::optional<QPointF> position) override;
    bool key(const QKeyEvent& event) override;

    friend class MeasureCommand;
    struct Job;
    // A place on the terrain as the pointer finds it.
    struct Place {
        MeasuredVertex vertex;
        LayerId layer = LayerId::None;
    };
    // A leg of an item as it is drawn.
    struct Leg {
        std::uint32_t item = 0;
        std::size_t index = 0; // of the vertex at its beginning
        double begin_m = 0.0;  // along the item
        std::vector<ScenePoint> points;
        std::vector<double> distances_m; // of the points from the leg's beginning
    };

    void setState(MeasureState state);
    void push(MeasureState after, const QString& text);
    MeasureItem* editable(MeasureState& state, std::uint32_t id) const;
    std::optional<Place> placeAt(QPointF position) const;
    std::optional<Place> placeRead() const;
    std::optional<Place> placeOf(const RayHit& hit) const;
    std::optional<LayerId> layerSeenAt(QPointF position) const;
    void addPoint(const Place& place);
    std::optional<GroundPosition> positionOf(const MeasuredVertex& vertex) const;
    std::optional<ScenePoint> scenePoint(GroundPosition position) const;
    std::optional<ScenePoint> scenePoint(const MeasuredVertex& vertex) const;
    template <typename Where>
    std::optional<QPointF> screenPoint(const Where& where) const
    {
        const auto point = scenePoint(where);
        return point ? view_.positionOfPlace(*point) : std::nullopt;
    }
    void drawLines();
    void addLeg(const GroundLine& line, Leg leg);
    Rgb8 colorOf(const MeasureItem& item) const;
    void addSymbol(std::vector<DrapedLine>& lines, const MeasureItem& item) const;
    void measureAgain(const MeasureItem& item);
    void take(const Job& job, std::shared_ptr<const MeasurementResult> result, bool is_last);

    TerrainView& view_;
    QUndoStack& undo_stack_;
    MeasureState state_;
    MeasurementKind kind_ = MeasurementKind::Profile;
    Session session_;
    std::map<std::uint32_t, MeasureOutcome> outcomes_;
    std::map<std::uint32_t, std::shared_ptr<const Map>> measured_on_;
    std::map<std::uint32_t, std::shared_ptr<Job>> jobs_; // the latest of each item
    std::shared_ptr<const Map> geometry_map_;
    std::unique_ptr<MeasuredTerrain> geometry_; // of it; no samples are read
    std::vector<Leg> legs_;
    std::optional<QPointF> pointer_;
    std::optional<double> profile_cursor_m_;
    struct Grabbed {
        std::uint32_t item = 0;
        std::size_t index = 0;
        MeasureState before;
    };
    std::optional<Grabbed> grabbed_;
    QTimer draw_timer_; // gathers reasons to draw the lines again
    QThreadPool pool_;
};

} // namespace marsview
