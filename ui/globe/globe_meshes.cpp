#include "ui/globe/globe_meshes.h"

#include "core/session/joined_maps.h"
#include "haptics/terrain/body_layers.h"

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

// The surface of a map that is in an earlier ground, too; null otherwise.
const BodyStylus::Surface* keptSurface(const std::optional<GlobeMeshes::Ground>& earlier,
                                       const BodyTerrain& terrain,
                                       double exaggeration)
{
    if (!earlier || earlier->exaggeration != exaggeration) {
        return nullptr;
    }
    const auto& maps = earlier->scene.maps();
    const auto found = std::find_if(maps.begin(), maps.end(), [&](const BodyTerrain& other) {
        return isSameMap(terrain, other);
    });
    return found != maps.end() ? &earlier->surfaces[static_cast<std::size_t>(found - maps.begin())]
                               : nullptr;
}

struct Piles {
    std::vector<std::vector<std::size_t>> joined;
    bool is_tiled_apart = false; // some map in tiles lies on top of others or below them
};

// A pile is joined as a whole if all of its maps in tiles, except for the lowest map, can be cut
// out. Of other piles, all other maps are joined.
Piles pilesIn(const GlobeMeshes::Ground& ground)
{
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < ground.surfaces.size(); ++i) {
        if (ground.surfaces[i].canBePressed()) {
            all.push_back(i);
        }
    }
    const auto can_be_above = [&](std::size_t i) {
        const BodyStylus::Surface& surface = ground.surfaces[i];
        return !surface.tiled || LayeredMesh::canBeCutOut(*tileHeightsOf(*surface.map));
    };
    Piles piles;
    std::vector<std::vector<std::size_t>> rest = pilesOf(ground.scene, all);
    while (!rest.empty()) {
        std::vector<std::size_t> pile = std::move(rest.back());
        rest.pop_back();
        const auto apart = std::find_if_not(pile.begin(), pile.end() - 1, can_be_above);
        if (apart == pile.end() - 1) {
            piles.joined.push_back(std::move(pile));
            continue;
        }
        piles.is_tiled_apart = true;
        pile.erase(apart);
        for (std::vector<std::size_t>& without : pilesOf(ground.scene, pile)) {
            rest.push_back(std::move(without));
        }
    }
    return piles;
}

Result<JoinedLayers> joinedOf(const std::vector<std::size_t>& pile,
                              const GlobeMeshes::Ground& ground,
                              JobMonitor& monitor)
{
    std::vector<BodyLayer> layers;
    for (const std::size_t i : pile) {
        const BodyStylus::Surface& surface = ground.surfaces[i];
        layers.push_back({.mesh = surface.mesh, .tiled = surface.tiled, .map = surface.map});
    }
    return joinLayers(layers, monitor);
}

// Each pile that can be joined becomes one surface.
void join(GlobeMeshes::Ground& ground, Piles piles, JobMonitor& monitor)
{
    while (!piles.joined.empty()) {
        std::vector<std::size_t> pile = std::move(piles.joined.back());
        piles.joined.pop_back();
        const auto joined = joinedOf(pile, ground, monitor);
        if (!joined) {
            ground.why_apart = QString::fromStdString(joined.error().message);
            const auto erased = std::erase_if(
                pile, [&](std::size_t i) { return ground.surfaces[i].tiled != nullptr; });
            if (erased > 0 && !monitor.isCanceled()) { // the others may be joined without it
                for (std::vector<std::size_t>& in_memory : pilesOf(ground.scene, pile)) {
                    piles.joined.push_back(std::move(in_memory));
                }
            }
            continue;
        }
        double radius_m = ground.surfaces[pile.front()].radius_m;
        for (const std::size_t i : pile) {
            radius_m = std::min(radius_m, ground.surfaces[i].radius_m);
        }
        for (const std::size_t i : pile) {
            ground.surfaces[i].joined = joined->mesh;
            ground.surfaces[i].radius_m = radius_m; // of the finest map
        }
    }
}

} // namespace

std::vector<std::size_t> GlobeMeshes::Ground::joinedWith(std::size_t index) const
{
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        if (i == index ||
            (surfaces[index].joined && surfaces[i].joined == surfaces[index].joined)) {
            found.push_back(i);
        }
    }
    return found;
}

bool isSameMap(const BodyTerrain& a, const BodyTerrain& b)
{
    return a.map() == b.map() && a.shown() == b.shown() && a.grid() == b.grid();
}

bool areSameMaps(const BodyScene& a, const BodyScene& b)
{
    return std::equal(a.maps().begin(), a.maps().end(), b.maps().begin(), b.maps().end(),
                      isSameMap);
}

