#include "ui/globe/globe_meshes.h"

#include "core/session/joined_maps.h"

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

// The mesh of a map that is in an earlier ground, too; null otherwise.
std::shared_ptr<const BodyMesh> keptMesh(const std::optional<GlobeMeshes::Ground>& earlier,
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
    return found != maps.end()
               ? earlier->surfaces[static_cast<std::size_t>(found - maps.begin())].mesh
               : nullptr;
}

using Piles = std::vector<std::vector<std::size_t>>;

Piles pilesInMemory(const GlobeMeshes::Ground& ground)
{
    std::vector<std::size_t> in_memory;
    for (std::size_t i = 0; i < ground.surfaces.size(); ++i) {
        if (ground.surfaces[i].mesh) {
            in_memory.push_back(i);
        }
    }
    return pilesOf(ground.scene, in_memory);
}

// Each pile that can be joined becomes one surface.
void join(GlobeMeshes::Ground& ground, const Piles& piles, JobMonitor& monitor)
{
    for (const std::vector<std::size_t>& pile : piles) {
        std::vector<std::shared_ptr<const BodyMesh>> meshes;
        double radius_m = ground.surfaces[pile.front()].radius_m;
        for (const std::size_t i : pile) {
            meshes.push_back(ground.surfaces[i].mesh);
            radius_m = std::min(radius_m, ground.surfaces[i].radius_m);
        }
        const auto joined = LayeredMesh::build(meshes, monitor);
        if (!joined) {
            ground.why_apart = QString::fromStdString(joined.error().message);
            continue;
        }
        for (const std::size_t i : pile) {
            ground.surfaces[i].joined = *joined;
            ground.surfaces[i].radius_m = radius_m; // of the finest map
        }
    }
}

} // namespace

bool isSameMap(const BodyTerrain& a, const BodyTerrain& b)
{
    return a.map() == b.map() && a.grid() == b.grid();
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
    if (std::none_of(scene_.maps().begin(), scene_.maps().end(), [](const BodyTerrain& terrain) {
            return terrain.map()->filled() != nullptr;
        })) {
        take(std::nullopt,
             tr("The globe can be touched only where the map is held in memory. Choose "
                "View › Scene › Flat Map to touch this map"));
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
            ground.surfaces.push_back({.mesh = keptMesh(earlier, terrain, exaggeration),
                                       .radius_m = 0.25 * (georeference.pixelWidthMeters() +
                                                           georeference.pixelHeightMeters())});
            if (!terrain.map()->filled() || ground.surfaces.back().mesh) {
                continue; // in tiles, or known
            }
            auto mesh = BodyMesh::build(terrain.map()->filled(), georeference, exaggeration,
                                        *monitor, scene.ellipsoid());
            if (mesh) {
                ground.surfaces.back().mesh = std::move(mesh).value();
            } else {
                problem = QString::fromStdString(mesh.error().message);
            }
        }
        const Piles piles = problem.isEmpty() ? pilesInMemory(ground) : Piles();
        // At another exaggeration the earlier surface is touched until the maps are joined again.
        const bool is_whole = piles.empty() || (earlier && areSameMaps(earlier->scene, scene));
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
