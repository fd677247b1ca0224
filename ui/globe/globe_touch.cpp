#include "ui/globe/globe_touch.h"

#include "core/globe/body_camera.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace marsview {

GlobeTouch::GlobeTouch(QObject* parent)
    : QObject(parent)
    , jobs_(*this)
{}

GlobeTouch::~GlobeTouch()
{
    if (preparing_) {
        preparing_->cancel();
    }
}

void GlobeTouch::setScene(const BodyScene& scene, double exaggeration)
{
    const bool is_same =
        exaggeration == exaggeration_ &&
        std::equal(scene.maps().begin(), scene.maps().end(), scene_.maps().begin(),
                   scene_.maps().end(), [](const BodyTerrain& a, const BodyTerrain& b) {
                       return a.map() == b.map() && a.grid() == b.grid();
                   });
    if (is_same) {
        return;
    }
    cancel();
    scene_ = scene;
    exaggeration_ = exaggeration;
    is_ready_ = false;
    stylus_.setGround({}, {});
    Q_EMIT moved();
    if (is_chosen_) {
        prepare();
    }
}

void GlobeTouch::setChosen(bool is_chosen)
{
    if (is_chosen == is_chosen_) {
        return;
    }
    is_chosen_ = is_chosen;
    if (is_chosen) {
        prepare();
    } else {
        cancel();
        buttons_ = {};
        stylus_.lift();
        Q_EMIT moved();
    }
}

void GlobeTouch::setModel(ContactModelKind model)
{
    stylus_.setModel(model);
    Q_EMIT moved();
}

void GlobeTouch::cancel()
{
    if (preparing_) {
        preparing_->cancel();
        preparing_.reset();
        Q_EMIT preparingChanged(false);
    }
}

// Bounds of all triangles take a second for fifty million samples.
void GlobeTouch::prepare()
{
    if (scene_.isEmpty() || is_ready_ || preparing_) {
        return;
    }
    if (std::none_of(scene_.maps().begin(), scene_.maps().end(), [](const BodyTerrain& terrain) {
            return terrain.map()->filled() != nullptr;
        })) {
        Q_EMIT failed(
            tr("The globe can be touched only where the map is held in memory. Choose "
               "View › Scene › Flat Map to touch this map"));
        return;
    }
    preparing_ = std::make_shared<JobMonitor>();
    Q_EMIT preparingChanged(true);
    jobs_.run([this, scene = scene_, exaggeration = exaggeration_,
               monitor = preparing_](const std::shared_ptr<DetachedJobs::Outlet>& outlet) {
        std::vector<BodyStylus::Surface> surfaces;
        QString problem;
        for (const BodyTerrain& terrain : scene.maps()) {
            const Georeference& georeference = terrain.map()->georeference();
            surfaces.push_back({.mesh = nullptr,
                                .radius_m = 0.25 * (georeference.pixelWidthMeters() +
                                                    georeference.pixelHeightMeters())});
            if (!terrain.map()->filled()) {
                continue; // in tiles
            }
            auto mesh = BodyMesh::build(terrain.map()->filled(), georeference, exaggeration,
                                        *monitor, scene.ellipsoid());
            if (mesh) {
                surfaces.back().mesh = std::move(mesh).value();
            } else {
                problem = QString::fromStdString(mesh.error().message);
            }
        }
        outlet->post([this, scene, monitor, problem, surfaces = std::move(surfaces)] {
            if (monitor != preparing_) {
                return; // superseded
            }
            preparing_.reset();
            is_ready_ = problem.isEmpty();
            if (is_ready_) {
                stylus_.setGround(surfaces, [scene](const ScenePoint& point) {
                    return scene.mapAt(placeOf(point, scene.ellipsoid()).foot);
                });
            }
            Q_EMIT preparingChanged(false);
            if (is_ready_) {
                follow(at_, point_m_);
            } else {
                Q_EMIT failed(problem);
            }
        });
    });
}

void GlobeTouch::follow(const std::optional<BodyAim>& at, double point_m)
{
    at_ = at;
    point_m_ = point_m;
    if (at && is_chosen_) {
        stylus_.aim(*at, buttons_, point_m);
    } else if (!buttons_.is_pressing || !is_chosen_) {
        stylus_.lift();
    }
    Q_EMIT moved();
}

} // namespace marsview
