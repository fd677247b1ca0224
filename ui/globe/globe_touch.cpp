#include "ui/globe/globe_touch.h"

#include "core/globe/body_camera.h"

namespace marsview {

GlobeTouch::GlobeTouch(GlobeMeshes& meshes, QObject* parent)
    : QObject(parent)
    , meshes_(meshes)
{
    connect(&meshes_, &GlobeMeshes::sceneChanged, this, [this] {
        stylus_.setGround({}, {});
        Q_EMIT moved();
    });
    connect(&meshes_, &GlobeMeshes::groundChanged, this, &GlobeTouch::takeGround);
}

void GlobeTouch::setChosen(bool is_chosen)
{
    if (is_chosen == is_chosen_) {
        return;
    }
    is_chosen_ = is_chosen;
    if (!is_chosen) {
        buttons_ = {};
        stylus_.lift();
        Q_EMIT moved();
    }
    meshes_.setWanted(GlobeMeshes::User::Mouse, is_chosen);
}

void GlobeTouch::takeGround()
{
    if (!meshes_.isReady()) {
        return;
    }
    const GlobeMeshes::Ground& ground = *meshes_.ground();
    stylus_.setGround(ground.surfaces, [scene = ground.scene](const ScenePoint& point) {
        return scene.mapAt(placeOf(point, scene.ellipsoid()).foot);
    });
    follow(at_, point_m_);
}

void GlobeTouch::setGrabbing(bool is_grabbing)
{
    buttons_.is_grabbing = is_grabbing;
    follow(at_, point_m_);
}

void GlobeTouch::setModel(ContactModelKind model)
{
    stylus_.setModel(model);
    Q_EMIT moved();
}

void GlobeTouch::follow(const std::optional<BodyAim>& at, double point_m)
{
    at_ = at;
    point_m_ = point_m;
    if (at && is_chosen_) {
        stylus_.aim(*at, buttons_, point_m);
    } else if (!is_chosen_ || (!buttons_.is_pressing && !buttons_.is_grabbing)) {
        stylus_.lift();
    }
    Q_EMIT moved();
}

} // namespace marsview
