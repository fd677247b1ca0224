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

SceneBox boxAround(const SceneFrame& frame,
                   GridPoint first,
                   GridPoint last,
                   const HeightRange& range,
                   double exaggeration)
{
    SceneBox box{.minimum = frame.toScene(first, range.minimum_m * exaggeration),
                 .maximum = frame.toScene(first, range.maximum_m * exaggeration)};
    for (const GridPoint corner :
         {GridPoint{last.column, first.row}, GridPoint{first.column, last.row}, last}) {
        const ScenePoint p = frame.toScene(corner, 0.0);
        box.minimum.x = std::min(box.minimum.x, p.x);
        box.minimum.y = std::min(box.minimum.y, p.y);
        box.maximum.x = std::max(box.maximum.x, p.x);
        box.maximum.y = std::max(box.maximum.y, p.y);
    }
    return box;
}

SceneBox sceneBox(const SceneFrame& frame,
                  std::size_t columns,
                  std::size_t rows,
                  const HeightRange& range,
                  double exaggeration)
{
    return boxAround(frame, {0.0, 0.0},
                     {static_cast<double>(columns) - 1.0, static_cast<double>(rows) - 1.0}, range,
                     exaggeration);
}

} // namespace marsview
