// Lines on the ground as they cross the triangles that close a map at a pole.
#pragma once

#include "core/measure/measured_terrain.h"
#include "core/measure/terrain_path.h"

namespace marsview {

/// The part of `line` from begin_m to end_m, which lies between the outermost row and the pole, as
/// tracePath() does it: cut where it enters another triangle.
void traceCap(MeasuredTerrain& terrain,
              const CapTerrain& cap,
              const GroundLine& line,
              double begin_m,
              double end_m,
              PathVisitor& visitor);

} // namespace marsview
