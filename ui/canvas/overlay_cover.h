// Whether an overlay of a view covers its picture.
#pragma once

#include <QPointF>

class QWidget;

namespace marsview {

/// A visible child is there that takes the mouse or hides the terrain (kHidesTerrain, map_mouse.h).
bool isOverOverlay(const QWidget& view, QPointF position);

} // namespace marsview
