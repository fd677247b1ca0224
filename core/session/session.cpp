#include "core/session/session.h"

#include "core/geo/covered_share.h"
#include "core/session/map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace marsview {
namespace {

// Positions at which two systems are compared, as fractions of a raster. Uneven, so that no
// symmetry of a projection hides a difference; none on an edge, where projections end.
constexpr std::array<std::array<double, 2>, 6> kProbes{{
    {0.5, 0.5},
    {0.07, 0.11},
    {0.93, 0.13},
    {0.17, 0.89},
    {0.83, 0.79},
    {0.41, 0.29},
}};
constexpr double kToleranceInPixels = 1e-3;

template <typename Change>
Session changed(Session session, LayerId id, Change change)
{
    const std::size_t index = indexOf(session, id);
    if (index < session.layers.size()) {
        change(session.layers[index]);
    }
    return session;
}

LayerState stateBeside(const Map& scene, const Map& map)
{
    const RasterInfo& info = map.info();
    if (info.body != nullptr && scene.info().body != nullptr && info.body != scene.info().body) {
        return LayerState::OtherBody;
    }
    if (!info.crs || !scene.info().crs) {
        return LayerState::UnknownPlace;
    }
    if (info.body != scene.info().body) {
        return LayerState::OtherCrs; // only one of the two is on a known body
    }
    return isSameCrs(*scene.info().crs, *info.crs, map.georeference()) ? LayerState::Shown
                                                                       : LayerState::OtherCrs;
}

// `layers` is in the order of the list.
std::vector<const Layer*> inOrder(std::vector<const Layer*> layers, LayerOrder order)
{
    if (order == LayerOrder::FinestFirst) {
        const auto pixel_m2 = [](const Layer* layer) {
            const Georeference& georeference = layer->map->georeference();
            return georeference.pixelWidthMeters() * georeference.pixelHeightMeters();
        };
        std::stable_sort(layers.begin(), layers.end(),
                         [&](const Layer* a, const Layer* b) { return pixel_m2(a) < pixel_m2(b); });
    }
    return layers;
}

bool isShownIn(const std::vector<const Layer*>& shown, LayerId id)
{
    return std::any_of(shown.begin(), shown.end(),
                       [id](const Layer* layer) { return layer->id == id; });
}

// `after` with the exaggeration of `before` if a layer stayed in the picture.
Session withPictureKept(const Session& before, Session after)
{
    const std::vector<const Layer*> then = shownLayers(before);
    const std::vector<const Layer*> now = shownLayers(after);
    const bool has_stayed = std::any_of(
        now.begin(), now.end(), [&then](const Layer* layer) { return isShownIn(then, layer->id); });
    return has_stayed ? withExaggeration(std::move(after), then.front()->exaggeration) : after;
}

// The file as the user named it, but of an archive with several rasters the one that is open.
std::filesystem::path pathToName(const Map& map)
{
    return map.info().in_archive.empty() ? map.spec().path : map.info().path;
}

// The name of the file, with its folder or a number if another layer has that name.
std::string distinctNameOf(const Map& map, const std::vector<Layer>& others)
{
    const std::filesystem::path path = pathToName(map);
    const std::string file = path.filename().string();
    const auto is_taken = [&others](const std::string& name) {
        return std::any_of(others.begin(), others.end(),
                           [&name](const Layer& other) { return other.name == name; });
    };
    std::string name = file;
    if (const std::string folder = path.parent_path().filename().string();
        is_taken(name) && !folder.empty()) {
        name = fmt::format("{} ({})", file, folder);
    }
    for (int number = 2; is_taken(name); ++number) {
        name = fmt::format("{} ({})", file, number);
    }
    return name;
}

} // namespace

const Layer* layerOf(const Session& session, LayerId id)
{
    const std::size_t index = indexOf(session, id);
    return index < session.layers.size() ? &session.layers[index] : nullptr;
}

