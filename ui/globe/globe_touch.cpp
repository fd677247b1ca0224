#include "ui/globe/globe_touch.h"

#include "core/globe/body_camera.h"

#include <chrono>
#include <utility>

namespace marsview {
namespace {

// How often finer terrain is looked for below a stylus that presses.
constexpr std::chrono::milliseconds kTouchInterval{33};

} // namespace

GlobeTouch::GlobeTouch(GlobeMeshes& meshes, QObject* parent)
    : QObject(parent)
    , meshes_(meshes)
{
    connect(&meshes_, &GlobeMeshes::sceneChanged, this, [this] {
        stylus_.setGround({}, {});
        Q_EMIT moved();
    });
    connect(&meshes_, &GlobeMeshes::groundChanged, this, &GlobeTouch::takeGround);
    refresh_timer_.setInterval(kTouchInterval);
    connect(&refresh_timer_, &QTimer::timeout, this, &GlobeTouch::refresh);
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

void GlobeTouch::setPressing(bool is_pressing)
{
    buttons_.is_pressing = is_pressing;
    if (is_pressing) {
        has_hand_moved_ = false;
    }
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
    const bool has_arrived = std::exchange(aimed_arrivals_, arrivals()) != aimed_arrivals_;
    if (at && is_chosen_) {
        stylus_.aim(*at, buttons_, point_m);
        if (has_arrived && !has_hand_moved_) {
            stylus_.pressAnew();
        }
    } else if (!is_chosen_ || (!buttons_.is_pressing && !buttons_.is_grabbing)) {
        stylus_.lift();
    }
    if (stylus_.isWaiting() != refresh_timer_.isActive()) {
        refresh_timer_.isActive() ? refresh_timer_.stop() : refresh_timer_.start();
    }
    Q_EMIT moved();
}

// Tiles that arrive after this was read may change where the pointer is on the terrain.
std::uint64_t GlobeTouch::arrivals() const
{
    std::uint64_t count = 0;
    if (const auto& ground = meshes_.ground()) {
        for (const BodyTerrain& terrain : ground->scene.maps()) {
            const Heightfield& heightfield = terrain.shown()->heightfield();
            count += heightfield.isTiled() ? heightfield.tiles()->raster().generation() : 0;
        }
    }
    return count;
}

void GlobeTouch::refresh()
{
    if (!stylus_.isWaiting()) {
        refresh_timer_.stop();
    } else if (arrivals() != aimed_arrivals_) {
        Q_EMIT aimOutdated();
    } else if (stylus_.refresh()) {
        if (!has_hand_moved_) {
            stylus_.pressAnew();
        }
        Q_EMIT moved();
    }
}

} // namespace marsview
