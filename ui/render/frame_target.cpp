#include "ui/render/frame_target.h"

#include "core/base/check.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace marsview {
namespace {

bool isSame(const Viewport& a, const Viewport& b)
{
    return a.width == b.width && a.height == b.height;
}

// Rows of OpenGL begin at the bottom, those of a picture at the top.
void turnOver(Picture& picture)
{
    const auto row = static_cast<std::ptrdiff_t>(picture.width) * 3;
    for (std::ptrdiff_t upper = 0, lower = picture.height - 1; upper < lower; ++upper, --lower) {
        std::swap_ranges(picture.rgb.begin() + upper * row, picture.rgb.begin() + (upper + 1) * row,
                         picture.rgb.begin() + lower * row);
    }
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

Picture FrameTarget::colors() const
{
    const Viewport& size = drawn().size();
    Picture colors{.width = size.width, .height = size.height, .rgb = {}};
    colors.rgb.resize(std::size_t{3} * static_cast<std::size_t>(size.width) *
                      static_cast<std::size_t>(size.height));
    glBindFramebuffer(GL_FRAMEBUFFER, drawn().id());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.width, size.height, GL_RGB, GL_UNSIGNED_BYTE, colors.rgb.data());
    turnOver(colors);
    return colors;
}

void FrameTarget::setColors(const Picture& colors)
{
    const Viewport& size = drawn().size();
    MARSVIEW_CHECK(colors.width == size.width && colors.height == size.height);
    Picture turned = colors;
    turnOver(turned);
    const GlTexture texture;
    const GlFramebuffer from;
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.width, size.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                 turned.rgb.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glBindTexture(GL_TEXTURE_2D, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, from.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
    copy(from.id(), size, drawn().id(), size, GL_COLOR_BUFFER_BIT);
}

} // namespace marsview
