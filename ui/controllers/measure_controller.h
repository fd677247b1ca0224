// Measuring on the map: the measurements, the tool that places their points, and their results.
#pragma once

#include "core/session/measurement.h"
#include "core/session/measurement_features.h"
#include "core/session/project.h"
#include "core/session/session.h"
#include "ui/drawing/drawing_controller.h"

#include <QThreadPool>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// A measurement as the user placed it. Its result follows from it and from the layer.
struct MeasureItem : DrawnItem {
    MeasurementKind kind = MeasurementKind::Profile;

    bool operator==(const MeasureItem&) const = default;
    /// An area has a border.
    bool isClosed() const noexcept { return kind == MeasurementKind::Area; }
    bool isLine() const noexcept
    {
        return kind == MeasurementKind::Distance || kind == MeasurementKind::Profile;
    }
    /// One point is enough.
    bool isSingle() const noexcept { return kind == MeasurementKind::Slope; }
    bool isComplete() const;
};

using MeasureState = DrawnState<MeasureItem>;

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

/// Lives in the GUI thread; measures on a thread of its own.
class MeasureController final : public DrawingController<MeasureItem> {
    Q_OBJECT

public:
    /// View and undo stack outlive it.
    MeasureController(TerrainView& view, QUndoStack& undo_stack, QObject* parent = nullptr);
    ~MeasureController() override;

    const MeasureOutcome& outcome(std::uint32_t id) const;

    /// What the next measurement will be; chooses the tool.
    void begin(MeasurementKind kind);
    MeasurementKind kind() const noexcept { return kind_; }
    void removeAll();

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

    /// Where the label of an item belongs, in the view; empty if nowhere.
    std::optional<QPointF> labelPlace(std::uint32_t id) const;
    /// Marks a place along the current line, or nothing.
    void setProfileCursor(std::optional<double> distance_m);
    std::optional<QPointF> profileCursorPlace() const;
    /// Points of the scene along an item that is a line, as it lies on the terrain. Fewer than two
    /// if it is not on the layers shown.
    std::vector<ScenePoint> pathOf(const MeasureItem& item) const;

Q_SIGNALS:
    void measured(std::uint32_t id);
    void kindChanged(MeasurementKind kind);
    /// The pointer is over the current line, so far from its start; or over none.
    void lineHovered(std::optional<double> distance_m);

private:
    struct Job;

    MeasureItem newItem(std::uint32_t id) const override;
    static QString nameOf(MeasurementKind kind, std::uint32_t number);
    bool isShown(const MeasureItem& item) const override;
    std::vector<GroundPosition> cornersOf(const MeasureItem& item,
                                          const std::optional<GroundPosition>& next) const override;
    void addLines(std::vector<DrapedLine>& lines) const override;
    void stateChanged(const MeasureState& before) override;
    void hovered(const std::optional<QPointF>& position) override;

    void addSymbol(std::vector<DrapedLine>& lines, const MeasureItem& item) const;
    void measureAgain(const MeasureItem& item);
    void take(const Job& job, std::shared_ptr<const MeasurementResult> result, bool is_last);

    MeasurementKind kind_ = MeasurementKind::Profile;
    std::map<std::uint32_t, MeasureOutcome> outcomes_;
    std::map<std::uint32_t, std::shared_ptr<const Map>> measured_on_;
    std::map<std::uint32_t, std::shared_ptr<Job>> jobs_; // the latest of each item
    std::optional<double> profile_cursor_m_;
    QThreadPool pool_;
};

} // namespace marsview
