// The document as a value: which maps are open, in what order, and how they look.
//
// Every change is a pure function from one session to the next, so undo is keeping the one before.
// Sessions share their maps; a copy costs a few words a layer.
#pragma once

#include "core/session/map.h"
#include "core/view/color_stretch.h"
#include "core/view/slope_range.h"
#include "core/view/terrain_look.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// Names a layer for as long as its session and all that follow from it live. Never reused.
enum class LayerId : std::uint32_t { None = 0 };

struct Layer {
    LayerId id = LayerId::None;
    std::shared_ptr<const Map> map; // never null in a session
    std::string name{};             // as people read it
    bool is_visible = true;         // as far as the user is concerned; see placement()
    std::string ramp{};             // a name of colorRamps(); empty: the one that suits the body
    bool is_sample = false;         // came by itself, and goes when the user opens something
    ColorStretch stretch{};         // over which elevations the ramp is spread
    std::optional<SlopeRange> slope_range{}; // the same for slopes; nothing: what suits the map
    /// Vertical exaggeration of the scene while this layer is the topmost in it. Positive in a
    /// session; 0 in a layer that is added: suitableExaggeration().
    double exaggeration = 0.0;

    bool operator==(const Layer&) const = default;
};

struct Session {
    std::vector<Layer> layers; // top first
    /// The layer that panels and status bar speak of; None only where there is no layer.
    LayerId active = LayerId::None;
    TerrainLook look;
    std::uint32_t next_id = 1;

    bool operator==(const Session&) const = default;
};

/// Null where there is no such layer.
const Layer* layerOf(const Session& session, LayerId id);
inline const Layer* activeLayer(const Session& session)
{
    return layerOf(session, session.active);
}
/// Counted from the top; the number of layers where there is no such layer.
std::size_t indexOf(const Session& session, LayerId id);

/// The layer on top, under a new id, and active. Samples make room for what is none. An empty name
/// becomes the last part of the map's path.
///
/// Where a change of layers leaves a layer in the picture that was there before, the picture keeps
/// its exaggeration: all layers that are shown take it over.
Session added(Session session, Layer layer);

// The following leave a session as it is where there is no such layer.

/// Where the active layer goes, the one that takes its place becomes active, or else the one above.
Session removed(Session session, LayerId id);
/// To `index` in the order that results; beyond the end is the end.
Session moved(Session session, LayerId id, std::size_t index);
Session activated(Session session, LayerId id);
Session withVisibility(Session session, LayerId id, bool is_visible);
Session withRamp(Session session, LayerId id, std::string ramp);
Session withStretch(Session session, LayerId id, const ColorStretch& stretch);
/// Nothing: the range that suits the map.
Session withSlopeRange(Session session, LayerId id, const std::optional<SlopeRange>& range);
Session withName(Session session, LayerId id, std::string name);
/// A layer whose exaggeration suited the old map gets the one that suits the new map.
Session withMap(Session session, LayerId id, std::shared_ptr<const Map> map);
Session withLook(Session session, const TerrainLook& look);

/// Whether a layer is in the picture, and if not, why not.
enum class LayerState {
    Shown,
    Hidden,      // by the user
    OtherBody,   // than the scene's
    OtherCrs,    // than the scene's
    UnknownPlace // it or the scene has no CRS, so that nobody knows how they lie to each other
};

/// One state a layer, in the order of the layers. The topmost visible layer is the scene: it is
/// shown, and with it the visible layers of the same body and CRS (see isSameCrs). Nothing is ever
/// bent into another CRS on the way to the screen.
std::vector<LayerState> placement(const Session& session);

/// The layers in the picture, top first; empty where all are hidden.
std::vector<const Layer*> shownLayers(const Session& session);

/// Vertical exaggeration of the picture; 1 where all layers are hidden.
double exaggerationOf(const Session& session);
/// For all layers in the picture; `exaggeration` is positive.
Session withExaggeration(Session session, double exaggeration);

/// True where map coordinates of `a` mean the same places as those of `b`, so that the grids of
/// rasters in them differ by an affine map: the same system under whatever name, up to whole turns
/// of longitude. `sample` is a raster that lies in `b`; its places are compared, to a thousandth of
/// its pixels. Asks PROJ some ten times.
bool isSameCrs(const Crs& a, const Crs& b, const Georeference& sample);

} // namespace marsview
