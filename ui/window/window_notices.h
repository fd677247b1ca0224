// The notices of the window about the active layer, the picture and the haptic device, with their
// buttons.
#pragma once

#include "ui/controllers/unplaced_layer.h"
#include "ui/widgets/notice.h"

#include <QObject>

#include <functional>
#include <memory>
#include <vector>

class QAction;

namespace marsview {

class HapticsController;
class NoticeCenter;
class SessionController;
class TerrainView;
class TileDiskCache;
struct CrsSuggestion;
struct Layer;
struct RasterInfo;
struct UnitSuggestion;

/// What the buttons of notices do outside the session.
struct NoticeCommands {
    /// Shows a notice of the active layer among its facts.
    std::function<void(const QString& notice)> show_fact;
    /// Edits body, CRS, unit and scale of the active layer.
    std::function<void()> set_georeferencing;
    std::function<void()> show_haptics;
    std::function<void()> save_diagnostic_log;
};

/// Collects the notices and passes them to the center. GUI thread; must not outlive its constructor
/// arguments.
class WindowNotices final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        NoticeCenter& center;
        SessionController& session;
        const TerrainView& view;
        HapticsController& haptics;
        QAction& globe; // shows the globe, is checked while it does
        /// May be null.
        std::shared_ptr<TileDiskCache> fetched_tiles;
    };

    WindowNotices(Parts parts, NoticeCommands commands, QObject* parent = nullptr);

    /// The layers that the globe cannot show.
    void setUnplaced(std::vector<UnplacedLayer> layers);
    /// Call when the reported state may have changed. Cheap if nothing did.
    void update();

private:
    QList<Notice> ofDevice() const;
    QList<Notice> ofReplay() const;
    QList<Notice> ofPicture() const;
    QList<Notice> ofSample() const;
    QList<Notice> ofScene() const;
    QList<Notice> ofUnplaced() const;
    /// Appends those of the layer: `corrections` are what the user should decide first.
    void addNotices(const Layer& layer, QList<Notice>& corrections, QList<Notice>& others) const;
    void addNodata(Notice& notice, double raw, const Layer& layer) const;
    void addUnit(Notice& notice, const UnitSuggestion& suggestion, const Layer& layer) const;
    void addRasters(Notice& notice, const RasterInfo& info) const;
    Notice ofAssumedNodata(const Layer& layer) const;
    void addChoices(Notice& notice, const CrsSuggestion& suggestion, const Layer& layer) const;
    Notice ofPreview(const Layer& layer) const;
    QList<Notice> ofStorage() const;

    Parts parts_;
    NoticeCommands commands_;
    std::vector<UnplacedLayer> unplaced_;
};

} // namespace marsview
