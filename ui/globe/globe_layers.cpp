#include "ui/globe/globe_layers.h"

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

bool isOfSameMap(const ShownLayer& a, const ShownLayer& b)
{
    return a.map == b.map;
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
        if (are_same(isSameLook)) {
            return;
        }
        for (ShownLayer& layer : shown_) {
            layer = *std::find_if(wanted_.begin(), wanted_.end(), [&](const ShownLayer& wanted) {
                return isOfSameMap(wanted, layer);
            });
        }
        Q_EMIT lookChanged();
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
        Q_EMIT placingFinished();
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

void GlobeLayers::showPlaced(bool is_other_body)
{
    std::vector<BodyTerrain> maps;
    shown_.clear();
    for (const ShownLayer& layer : wanted_) {
        const Placed* placed = placedOf(layer);
        if (placed != nullptr && placed->grid) {
            maps.emplace_back(layer.map, placed->grid);
            shown_.push_back(layer);
        }
    }
    scene_ = BodyScene(std::move(maps));
    Q_EMIT shownChanged(is_other_body);
}

} // namespace marsview
