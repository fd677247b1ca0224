// Drawing a picture of any size while the window stays usable.
#pragma once

#include "ui/pictures/picture_scene.h"

#include <QImage>
#include <QObject>
#include <QTimer>

namespace marsview {

/// Draws the terrain that a camera has, block by block, in the GUI thread between its events. Look
/// and exaggeration are those at the start unless set. Where the scene gets other layers meanwhile,
/// it begins again with these. Its end stops it. Must not outlive the scene.
class PictureDrawing final : public QObject {
    Q_OBJECT

public:
    PictureDrawing(PictureScene& scene,
                   const SceneCamera& camera,
                   const QSize& size,
                   PictureLines lines = PictureLines::Drawn,
                   QObject* parent = nullptr);

    /// In place of the scene's; before the first events are handled.
    void setStyle(const DrawStyle& style) { style_ = style; }

Q_SIGNALS:
    /// The share that is drawn, 0 to 1.
    void progressed(double share);
    /// RGB888. Follows as failed() does not, and once.
    void finished(const QImage& picture);
    void failed(const QString& problem);

private:
    void drawNext();
    int blockSide() const;

    PictureScene& scene_;
    SceneCamera camera_;
    DrawStyle style_;
    PictureLines lines_;
    QImage picture_;
    int next_ = 0; // block, row by row
    bool is_supersampled_ = false;
    QTimer timer_;
};

} // namespace marsview
