// Vector files on the terrain: reading them, placing them on the map, drawing what is in sight.
#pragma once

#include "core/annotations/drawn_vertex.h"
#include "core/base/job_monitor.h"
#include "core/geo/frames.h"
#include "core/session/session.h"
#include "core/vector/feature_index.h"
#include "core/vector/vector_file.h"
#include "ui/drawing/flat_scene.h"
#include "ui/widgets/posted_call.h"

#include <QElapsedTimer>
#include <QObject>
#include <QPointF>
#include <QString>
#include <QStringList>
#include <QThreadPool>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace marsview {

class FileWork;

/// Files are read and placed on a thread of their own, with progress and cancel by `work`; they are
/// simplified to the resolution of the picture, and to fewer points while it moves. Lives in the
/// GUI thread; view and `work` outlive it.
class VectorOverlays final : public QObject {
    Q_OBJECT

public:
    VectorOverlays(TerrainView& view, FileWork& work, QObject* parent = nullptr);
    /// Cancels what is being read.
    ~VectorOverlays() override;

    /// The overlays are drawn on another scene from now on; null for the flat map. The scene
    /// outlives this, or is taken back before.
    void drawOn(DrawingScene* scene);
    /// Reads a file for the map that is shown; wasRead(), failed() or isOnOtherBody() follows.
    /// `crs` replaces that of the file, as VectorOverlay::crs does.
    void open(const QString& file, const QString& crs = {});
    /// Draws the overlays of a session, and reads those that are not known yet.
    void setSession(const Session& session);

    /// Whether a file that has been read is on another body than the map that is shown.
    bool isElsewhere(const std::string& path) const;

    /// A feature of one of the files.
    struct FeatureId {
        std::string path;
        std::uint32_t number = 0;
        bool operator==(const FeatureId&) const = default;
    };
    /// A file that is in sight, with the attributes of its feature at a place.
    struct Hit {
        QString file; // its name without folder
        std::vector<std::pair<QString, QString>> attributes;
        FeatureId feature;
        FeatureShape shape = FeatureShape::Point;
    };
    static constexpr std::size_t kAttributesMax = 8; // unless others are asked for
    /// The features within `reach_m` of a place, of the overlay drawn last first. Takes as long for
    /// a million features as for a few.
    std::vector<Hit> featuresAt(const DrawnVertex& place,
                                double reach_m,
                                std::size_t attributes_max = kAttributesMax) const;
    /// The vertex of a feature that is drawn within `reach` points of a position of the view.
    std::optional<DrawnVertex> vertexNear(QPointF position, double reach) const;
    /// Draws a feature with a light border, above all others; nothing: none.
    void select(const std::optional<FeatureId>& feature);
    const std::optional<FeatureId>& selected() const noexcept { return selected_; }
    /// Flies to where all features of a file can be seen, if they are on the map.
    void goTo(const std::string& path);
    /// Something is being read or placed, or is about to be drawn.
    bool isBusy() const noexcept { return running_ > 0 || draw_soon_.isPending(); }

Q_SIGNALS:
    /// The file that open() asked for can be drawn. A notice is a sentence.
    void wasRead(const QString& file, const QString& crs, const QStringList& notices);
    /// The file states longitude and latitude on the Earth, but the map is of `body`; it can be
    /// opened in `crs` instead.
    void isOnOtherBody(const QString& file, const QString& body, const QString& crs);
    /// "FILE: WHY"
    void failed(const QString& problem);
    /// Other features are drawn.
    void changed();
    /// The selected feature is not drawn any more, and not selected.
    void selectionLost();

private:
    struct Placed {
        FeatureIndex index;
        PlaneBox box;
        /// Of the numbers in the index: layer and feature of the file.
        std::vector<std::pair<std::size_t, std::size_t>> features;
    };
    struct Entry {
        std::shared_ptr<const VectorFile> file; // null before it is read
        std::string crs;                        // in place of the file's
        std::weak_ptr<const ScenePlan> plan;    // that it is, or is being, placed on
        std::shared_ptr<const Placed> placed;   // null if it is of another body
        bool has_failed = false;
        double coarsening = 1.0;            // of the last selection, likely that of the next one
        std::vector<ScenePoint> dot_places; // by part of the index, as far as they were needed
    };
    struct Outcome {
        std::shared_ptr<const VectorFile> file;
        std::shared_ptr<const Placed> placed;
        std::optional<Error> problem;
        std::optional<Crs> likely; // that the file may be meant in, if it is of another body
    };
    struct Request {
        std::string path;
        std::string crs{}; // in place of the file's
        bool is_asked_for = false;
    };

    /// A file that is in sight on a plan.
    struct InSight {
        const VectorOverlay& overlay;
        const Entry& entry; // it is placed
    };
    /// The one drawn last first.
    std::vector<InSight> filesInSight(const std::shared_ptr<const ScenePlan>& plan) const;
    void joinScene();
    void placeAll();
    void place(const Request& request);
    static Outcome readFor(const Request& request,
                           const ScenePlan& plan,
                           std::shared_ptr<const VectorFile> known,
                           JobMonitor& monitor);
    void take(const Request& request, const std::weak_ptr<const ScenePlan>& plan, Outcome outcome);
    /// Null if canceled.
    static std::shared_ptr<const Placed>
    placedOn(const ScenePlan& plan, const VectorFile& file, JobMonitor& monitor);
    void drawLines();
    struct Drawn {
        std::vector<DrapedLine> lines;
        std::vector<TerrainDot> dots;
        std::vector<DrapedLine> selected; // lines and dots
    };
    void dropSelectionIfHidden();
    void addLines(const VectorOverlay& overlay, Entry& entry, std::size_t points_max, Drawn& drawn);
    std::optional<ScenePoint>
    placeOfDot(Entry& entry, std::uint32_t part, const PlanePoint& point) const;
    void forgetDotPlaces();

    FlatScene flat_;
    DrawingScene* scene_ = &flat_;
    FileWork& work_;
    std::vector<VectorOverlay> overlays_; // of the session
    std::map<std::string, Entry> entries_;
    std::vector<Request> waiting_; // for a map to be shown
    std::optional<FeatureId> selected_;
    std::weak_ptr<const Placed> selected_on_; // that the box is of
    PlaneBox selected_box_;
    bool is_drawn_ = false;
    PostedCall draw_soon_{[this] { drawLines(); }}; // gathers reasons to draw the lines again
    bool is_hasty_ = false;       // the camera has moved since the picture was complete
    QElapsedTimer drawn_at_;      // since the lines were made last
    qint64 hasty_drawing_ns_ = 0; // time for that while is_hasty_
    int running_ = 0;
    QThreadPool pool_;
};

} // namespace marsview
