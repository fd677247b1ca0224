#include "ui/pictures/picture_scene.h"

#include <QPainter>
#include <QWidget>

#include <iterator>
#include <utility>

namespace marsview {

// The field of view is vertical: equal heights of the picture have equal meters per pixel.
std::vector<PicturePart> PictureScene::platesFor(const QWidget& view,
                                                 const std::vector<QWidget*>& plates,
                                                 const QSize& picture)
{
    const double scale = static_cast<double>(picture.height()) / view.height();
    const int more_width = qRound(picture.width() / scale) - view.width();
    std::vector<PicturePart> made;
    for (QWidget* plate : plates) {
        if (!plate->isVisible()) {
            continue;
        }
        QImage image((QSizeF(plate->size()) * scale).toSize(), QImage::Format_ARGB32_Premultiplied);
        image.setDevicePixelRatio(scale);
        image.fill(Qt::transparent);
        QPainter painter(&image);
        plate->render(&painter, {}, {}, QWidget::DrawChildren);
        painter.end();
        image.setDevicePixelRatio(1.0);
        const bool is_at_right = plate->geometry().center().x() > view.width() / 2;
        const QPointF at = plate->pos() + QPoint(is_at_right ? more_width : 0, 0);
        made.push_back({.image = std::move(image), .at = (at * scale).toPoint()});
    }
    return made;
}

std::vector<QRect> PictureScene::placesOf(const std::vector<PicturePart>& parts)
{
    std::vector<QRect> places;
    places.reserve(parts.size());
    for (const PicturePart& part : parts) {
        places.emplace_back(part.at, part.image.size());
    }
    return places;
}

void PictureScene::append(std::vector<PicturePart>& parts, std::vector<PicturePart> more)
{
    std::move(more.begin(), more.end(), std::back_inserter(parts));
}

} // namespace marsview
