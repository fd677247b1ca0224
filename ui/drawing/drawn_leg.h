// The lines between the points of items, as they are drawn.
#pragma once

#include "ui/drawing/draped_geometry.h"

#include <QPointF>
#include <QRectF>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace marsview {

class DrawingScene;

/// A leg of an item as it is drawn.
struct DrawnLeg {
    std::uint32_t item = 0;
    std::size_t index = 0; // of the vertex at its beginning
    double begin_m = 0.0;  // along the item
    DrapedRun run;
};

/// The leg that is nearest to a position of the view, the last one of equal ones; null if none is
/// within `reach` points.
const DrawnLeg* legNear(const std::vector<DrawnLeg>& legs,
                        const DrawingScene& scene,
                        QPointF position,
                        double reach);

/// Boxes in the view that together cover the legs that are `wanted`. Of very many legs, some.
std::vector<QRectF> boxesAround(const std::vector<DrawnLeg>& legs,
                                const DrawingScene& scene,
                                const std::function<bool(const DrawnLeg&)>& wanted);

} // namespace marsview
