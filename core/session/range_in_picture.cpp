#include "core/session/range_in_picture.h"

#include "core/base/check.h"

#include <algorithm>

namespace marsview {

std::vector<std::optional<HeightRange>> rangesInPicture(const SceneSurface& ground,
                                                        const OrbitCamera& camera,
                                                        const Viewport& viewport,
                                                        double exaggeration,
                                                        const PictureProbes& probes)
{
    MARSVIEW_CHECK(probes.columns >= 2 && probes.rows >= 2);
    std::vector<std::optional<HeightRange>> ranges(ground.maps().size());
    for (int row = 0; row < probes.rows; ++row) {
        for (int column = 0; column < probes.columns; ++column) {
            const PixelPoint pixel{viewport.width * (column / (probes.columns - 1.0)),
                                   viewport.height * (row / (probes.rows - 1.0))};
            const auto hit = ground.cast(pickRay(camera, viewport, pixel), exaggeration);
            if (!hit) {
                continue;
            }
            std::optional<HeightRange>& range = ranges[hit->index];
            if (!range) {
                range = HeightRange{.minimum_m = hit->height_m, .maximum_m = hit->height_m};
            }
            range->minimum_m = std::min(range->minimum_m, hit->height_m);
            range->maximum_m = std::max(range->maximum_m, hit->height_m);
        }
    }
    return ranges;
}

} // namespace marsview
