// The session of the window: the only bridge between layers, loading, undo and the view.
#pragma once

#include "core/session/session.h"
#include "ui/load_controller.h"
#include "ui/loaded_map_store.h"
#include "ui/map_preparer.h"
#include "ui/session_command.h"
#include "ui/shown_layer.h"

#include <QObject>
#include <QString>
#include <QUndoStack>

#include <deque>
#include <optional>
#include <vector>

namespace marsview {

class TerrainView;

/// What is loading, for people.
struct LoadReport {
    QString file;          // its path
    double fraction = 0.0; // done
    int position = 1;      // of those asked for together, counted from 1
    int count = 1;
};

/// How far a layer is that is shown by a preview.
enum class PreparationState {
    None,    // the layer is no preview, or is about to be whole
    Waiting, // for other maps
    Running,
    Stopped, // by the user
    Failed,
};

struct Preparation {
    PreparationState state = PreparationState::None;
    QString problem{}; // "FILE: WHY" of what failed
};

/// Whether a change is a step of undo by itself, or one of many of a drag.
enum class ChangeKind { Single, OfDrag };

/// Holds the session and changes it on request; every change is undoable, except which layer is
/// active. What has to be loaded is loaded first, one after the other in the order asked for, and
/// becomes a change when it is there. Lives in the GUI thread; must not outlive the view.
///
/// A map that is too large to be held and was not prepared before comes as a preview and is
/// prepared meanwhile. When it is ready it takes the preview's place wherever that is, which is no
/// change to take back; so it does in steps of undo.
class SessionController final : public QObject {
    Q_OBJECT

public:
    explicit SessionController(TerrainView& view, QObject* parent = nullptr);
    ~SessionController() override;

    /// For what is opened from now on.
    void setOpener(const MapOpener& opener);

    const Session& session() const noexcept { return session_; }
    QUndoStack& undoStack() noexcept { return undo_stack_; }
    const LoadController& loader() const noexcept { return *loader_; }
    /// Something is loading or waits for its turn.
    bool isBusy() const noexcept { return current_.has_value() || !waiting_.empty(); }
    /// A map is being prepared while its preview is shown.
    bool isPreparing() const noexcept { return preparer_->isBusy(); }
    Preparation preparationOf(LayerId id) const;

    /// Each becomes a layer on top when it is loaded. May be called before the view can draw.
    void open(const QStringList& files);
    /// As a sample, which is no change to take back and gives way to the first map opened. Nothing
    /// where the user was faster.
    void openSample(const QString& file);
    /// Tells the file of a layer better.
    void overrideGeoreferencing(LayerId id, const RasterOverrides& overrides);
    /// Stops what is loading and forgets what waits.
    void cancel();
    /// Prepares a layer that is a preview, or goes on with it.
    void prepare(LayerId id);
    /// Stops what is being prepared, to be gone on with another time; others that wait are next.
    void stopPreparing();
    /// Stops everything, as before the end.
    void stopAll();

    // Nothing where there is no such layer, or nothing would change.
    void remove(LayerId id);
    void move(LayerId id, std::size_t index);
    void setVisible(LayerId id, bool is_visible);
    /// A name of colorRamps(); empty for the one that suits the body.
    void setRamp(LayerId id, const QString& ramp);
    /// Over which elevations the layer's ramp is spread.
    void setStretch(LayerId id, const ColorStretch& stretch, ChangeKind kind = ChangeKind::Single);
    /// Over which slopes it is spread; nothing for the slopes that suit the map.
    void setSlopeRange(LayerId id, const std::optional<SlopeRange>& range);
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
    /// What is dragged next is a step of undo of its own.
    void endDrag();
    void setShading(ShadingMode mode);
    void setContours(bool has_contours);
    void setLight(Angle azimuth, Angle altitude);
    void activate(LayerId id);

    /// Flies to where all of a layer is in sight. Nothing where it is not shown.
    void goTo(LayerId id);

Q_SIGNALS:
    /// Layers, their looks or which one is active.
    void sessionChanged();
    void loadProgressed(const LoadReport& report);
    /// Nothing is loading any more.
    void loadingEnded();
    /// The user stopped it.
    void loadingCancelled();
    void preparingProgressed(const PrepareProgress& progress);
    /// Nothing is being prepared any more.
    void preparingEnded();
    /// Of some layer.
    void preparationChanged();
    void opened(const QString& file);
    /// "FILE: WHY". The session is as it was.
    void failed(const QString& problem);

private:
    struct Load {
        /// Complete: a preview whose map has been prepared.
        enum class Purpose { Open, Sample, Override, Complete } purpose = Purpose::Open;
        DatasetSpec spec;
        LayerId layer = LayerId::None; // whose georeferencing is told, or whose preview it is
    };
    /// What became of a preview. It lives as long as some step of undo holds the preview.
    struct Successor {
        std::weak_ptr<const Dataset> preview;
        std::shared_ptr<const Dataset> map; // may itself be a preview, a better one
    };
    /// How preparing ended, for maps of which the session or its undo steps may hold a preview.
    struct Ending {
        enum class How { Done, Stopped, Failed } how = How::Done;
        DatasetSpec spec;
        QString problem{};
    };

    void enqueue(Load load);
    void startNext();
    void dropLoadsOf(LayerId id);
    void accept(const LoadedMap& map);
    void endLoad();
    void acceptComplete(const Load& load, const LoadedMap& map);
    void succeed(const std::shared_ptr<const Dataset>& preview, const LoadedMap& map);
    std::shared_ptr<const Dataset> latest(std::shared_ptr<const Dataset> dataset) const;
    void endPreparing(const Ending& ending);
    const Ending* endingOf(const DatasetSpec& spec) const;
    void forgetEnding(const DatasetSpec& spec);
    void lookAfterPreviews();
    bool isCompleting(LayerId id) const;
    void change(const QString& text, const Session& after, SessionRun run = {});
    void apply(const Session& session);
    void show();
    void revealWhatCame();

    TerrainView& view_;
    LoadController* loader_ = nullptr;
    MapPreparer* preparer_ = nullptr;
    std::vector<Successor> successors_;
    std::vector<Ending> endings_;
    bool are_previews_left_alone_ = false; // everything is about to end
    LoadedMapStore maps_;
    Session session_;
    QUndoStack undo_stack_;
    std::optional<Load> current_;
    std::deque<Load> waiting_;
    int asked_count_ = 0; // since nothing was loading
    int begun_count_ = 0;
    LayerId to_reveal_ = LayerId::None;
    std::vector<ShownLayer> shown_;
    int drag_serial_ = 0;
    /// A percentile takes a while to find.
    struct KnownRange {
        std::weak_ptr<const Dataset> dataset;
        ColorStretch stretch;
        HeightRange range;
    };
    mutable std::vector<KnownRange> known_ranges_;
};

/// The ramp that a layer is drawn with.
const ColorRamp& rampOf(const Layer& layer);

} // namespace marsview
