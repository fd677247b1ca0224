#include "ui/canvas/overlay_cover.h"

#include "ui/canvas/map_mouse.h"

#include <QWidget>

#include <algorithm>

namespace marsview {

bool isOverOverlay(const QWidget& view, QPointF position)
{
    const auto children = view.findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly);
    return std::any_of(children.begin(), children.end(), [&](const QWidget* child) {
        const bool hides_terrain = !child->testAttribute(Qt::WA_TransparentForMouseEvents) ||
                                   child->property(kHidesTerrain).toBool();
        return child->isVisible() && !child->isWindow() && hides_terrain &&
               child->geometry().contains(position.toPoint());
    });
}

} // namespace marsview
