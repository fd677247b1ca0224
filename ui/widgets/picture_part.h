// A piece of an overlay in a saved picture.
#pragma once

#include <QImage>
#include <QPoint>

namespace marsview {

/// Which overlays a picture gets, as far as they are shown in the window.
struct PictureParts {
    bool has_legend = true;
    bool has_scale = true;  // compass and scale bar
    bool has_labels = true; // names, values of the graticule, elevations of contours
    bool has_marks = true;  // of measurements and annotations, from the camera of the window
};

struct PicturePart {
    QImage image; // with transparency
    QPoint at;    // of its upper left corner in the picture, in pixels
};

} // namespace marsview
