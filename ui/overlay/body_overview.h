// Maps on their body as a small map of the whole body, for the overview map.
#pragma once

#include "core/base/job_monitor.h"
#include "core/session/body_terrain.h"
#include "core/view/terrain_look.h"
#include "ui/canvas/shown_layer.h"

#include <QImage>
#include <QPolygonF>

#include <cstddef>
#include <vector>

namespace marsview {

/// Longitude -180° to 180° and latitude 90° to -90°, pixel by pixel.
inline constexpr std::size_t kOverviewColumns = 440;
inline constexpr std::size_t kOverviewRows = 220;

/// The mean elevations of a map around each pixel, in meters, NaN outside the map. Some 10 ms, or
/// some 100 ms for a projected map of half the body. Any thread; empty if canceled.
std::vector<float> overviewHeights(const BodyTerrain& terrain, JobMonitor& monitor);

/// In degrees of longitude and latitude: x in [-180°, 180°], in pieces where it crosses 180°.
std::vector<QPolygonF> outlineOf(const Georeference& georeference);

/// The frame of the picture, in degrees.
SceneFrame overviewFrame();

/// What overviewHeights() made of a layer in the colors of the terrain. `equator_m` is the length
/// of the equator.
QImage overviewOf(const std::vector<float>& heights_m,
                  const ShownLayer& layer,
                  const TerrainLook& look,
                  double exaggeration,
                  double equator_m);

/// Darkens the night of a sun that stands over a place. `picture` is that of overviewFrame(), in
/// ARGB32_Premultiplied.
void darkenNight(QImage& picture, const GeographicPoint& subsolar, const Ellipsoid& ellipsoid);

} // namespace marsview
