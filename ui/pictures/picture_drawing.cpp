#include "ui/pictures/picture_drawing.h"

#include <chrono>

namespace marsview {
namespace {

// Pixels per side. In software a block takes some 50 ms, during which input has to wait.
constexpr int kBlockSide = 512;

// The interval at which pieces of a block that were missing are looked for.
constexpr std::chrono::milliseconds kArrivalInterval{20};

int blocksAlong(int pixels)
{
    return (pixels + kBlockSide - 1) / kBlockSide;
}

} // namespace

PictureDrawing::PictureDrawing(PictureScene& scene,
                               const SceneCamera& camera,
                               const QSize& size,
                               PictureLines lines,
                               QObject* parent)
    : QObject(parent)
    , scene_(scene)
    , camera_(camera)
    , style_(scene.style())
    , lines_(lines)
    , picture_(size, QImage::Format_RGB888)
{
    timer_.setSingleShot(true);
    connect(&timer_, &QTimer::timeout, this, &PictureDrawing::drawNext);
    connect(&scene_, &PictureScene::layersChanged, this, [this] { next_ = 0; });
    timer_.start(0);
}

void PictureDrawing::drawNext()
{
    if (picture_.isNull()) {
        Q_EMIT failed(
            tr("There is not enough memory for a picture of this size; choose a smaller "
               "one"));
        return;
    }
    const int columns = blocksAlong(picture_.width());
    const int count = columns * blocksAlong(picture_.height());
    const QRect block(next_ % columns * kBlockSide, next_ / columns * kBlockSide, kBlockSide,
                      kBlockSide);
    const Result<bool> drawn =
        scene_.drawPart(camera_, style_, block.intersected(picture_.rect()), lines_, picture_);
    if (!drawn) {
        Q_EMIT failed(QString::fromStdString(drawn.error().message));
        return;
    }
    if (!*drawn) {
        timer_.start(kArrivalInterval);
        return;
    }
    ++next_;
    Q_EMIT progressed(static_cast<double>(next_) / count);
    if (next_ == count) {
        Q_EMIT finished(picture_);
    } else {
        timer_.start(0);
    }
}

} // namespace marsview
