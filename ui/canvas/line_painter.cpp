#include "ui/canvas/line_painter.h"

#include <utility>

namespace marsview {
namespace {

void copyColors(unsigned from, unsigned to, const Viewport& size)
{
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
    glBlitFramebuffer(0, 0, size.width, size.height, 0, 0, size.width, size.height,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

} // namespace

LinePainter::LinePainter(std::unique_ptr<LineRenderer> lines, std::unique_ptr<DotRenderer> dots)
    : lines_(std::move(lines))
    , dots_(std::move(dots))
{}

Result<std::unique_ptr<LinePainter>> LinePainter::create()
{
    auto lines = LineRenderer::create();
    if (!lines) {
        return std::move(lines).error();
    }
    auto dots = DotRenderer::create();
    if (!dots) {
        return std::move(dots).error();
    }
    return std::unique_ptr<LinePainter>(
        new LinePainter(std::move(lines).value(), std::move(dots).value()));
}

void LinePainter::paint(const LineSets& sets,
                        TerrainRenderer& terrain,
                        TerrainPicture terrain_picture,
                        const LinePicture& picture,
                        unsigned frame_buffer)
{
    const Viewport& size = picture.viewport;
    const bool is_same = std::exchange(painted_of_, sets.revision()) == sets.revision() &&
                         terrain_picture == TerrainPicture::Same;
    is_kept_current_ = is_kept_current_ && is_same;
    if (is_kept_current_) {
        copyColors(kept_->id(), frame_buffer, size);
        glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer);
        glViewport(0, 0, size.width, size.height);
        return;
    }
    if (terrain_picture == TerrainPicture::Same) {
        terrain.present(frame_buffer);
    }
    sets.paint(terrain, {.lines = *lines_, .dots = *dots_}, picture, frame_buffer);
    // The second time, more are likely to follow.
    if (is_same && !sets.isEmpty()) {
        if (!kept_ || kept_->size().width != size.width || kept_->size().height != size.height) {
            kept_.reset(); // first, so that both are never held
            kept_.emplace(size);
        }
        copyColors(frame_buffer, kept_->id(), size);
        glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer);
        is_kept_current_ = true;
    }
}

} // namespace marsview
