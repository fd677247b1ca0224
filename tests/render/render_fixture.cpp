#include "tests/render/render_fixture.h"

#include "core/view/exaggeration.h"
#include "core/view/tint_range.h"

#include <epoxy/gl.h>

namespace marsview::test {

DrawnMap::DrawnMap(const Heightfield& heightfield, const SceneFrame& map_frame)
    : field(std::make_shared<const Heightfield>(heightfield))
    , analysis(analyzed(*field))
    , frame(map_frame)
{}

TerrainLayer DrawnMap::layer() const
{
    const HeightRange range = field->range().value_or(HeightRange{});
    const double slope_max =
        16.0 / defaultExaggeration(box(1.0).extent_m(), range.maximum_m - range.minimum_m);
    return {.heightfield = field,
            .analysis = analysis,
            .frame = frame,
            .ramp = &defaultColorRamp(""),
            .tint_range = tintRange(analysis->means, range),
            .slope_range = {},
            .slope_max = slope_max,
            .relief = std::make_shared<const ReliefTile>(makeReliefTile(
                *field, frame, wholeRelief(field->columns(), field->rows()), slope_max))};
}

SceneBox DrawnMap::box(double exaggeration) const
{
    return sceneBox(frame, field->columns(), field->rows(), field->range().value_or(HeightRange{}),
                    exaggeration);
}

double DrawnMap::ground(double east_m, double north_m, double exaggeration) const
{
    return field->height(frame.toGrid({east_m, north_m, 0.0})) * exaggeration;
}

void RenderTest::SetUp()
{
    Result<std::unique_ptr<EglContext>> context = EglContext::create();
    if (!context) {
        GTEST_SKIP() << context.error().message;
    }
    context_ = std::move(context).value();
    renderer_ = TerrainRenderer::create({}).value();
}

void RenderTest::TearDown()
{
    renderer_.reset();
    context_.reset();
}

OffscreenPicture RenderTest::draw(const OrbitCamera& camera,
                                  const Viewport& viewport,
                                  const DetailTarget& detail,
                                  DrawStyle style,
                                  int samples)
{
    style.sky_top = kSkyColor;
    style.sky_bottom = kSkyColor;
    OffscreenPicture picture =
        drawOffscreen(
            *renderer_,
            {.camera = camera, .viewport = viewport, .detail = detail, .samples = samples}, style,
            samples > 1 ? DepthUse::No : DepthUse::Yes)
            .value();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    EXPECT_TRUE(picture.report.is_complete);
    return picture;
}

std::vector<std::uint8_t> readColors(const Viewport& size)
{
    std::vector<std::uint8_t> rgb(std::size_t{3} * static_cast<std::size_t>(size.width) *
                                  static_cast<std::size_t>(size.height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.width, size.height, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
    return rgb;
}

bool isSky(const Picture& picture, std::size_t pixel)
{
    return picture.rgb[3 * pixel] == kSkyColor.red &&
           picture.rgb[3 * pixel + 1] == kSkyColor.green &&
           picture.rgb[3 * pixel + 2] == kSkyColor.blue;
}

std::size_t skyPixels(const Picture& picture)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < picture.rgb.size() / 3; ++i) {
        count += isSky(picture, i) ? 1U : 0U;
    }
    return count;
}

} // namespace marsview::test