std::size_t indexOf(const Session& session, LayerId id)
{
    const auto hit = std::find_if(session.layers.begin(), session.layers.end(),
                                  [id](const Layer& layer) { return layer.id == id; });
    return static_cast<std::size_t>(hit - session.layers.begin());
}

Session added(Session session, Layer layer)
{
    MARSVIEW_CHECK(layer.map != nullptr);
    const Session before = session;
    if (!(layer.exaggeration > 0.0)) {
        layer.exaggeration = suitableExaggeration(*layer.map);
    }
    layer.id = LayerId{session.next_id};
    ++session.next_id;
    if (!layer.is_sample) {
        std::erase_if(session.layers, [](const Layer& other) { return other.is_sample; });
    }
    if (layer.name.empty()) {
        layer.name = distinctNameOf(*layer.map, session.layers);
    }
    session.active = layer.id;
    session.layers.insert(session.layers.begin(), std::move(layer));
    return withPictureKept(before, std::move(session));
}

LayerRecord recordOf(const Layer& layer)
{
    return {.spec = layer.map->spec(),
            .name = layer.name,
            .is_visible = layer.is_visible,
            .ramp = layer.ramp,
            .stretch = layer.stretch,
            .slope_range = layer.slope_range,
            .exaggeration = layer.exaggeration,
            .feather_cells = layer.feather_cells};
}

Layer layerFrom(LayerRecord record, std::shared_ptr<const Map> map)
{
    MARSVIEW_CHECK(map != nullptr);
    Layer layer{.map = std::move(map),
                .name = std::move(record.name),
                .is_visible = record.is_visible,
                .ramp = std::move(record.ramp),
                .stretch = record.stretch,
                .slope_range = record.slope_range,
                .exaggeration = record.exaggeration,
                .feather_cells = record.feather_cells};
    if (layer.name.empty()) {
        layer.name = pathToName(*layer.map).filename().string();
    }
    if (!(layer.exaggeration > 0.0)) {
        layer.exaggeration = suitableExaggeration(*layer.map);
    }
    return layer;
}

Session withProjectLayer(Session session, Layer layer, LayerId id)
{
    MARSVIEW_CHECK(layer.map != nullptr && layerOf(session, id) == nullptr);
    layer.id = id;
    session.next_id = std::max(session.next_id, static_cast<std::uint32_t>(id) + 1);
    const auto next = std::find_if(session.layers.begin(), session.layers.end(),
                                   [id](const Layer& other) { return other.id > id; });
    session.layers.insert(next, std::move(layer));
    if (session.active == LayerId::None) {
        session.active = id;
    }
    return withoutMissing(std::move(session), id);
}

Session withMissing(Session session, MissingLayer missing)
{
    session.next_id = std::max(session.next_id, static_cast<std::uint32_t>(missing.id) + 1);
    session = withoutMissing(std::move(session), missing.id);
    const auto next =
        std::find_if(session.missing.begin(), session.missing.end(),
                     [&](const MissingLayer& other) { return other.index > missing.index; });
    session.missing.insert(next, std::move(missing));
    return session;
}

Session withoutMissing(Session session, LayerId id)
{
    std::erase_if(session.missing, [id](const MissingLayer& missing) { return missing.id == id; });
    return session;
}

Session removed(Session session, LayerId id)
{
    const std::size_t index = indexOf(session, id);
    if (index == session.layers.size()) {
        return session;
    }
    const Session before = session;
    session.layers.erase(session.layers.begin() + static_cast<std::ptrdiff_t>(index));
    if (session.layers.empty()) {
        session.active = LayerId::None;
    } else if (session.active == id) {
        session.active = session.layers[std::min(index, session.layers.size() - 1)].id;
    }
    return withPictureKept(before, std::move(session));
}

