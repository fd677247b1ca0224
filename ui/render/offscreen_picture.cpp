#include "ui/render/offscreen_picture.h"

#include "ui/render/opengl/frame_buffer.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <fmt/format.h>
#include <limits>

namespace marsview {
namespace {

std::size_t pixelCount(const Viewport& size)
{
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

Error noFrameBuffer(const Viewport& size)
{
    return {ErrorCode::OutOfRange,
            fmt::format("{} × {} pixels: this driver has no frame buffer of that size", size.width,
                        size.height)};
}

// OpenGL's rows begin at the bottom.
template <typename T>
std::vector<T> upsideDown(const std::vector<T>& rows, std::size_t row_length)
{
    std::vector<T> turned;
    turned.reserve(rows.size());
    for (std::size_t end = rows.size(); end > 0; end -= row_length) {
        turned.insert(turned.end(), rows.begin() + static_cast<std::ptrdiff_t>(end - row_length),
                      rows.begin() + static_cast<std::ptrdiff_t>(end));
    }
    return turned;
}

} // namespace

int offscreenSideMax()
{
    GLint side_max = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &side_max);
    return side_max;
}

Result<DrawReport> drawPart(TerrainRenderer& renderer,
                            const DrawRequest& request,
                            const DrawStyle& style,
                            const PartTarget& target,
                            const std::function<void()>& draw_over)
{
    const Viewport size{.width = request.part->width, .height = request.part->height};
    const FrameBuffer drawn(size, request.samples);
    const FrameBuffer merged(size);
    if (!drawn.isComplete() || !merged.isComplete()) {
        return noFrameBuffer(size);
    }
    DrawRequest straight = request;
    straight.samples = 1; // the target has them
    DrawReport report = renderer.draw(straight, style, drawn.id());
    if (report.is_complete) {
        if (draw_over) {
            glBindFramebuffer(GL_FRAMEBUFFER, drawn.id());
            draw_over();
        }
        glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn.id());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, merged.id());
        glBlitFramebuffer(0, 0, size.width, size.height, 0, 0, size.width, size.height,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_FRAMEBUFFER, merged.id());
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        const auto row_length = static_cast<std::size_t>(size.width) * 3;
        std::vector<std::uint8_t> rgb(pixelCount(size) * 3);
        glReadPixels(0, 0, size.width, size.height, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
        for (int y = 0; y < size.height; ++y) {
            const auto row = static_cast<std::size_t>(size.height - 1 - y);
            std::memcpy(target.first + y * target.line_length, rgb.data() + row * row_length,
                        row_length);
        }
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return report;
}

Result<OffscreenPicture> drawOffscreen(TerrainRenderer& renderer,
                                       const DrawRequest& request,
                                       const DrawStyle& style,
                                       DepthUse depth_use)
{
    const Viewport& size = request.viewport;
    const int side_max = offscreenSideMax();
    if (std::max(size.width, size.height) > side_max) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("{} × {} pixels: this driver draws at most {} a side", size.width,
                                 size.height, side_max)};
    }
    const FrameBuffer frame(size);
    if (!frame.isComplete()) {
        return noFrameBuffer(size);
    }
    OffscreenPicture picture;
    picture.report = renderer.drawComplete(request, style, frame.id());
    picture.colors.width = size.width;
    picture.colors.height = size.height;
    std::vector<std::uint8_t> rgb(pixelCount(size) * 3);
    glBindFramebuffer(GL_FRAMEBUFFER, frame.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.width, size.height, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
    const auto width = static_cast<std::size_t>(size.width);
    picture.colors.rgb = upsideDown(rgb, width * 3);
    if (depth_use == DepthUse::Yes && request.samples <= 1 && request.scale == 1.0) {
        std::vector<float> window_depths(pixelCount(size));
        glReadPixels(0, 0, size.width, size.height, GL_DEPTH_COMPONENT, GL_FLOAT,
                     window_depths.data());
        const ClipRange clip = renderer.clip(request.pose(), style.exaggeration);
        std::vector<double> depths(window_depths.size());
        std::transform(window_depths.begin(), window_depths.end(), depths.begin(), [&](float d) {
            if (d >= 1.0F) {
                return std::numeric_limits<double>::infinity();
            }
            const double z = 2.0 * static_cast<double>(d) - 1.0;
            return 2.0 * clip.near_m * clip.far_m /
                   (clip.far_m + clip.near_m - z * (clip.far_m - clip.near_m));
        });
        picture.depths_m = upsideDown(depths, width);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return picture;
}

} // namespace marsview
