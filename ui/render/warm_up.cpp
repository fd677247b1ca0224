#include "ui/render/warm_up.h"

#include "core/base/check.h"
#include "core/view/navigation.h"
#include "ui/render/opengl/frame_buffer.h"
#include "ui/render/terrain_renderer.h"

#include <cstring>
#include <memory>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kSide = 65; // samples: some nodes
constexpr double kHeightM = 8.0;

// A dome, a meter a cell: level ground would be cut down to nothing.
Heightfield dome()
{
    Result<SampleGrid> samples = SampleGrid::create(SampleType::Float32, kSide, kSide);
    MARSVIEW_CHECK(samples.has_value());
    const auto share = [](std::size_t i) {
        const double t = static_cast<double>(i) / static_cast<double>(kSide - 1);
        return 4.0 * t * (1.0 - t);
    };
    for (std::size_t row = 0; row < kSide; ++row) {
        for (std::size_t column = 0; column < kSide; ++column) {
            const auto height = static_cast<float>(kHeightM * share(row) * share(column));
            std::memcpy(samples->rowData(row) + column * sizeof(height), &height, sizeof(height));
        }
    }
    const SampleStatistics statistics = samples->applyRule({}, 0, kSide);
    samples->clearVoids();
    return {std::make_shared<const SampleGrid>(std::move(samples).value()), statistics, {}};
}

} // namespace

void warmUp(TerrainRenderer& renderer)
{
    const auto heightfield = std::make_shared<const Heightfield>(dome());
    JobMonitor monitor;
    auto analysis = analyze(*heightfield, monitor);
    MARSVIEW_CHECK(analysis.has_value()); // it is never canceled
    constexpr double kMiddle = static_cast<double>(kSide - 1) / 2.0;
    const SceneFrame frame{.origin = {kMiddle, kMiddle}};
    constexpr double kSlopeMax = 1.0;
    const ColorRamp& ramp = defaultColorRamp({});
    renderer.setLayers({{.heightfield = heightfield,
                         .analysis = std::move(analysis).value(),
                         .frame = frame,
                         .ramp = &ramp,
                         .tint_range = {0.0, kHeightM},
                         .slope_range = {},
                         .slope_max = kSlopeMax,
                         .relief = std::make_shared<const ReliefTile>(makeReliefTile(
                             *heightfield, frame, wholeRelief(kSide, kSide), kSlopeMax))}});

    constexpr Viewport kSize{90, 60}; // no powers of two, for which there would be other code
    const FrameBuffer buffer(kSize);
    if (buffer.isComplete()) {
        const SceneBox box = sceneBox(frame, kSide, kSide, {0.0, kHeightM}, 1.0);
        DrawRequest request{.camera = homeCamera(box, kSize), .viewport = kSize};
        renderer.draw(request, {}, buffer.id());
        request.is_hasty = true;
        request.is_kept = true;
        renderer.draw(request, {}, buffer.id());
        request.scale = 0.5;
        renderer.draw(request, {}, buffer.id());
    }
    renderer.setLayers({});
}

} // namespace marsview
