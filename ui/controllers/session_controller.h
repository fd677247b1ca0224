// The session of the window: the only bridge between layers, loading, undo and the view.
#pragma once

#include "core/session/project.h"
#include "core/session/session.h"
#include "ui/canvas/shown_layer.h"
#include "ui/controllers/load_controller.h"
#include "ui/controllers/map_preparer.h"
#include "ui/controllers/session_command.h"

#include <QObject>
#include <QString>
#include <QUndoStack>

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace marsview {

class TerrainView;

/// Progress of loading, for people.
struct LoadReport {
    QString file;          // its path
    double fraction = 0.0; // done
    int position = 1;      // of those asked for together, counted from 1
    int count = 1;
};

/// The state of the overviews of a layer that is shown as a preview.
enum class PreparationState {
    None,    // the layer is not a preview, or its map is about to replace it
    Waiting, // for other maps
    Running,
    Stopped, // by the user
    Failed,
};

struct Preparation {
    PreparationState state = PreparationState::None;
    QString problem{}; // "FILE: WHY" of what failed
    int ending = 0;    // a number of its own for each time that building was stopped or failed
};

/// Whether a change is a step of undo by itself, or one of many of a drag.
enum class ChangeKind { Single, OfDrag };

/// What is shown in place of the flat map, such as a globe.
struct OtherScene {
    /// Flies to where all of a layer is in sight; false if the layer is not in the scene.
    std::function<bool(const std::shared_ptr<const Map>&)> fly_to;
    /// The same, unless some of the layer is in sight.
    std::function<bool(const std::shared_ptr<const Map>&)> reveal;
    /// The elevations of a layer in the picture; empty if the picture shows none of it.
    std::function<std::optional<HeightRange>(const std::shared_ptr<const Map>&)> range_in_picture;
};

/// Holds the session and changes it on request; every change is undoable, except which layer is
/// active. Files are loaded first, one at a time in the order of the requests, and become a change
/// when they are loaded. Lives in the GUI thread; must not outlive the view.
///
/// A map that is too large for memory and has no overviews yet is shown as a preview while they are
/// built. The finished map replaces the preview in the session and in the steps of undo, without a
/// step of its own.
class SessionController final : public QObject {
    Q_OBJECT

public:
    explicit SessionController(TerrainView& view, QObject* parent = nullptr);
    ~SessionController() override;

    /// What the camera and the picture are of, from now on; empty for the flat map.
    void showOn(std::optional<OtherScene> scene);
    /// Whether a layer is in the scene that is shown, and visible.
    bool isInScene(const Layer& layer) const;
    /// For files that are opened from now on.
    void setOpener(const MapOpener& opener);

    const Session& session() const noexcept { return session_; }
    QUndoStack& undoStack() noexcept { return undo_stack_; }
    const LoadController& loader() const noexcept { return *loader_; }
    /// Something is loading or waits for its turn.
    bool isBusy() const noexcept { return current_.has_value() || !waiting_.empty(); }
    /// The overviews of some map are being built.
    bool isPreparing() const noexcept { return preparer_->isBusy(); }
    Preparation preparationOf(LayerId id) const;

    /// Each becomes a layer on top when it is loaded. May be called before the view can draw.
    void open(const QStringList& files);
    /// The same for files that the program is started with: not a step of undo, unless the user has
    /// changed something by the time that they are loaded.
    void openAtStart(const QStringList& files);
    /// As a sample: not a step of undo, and replaced by the first map that the user opens. Does
    /// nothing if a layer is open or being opened.
    void openSample(const QString& file);
    /// Replaces the session by that of a project. Its layers are loaded one after the other; until
    /// then, and if they cannot be loaded, they are missing layers of the session. Clears the steps
    /// of undo.
    void openProject(const Project& project);
    /// Opens a missing layer with all its settings from another file. failed() follows if that is
    /// not possible. Without effect if the layer is not missing.
    void locate(LayerId id, const QString& file);
    /// Removes a missing layer from the session.
    void removeMissing(LayerId id);
    /// The user works with the sample: it stays when other maps are opened, as a layer like them.
    void adoptSample() { is_sample_adopted_ = true; }
    /// The sample that the first opened map replaced, as long as it is not back in the session;
    /// null otherwise.
    const Layer* replacedSample() const;
    /// Puts the replaced sample back below the other layers, as a layer like them.
    void keepSample();
    /// Replaces what the file of a layer states. overrideFailed() follows if that is not
    /// possible.
    void overrideGeoreferencing(LayerId id, const RasterOverrides& overrides);
    /// Whether a layer's nodata value is neither of its file nor chosen by the user, but one that
    /// no elevation has: files are opened with it (certainNodata()).
    bool isNodataAssumed(const Layer& layer) const;
    /// Cancels the file that is loading and those that wait.
    void cancel();
    /// Builds the overviews of a layer that is a preview, or resumes that.
    void prepare(LayerId id);
    /// Stops building the current overviews, which can be resumed; maps that wait are next.
    void stopPreparing();
    /// Stops everything, before the program ends.
    void stopAll();

    // Without effect if the layer does not exist or nothing would change.
    void remove(LayerId id);
    void move(LayerId id, std::size_t index);
    /// Shown means in the picture: a layer that the view cannot show together with the present ones
    /// moves to the top and becomes what the view shows.
    void setVisible(LayerId id, bool is_visible);
    /// A name of colorRamps(); empty for the one that suits the body.
    void setRamp(LayerId id, const QString& ramp);
    /// Over which elevations the layer's ramp is spread.
    void setStretch(LayerId id, const ColorStretch& stretch, ChangeKind kind = ChangeKind::Single);
    /// Over which slopes it is spread; nothing for the slopes that suit the map.
    void setSlopeRange(LayerId id,
                       const std::optional<SlopeRange>& range,
                       ChangeKind kind = ChangeKind::Single);
    /// Over how many cells its edges are blended into the layers below it, on the globe.
    void setFeather(LayerId id, std::size_t cells);
    /// Whether the globe is shown and the layer has others below it there.
    bool canFeather(LayerId id) const;
    /// Over which slopes it is spread now.
    SlopeRange slopeRangeOf(const Layer& layer) const;
    /// From the lowest to the highest elevation of the layer in the picture. Nothing where the
    /// picture shows none of it, or a single elevation.
    void stretchToView(LayerId id);
    /// The elevations that a layer's stretch comes to, without the symmetry of diverging ramps.
    HeightRange stretchedRangeOf(const Layer& layer) const;
    void rename(LayerId id, const QString& name);
    /// Of the picture, bounded to exaggerationRange() of the topmost layer in it. Nothing where all
    /// layers are hidden.
    void setExaggeration(double exaggeration, ChangeKind kind = ChangeKind::Single);
    /// The next round number above, or below for steps < 0.
    void stepExaggeration(int steps);
    /// Ends merging: the next drag is a separate undo step.
    void endDrag();
    void setShading(ShadingMode mode);
    void setContours(bool has_contours);
    void setOrder(LayerOrder order);
    /// Shows contour lines so many meters apart; 0: automatic.
    void setContourInterval(double interval_m);
    void setLight(Angle azimuth, Angle altitude);
    void fixLightInView();
    /// Fixes the light on the body, with the sun overhead at that place.
    void setSubsolarPoint(const GeographicPoint& place);
    void activate(LayerId id);
    /// Adds a vector file that was read, or changes how it is drawn.
    void setOverlay(const VectorOverlay& overlay);
    void removeOverlay(const std::string& path);

    /// Adds a view at the end, under the id that is returned.
    ViewId addView(SavedView view);
    // Without effect if the view does not exist or nothing would change.
    void updateView(const SavedView& view);
    void renameView(ViewId id, const QString& name);
    void moveView(ViewId id, std::size_t index);
    void removeView(ViewId id);
    /// Whether a layer of the session has the place of that view.
    bool canShow(const SavedView& view) const;
    /// Brings the layer and the exaggeration of a view into the picture, in one step of undo, for
    /// the camera to go there. False if the view does not exist, or canShow() is false.
    bool prepareView(ViewId id);

    /// Flies to where all of a layer is in sight, and shows it first if it is not shown.
    void goTo(LayerId id);

Q_SIGNALS:
    /// Layers, their looks or which one is active.
    void sessionChanged();
    /// Another scene is shown; see showOn().
    void sceneChanged();
    void loadProgressed(const LoadReport& report);
    /// Nothing is loading any more.
    void loadingEnded();
    /// The user stopped it.
    void loadingCanceled();
    void preparingProgressed(const PrepareProgress& progress);
    /// No overviews are being built any more.
    void preparingEnded();
    /// Of some layer.
    void preparationChanged();
    void opened(const QString& file);
    /// "FILE: WHY". The session is as it was.
    void failed(const QString& problem);
    /// Overrides of a layer cannot be used, "FILE: WHY" or "OPTION: WHY". The session is as it was.
    void overrideFailed(LayerId id, const QString& problem);

private:
    struct Load {
        /// Complete: a preview whose map has been prepared.
        /// Project, Locate: a missing layer of the session.
        enum class Purpose {
            Open,
            Sample,
            Override,
            Complete,
            Project,
            Locate
        } purpose = Purpose::Open;
        RasterSpec spec;
        bool is_at_start = false;
        LayerId layer = LayerId::None; // that is overridden or missing, or whose preview it is
        std::shared_ptr<const Map> as_declared{}; // the map before its nodata value was assumed
    };
    /// What became of a preview. It lives as long as some step of undo holds the preview.
    struct Successor {
        std::weak_ptr<const Map> preview;
        std::shared_ptr<const Map> map; // may itself be a preview, a better one
    };
    /// How preparing ended, for maps of which the session or its undo steps may hold a preview.
    struct Ending {
        enum class How { Done, Stopped, Failed } how = How::Done;
        RasterSpec spec;
        QString problem{};
        int number = 0; // counted from 1
    };

    void openFiles(const QStringList& files, bool is_at_start);
    void enqueue(Load load);
    void startNext();
    void dropLoadsOf(LayerId id);
    void accept(const std::shared_ptr<const Map>& map);
    bool openAgainWithNodata(const Load& load, const std::shared_ptr<const Map>& map);
    void endLoad();
    const MissingLayer* missingLayer(LayerId id) const;
    void acceptMissing(const Load& load, const std::shared_ptr<const Map>& map);
    void keepMissing(LayerId id, const QString& problem);
    void changeWhileOpening(const QString& text, const Session& after);
    void acceptComplete(const Load& load, const std::shared_ptr<const Map>& map);
    void replacePreview(const std::shared_ptr<const Map>& preview,
                        const std::shared_ptr<const Map>& map);
    std::shared_ptr<const Map> latest(std::shared_ptr<const Map> map) const;
    void endPreparing(const Ending& ending);
    const Ending* endingOf(const RasterSpec& spec) const;
    void forgetEnding(const RasterSpec& spec);
    void lookAfterPreviews();
    bool isCompleting(LayerId id) const;
    static Session withLayerShown(const Session& session, LayerId id);
    const Layer* layerForView(const SavedView& view) const;
    void change(const QString& text, const Session& after, SessionRun run = {});
    SessionRun runOf(ChangeKind kind, SessionRun::Kind what) const;
    void apply(const Session& session);
    void show();
    void revealWhatCame();

    std::optional<HeightRange> rangeInPicture(const std::shared_ptr<const Map>& map) const;
    Session withLayerInScene(const Layer& layer) const;
    void flyOnFlatMapTo(const Map& map);

    TerrainView& view_;
    std::optional<OtherScene> other_scene_;
    LoadController* loader_ = nullptr;
    MapPreparer* preparer_ = nullptr;
    std::vector<Successor> successors_;
    std::vector<Ending> endings_;
    bool are_previews_left_alone_ = false; // everything is about to end
    Session session_;
    QUndoStack undo_stack_;
    std::optional<Load> current_;
    std::deque<Load> waiting_;
    int asked_count_ = 0; // since nothing was loading
    int begun_count_ = 0;
    int ending_count_ = 0;
    LayerId to_reveal_ = LayerId::None;
    std::optional<Layer> replaced_sample_;
    bool is_sample_adopted_ = false;
    struct AssumedNodata {
        LayerId layer;
        double raw;
    };
    std::vector<AssumedNodata> assumed_nodata_;
    LayerId project_active_ = LayerId::None; // becomes active when it is loaded
    std::vector<ShownLayer> shown_;
    int drag_serial_ = 0;
    /// A percentile takes a while to find.
    struct KnownRange {
        std::weak_ptr<const Map> map;
        ColorStretch stretch;
        HeightRange range;
    };
    mutable std::vector<KnownRange> known_ranges_;
};

/// The ramp that a layer is drawn with.
const ColorRamp& rampOf(const Layer& layer);

} // namespace marsview
