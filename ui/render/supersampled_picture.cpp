#include "ui/render/supersampled_picture.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// Half a pixel, if the store has room for that many texels and for those of the next picture.
constexpr double kTexelSamples = 0.5 * kSamplesPerSide;

// Of the picture, per side: some 600 samples.
constexpr int kBlockSide = 192;

// Of absolute values up to 255; that of which one in a hundred is above.
class Levels {
public:
    void add(int level) { ++counts_.at(static_cast<std::size_t>(level)); }
    int exceededByOneInHundred() const
    {
        const std::size_t all = std::accumulate(counts_.begin(), counts_.end(), std::size_t{0});
        std::size_t above = 0;
        for (std::size_t level = counts_.size(); level-- > 0;) {
            above += counts_[level];
            if (above * 100 > all) {
                return static_cast<int>(level);
            }
        }
        return 0;
    }

private:
    std::array<std::size_t, 256> counts_{};
};

int blocksAlong(int pixels)
{
    return (pixels + kBlockSide - 1) / kBlockSide;
}

PixelArea areaOfSamples(const PixelArea& area)
{
    return {.left = area.left * kSamplesPerSide,
            .bottom = area.bottom * kSamplesPerSide,
            .width = area.width * kSamplesPerSide,
            .height = area.height * kSamplesPerSide};
}

// The means of the samples of each of width × height pixels, rounded.
void mergeSamples(const std::vector<std::uint8_t>& samples,
                  int width,
                  int height,
                  const PartTarget& target)
{
    constexpr auto kSide = static_cast<std::size_t>(kSamplesPerSide);
    constexpr unsigned kSamples = kSamplesPerSide * kSamplesPerSide;
    const auto columns = static_cast<std::size_t>(width);
    const std::size_t sample_row = 3 * kSide * columns;
    std::vector<unsigned> sums(3 * columns);
    for (std::ptrdiff_t y = 0; y < height; ++y) {
        std::fill(sums.begin(), sums.end(), 0U);
        for (std::size_t line = 0; line < kSide; ++line) {
            const std::uint8_t* from =
                samples.data() + (static_cast<std::size_t>(y) * kSide + line) * sample_row;
            for (std::size_t x = 0; x < kSide * columns; ++x, from += 3) {
                unsigned* sum = sums.data() + 3 * (x / kSide);
                sum[0] += from[0];
                sum[1] += from[1];
                sum[2] += from[2];
            }
        }
        std::transform(sums.begin(), sums.end(), target.first + y * target.line_length,
                       [](unsigned sum) {
                           return static_cast<std::uint8_t>((2 * sum + kSamples) / (2 * kSamples));
                       });
    }
}

// Of the pixels of a row, which ones are not of the sky's color there.
std::vector<bool> terrainIn(const PixelRows& picture, int y, const DrawStyle& style)
{
    constexpr double kRounding = 1.0;
    const double up = 1.0 - (y + 0.5) / picture.height;
    const auto mixed = [up](std::uint8_t bottom, std::uint8_t top) {
        return bottom + up * (top - bottom);
    };
    const std::array<double, 3> sky{mixed(style.sky_bottom.red, style.sky_top.red),
                                    mixed(style.sky_bottom.green, style.sky_top.green),
                                    mixed(style.sky_bottom.blue, style.sky_top.blue)};
    std::vector<bool> is_terrain(static_cast<std::size_t>(picture.width));
    const std::uint8_t* pixel = picture.first + y * picture.line_length;
    for (std::size_t x = 0; x < is_terrain.size(); ++x, pixel += 3) {
        is_terrain[x] = std::abs(pixel[0] - sky[0]) > kRounding ||
                        std::abs(pixel[1] - sky[1]) > kRounding ||
                        std::abs(pixel[2] - sky[2]) > kRounding;
    }
    return is_terrain;
}

} // namespace

int contrastOf(const PixelRows& picture, const DrawStyle& style)
{
    if (picture.width < 3 || picture.height < 3) {
        return 0;
    }
    const auto deviation = [](const std::uint8_t* at, std::ptrdiff_t step) {
        return std::abs(2 * at[0] - at[-step] - at[step]) / 2;
    };
    Levels along_rows;
    Levels along_columns;
    std::vector<bool> above = terrainIn(picture, 0, style);
    std::vector<bool> here = terrainIn(picture, 1, style);
    for (int y = 1; y + 1 < picture.height; ++y) {
        std::vector<bool> below = terrainIn(picture, y + 1, style);
        const std::uint8_t* row = picture.first + y * picture.line_length;
        for (std::size_t x = 1; x + 1 < here.size(); ++x) {
            if (!here[x]) {
                continue;
            }
            const std::uint8_t* pixel = row + 3 * x;
            if (here[x - 1] && here[x + 1]) {
                for (const std::uint8_t* at = pixel; at < pixel + 3; ++at) {
                    along_rows.add(deviation(at, 3));
                }
            }
            if (above[x] && below[x]) {
                for (const std::uint8_t* at = pixel; at < pixel + 3; ++at) {
                    along_columns.add(deviation(at, picture.line_length));
                }
            }
        }
        above = std::exchange(here, std::move(below));
    }
    return std::max(along_rows.exceededByOneInHundred(), along_columns.exceededByOneInHundred());
}

