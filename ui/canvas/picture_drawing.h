// Drawing a picture of any size while the window stays usable.
#pragma once

#include "core/view/camera.h"
#include "ui/canvas/terrain_canvas.h"

#include <QImage>
#include <QObject>
#include <QTimer>

namespace marsview {

class TerrainView;

/// Draws the terrain that a camera has, block by block, in the GUI thread between its events. Look
/// and exaggeration are those at the start unless set. Where the view gets other layers meanwhile,
/// it begins again with these. Its end stops it. Must not outlive the view.
class PictureDrawing final : public QObject {
    Q_OBJECT

public:
    PictureDrawing(TerrainView& view,
                   const OrbitCamera& camera,
                   const QSize& size,
                   PictureLines lines = PictureLines::Drawn,
                   QObject* parent = nullptr);

    /// In place of the view's; before the first events are handled.
    void setStyle(const DrawStyle& style) { style_ = style; }

Q_SIGNALS:
    /// The share that is drawn, 0 to 1.
    void progressed(double share);
    /// RGB888. Follows as failed() does not, and once.
    void finished(const QImage& picture);
    void failed(const QString& problem);

private:
    void drawNext();

    TerrainView& view_;
    OrbitCamera camera_;
    DrawStyle style_;
    PictureLines lines_;
    QImage picture_;
    int next_ = 0; // block, row by row
    QTimer timer_;
};

} // namespace marsview
