// A map with everything that was prepared for showing it.
#pragma once

#include "core/session/dataset.h"
#include "core/terrain/min_max_pyramid.h"
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

} // namespace marsview
