// The picture of all layers of a scene, seen from above, for the overview map.
#pragma once

#include "core/session/scene_surface.h"
#include "core/view/terrain_look.h"
#include "ui/canvas/shown_layer.h"

#include <QImage>

#include <cstddef>
#include <vector>

namespace marsview {

/// Covers its columns × rows pixels from edge to edge, as `frame` places them in the scene.
struct OverviewPicture {
    QImage image;
    SceneFrame frame;
    std::size_t columns = 2;
    std::size_t rows = 2;
};

/// Layers are top first, in the colors of the terrain and on top of each other as in the view.
/// `ground` is made of their maps; neither is empty. A single layer keeps the grid of its raster;
/// several are put on one with north up. Some ms a layer.
OverviewPicture overviewPicture(const std::vector<ShownLayer>& layers,
                                const SceneSurface& ground,
                                const TerrainLook& look,
                                double exaggeration);

} // namespace marsview
