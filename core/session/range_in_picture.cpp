#include "core/session/range_in_picture.h"

#include "core/base/check.h"

#include <algorithm>

namespace marsview {

namespace {

struct Probe {
    std::size_t index = 0; // of the map
    double height_m = 0.0;
};

// `cast` returns what a ray hits first, if anything.
template <typename Cast>
std::vector<std::optional<HeightRange>> rangesOf(std::size_t map_count,
                                                 const CameraPose& camera,
                                                 const Viewport& viewport,
                                                 const PictureProbes& probes,
                                                 const Cast& cast)
{
    MARSVIEW_CHECK(probes.columns >= 2 && probes.rows >= 2);
    std::vector<std::optional<HeightRange>> ranges(map_count);
    for (int row = 0; row < probes.rows; ++row) {
        for (int column = 0; column < probes.columns; ++column) {
            const PixelPoint pixel{viewport.width * (column / (probes.columns - 1.0)),
                                   viewport.height * (row / (probes.rows - 1.0))};
            const std::optional<Probe> probe = cast(pickRay(camera, viewport, pixel));
            if (!probe) {
                continue;
            }
            std::optional<HeightRange>& range = ranges[probe->index];
            if (!range) {
                range = HeightRange{.minimum_m = probe->height_m, .maximum_m = probe->height_m};
            }
            range->minimum_m = std::min(range->minimum_m, probe->height_m);
            range->maximum_m = std::max(range->maximum_m, probe->height_m);
        }
    }
    return ranges;
}

} // namespace

std::vector<std::optional<HeightRange>> rangesInPicture(const SceneSurface& ground,
                                                        const OrbitCamera& camera,
                                                        const Viewport& viewport,
                                                        double exaggeration,
                                                        const PictureProbes& probes)
{
    return rangesOf(ground.maps().size(), camera, viewport, probes,
                    [&](const Ray& ray) -> std::optional<Probe> {
                        const auto hit = ground.cast(ray, exaggeration);
                        return hit ? std::optional(Probe{hit->index, hit->height_m}) : std::nullopt;
                    });
}

std::vector<std::optional<HeightRange>> rangesInPicture(const BodyScene& scene,
                                                        const CameraPose& camera,
                                                        const Viewport& viewport,
                                                        double exaggeration,
                                                        const PictureProbes& probes)
{
    return rangesOf(
        scene.maps().size(), camera, viewport, probes, [&](const Ray& ray) -> std::optional<Probe> {
            const auto point = scene.cast(ray, exaggeration);
            return point ? std::optional(Probe{point->index, point->hit.height_m}) : std::nullopt;
        });
}

} // namespace marsview
