#include "ui/canvas/part_drawing.h"

#include "ui/render/offscreen_picture.h"
#include "ui/render/supersampled_picture.h"

#include <functional>

namespace marsview {

Result<bool> drawPart(const PartDrawing& drawing,
                      DrawRequest request,
                      const DrawStyle& style,
                      const QRect& part,
                      QImage& picture)
{
    request.viewport = {.width = picture.width(), .height = picture.height()};
    request.samples = drawing.has_antialiasing ? kSmoothSamples : 1;
    request.part = PixelArea{.left = part.left(),
                             .bottom = picture.height() - part.bottom() - 1,
                             .width = part.width(),
                             .height = part.height()};
    if (drawing.is_supersampled) {
        request = supersampled(request, drawing.terrain, style.exaggeration);
    }
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
    const std::function<void()> draw_over =
        drawing.line_renderer != nullptr ? std::function<void()>(draw_lines) : nullptr;
    const Result<DrawReport> drawn =
        drawing.is_supersampled
            ? drawSupersampledPart(drawing.terrain, request, style, target, draw_over)
            : drawPart(drawing.terrain, request, style, target, draw_over);
    if (!drawn) {
        return drawn.error();
    }
    return drawn->is_complete;
}

} // namespace marsview