Session moved(Session session, LayerId id, std::size_t index)
{
    const std::size_t from = indexOf(session, id);
    if (from == session.layers.size()) {
        return session;
    }
    const Session before = session;
    Layer layer = std::move(session.layers[from]);
    session.layers.erase(session.layers.begin() + static_cast<std::ptrdiff_t>(from));
    const std::size_t to = std::min(index, session.layers.size());
    session.layers.insert(session.layers.begin() + static_cast<std::ptrdiff_t>(to),
                          std::move(layer));
    return withPictureKept(before, std::move(session));
}

Session activated(Session session, LayerId id)
{
    if (layerOf(session, id) != nullptr) {
        session.active = id;
    }
    return session;
}

Session withVisibility(Session session, LayerId id, bool is_visible)
{
    const Session before = session;
    return withPictureKept(before, changed(std::move(session), id,
                                           [&](Layer& layer) { layer.is_visible = is_visible; }));
}

Session withRamp(Session session, LayerId id, std::string ramp)
{
    return changed(std::move(session), id, [&](Layer& layer) { layer.ramp = std::move(ramp); });
}

Session withStretch(Session session, LayerId id, const ColorStretch& stretch)
{
    return changed(std::move(session), id, [&](Layer& layer) { layer.stretch = stretch; });
}

Session withSlopeRange(Session session, LayerId id, const std::optional<SlopeRange>& range)
{
    return changed(std::move(session), id, [&](Layer& layer) { layer.slope_range = range; });
}

Session withFeather(Session session, LayerId id, std::size_t cells)
{
    MARSVIEW_CHECK(cells <= kFeatherCellsMax);
    return changed(std::move(session), id, [&](Layer& layer) { layer.feather_cells = cells; });
}

Session withName(Session session, LayerId id, std::string name)
{
    return changed(std::move(session), id, [&](Layer& layer) { layer.name = std::move(name); });
}

Session withMap(Session session, LayerId id, std::shared_ptr<const Map> map)
{
    MARSVIEW_CHECK(map != nullptr);
    return changed(std::move(session), id, [&](Layer& layer) {
        if (layer.exaggeration == suitableExaggeration(*layer.map)) {
            layer.exaggeration = suitableExaggeration(*map);
        }
        layer.map = std::move(map);
    });
}

Session withOrder(Session session, LayerOrder order)
{
    session.order = order;
    return session;
}

Session withLook(Session session, const TerrainLook& look)
{
    session.look = look;
    return session;
}

Session withOverlay(Session session, VectorOverlay overlay)
{
    const auto known =
        std::find_if(session.overlays.begin(), session.overlays.end(),
                     [&](const VectorOverlay& other) { return other.path == overlay.path; });
    if (known != session.overlays.end()) {
        *known = std::move(overlay);
    } else {
        session.overlays.push_back(std::move(overlay));
    }
    return session;
}

Session withoutOverlay(Session session, const std::string& path)
{
    std::erase_if(session.overlays,
                  [&path](const VectorOverlay& overlay) { return overlay.path == path; });
    return session;
}

const SavedView* viewOf(const Session& session, ViewId id)
{
    const auto hit = std::find_if(session.views.begin(), session.views.end(),
                                  [id](const SavedView& view) { return view.id == id; });
    return hit != session.views.end() ? &*hit : nullptr;
}

Session withView(Session session, SavedView view)
{
    if (view.id == ViewId::None) {
        view.id = ViewId{session.next_view_id};
    }
    session.next_view_id = std::max(session.next_view_id, static_cast<std::uint32_t>(view.id) + 1);
    const auto known = std::find_if(session.views.begin(), session.views.end(),
                                    [&](const SavedView& other) { return other.id == view.id; });
    if (known != session.views.end()) {
        *known = std::move(view);
    } else {
        session.views.push_back(std::move(view));
    }
    return session;
}

Session withoutView(Session session, ViewId id)
{
    std::erase_if(session.views, [id](const SavedView& view) { return view.id == id; });
    return session;
}

