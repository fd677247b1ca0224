#include "ui/globe/globe_meshes.h"

#include <algorithm>
#include <utility>

namespace marsview {

bool areSameMaps(const BodyScene& a, const BodyScene& b)
{
    return std::equal(a.maps().begin(), a.maps().end(), b.maps().begin(), b.maps().end(),
                      [](const BodyTerrain& one, const BodyTerrain& other) {
                          return one.map() == other.map() && one.grid() == other.grid();
                      });
}

GlobeMeshes::GlobeMeshes(QObject* parent)
    : QObject(parent)
    , jobs_(*this)
{}

GlobeMeshes::~GlobeMeshes()
{
    if (preparing_) {
        preparing_->cancel();
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
    if (preparing_) {
        preparing_->cancel();
        preparing_.reset();
        Q_EMIT preparingChanged(false);
    }
}

// Bounds of all triangles take a second for fifty million samples.
void GlobeMeshes::prepare()
{
    if (scene_.isEmpty() || is_ready_ || preparing_) {
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
    jobs_.run([this, scene = scene_, exaggeration = exaggeration_,
               monitor = preparing_](const std::shared_ptr<DetachedJobs::Outlet>& outlet) {
        Ground ground{.scene = scene, .exaggeration = exaggeration, .surfaces = {}};
        QString problem;
        for (const BodyTerrain& terrain : scene.maps()) {
            const Georeference& georeference = terrain.map()->georeference();
            ground.surfaces.push_back({.mesh = nullptr,
                                       .radius_m = 0.25 * (georeference.pixelWidthMeters() +
                                                           georeference.pixelHeightMeters())});
            if (!terrain.map()->filled()) {
                continue; // in tiles
            }
            auto mesh = BodyMesh::build(terrain.map()->filled(), georeference, exaggeration,
                                        *monitor, scene.ellipsoid());
            if (mesh) {
                ground.surfaces.back().mesh = std::move(mesh).value();
            } else {
                problem = QString::fromStdString(mesh.error().message);
            }
        }
        outlet->post([this, monitor, problem, ground = std::move(ground)] {
            if (monitor != preparing_) {
                return; // superseded
            }
            preparing_.reset();
            Q_EMIT preparingChanged(false);
            take(problem.isEmpty() ? std::optional(ground) : std::nullopt, problem);
        });
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

} // namespace marsview