int contrastOf(const Picture& picture, const DrawStyle& style)
{
    return contrastOf({.first = picture.rgb.data(),
                       .width = picture.width,
                       .height = picture.height,
                       .line_length = std::ptrdiff_t{3} * picture.width},
                      style);
}

DrawRequest supersampled(const DrawRequest& request, TerrainRenderer& renderer, double exaggeration)
{
    DrawRequest samples = request;
    samples.viewport.width *= kSamplesPerSide;
    samples.viewport.height *= kSamplesPerSide;
    samples.pixels_shown_as_one *= kSamplesPerSide;
    samples.samples = 1;
    samples.scale = 1.0;
    samples.is_kept = false;
    samples.part.reset(); // the same texels in all parts
    samples.detail.texel_px = kTexelSamples * request.detail.texel_px;
    if (!renderer.hasRoomFor(samples, exaggeration)) {
        samples.detail.texel_px = kSamplesPerSide * request.detail.texel_px; // the same relief
    }
    if (request.part) {
        samples.part = areaOfSamples(*request.part);
    }
    return samples;
}

Result<DrawReport> drawSupersampledPart(TerrainRenderer& renderer,
                                        const DrawRequest& samples,
                                        const DrawStyle& style,
                                        const PartTarget& target,
                                        const std::function<void()>& draw_over)
{
    const PixelArea& part = *samples.part;
    const auto row = std::ptrdiff_t{3} * part.width;
    std::vector<std::uint8_t> rgb(static_cast<std::size_t>(row * part.height));
    Result<DrawReport> drawn =
        drawPart(renderer, samples, style, {.first = rgb.data(), .line_length = row}, draw_over);
    if (drawn && drawn->is_complete) {
        mergeSamples(rgb, part.width / kSamplesPerSide, part.height / kSamplesPerSide, target);
    }
    return drawn;
}

SupersampledPicture::SupersampledPicture(TerrainRenderer& renderer,
                                         const DrawRequest& request,
                                         const DrawStyle& style)
    : renderer_(renderer)
    , request_(supersampled(request, renderer, style.exaggeration))
    , style_(style)
    , colors_{.width = request.viewport.width, .height = request.viewport.height, .rgb = {}}
    , columns_(blocksAlong(colors_.width))
    , count_(columns_ * blocksAlong(colors_.height))
{
    colors_.rgb.resize(std::size_t{3} * static_cast<std::size_t>(colors_.width) *
                       static_cast<std::size_t>(colors_.height));
}

PixelArea SupersampledPicture::block(int number) const
{
    PixelArea area{.left = number % columns_ * kBlockSide,
                   .bottom = number / columns_ * kBlockSide,
                   .width = kBlockSide,
                   .height = kBlockSide};
    area.width = std::min(area.width, colors_.width - area.left);
    area.height = std::min(area.height, colors_.height - area.bottom);
    return area;
}

Result<bool> SupersampledPicture::drawNext()
{
    const PixelArea area = block(next_);
    request_.part = areaOfSamples(area);
    const auto line_length = std::ptrdiff_t{3} * colors_.width;
    const Result<DrawReport> drawn = drawSupersampledPart(
        renderer_, request_, style_,
        {.first = colors_.rgb.data() + (colors_.height - area.bottom - area.height) * line_length +
                  std::ptrdiff_t{3} * area.left,
         .line_length = line_length});
    if (!drawn) {
        return drawn.error();
    }
    if (!drawn->is_complete) {
        return false;
    }
    report_.triangle_count += drawn->triangle_count;
    report_.node_count += drawn->node_count;
    report_.error_px = std::max(report_.error_px, drawn->error_px / kSamplesPerSide);
    if (!report_.problem) {
        report_.problem = drawn->problem;
    }
    ++next_;
    return true;
}

Status SupersampledPicture::finish()
{
    while (!isDone()) {
        const Result<bool> drawn = drawNext();
        if (!drawn) {
            return drawn.error();
        }
        if (!*drawn) {
            renderer_.waitForPending();
        }
    }
    return Done{};
}

} // namespace marsview