GlobeMeshes::GlobeMeshes(QObject* parent)
    : QObject(parent)
    , jobs_(*this)
{}

GlobeMeshes::~GlobeMeshes()
{
    for (const auto& monitor : {preparing_, joining_}) {
        if (monitor) {
            monitor->cancel();
        }
    }
}

void GlobeMeshes::setScene(const BodyScene& scene, double exaggeration)
{
    if (exaggeration == exaggeration_ && areSameMaps(scene, scene_)) {
        return;
    }
    cancel();
    scene_ = scene;
    exaggeration_ = exaggeration;
    is_ready_ = false;
    is_complete_ = false;
    problem_.clear();
    Q_EMIT sceneChanged();
    if (scene_.isEmpty()) {
        take(std::nullopt, {});
    } else if (isWanted()) {
        prepare();
    } else {
        ground_.reset();
    }
}

void GlobeMeshes::setWanted(User user, bool is_wanted)
{
    bool& is_wanted_now = is_wanted_[static_cast<std::size_t>(user)];
    if (is_wanted == std::exchange(is_wanted_now, is_wanted)) {
        return;
    }
    if (is_wanted) {
        prepare();
    } else if (!isWanted()) {
        cancel();
    }
}

void GlobeMeshes::cancel()
{
    if (joining_) {
        joining_->cancel();
        joining_.reset();
    }
    if (preparing_) {
        preparing_->cancel();
        preparing_.reset();
        Q_EMIT preparingChanged(false);
    }
}

// Bounds of all triangles take a second for fifty million samples.
void GlobeMeshes::prepare()
{
    if (scene_.isEmpty() || isComplete() || preparing_ || joining_) {
        return;
    }
    preparing_ = std::make_shared<JobMonitor>();
    Q_EMIT preparingChanged(true);
    jobs_.run([this, scene = scene_, exaggeration = exaggeration_, earlier = ground_,
               monitor = preparing_](const std::shared_ptr<DetachedJobs::Outlet>& outlet) {
        Ground ground{.scene = scene, .exaggeration = exaggeration, .surfaces = {}};
        QString problem;
        for (const BodyTerrain& terrain : scene.maps()) {
            const Georeference& georeference = terrain.map()->georeference();
            BodyStylus::Surface& surface = ground.surfaces.emplace_back();
            if (const auto* kept = keptSurface(earlier, terrain, exaggeration)) {
                surface = *kept;
                surface.joined = nullptr;
            } else if (auto laid = layOnBody(terrain, exaggeration, *monitor)) {
                surface.mesh = std::move(laid->mesh);
                surface.tiled = std::move(laid->tiled);
                surface.map = std::move(laid->map);
            } else {
                problem = QString::fromStdString(laid.error().message);
            }
            surface.radius_m =
                0.25 * (georeference.pixelWidthMeters() + georeference.pixelHeightMeters());
        }
        const Piles piles = problem.isEmpty() ? pilesIn(ground) : Piles();
        if (piles.is_tiled_apart) {
            ground.why_apart =
                tr("Of layers on top of each other, only the lowest may be larger than memory and "
                   "have nodata");
        }
        // At another exaggeration the earlier surface is touched until the maps are joined again.
        const bool is_whole =
            piles.joined.empty() || (earlier && areSameMaps(earlier->scene, scene));
        if (is_whole) {
            join(ground, piles, *monitor);
        }
        outlet->post([this, monitor, problem, is_whole, ground] {
            if (monitor != preparing_) {
                return; // superseded
            }
            preparing_.reset();
            joining_ = is_whole ? nullptr : monitor;
            Q_EMIT preparingChanged(false);
            is_complete_ = is_whole;
            take(problem.isEmpty() ? std::optional(ground) : std::nullopt, problem);
        });
        if (!is_whole) {
            join(ground, piles, *monitor);
            outlet->post([this, monitor, ground = std::move(ground)] {
                if (monitor == joining_) {
                    takeJoined(ground);
                }
            });
        }
    });
}

void GlobeMeshes::take(std::optional<Ground> ground, const QString& problem)
{
    ground_ = std::move(ground);
    problem_ = problem;
    is_ready_ = ground_.has_value();
    Q_EMIT groundChanged();
    if (!problem_.isEmpty()) {
        Q_EMIT failed(problem_);
    }
}

void GlobeMeshes::takeJoined(const Ground& ground)
{
    joining_.reset();
    ground_ = ground;
    is_complete_ = true;
    Q_EMIT groundChanged();
}

} // namespace marsview
