// Drawing without a window, for tests.
#pragma once

#include "tests/support/make_terrain.h"
#include "ui/render/offscreen_picture.h"
#include "ui/render/opengl/egl_context.h"
#include "ui/render/terrain_renderer.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace marsview::test {

/// A map that can be drawn. Copies share the large data.
struct DrawnMap {
    std::shared_ptr<const Heightfield> field;
    std::shared_ptr<const SurfaceAnalysis> analysis;
    SceneFrame frame;

    DrawnMap(const Heightfield& heightfield, const SceneFrame& map_frame);

    TerrainLayer layer() const;
    SceneBox box(double exaggeration) const;
    /// Height of the terrain in scene meters; NaN outside the map.
    double ground(double east_m, double north_m, double exaggeration) const;
};

/// Colors that no terrain has.
constexpr Rgb8 kSkyColor{255, 0, 255};

/// Tests with a context and a renderer. Skipped with a message if OpenGL is missing.
class RenderTest : public testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    /// Under a sky of kSkyColor. Checks that OpenGL reports no errors. With more than one sample
    /// per pixel there are no depths.
    OffscreenPicture draw(const OrbitCamera& camera,
                          const Viewport& viewport,
                          const DetailTarget& detail,
                          DrawStyle style,
                          int samples = 1);

    std::unique_ptr<EglContext> context_;       // outlives the renderer
    std::unique_ptr<TerrainRenderer> renderer_; // null only if tests are skipped
};

/// The colors in the bound frame buffer: red, green, blue, rows from the bottom.
std::vector<std::uint8_t> readColors(const Viewport& size);
bool isSky(const Picture& picture, std::size_t pixel);
std::size_t skyPixels(const Picture& picture);

} // namespace marsview::test
