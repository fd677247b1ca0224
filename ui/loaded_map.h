// A map with everything that was prepared for showing it.
#pragma once

#include "core/session/dataset.h"
#include "core/terrain/min_max_pyramid.h"
#include "core/view/color_ramp.h"
#include "ui/render/terrain_draw_data.h"

#include <memory>

namespace marsview {

/// All null, or none. Copies share.
struct LoadedMap {
    std::shared_ptr<const Dataset> dataset;
    std::shared_ptr<const MinMaxPyramid> pyramid;
    std::shared_ptr<const TerrainDrawData> draw_data;

    explicit operator bool() const noexcept { return dataset != nullptr; }
};

/// A map as it is to be drawn.
struct ShownLayer {
    LoadedMap map;
    const ColorRamp* ramp = nullptr; // one of colorRamps(); never null
};

} // namespace marsview
