// The document as a value: the open maps, their order and their appearance.
//
// Every change is a pure function from one session to the next, so undo keeps the previous one.
// Sessions share their maps; a copy costs a few words per layer.
#pragma once

#include "core/session/map.h"
#include "core/session/saved_view.h"
#include "core/view/color_ramp.h"
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

/// Identifies a layer in a session and in all sessions derived from it. Never reused.
enum class LayerId : std::uint32_t { None = 0 };

/// Over so many cells the edges of a layer are blended at most.
inline constexpr std::size_t kFeatherCellsMax = 200;

struct Layer {
    LayerId id = LayerId::None;
    std::shared_ptr<const Map> map; // never null in a session
    std::string name{};             // as people read it
    bool is_visible = true;         // as far as the user is concerned; see placement()
    std::string ramp{};             // a name of colorRamps(); empty: the one that suits the body
    bool is_sample = false;         // opened automatically; removed when the user opens a map
    ColorStretch stretch{};         // over which elevations the ramp is spread
    std::optional<SlopeRange> slope_range{}; // the same for slopes; empty: chosen for the map
    /// Vertical exaggeration of the scene while this layer is the topmost in it. Positive in a
    /// session; 0 in a layer that is added: suitableExaggeration().
    double exaggeration = 0.0;
    /// In the scene of a body, over so many of its cells its edges are blended into the layers
    /// below it (core/feather); at most kFeatherCellsMax, 0 for not at all.
    std::size_t feather_cells = 0;

    bool operator==(const Layer&) const = default;
};

/// All of a layer except its samples: enough to open it again.
struct LayerRecord {
    RasterSpec spec;
    std::string name{};
    bool is_visible = true;
    std::string ramp{};
    ColorStretch stretch{};
    std::optional<SlopeRange> slope_range{};
    double exaggeration = 0.0; // 0: what suits the map
    std::size_t feather_cells = 0;

    bool operator==(const LayerRecord&) const = default;
};

/// A layer of a project whose file cannot be opened. It keeps everything until the file is located
/// or the user removes it.
struct MissingLayer {
    LayerId id = LayerId::None;
    LayerRecord record{};
    std::size_t index = 0; // among all layers of the project, from the top
    std::string problem{}; // "FILE: WHY"

    bool operator==(const MissingLayer&) const = default;
};

/// A file of points, lines and polygons that is drawn over the layers.
struct VectorOverlay {
    std::string path; // unique in a session
    Rgb8 color{255, 221, 64};
    bool is_visible = true;
    /// Text for Crs::fromText that replaces the file's CRS; empty: the file's own.
    std::string crs{};

    bool operator==(const VectorOverlay&) const = default;
};

/// Which layer covers the others where several have data.
enum class LayerOrder : std::uint8_t {
    Listed,      // the upper one in the list
    FinestFirst, // the one with the smallest pixels; of equal ones, the upper one
};

struct Session {
    std::vector<Layer> layers;             // top first
    std::vector<MissingLayer> missing{};   // by index, ascending
    std::vector<VectorOverlay> overlays{}; // in the order in which they were opened
    std::vector<SavedView> views{};        // in the user's order
    /// The layer that panels and the status bar describe; None only without layers.
    LayerId active = LayerId::None;
    TerrainLook look;
    LayerOrder order = LayerOrder::Listed;
    std::uint32_t next_id = 1;
    std::uint32_t next_view_id = 1;

    bool operator==(const Session&) const = default;
};

/// Null if the layer does not exist.
const Layer* layerOf(const Session& session, LayerId id);
inline const Layer* activeLayer(const Session& session)
{
    return layerOf(session, session.active);
}
/// Counted from the top; the number of layers if it does not exist.
std::size_t indexOf(const Session& session, LayerId id);

/// The layer on top, under a new id, and active. Bundled samples are removed when another map is
/// added. An empty name becomes the last part of the map's path, with its folder or a number if
/// another layer has that name.
///
/// If a layer stays in the picture through a change of layers, the picture keeps its exaggeration:
/// all layers that are shown adopt it.
Session added(Session session, Layer layer);

