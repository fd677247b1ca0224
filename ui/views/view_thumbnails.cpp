#include "ui/views/view_thumbnails.h"

#include "ui/canvas/picture_drawing.h"
#include "ui/canvas/terrain_view.h"

#include <QImage>

#include <algorithm>
#include <chrono>
#include <utility>

namespace marsview {
namespace {

// After the picture at rest is complete.
constexpr std::chrono::milliseconds kThumbnailDelay{50};

} // namespace

std::optional<OrbitCamera> sceneCamera(const TerrainView& view,
                                       const Session& session,
                                       const SavedView& saved,
                                       double exaggeration)
{
    const auto& map = view.map();
    if (!map) {
        return std::nullopt;
    }
    const Body* body = map->info().body;
    const Layer* layer = layerOf(session, saved.layer);
    const bool is_same_map = layer != nullptr && layer->map == map;
    const bool is_same_body = body != nullptr && body->name == saved.body;
    if (!is_same_map && !is_same_body) {
        return std::nullopt;
    }
    return orbitCamera(map->georeference(), saved.camera, exaggeration);
}

ViewThumbnails::ViewThumbnails(TerrainView& view, QObject* parent)
    : QObject(parent)
    , view_(view)
{
    timer_.setSingleShot(true);
    timer_.setInterval(kThumbnailDelay);
    connect(&timer_, &QTimer::timeout, this, &ViewThumbnails::drawNext);
    connect(&view_, &TerrainView::layersChanged, this, &ViewThumbnails::makeStale);
    connect(&view_, &TerrainView::lookChanged, this, &ViewThumbnails::makeStale);
    connect(&view_, &TerrainView::pictureCompleted, &timer_, qOverload<>(&QTimer::start));
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

std::optional<OrbitCamera> ViewThumbnails::cameraOf(const SavedView& view) const
{
    return sceneCamera(view_, session_, view, view.exaggeration);
}

const SavedView* ViewThumbnails::next() const
{
    const auto found =
        std::find_if(session_.views.begin(), session_.views.end(), [this](const SavedView& view) {
            const auto entry = entries_.find(view.id);
            return entry != entries_.end() && !entry->second.is_current && cameraOf(view);
        });
    return found != session_.views.end() ? &*found : nullptr;
}

void ViewThumbnails::drawNext()
{
    if (!is_wanted_ || drawing_ || !view_.isReady() || !view_.isPictureComplete()) {
        return; // pictureCompleted() follows
    }
    const SavedView* view = next();
    if (view == nullptr) {
        return;
    }
    drawing_id_ = view->id;
    Entry& entry = entries_[drawing_id_];
    entry.is_current = true; // unless something changes while it is drawn
    const double ratio = view_.devicePixelRatioF();
    drawing_ = std::make_unique<PictureDrawing>(
        view_, *cameraOf(*view), (QSizeF(kSize) * ratio).toSize(), PictureLines::Omitted);
    DrawStyle style = view_.style();
    style.exaggeration = view->exaggeration;
    drawing_->setStyle(style);
    const auto end = [this](const QImage& picture) {
        drawing_.reset();
        const ViewId id = std::exchange(drawing_id_, ViewId::None);
        if (!picture.isNull() && viewOf(session_, id) != nullptr) {
            QPixmap pixmap = QPixmap::fromImage(picture);
            pixmap.setDevicePixelRatio(view_.devicePixelRatioF());
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
