// Drawing a part of a picture of any size, with the lines of a view.
#pragma once

#include "core/base/result.h"
#include "ui/canvas/line_sets.h"
#include "ui/render/line_renderer.h"
#include "ui/render/terrain_renderer.h"

#include <QImage>
#include <QRect>

#include <cstdint>

namespace marsview {

/// Whether a picture shows the lines on the terrain.
enum class PictureLines : std::uint8_t { Omitted, Drawn };

struct PartOptions {
    PictureLines lines = PictureLines::Drawn;
    bool is_supersampled = false; // see ui/render/supersampled_picture.h
};

struct PartDrawing {
    TerrainRenderer& terrain;
    LineRenderer* line_renderer = nullptr; // null to omit lines
    const LineSets& lines;
    double view_height = 1.0; // in points, of the view that has lines as wide
    bool has_antialiasing = true;
    bool is_supersampled = false;
};

/// Draws `part` of the picture that the camera of `request` has into `picture`, RGB888 of the whole
/// size. False, and nothing drawn, while pieces of it are missing: they are on their way. With the
/// graphics context current.
Result<bool> drawPart(const PartDrawing& drawing,
                      DrawRequest request,
                      const DrawStyle& style,
                      const QRect& part,
                      QImage& picture);

} // namespace marsview
