// Small pictures of the saved views, drawn from the terrain and never stored.
#pragma once

#include "core/session/saved_view.h"
#include "core/session/session.h"

#include <QObject>
#include <QPixmap>
#include <QSize>
#include <QTimer>

#include <map>
#include <memory>
#include <optional>

namespace marsview {

class PictureDrawing;
class TerrainView;

/// Draws one picture after the other in the GUI thread while the view is at rest. A view whose
/// layer is not in the picture keeps the last one. Outlived by the view.
class ViewThumbnails final : public QObject {
    Q_OBJECT

public:
    static constexpr QSize kSize{112, 70}; // points

    explicit ViewThumbnails(TerrainView& view, QObject* parent = nullptr);
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
    };

    std::optional<OrbitCamera> cameraOf(const SavedView& view) const;
    const SavedView* next() const;
    void drawNext();
    void makeStale();

    TerrainView& view_;
    Session session_;
    std::map<ViewId, Entry> entries_;
    bool is_wanted_ = false;
    ViewId drawing_id_ = ViewId::None;
    std::unique_ptr<PictureDrawing> drawing_;
    QTimer timer_;
};

/// Whether a view can be seen with the layers that `view` shows now: its body is theirs, or its
/// layer is on top. Then the camera for it.
std::optional<OrbitCamera> sceneCamera(const TerrainView& view,
                                       const Session& session,
                                       const SavedView& saved,
                                       double exaggeration);

} // namespace marsview
