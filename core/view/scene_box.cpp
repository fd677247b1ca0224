#include "core/view/scene_box.h"

#include <algorithm>

namespace marsview {

std::array<ScenePoint, 8> SceneBox::corners() const noexcept
{
    std::array<ScenePoint, 8> all{};
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i] = {(i & 1U) != 0 ? maximum.x : minimum.x, (i & 2U) != 0 ? maximum.y : minimum.y,
                  (i & 4U) != 0 ? maximum.z : minimum.z};
    }
    return all;
}

SceneBox united(const SceneBox& a, const SceneBox& b) noexcept
{
    return {{std::min(a.minimum.x, b.minimum.x), std::min(a.minimum.y, b.minimum.y),
             std::min(a.minimum.z, b.minimum.z)},
            {std::max(a.maximum.x, b.maximum.x), std::max(a.maximum.y, b.maximum.y),
             std::max(a.maximum.z, b.maximum.z)}};
}

SceneBox sceneBox(const SceneFrame& frame,
                  std::size_t columns,
                  std::size_t rows,
                  const HeightRange& range,
                  double exaggeration)
{
    const double last_column = static_cast<double>(columns) - 1.0;
    const double last_row = static_cast<double>(rows) - 1.0;
    SceneBox box{.minimum = frame.toScene({0.0, 0.0}, range.minimum_m * exaggeration),
                 .maximum = frame.toScene({0.0, 0.0}, range.maximum_m * exaggeration)};
    for (const GridPoint corner : {GridPoint{last_column, 0.0}, GridPoint{0.0, last_row},
                                   GridPoint{last_column, last_row}}) {
        const ScenePoint p = frame.toScene(corner, 0.0);
        box.minimum.x = std::min(box.minimum.x, p.x);
        box.minimum.y = std::min(box.minimum.y, p.y);
        box.maximum.x = std::max(box.maximum.x, p.x);
        box.maximum.y = std::max(box.maximum.y, p.y);
    }
    return box;
}

} // namespace marsview
