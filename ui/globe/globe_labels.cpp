#include "ui/globe/globe_labels.h"

#include "core/globe/body_camera.h"
#include "ui/globe/globe_view.h"

#include <QEvent>
#include <QPainter>

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

constexpr double kLargeShare = 0.25;  // as on the flat map
constexpr double kCursorReach = 22.0; // points around the cursor that it needs
constexpr qsizetype kPicturesMax = 600;

} // namespace

GlobeLabels::GlobeLabels(GlobeView& globe)
    : QWidget(&globe)
    , globe_(globe)
{
    setObjectName(QStringLiteral("globeLabels"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    setAccessibleName(tr("Names"));
    setGeometry(globe.rect());
    globe.installEventFilter(this);
    obstacles_timer_.setSingleShot(true);
    obstacles_timer_.setInterval(0);
    connect(&obstacles_timer_, &QTimer::timeout, this, &GlobeLabels::showSight);
    connect(&globe, &GlobeView::placed, this, &GlobeLabels::showScene);
    connect(&globe, &GlobeView::sceneChanged, this, &GlobeLabels::showScene);
    connect(&globe, &GlobeView::sightChanged, this, &GlobeLabels::showSight);
    // Finer tiles may have arrived.
    connect(&globe, &GlobeView::pictureCompleted, this, &GlobeLabels::showSight);
    connect(&globe, &GlobeView::stylusMoved, this, qOverload<>(&QWidget::update));
}

void GlobeLabels::setNames(std::shared_ptr<const Gazetteer> names)
{
    if (names != gazetteer_) {
        gazetteer_ = std::move(names);
        names_.reset();
        maps_.clear();
        pictures_.clear();
        showScene();
    }
}

void GlobeLabels::setNamesShown(bool is_shown)
{
    are_names_shown_ = is_shown;
    showScene();
}

void GlobeLabels::setObstacles(std::vector<QWidget*> obstacles)
{
    obstacles_ = std::move(obstacles);
    for (QWidget* obstacle : obstacles_) {
        obstacle->installEventFilter(this);
    }
}

bool GlobeLabels::eventFilter(QObject* watched, QEvent* event)
{
    if (watched == parent() && event->type() == QEvent::Resize) {
        setGeometry(parentWidget()->rect());
    } else if (watched != parent() &&
               (event->type() == QEvent::Show || event->type() == QEvent::Hide ||
                event->type() == QEvent::Move || event->type() == QEvent::Resize)) {
        obstacles_timer_.start();
    }
    return QWidget::eventFilter(watched, event);
}

void GlobeLabels::changeEvent(QEvent* event)
{
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) {
        pictures_.clear();
    }
    QWidget::changeEvent(event);
}

// Looks do not move names: only other maps do.
void GlobeLabels::showScene()
{
    const std::vector<BodyTerrain>& maps = globe_.scene().maps();
    const bool is_same = std::equal(
        maps.begin(), maps.end(), maps_.begin(), maps_.end(),
        [](const BodyTerrain& map, const auto& known) { return map.map() == known.lock(); });
    if (!gazetteer_ || !are_names_shown_ || maps.empty() ||
        gazetteer_->body() != maps.front().map()->info().body) {
        names_.reset();
        maps_.clear();
    } else if (!names_ || !is_same) {
        names_ = std::make_unique<NameLabels>(gazetteer_, globe_.scene());
        maps_.clear();
        for (const BodyTerrain& map : maps) {
            maps_.emplace_back(map.map());
        }
    }
    showSight();
}

void GlobeLabels::showSight()
{
    const bool had_labels = !labels_.empty();
    labels_.clear();
    if (names_ && !globe_.scene().isEmpty() && !globe_.isHidden()) {
        placeLabels();
    }
    if (had_labels || !labels_.empty()) {
        update();
    }
}

void GlobeLabels::placeLabels()
{
    const double scale = globe_.devicePixelRatioF();
    const Viewport viewport = globe_.viewport();
    std::vector<LabelBox> taken;
    for (const QWidget* obstacle : obstacles_) {
        if (obstacle->isVisible()) {
            const QRectF box = obstacle->geometry();
            taken.push_back(
                {box.left() * scale, box.top() * scale, box.right() * scale, box.bottom() * scale});
        }
    }
    const auto size_of = [large_px = kLargeShare * viewport.height](double across_px) {
        return across_px >= large_px ? LabelFont::Large : LabelFont::Small;
    };
    const auto text_of = [this](std::size_t name) {
        return QString::fromStdString(gazetteer_->names()[name].name);
    };
    for (const NameLabel& label : names_->inPicture(
             poseOf(globe_.camera(), globe_.scene().ellipsoid()),
             {.viewport = viewport,
             .pixels_per_point = scale,
             .exaggeration = globe_.exaggeration(),
             .obstacles = taken},
             [&](std::size_t name, double across_px) {
                 const QSizeF size =
                     labelSize(text_of(name), labelFont(font(), size_of(across_px))) * scale;
                 return LabelSize{.width_px = size.width(), .height_px = size.height()};
             })) {
        Label shown{.text = text_of(label.name),
                    .box = {QPointF(label.box.left, label.box.top) / scale,
                            QPointF(label.box.right, label.box.bottom) / scale},
                    .size = size_of(label.across_px),
                    .point = {}};
        if (label.anchor == LabelAnchor::Point) {
            shown.point = QPointF(label.place.x, label.place.y) / scale;
        }
        labels_.push_back(std::move(shown));
    }
}

// Empty while there is no stylus.
QRectF GlobeLabels::aroundStylus() const
{
    const auto& stylus = globe_.stylus();
    if (!stylus || globe_.scene().isEmpty()) {
        return {};
    }
    const auto pixel = project(poseOf(globe_.camera(), globe_.scene().ellipsoid()),
                               globe_.viewport(), stylus->proxy);
    if (!pixel) {
        return {};
    }
    const QPointF place = QPointF(pixel->x, pixel->y) / globe_.devicePixelRatioF();
    const QPointF reach(kCursorReach, kCursorReach);
    return {place - reach, place + reach};
}

const QPixmap& GlobeLabels::picture(const Label& label)
{
    const QString key =
        label.text + (label.size == LabelFont::Large ? QLatin1Char('+') : QLatin1Char('-'));
    auto found = pictures_.find(key);
    const double scale = devicePixelRatioF();
    if (found != pictures_.end() && found->devicePixelRatio() == scale) {
        return *found;
    }
    if (pictures_.size() > kPicturesMax) {
        pictures_.clear();
    }
    QPixmap pixmap =
        QPixmap::fromImage(labelPicture(label.text, labelFont(font(), label.size), scale));
    pixmap.setDevicePixelRatio(scale);
    return *pictures_.insert(key, pixmap);
}

void GlobeLabels::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    const QRectF cursor = aroundStylus();
    for (const Label& label : labels_) {
        if (label.box.intersects(cursor)) {
            continue;
        }
        if (label.point) {
            drawLabelDot(painter, *label.point);
        }
        painter.drawPixmap(label.box.topLeft().toPoint(), picture(label));
    }
}

} // namespace marsview
