#include "ui/globe/globe_layers.h"

#include "core/feather/feathered_map.h"
#include "ui/globe/globe_meshes.h"

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

bool isOfSameMap(const ShownLayer& a, const ShownLayer& b)
{
    return a.map == b.map;
}

bool isBlendedAlike(const ShownLayer& a, const ShownLayer& b)
{
    return a.feather_cells == b.feather_cells;
}

bool isSameLook(const ShownLayer& a, const ShownLayer& b)
{
    const HeightRange a_range = colorRangeOf(a);
    const HeightRange b_range = colorRangeOf(b);
    return a.ramp == b.ramp && a.slope_range == b.slope_range &&
           a_range.minimum_m == b_range.minimum_m && a_range.maximum_m == b_range.maximum_m;
}

} // namespace

GlobeLayers::GlobeLayers(QObject* parent)
    : QObject(parent)
    , jobs_(*this)
{}

GlobeLayers::~GlobeLayers()
{
    cancel();
}

void GlobeLayers::cancel()
{
    if (placing_) {
        placing_->cancel();
        placing_.reset();
    }
}

void GlobeLayers::set(const std::vector<ShownLayer>& top_first)
{
    const Body* before = wanted_.empty() ? nullptr : wanted_.front().map->info().body;
    const std::vector<ShownLayer> previous = std::exchange(wanted_, top_first);
    const auto are_same = [&](bool (*is_same)(const ShownLayer&, const ShownLayer&)) {
        return std::equal(wanted_.begin(), wanted_.end(), previous.begin(), previous.end(),
                          is_same);
    };
    if (are_same(isOfSameMap)) {
        for (ShownLayer& layer : shown_) {
            layer = *std::find_if(wanted_.begin(), wanted_.end(), [&](const ShownLayer& wanted) {
                return isOfSameMap(wanted, layer);
            });
        }
        if (!are_same(isSameLook)) {
            Q_EMIT lookChanged();
        }
        if (!are_same(isBlendedAlike)) {
            cancel();
            placeNext();
        }
        return;
    }
    cancel();
    std::erase_if(placed_, [this, ellipsoid = ellipsoid()](const Placed& placed) {
        return (placed.grid && placed.grid->ellipsoid() != ellipsoid) || !isWanted(placed.map);
    });
    const bool is_other_body = wanted_.empty() || wanted_.front().map->info().body != before;
    if (is_other_body || !isReplacing()) {
        showPlaced(is_other_body);
    }
    placeNext();
}

bool GlobeLayers::isWanted(const std::shared_ptr<const Map>& map) const
{
    return std::any_of(wanted_.begin(), wanted_.end(),
                       [&](const ShownLayer& layer) { return layer.map == map; });
}

bool GlobeLayers::isReplacing() const
{
    return std::all_of(shown_.begin(), shown_.end(),
                       [this](const ShownLayer& layer) { return isWanted(layer.map); }) &&
           std::any_of(shown_.begin(), shown_.end(),
                       [this](const ShownLayer& layer) { return placedOf(layer) == nullptr; });
}

std::vector<UnplacedLayer> GlobeLayers::unplaced() const
{
    std::vector<UnplacedLayer> unplaced;
    for (const ShownLayer& layer : wanted_) {
        const Placed* placed = placedOf(layer);
        if (placed != nullptr && !placed->grid) {
            unplaced.push_back({.map = layer.map, .problem = placed->problem});
        }
    }
    return unplaced;
}

// Of the lowest layer, which the others are put on in most cases.
std::optional<Ellipsoid> GlobeLayers::ellipsoid() const
{
    for (auto layer = wanted_.rbegin(); layer != wanted_.rend(); ++layer) {
        const auto& crs = layer->map->georeference().crs();
        if (crs && crs->ellipsoid()) {
            return crs->ellipsoid();
        }
    }
    return std::nullopt;
}

const GlobeLayers::Placed* GlobeLayers::placedOf(const ShownLayer& layer) const
{
    const auto found = std::find_if(placed_.begin(), placed_.end(),
                                    [&](const Placed& placed) { return placed.map == layer.map; });
    return found != placed_.end() ? &*found : nullptr;
}