Session movedView(Session session, ViewId id, std::size_t index)
{
    const SavedView* found = viewOf(session, id);
    if (found == nullptr) {
        return session;
    }
    SavedView view = *found;
    session = withoutView(std::move(session), id);
    const std::size_t to = std::min(index, session.views.size());
    session.views.insert(session.views.begin() + static_cast<std::ptrdiff_t>(to), std::move(view));
    return session;
}

std::vector<LayerState> placement(const Session& session)
{
    std::vector<LayerState> states;
    states.reserve(session.layers.size());
    const Map* scene = nullptr;
    for (const Layer& layer : session.layers) {
        if (!layer.is_visible) {
            states.push_back(LayerState::Hidden);
        } else if (scene == nullptr) {
            scene = layer.map.get();
            states.push_back(LayerState::Shown);
        } else {
            states.push_back(stateBeside(*scene, *layer.map));
        }
    }
    return states;
}

std::vector<const Layer*> shownLayers(const Session& session)
{
    const std::vector<LayerState> states = placement(session);
    std::vector<const Layer*> shown;
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (states[i] == LayerState::Shown) {
            shown.push_back(&session.layers[i]);
        }
    }
    return inOrder(std::move(shown), session.order);
}

std::vector<const Layer*> layersOnBody(const Session& session)
{
    const Body* body = nullptr;
    std::vector<const Layer*> layers;
    for (const Layer& layer : session.layers) {
        const Body* own = layer.map->info().body;
        if (layer.is_visible && own != nullptr && (body == nullptr || own == body)) {
            body = own;
            layers.push_back(&layer);
        }
    }
    return inOrder(std::move(layers), session.order);
}

bool suitsGlobe(const Session& session)
{
    const auto top = std::ranges::find_if(session.layers, &Layer::is_visible);
    if (top == session.layers.end() || top->map->info().body == nullptr) {
        return false;
    }
    const std::vector<const Layer*> layers = layersOnBody(session);
    if (layers.size() > shownLayers(session).size()) {
        return true; // the flat map leaves some out
    }
    std::vector<const Georeference*> rasters;
    for (const Layer* layer : layers) {
        rasters.push_back(&layer->map->georeference());
    }
    return coveredShare(rasters) >= kGlobeShare;
}

double exaggerationOf(const Session& session)
{
    const std::vector<const Layer*> shown = shownLayers(session);
    return shown.empty() ? 1.0 : shown.front()->exaggeration;
}

Session withExaggeration(Session session, double exaggeration)
{
    MARSVIEW_CHECK(exaggeration > 0.0 && std::isfinite(exaggeration));
    const std::vector<LayerState> states = placement(session);
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (states[i] == LayerState::Shown) {
            session.layers[i].exaggeration = exaggeration;
        }
    }
    return session;
}

bool isSameCrs(const Crs& a, const Crs& b, const Georeference& sample)
{
    if (a.wkt() == b.wkt()) {
        return true;
    }
    if (a.kind() != b.kind() || a.kind() == CrsKind::Local || a.unit() != b.unit()) {
        return false;
    }
    const double tolerance = kToleranceInPixels * std::min(sample.transform().pixelWidth(),
                                                           sample.transform().pixelHeight());
    bool is_compared = false;
    for (const auto& [column_share, row_share] : kProbes) {
        const MapPoint here =
            sample.toMap({column_share * static_cast<double>(sample.columns() - 1),
                          row_share * static_cast<double>(sample.rows() - 1)});
        const auto place = b.toGeographic(here);
        if (!place) {
            continue; // outside the projection: inconclusive
        }
        const auto there = a.toMap(*place);
        if (!there) {
            return false;
        }
        double dx = there->x - here.x;
        if (a.turn()) {
            dx = std::remainder(dx, *a.turn());
        }
        if (!(std::abs(dx) <= tolerance && std::abs(there->y - here.y) <= tolerance)) {
            return false;
        }
        is_compared = true;
    }
    return is_compared;
}

} // namespace marsview
