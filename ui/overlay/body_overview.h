// Maps on their body as a small map of the whole body or of the surroundings of a pole, for the
// overview map.
#pragma once

#include "core/base/job_monitor.h"
#include "core/globe/polar_plane.h"
#include "core/session/body_terrain.h"
#include "core/view/terrain_look.h"
#include "ui/canvas/shown_layer.h"

#include <QImage>
#include <QPolygonF>
#include <QSize>

#include <cstddef>
#include <vector>

namespace marsview {

/// Longitude -180° to 180° and latitude 90° to -90°, pixel by pixel.
inline constexpr std::size_t kOverviewColumns = 440;
inline constexpr std::size_t kOverviewRows = 220;
/// Around a pole: twice as many as the overview map has on a screen with one pixel a point.
inline constexpr std::size_t kPolarOverviewSide = 320;

/// The mean elevations of a map around each pixel, in meters, NaN outside the map. Some 10 ms, or
/// some 100 ms for a projected map of half the body. Any thread; empty if canceled.
std::vector<float> overviewHeights(const BodyTerrain& terrain,
                                   JobMonitor& monitor,
                                   BodyOverview overview = BodyOverview::Whole);

/// In the scene of the picture. Of the whole body in pieces where it crosses 180°; around a pole
/// without what is on the other hemisphere, and without edges next to the pole that a map closes
/// at.
std::vector<QPolygonF> outlineOf(const Georeference& georeference,
                                 BodyOverview overview = BodyOverview::Whole);

/// The size of the picture in pixels, and its frame: in degrees of longitude and latitude, or on
/// the PolarPlane.
QSize overviewSize(BodyOverview overview);
SceneFrame overviewFrame(BodyOverview overview = BodyOverview::Whole);

/// What overviewHeights() made of a layer in the colors of the terrain.
QImage overviewOf(const std::vector<float>& heights_m,
                  BodyOverview overview,
                  const ShownLayer& layer,
                  const TerrainLook& look,
                  double exaggeration,
                  double equatorial_m);

/// Darkens the night of a sun that stands over a place. `picture` is that of overviewFrame(), in
/// ARGB32_Premultiplied. Some 10 ms.
void darkenNight(QImage& picture,
                 BodyOverview overview,
                 const GeographicPoint& subsolar,
                 const Ellipsoid& ellipsoid);

} // namespace marsview
