// The picture that items are drawn on: the flat map, or the globe.
#pragma once

#include "core/annotations/drawn_vertex.h"
#include "core/measure/measured_terrain.h"
#include "core/session/map.h"
#include "core/terrain/ray_cast.h"
#include "core/vector/feature_index.h"
#include "ui/canvas/line_sets.h"
#include "ui/canvas/place_tool.h"
#include "ui/canvas/tool.h"
#include "ui/canvas/view_projection.h"
#include "ui/drawing/dot_index.h"

#include <QObject>
#include <QPointF>
#include <QWidget>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// The plane in which features of vector files have their places: that of the scene of a map.
struct ScenePlan {
    std::shared_ptr<const Map> map; // coordinates without a CRS are in its CRS
    Georeference georeference;      // has the scene
    bool has_equator_scale = false; // lengths along parallels are those on the equator
};

/// Places are those of the scene that the view draws: x east, y north, z up on the flat map, the
/// body-fixed frame on the globe, exaggerated in both. Positions are those of the view, in points.
/// GUI thread; reads no samples from disk.
class DrawingScene : public QObject {
    Q_OBJECT

public:
    using QObject::QObject;

    virtual const QWidget& view() const = 0;
    /// The topmost map; null if none is shown. The rest is only for a scene with a map.
    virtual std::shared_ptr<const Map> map() const = 0;
    virtual CameraPose camera() const = 0;
    virtual double exaggeration() const = 0;
    Viewport viewport() const { return viewportOf(view()); }

    /// On the terrain. Empty outside it. `terrain` is that of map().
    virtual std::optional<ScenePoint> onTerrain(const MeasuredTerrain& terrain,
                                                GroundPosition position) const = 0;
    /// Nothing behind the eye or the horizon.
    virtual std::optional<QPointF> positionOf(const ScenePoint& place) const = 0;
    /// Terrain in front of a place hides it.
    virtual bool isHidden(const ScenePoint& place) const = 0;
    /// The body itself hides it. Lines end there.
    virtual bool isBehindHorizon(const ScenePoint& place) const = 0;
    /// Nothing of a line on the terrain between two places is in the picture, as far as can be said
    /// from its ends and its length. An end may lack terrain.
    virtual bool isOutOfSight(const std::optional<ScenePoint>& from,
                              const std::optional<ScenePoint>& to,
                              double length_m) const = 0;
    /// Places of a DotIndex have their z divided by this, so that they stay as the exaggeration
    /// changes; 1 where that is not possible: then mapsChanged() follows, too.
    virtual double dotExaggeration() const = 0;
    virtual DotSight dotSight(const QRectF& area) const = 0;

    /// A place on the terrain, with the map that is seen there.
    struct Place {
        DrawnVertex vertex;
        std::shared_ptr<const Map> map;
    };
    virtual std::optional<Place> placeAt(QPointF position) const = 0;
    /// At the crosshair, or under the stylus of a device.
    virtual std::optional<Place> placeRead() const = 0;
    virtual bool isReadByStylus() const = 0;

    virtual void setPlaceTool(Tool tool, PlaceTool* place_tool) = 0;
    virtual void setLines(std::vector<DrapedLine> lines, LineSet set) = 0;
    virtual void setDots(DotSet dots, LineSet set) = 0;
    /// Flies to where all of these can be seen, at least one.
    virtual void flyToAll(const std::vector<ScenePoint>& places) = 0;

    /// Of map(), the same one until that changes. That of the flat map is its own scene; that of
    /// the globe has longitude and latitude.
    virtual std::shared_ptr<const ScenePlan> plan() const = 0;
    /// Empty where there is no terrain.
    virtual std::optional<ScenePoint> onTerrain(const PlanePoint& point) const = 0;
    /// How long a point of the screen is at least in a box of the plan, in its meters; infinity out
    /// of the picture. Of the camera of now.
    virtual std::function<double(const PlaneBox&)> planResolution() const = 0;
    /// Flies to where all of a box of the plan can be seen.
    virtual void flyToBox(const PlaneBox& box) = 0;

Q_SIGNALS:
    /// The camera or the size of the picture.
    void sightChanged();
    void exaggerationChanged();
    /// Which maps are shown: places on the terrain are others.
    void mapsChanged();
    void pictureCompleted();
};

} // namespace marsview