// Projections take some time for each sample.
void GlobeLayers::placeNext()
{
    const auto next = std::find_if(wanted_.begin(), wanted_.end(), [this](const ShownLayer& layer) {
        return placedOf(layer) == nullptr;
    });
    if (next == wanted_.end()) {
        blendNext();
        return;
    }
    placing_ = std::make_shared<JobMonitor>();
    Q_EMIT placingStarted();
    jobs_.run([this, map = next->map, ellipsoid = ellipsoid(),
               monitor = placing_](const std::shared_ptr<DetachedJobs::Outlet>& outlet) {
        auto grid = BodyGrid::make(map->georeference(), *monitor, ellipsoid);
        outlet->post([this, map, monitor, grid = std::move(grid)] {
            if (monitor != placing_) {
                return; // superseded
            }
            placing_.reset();
            placed_.push_back(
                {.map = map,
                 .grid = grid ? *grid : nullptr,
                 .problem = grid ? QString() : QString::fromStdString(grid.error().message)});
            if (!isReplacing()) {
                showPlaced(false);
            }
            placeNext();
        });
    });
}

GlobeLayers::Pile GlobeLayers::pile() const
{
    const auto are_same = [](const std::vector<BodyTerrain>& a, const std::vector<BodyTerrain>& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(), isSameMap);
    };
    Pile pile;
    for (auto layer = wanted_.rbegin(); layer != wanted_.rend(); ++layer) {
        const Placed* placed = placedOf(*layer);
        if (placed == nullptr || !placed->grid) {
            continue;
        }
        Blended wanted{.terrain = BodyTerrain(layer->map, placed->grid),
                       .cells = layer->feather_cells,
                       .below = {pile.maps.rbegin(), pile.maps.rend()}};
        if (wanted.cells == 0 || wanted.below.empty()) {
            pile.maps.push_back(wanted.terrain);
            continue;
        }
        const auto known =
            std::find_if(blended_.begin(), blended_.end(), [&](const Blended& blended) {
                return blended.cells == wanted.cells &&
                       blended.terrain.map() == wanted.terrain.map() &&
                       blended.terrain.grid() == wanted.terrain.grid() &&
                       are_same(blended.below, wanted.below);
            });
        pile.maps.push_back(known != blended_.end() ? known->terrain : wanted.terrain);
        if (known == blended_.end() && !pile.next) {
            pile.next = std::move(wanted);
        }
    }
    return pile;
}

// Reads each sample of a layer a few times.
void GlobeLayers::blendNext()
{
    Pile now = pile();
    if (!now.next) {
        const auto is_shown = [&now](const BodyTerrain& terrain) {
            return std::any_of(now.maps.begin(), now.maps.end(), [&](const BodyTerrain& shown) {
                return shown.shown() == terrain.shown();
            });
        };
        std::erase_if(blended_, [&](const Blended& known) { return !is_shown(known.terrain); });
        const bool is_new = !std::equal(now.maps.rbegin(), now.maps.rend(), scene_.maps().begin(),
                                        scene_.maps().end(), isSameMap);
        if (is_new) {
            showPile(now, false);
        }
        Q_EMIT placingFinished();
        return;
    }
    placing_ = std::make_shared<JobMonitor>();
    Q_EMIT blendingStarted();
    jobs_.run([this, wanted = std::move(*now.next),
               monitor = placing_](const std::shared_ptr<DetachedJobs::Outlet>& outlet) {
        const BodyTerrain& own = wanted.terrain;
        auto shown = featheredMap(own, wanted.below, wanted.cells, *monitor);
        const QString problem = shown ? QString() : QString::fromStdString(shown.error().message);
        Blended blended{.terrain = BodyTerrain(own.map(), own.grid(), shown ? *shown : nullptr),
                        .cells = wanted.cells,
                        .below = wanted.below};
        outlet->post([this, monitor, problem, blended = std::move(blended)] {
            if (monitor != placing_) {
                return; // superseded
            }
            placing_.reset();
            blended_.push_back(blended);
            if (!problem.isEmpty()) {
                Q_EMIT blendingFailed(problem);
            }
            blendNext();
        });
    });
}

void GlobeLayers::showPlaced(bool is_other_body)
{
    showPile(pile(), is_other_body);
}

void GlobeLayers::showPile(const Pile& pile, bool is_other_body)
{
    shown_.clear();
    for (const ShownLayer& layer : wanted_) {
        const Placed* placed = placedOf(layer);
        if (placed != nullptr && placed->grid) {
            shown_.push_back(layer);
        }
    }
    scene_ = BodyScene({pile.maps.rbegin(), pile.maps.rend()});
    Q_EMIT shownChanged(is_other_body);
}

} // namespace marsview
