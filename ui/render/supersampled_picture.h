// Pictures with nine samples a pixel, for terrain that changes much from one pixel to the next.
#pragma once

#include "core/base/result.h"
#include "core/files/picture_file.h"
#include "ui/render/offscreen_picture.h"
#include "ui/render/terrain_renderer.h"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace marsview {

/// Samples along a side of a pixel.
inline constexpr int kSamplesPerSide = 3;

/// Rows of red, green and blue.
struct PixelRows {
    const std::uint8_t* first = nullptr;
    int width = 0;
    int height = 0;
    std::ptrdiff_t line_length = 0; // bytes from one row to the next
};

/// 99 in 100 color values of the terrain are at most this far from the mean of their neighbors on
/// both sides, in levels of 255, along rows or along columns: the larger of the two. Pixels of the
/// sky of `style`, and those next to it, do not count: there may be many of them. 0 where no pixel
/// has terrain on both sides.
int contrastOf(const PixelRows& picture, const DrawStyle& style);
int contrastOf(const Picture& picture, const DrawStyle& style);

/// Above this contrast a picture with four samples a pixel may be more than four levels off the
/// mean over its pixels (tests/bench/VIEW.md).
inline constexpr int kSmoothContrastMax = 12;

/// The request for the samples of the picture that `request` draws, or of its part.
DrawRequest
supersampled(const DrawRequest& request, TerrainRenderer& renderer, double exaggeration);
/// As drawPart() with a request from supersampled(), whose part must be set. The target gets the
/// mean of each pixel's samples, rounded.
Result<DrawReport> drawSupersampledPart(TerrainRenderer& renderer,
                                        const DrawRequest& samples,
                                        const DrawStyle& style,
                                        const PartTarget& target,
                                        const std::function<void()>& draw_over = {});

/// Draws a picture of any size block by block, each within some 50 ms in software. Use with the
/// renderer's context current; must not outlive the renderer. No frame buffer is kept between
/// blocks.
class SupersampledPicture {
public:
    /// `request` is that of a picture with one sample a pixel; its errors hold for each sample.
    SupersampledPicture(TerrainRenderer& renderer,
                        const DrawRequest& request,
                        const DrawStyle& style);

    /// Draws the next block. False, and nothing drawn, while pieces of it are missing: they are on
    /// their way. OutOfRange where the driver has no frame buffer of a block's size.
    Result<bool> drawNext();
    bool isDone() const noexcept { return next_ == count_; }
    /// Draws what is left of it and waits for what is missing.
    Status finish();

    /// Rows from the top.
    const Picture& colors() const noexcept { return colors_; }
    /// Of all blocks: nodes at the border of two count twice.
    const DrawReport& report() const noexcept { return report_; }

private:
    PixelArea block(int number) const;

    TerrainRenderer& renderer_;
    DrawRequest request_; // of the samples
    DrawStyle style_;
    Picture colors_;
    DrawReport report_;
    int columns_ = 0; // blocks
    int count_ = 0;
    int next_ = 0;
};

} // namespace marsview
