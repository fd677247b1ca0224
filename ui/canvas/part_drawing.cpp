#include "ui/canvas/part_drawing.h"

#include "ui/render/offscreen_picture.h"
#include "ui/render/supersampled_picture.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace marsview {

Result<bool> drawPart(const PartDrawing& drawing,
                      DrawRequest request,
                      const DrawStyle& style,
                      const QRect& part,
                      QImage& picture)
{
    request.viewport = {.width = picture.width(), .height = picture.height()};
    request.samples = drawing.has_antialiasing ? kSmoothSamples : 1;
    PixelArea area{.left = part.left(),
                   .bottom = picture.height() - part.bottom() - 1,
                   .width = part.width(),
                   .height = part.height()};
    if (drawing.is_supersampled) {
        request = supersampled(request, drawing.terrain, style.exaggeration);
        area = areaOfSamples(area);
    }
    request.part = area;
    const auto draw_lines = [&] {
        const CameraPose pose = request.pose();
        drawing.lines.draw(*drawing.line_renderer,
                           {.camera = pose,
                            .viewport = request.viewport,
                            .clip = drawing.terrain.clip(pose, style.exaggeration),
                            .pixels_per_point = request.viewport.height / drawing.view_height,
                            .part = request.part});
    };
    const PartTarget target{.first = picture.scanLine(part.top()) +
                                     static_cast<qsizetype>(3) * part.left(),
                            .line_length = picture.bytesPerLine()};
    std::vector<std::uint8_t> samples;
    PartTarget drawn_into = target;
    if (drawing.is_supersampled) {
        drawn_into.line_length = std::ptrdiff_t{3} * area.width;
        samples.resize(static_cast<std::size_t>(drawn_into.line_length) *
                       static_cast<std::size_t>(area.height));
        drawn_into.first = samples.data();
    }
    const auto drawn =
        drawPart(drawing.terrain, request, style, drawn_into,
                 drawing.line_renderer != nullptr ? std::function<void()>(draw_lines) : nullptr);
    if (!drawn) {
        return drawn.error();
    }
    if (drawn->is_complete && drawing.is_supersampled) {
        mergeSamples(samples, part.width(), part.height(), target);
    }
    return drawn->is_complete;
}

} // namespace marsview
