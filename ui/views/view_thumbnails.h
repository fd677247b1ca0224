// Small pictures of the saved views, drawn from the terrain and never stored.
#pragma once

#include "core/session/saved_view.h"
#include "core/session/session.h"
#include "ui/pictures/picture_scenes.h"

#include <QObject>
#include <QPixmap>
#include <QSize>
#include <QTimer>

#include <map>
#include <memory>
#include <optional>

namespace marsview {

class PictureDrawing;

/// Draws one picture after the other in the GUI thread while the map is at rest, of the scene that
/// is shown. A view whose layer is not in it keeps the last one. Outlived by the scenes.
class ViewThumbnails final : public QObject {
    Q_OBJECT

public:
    static constexpr QSize kSize{112, 70}; // points

    explicit ViewThumbnails(const PictureScenes& scenes, QObject* parent = nullptr);
    ~ViewThumbnails() override;

    /// Whether anyone looks at them; nothing is drawn otherwise.
    void setWanted(bool is_wanted);
    void setSession(const Session& session);
    /// Null if it has not been drawn yet.
    QPixmap thumbnail(ViewId id) const;
    /// The pictures that can be drawn are those of now.
    bool isComplete() const;

Q_SIGNALS:
    void drawn(ViewId id);

private:
    /// What the picture of a view depends on, besides layers and look.
    struct Entry {
        ViewCamera camera;
        double exaggeration = 1.0;
        QPixmap picture;
        bool is_current = false;
        bool is_of_globe = false;
    };

    std::optional<SceneCamera> cameraOf(const SavedView& view) const;
    bool isCurrent(const Entry& entry, const SavedView& view) const;
    void connectTo(PictureScene& scene);
    const SavedView* next() const;
    void drawNext();
    void makeStale();

    PictureScenes scenes_;
    Session session_;
    std::map<ViewId, Entry> entries_;
    bool is_wanted_ = false;
    ViewId drawing_id_ = ViewId::None;
    std::unique_ptr<PictureDrawing> drawing_;
    QTimer timer_;
};

} // namespace marsview
