// A map as the view is given it.
#pragma once

#include "core/session/loaded_map.h"
#include "core/view/color_ramp.h"

namespace marsview {

struct ShownLayer {
    LoadedMap map;
    const ColorRamp* ramp = nullptr; // one of colorRamps(); never null
};

} // namespace marsview
