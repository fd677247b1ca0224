// What the legend of a layer explains.
#pragma once

#include "ui/canvas/shown_layer.h"
#include "ui/overlay/legend.h"

namespace marsview {

/// The picture that a legend belongs to.
struct LegendPicture {
    const TerrainLook& look;
    double pixel_m = 1.0; // at the camera's target
    double exaggeration = 1.0;
    HeightUnit unit = HeightUnit::Meters;
    QString layer{}; // its name, where several layers are in the picture
};

LegendContent legendContent(const ShownLayer& layer, const LegendPicture& picture);

} // namespace marsview
