// The terrain of a globe as it is shown: of all layers on their body, raised by the exaggeration.
#pragma once

#include "core/globe/body_camera.h"
#include "core/globe/body_navigation.h"
#include "core/session/body_terrain.h"
#include "ui/render/terrain_renderer.h"

#include <optional>
#include <vector>

namespace marsview {

/// Places and heights of the scene are exaggerated, elevations on grids are not. GUI thread.
struct GlobeGround {
    BodyScene scene;
    DrawStyle style;

    bool isEmpty() const noexcept { return scene.isEmpty(); }
    /// Not of an empty scene; nor are those that follow.
    const Ellipsoid& ellipsoid() const { return scene.ellipsoid(); }
    /// NaN without terrain.
    double height(const GeographicPoint& place) const
    {
        return scene.height(place) * style.exaggeration;
    }
    /// The terrain at a place, or the ellipsoid without terrain there.
    double heightOrZero(const GeographicPoint& place) const;
    std::optional<BodyScenePoint> cast(const Ray& ray) const
    {
        return scene.cast(ray, style.exaggeration);
    }
    /// Where a layer has no data, the place behind its hole: on the ellipsoid raised to elevation
    /// 0, or to the lowest or highest terrain. Its height is NaN. For rays that meet no terrain.
    /// Not of an empty scene.
    std::optional<BodyScenePoint> voidOn(const Ray& ray) const;
    /// The terrain straight below or above a place; its distance is that from `eye`. Nothing for an
    /// empty scene.
    std::optional<BodyScenePoint> below(const ScenePoint& place, const ScenePoint& eye) const;
    /// Of all layers.
    BodyLimits limits() const;
    BodyLimits limitsOf(const BodyTerrain& map) const;
    /// All over a layer, and over all of them.
    std::vector<ScenePoint> placesOf(const BodyTerrain& map) const;
    std::vector<ScenePoint> places() const;
};

} // namespace marsview