LayerRecord recordOf(const Layer& layer);
/// The layer that `record` describes, of its map, without an id.
Layer layerFrom(LayerRecord record, std::shared_ptr<const Map> map);

/// A layer of a project at its place: above the first layer that has a greater id, under the id
/// `id`. It replaces the missing layer of that id. It becomes active if no layer is.
Session withProjectLayer(Session session, Layer layer, LayerId id);
/// Adds a missing layer, or replaces the one with its id.
Session withMissing(Session session, MissingLayer missing);
/// Without the missing layer of that id.
Session withoutMissing(Session session, LayerId id);

// The following leave the session unchanged if the layer does not exist.

/// If the active layer is removed, the layer that takes its place becomes active, or else the one
/// above.
Session removed(Session session, LayerId id);
/// To `index` in the resulting order; values beyond the end mean the end.
Session moved(Session session, LayerId id, std::size_t index);
Session activated(Session session, LayerId id);
Session withVisibility(Session session, LayerId id, bool is_visible);
Session withRamp(Session session, LayerId id, std::string ramp);
Session withStretch(Session session, LayerId id, const ColorStretch& stretch);
/// Empty: the default range for the map.
Session withSlopeRange(Session session, LayerId id, const std::optional<SlopeRange>& range);
/// `cells` is at most kFeatherCellsMax.
Session withFeather(Session session, LayerId id, std::size_t cells);
Session withName(Session session, LayerId id, std::string name);
/// A layer whose exaggeration suited the old map gets the one that suits the new map.
Session withMap(Session session, LayerId id, std::shared_ptr<const Map> map);
Session withLook(Session session, const TerrainLook& look);
Session withOrder(Session session, LayerOrder order);
/// Adds an overlay, or replaces the one of that path.
Session withOverlay(Session session, VectorOverlay overlay);
Session withoutOverlay(Session session, const std::string& path);

/// Null if the view does not exist.
const SavedView* viewOf(const Session& session, ViewId id);
/// Replaces the view of that id, or adds it at the end. ViewId::None gets a new id.
Session withView(Session session, SavedView view);
/// Unchanged if the view does not exist.
Session withoutView(Session session, ViewId id);
/// To `index` in the resulting order; values beyond the end mean the end. Unchanged if the view
/// does not exist.
Session movedView(Session session, ViewId id, std::size_t index);

/// Whether a layer is in the picture, and if not, the reason.
enum class LayerState {
    Shown,
    Hidden,      // by the user
    OtherBody,   // than the scene's
    OtherCrs,    // than the scene's
    UnknownPlace // it or the scene has no CRS, so their relative position is unknown
};

/// One state per layer, in the order of the layers. The topmost visible layer defines the scene: it
/// is shown together with the visible layers of the same body and CRS (see isSameCrs). Layers are
/// never reprojected for display.
std::vector<LayerState> placement(const Session& session);

/// The layers in the picture, in the order in which they cover each other; empty if all are hidden.
std::vector<const Layer*> shownLayers(const Session& session);
/// The same in the scene of a body: all visible layers on the body of the topmost visible one,
/// whatever their CRS.
std::vector<const Layer*> layersOnBody(const Session& session);

/// Layers that cover at least this share of their body are shown on it.
inline constexpr double kGlobeShare = 0.1;

/// Whether the scene of a body suits the visible layers on the topmost one's body better than a
/// flat map: they are in several CRSs, or cover kGlobeShare of it together. False if that body is
/// unknown. Takes milliseconds per layer.
bool suitsGlobe(const Session& session);

/// Vertical exaggeration of the picture; 1 if all layers are hidden.
double exaggerationOf(const Session& session);
/// For all layers in the picture; `exaggeration` is positive.
Session withExaggeration(Session session, double exaggeration);

/// True if map coordinates in `a` mean the same positions as in `b`, so that the grids of rasters
/// in them differ by an affine map: the same system under any name, up to whole turns of longitude.
/// `sample` is a raster in `b`; positions on it are compared to a thousandth of its pixels. Calls
/// PROJ some ten times.
bool isSameCrs(const Crs& a, const Crs& b, const Georeference& sample);

} // namespace marsview
