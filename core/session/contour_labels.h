// Which index contours a picture of the terrain labels, and where.
#pragma once

#include "core/session/body_terrain.h"
#include "core/session/scene_surface.h"
#include "core/view/label_placement.h"
#include "core/view/terrain_look.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace marsview {

/// Every fifth contour is an index contour: it is drawn wider, and it has the labels.
inline constexpr int kIndexContour = 5;

/// A label that lies on a contour, along it.
struct ContourLabel {
    double elevation_m = 0.0;
    ScenePoint from{}; // points of the contour on either side of the label's middle, in the scene
    ScenePoint to{};
    PixelPoint middle{};    // in the picture
    double angle_rad = 0.0; // of the text, clockwise, within a quarter turn: never upside down
    LabelBox box{};         // around the turned text
};

struct ContourLabelOptions {
    Viewport viewport{};
    double pixels_per_point = 1.0;
    double exaggeration = 1.0;
    std::span<const LabelBox> obstacles = {};
};

/// The labels of a picture, at most some 40: apart from each other and from the obstacles, whole in
/// the picture, only where the contour is nearly straight along the text. Empty if `look` draws no
/// contours. `width_of` returns the width in pixels of the text of an elevation; the height is
/// `height_px`. Casts some thousand rays at full resolution: for a picture at rest.
std::vector<ContourLabel> contourLabels(const SceneSurface& ground,
                                        const OrbitCamera& camera,
                                        const TerrainLook& look,
                                        const ContourLabelOptions& options,
                                        double height_px,
                                        const std::function<double(double elevation_m)>& width_of);

/// The same for maps on their body. The labels' points are in the body-fixed frame.
std::vector<ContourLabel> contourLabels(const BodyScene& ground,
                                        const CameraPose& pose,
                                        const TerrainLook& look,
                                        const ContourLabelOptions& options,
                                        double height_px,
                                        const std::function<double(double elevation_m)>& width_of);

/// The same label in the picture of another camera; empty if it is not in it.
std::optional<ContourLabel>
labelIn(ContourLabel label, const CameraPose& pose, const Viewport& viewport);

} // namespace marsview
