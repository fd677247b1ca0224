// Drawing a picture of any size while the window stays usable.
#pragma once

#include "ui/pictures/picture_scene.h"

#include <QImage>
#include <QObject>
#include <QTimer>

namespace marsview {

/// Whether pictures of high contrast are drawn a second time, with nine samples a pixel. In
/// software that can take several times as long as the first time.
enum class PictureSmoothing {
    ByContrast,
    Never, // for pictures that are shown smaller than they are, or on paper
};

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
    /// By contrast until it is set; before the first events are handled.
    void setSmoothing(PictureSmoothing smoothing) { smoothing_ = smoothing; }

Q_SIGNALS:
    /// The share that is drawn, 0 to 1.
    void progressed(double share);
    /// RGB888. Follows as failed() does not, and once.
    void finished(const QImage& picture);
    void failed(const QString& problem);

private:
    void drawNext();
    int blockSide() const;
    // Of the picture, when `share` of its blocks are drawn this time.
    double progress(double share) const;
    bool needsSecondDrawing() const;

    PictureScene& scene_;
    SceneCamera camera_;
    DrawStyle style_;
    PictureLines lines_;
    PictureSmoothing smoothing_ = PictureSmoothing::ByContrast;
    QImage picture_;
    int next_ = 0; // block, row by row
    bool is_supersampled_ = false;
    QTimer timer_;
};

} // namespace marsview
