// A piece of an overlay in a saved picture.
#pragma once

#include <QImage>
#include <QPoint>

namespace marsview {

struct PicturePart {
    QImage image; // with transparency
    QPoint at;    // of its upper left corner in the picture, in pixels
};

} // namespace marsview
