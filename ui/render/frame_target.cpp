#include "ui/render/frame_target.h"

#include "core/base/check.h"

#include <algorithm>
#include <array>
#include <utility>

namespace marsview {
namespace {

bool isSame(const Viewport& a, const Viewport& b)
{
    return a.width == b.width && a.height == b.height;
}

void copy(
    GLuint from, const Viewport& from_size, GLuint to, const Viewport& to_size, GLbitfield mask)
{
    const bool is_smoothed = mask == GL_COLOR_BUFFER_BIT && !isSame(from_size, to_size);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
    glBlitFramebuffer(0, 0, from_size.width, from_size.height, 0, 0, to_size.width, to_size.height,
                      mask, is_smoothed ? GL_LINEAR : GL_NEAREST);
}

} // namespace

void FrameTarget::begin(const Viewport& size, int samples)
{
    if (!drawn_ || !isSame(drawn_->size(), size) || drawn_->samples() != samples) {
        drawn_.reset(); // first, so that both are never held
        drawn_.emplace(size, samples);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_->id());
}

void FrameTarget::end()
{
    if (drawn_->samples() > 1) {
        // Merged once, so that the many samples need not be kept.
        FrameBuffer merged(drawn_->size());
        for (const GLbitfield part :
             std::array<GLbitfield, 2>{GL_COLOR_BUFFER_BIT, GL_DEPTH_BUFFER_BIT}) {
            copy(drawn_->id(), drawn_->size(), merged.id(), merged.size(), part);
        }
        drawn_ = std::move(merged);
    }
}

void FrameTarget::present(GLuint target, const Viewport& target_size)
{
    MARSVIEW_CHECK(drawn_.has_value() && drawn_->samples() <= 1);
    copy(drawn_->id(), drawn_->size(), target, target_size, GL_COLOR_BUFFER_BIT);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
}

void FrameTarget::presentDepth(GLuint target, const Viewport& target_size, const PixelArea& area)
{
    MARSVIEW_CHECK(drawn_.has_value() && drawn_->samples() <= 1);
    glEnable(GL_SCISSOR_TEST);
    glScissor(area.left, area.bottom, area.width, area.height);
    copy(drawn_->id(), drawn_->size(), target, target_size, GL_DEPTH_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
}

const FrameBuffer& FrameTarget::drawn() const
{
    MARSVIEW_CHECK(drawn_.has_value() && drawn_->samples() <= 1);
    return *drawn_;
}

} // namespace marsview
