#include "ui/pictures/picture_drawing.h"

#include "ui/render/supersampled_picture.h"

#include <chrono>

namespace marsview {
namespace {

// Pixels per side. In software a block takes some 50 ms, during which input has to wait.
constexpr int kBlockSide = 512;

// Of the progress: a picture with few samples a pixel comes first, and shows whether more follow.
constexpr double kSmoothShare = 0.4;

// The interval at which pieces of a block that were missing are looked for.
constexpr std::chrono::milliseconds kArrivalInterval{20};

int blocksAlong(int pixels, int side)
{
    return (pixels + side - 1) / side;
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
    connect(&scene_, &PictureScene::layersChanged, this, [this] {
        next_ = 0;
        is_supersampled_ = false;
    });
    timer_.start(0);
}

int PictureDrawing::blockSide() const
{
    return is_supersampled_ ? kBlockSide / kSamplesPerSide : kBlockSide;
}

double PictureDrawing::progress(double share) const
{
    if (smoothing_ == PictureSmoothing::Never) {
        return share;
    }
    return is_supersampled_ ? kSmoothShare + (1.0 - kSmoothShare) * share : kSmoothShare * share;
}

bool PictureDrawing::needsSecondDrawing() const
{
    return smoothing_ == PictureSmoothing::ByContrast && !is_supersampled_ &&
           contrastOf({.first = picture_.constBits(),
                       .width = picture_.width(),
                       .height = picture_.height(),
                       .line_length = picture_.bytesPerLine()},
                      style_) > kSmoothContrastMax;
}

void PictureDrawing::drawNext()
{
    if (picture_.isNull()) {
        Q_EMIT failed(
            tr("There is not enough memory for a picture of this size; choose a smaller "
               "one"));
        return;
    }
    const int side = blockSide();
    const int columns = blocksAlong(picture_.width(), side);
    const int count = columns * blocksAlong(picture_.height(), side);
    const QRect block(next_ % columns * side, next_ / columns * side, side, side);
    const Result<bool> drawn =
        scene_.drawPart(camera_, style_, block.intersected(picture_.rect()),
                        {.lines = lines_, .is_supersampled = is_supersampled_}, picture_);
    if (!drawn) {
        Q_EMIT failed(QString::fromStdString(drawn.error().message));
        return;
    }
    if (!*drawn) {
        timer_.start(kArrivalInterval);
        return;
    }
    ++next_;
    Q_EMIT progressed(progress(static_cast<double>(next_) / count));
    if (next_ < count) {
        timer_.start(0);
    } else if (needsSecondDrawing()) {
        next_ = 0;
        is_supersampled_ = true;
        timer_.start(0);
    } else {
        Q_EMIT finished(picture_);
    }
}

} // namespace marsview
