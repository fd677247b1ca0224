#include "ui/views/view_thumbnails.h"

#include "ui/pictures/picture_drawing.h"

#include <QImage>

#include <algorithm>
#include <chrono>
#include <utility>

namespace marsview {
namespace {

// After the picture at rest is complete.
constexpr std::chrono::milliseconds kThumbnailDelay{50};

} // namespace

ViewThumbnails::ViewThumbnails(const PictureScenes& scenes, QObject* parent)
    : QObject(parent)
    , scenes_(scenes)
{
    timer_.setSingleShot(true);
    timer_.setInterval(kThumbnailDelay);
    connect(&timer_, &QTimer::timeout, this, &ViewThumbnails::drawNext);
    connectTo(scenes_.flat);
    connectTo(scenes_.globe);
}

void ViewThumbnails::connectTo(PictureScene& scene)
{
    const auto make_stale = [this, &scene] {
        if (&scene == &scenes_.shown()) {
            makeStale();
        }
    };
    connect(&scene, &PictureScene::layersChanged, this, make_stale);
    connect(&scene, &PictureScene::lookChanged, this, make_stale);
    connect(&scene, &PictureScene::pictureCompleted, &timer_, qOverload<>(&QTimer::start));
}

ViewThumbnails::~ViewThumbnails() = default;

void ViewThumbnails::setWanted(bool is_wanted)
{
    is_wanted_ = is_wanted;
    if (is_wanted_) {
        timer_.start();
    }
}

void ViewThumbnails::setSession(const Session& session)
{
    session_ = session;
    std::erase_if(entries_, [&](const auto& entry) {
        return viewOf(session_, entry.first) == nullptr && entry.first != drawing_id_;
    });
    for (const SavedView& view : session_.views) {
        Entry& entry = entries_[view.id];
        if (entry.camera != view.camera || entry.exaggeration != view.exaggeration) {
            entry.camera = view.camera;
            entry.exaggeration = view.exaggeration;
            entry.is_current = false;
        }
    }
    if (is_wanted_) {
        timer_.start();
    }
}

QPixmap ViewThumbnails::thumbnail(ViewId id) const
{
    const auto entry = entries_.find(id);
    return entry != entries_.end() ? entry->second.picture : QPixmap();
}

bool ViewThumbnails::isComplete() const
{
    return !drawing_ && next() == nullptr;
}

void ViewThumbnails::makeStale()
{
    for (auto& [id, entry] : entries_) {
        entry.is_current = false;
    }
    if (is_wanted_) {
        timer_.start();
    }
}

std::optional<SceneCamera> ViewThumbnails::cameraOf(const SavedView& view) const
{
    return scenes_.shown().cameraFor(session_, view, view.exaggeration);
}

// A picture of the scene that a view was saved in replaces one of the other scene.
bool ViewThumbnails::isCurrent(const Entry& entry, const SavedView& view) const
{
    const bool is_own_shown = view.is_on_globe == (&scenes_.shown() == &scenes_.globe);
    return entry.is_current && (entry.is_of_globe == view.is_on_globe || !is_own_shown);
}

const SavedView* ViewThumbnails::next() const
{
    const auto found =
        std::find_if(session_.views.begin(), session_.views.end(), [this](const SavedView& view) {
            const auto entry = entries_.find(view.id);
            return entry != entries_.end() && !isCurrent(entry->second, view) && cameraOf(view);
        });
    return found != session_.views.end() ? &*found : nullptr;
}

void ViewThumbnails::drawNext()
{
    PictureScene& scene = scenes_.shown();
    if (!is_wanted_ || drawing_ || !scene.isReady() || !scene.isComplete()) {
        return; // pictureCompleted() follows
    }
    const SavedView* view = next();
    if (view == nullptr) {
        return;
    }
    drawing_id_ = view->id;
    Entry& entry = entries_[drawing_id_];
    entry.is_current = true; // unless something changes while it is drawn
    entry.is_of_globe = &scene == &scenes_.globe;
    const double ratio = scene.devicePixelRatio();
    drawing_ = std::make_unique<PictureDrawing>(
        scene, *cameraOf(*view), (QSizeF(kSize) * ratio).toSize(), PictureLines::Omitted);
    DrawStyle style = scene.style();
    style.exaggeration = view->exaggeration;
    drawing_->setStyle(style);
    const auto end = [this, ratio, &scene](const QImage& picture) {
        drawing_.reset();
        const ViewId id = std::exchange(drawing_id_, ViewId::None);
        if (picture.isNull() && &scene != &scenes_.shown()) {
            entries_[id].is_current = false; // the other scene came in between
        }
        if (!picture.isNull() && viewOf(session_, id) != nullptr) {
            QPixmap pixmap = QPixmap::fromImage(picture);
            pixmap.setDevicePixelRatio(ratio);
            entries_[id].picture = pixmap;
            Q_EMIT drawn(id);
        }
        timer_.start();
    };
    // Queued: the drawing is deleted when it ends.
    connect(drawing_.get(), &PictureDrawing::finished, this, end, Qt::QueuedConnection);
    connect(
        drawing_.get(), &PictureDrawing::failed, this, [end](const QString&) { end({}); },
        Qt::QueuedConnection);
}

} // namespace marsview
