#include "haptics/interaction/body_stylus.h"

#include <algorithm>
#include <utility>

namespace marsview {

void BodyStylus::setGround(std::vector<Surface> surfaces, SurfaceAt surface_at)
{
    lift();
    touch_.reset();
    surfaces_ = std::move(surfaces);
    surface_at_ = std::move(surface_at);
}

void BodyStylus::setModel(ContactModelKind kind)
{
    if (kind == std::exchange(kind_, kind) || !model_) {
        return;
    }
    // Slightly away from the proxy toward the goal, the proxy is the nearest point of the surface.
    constexpr double kHair = 1e-6;
    const auto [proxy, goal] = std::pair(pose_->proxy, pose_->goal);
    makeModel();
    model_->place(proxy + (goal - proxy) * kHair);
    model_->update(goal);
    keepOnItsSurface(goal);
    updatePose(pose_->mode, goal);
}

void BodyStylus::aim(const BodyAim& at, const StylusButtons& buttons, double point_m)
{
    const StylusMode mode = pose_ ? nextMode(pose_->mode, buttons, pose_->is_in_contact)
                                  : nextMode(StylusMode::Hover, buttons, false);
    if (pose_ && (mode == StylusMode::Pan || mode == StylusMode::Zoom)) {
        pose_->mode = mode;
        return;
    }
    const bool is_pressing = mode == StylusMode::Press;
    if (at.index != at_.index) {
        releaseModel(); // no wall between two maps holds a pointer, which feels none
        if (at_.index >= surfaces_.size() || at.index >= surfaces_.size() ||
            tilesOf(surfaces_[at_.index]) != tilesOf(surfaces_[at.index])) {
            touch_.reset();
        }
    }
    at_ = at;
    point_m_ = point_m;
    const double up_points = is_pressing ? -reach_.depth_points : reach_.hover_points;
    const ScenePoint goal = at_.point + at_.up * (up_points * point_m_);
    if (is_pressing) {
        press(goal);
    } else {
        releaseModel(); // a hovering stylus has no height of its own, so ridges cannot obstruct it
    }
    updatePose(mode, goal);
}

void BodyStylus::lift()
{
    releaseModel();
    pose_.reset();
}

void BodyStylus::releaseModel()
{
    model_.reset();
    made_.reset();
    if (touch_) {
        touch_->release();
    }
}

bool BodyStylus::refresh()
{
    if (!isWaiting() || !touch_->follow(*made_, pose_->proxy)) {
        return false;
    }
    model_->update(pose_->goal);
    keepOnItsSurface(pose_->goal);
    updatePose(pose_->mode, pose_->goal);
    return true;
}

void BodyStylus::pressAnew()
{
    if (!model_ || pose_->mode != StylusMode::Press) {
        return;
    }
    model_->place(pose_->goal);
    model_->update(pose_->goal);
    keepOnItsSurface(pose_->goal);
    updatePose(pose_->mode, pose_->goal);
}

void BodyStylus::deepen(double factor)
{
    reach_.depth_points =
        std::clamp(reach_.depth_points * factor, kStylusDepthMin, kStylusDepthMax);
}

// The maps in tiles that a surface has or is joined with, the uppermost first.
std::vector<const BodyStylus::Surface*> BodyStylus::tilesOf(const Surface& surface) const
{
    std::vector<const Surface*> tiles;
    for (const Surface& other : surfaces_) {
        const bool is_part =
            &other == &surface || (surface.joined && other.joined == surface.joined);
        if (is_part && other.tiled) {
            tiles.push_back(&other);
        }
    }
    return tiles;
}

void BodyStylus::makeModel()
{
    const Surface& surface = surfaces_[at_.index];
    if (const std::vector<const Surface*> tiles = tilesOf(surface); !tiles.empty()) {
        std::vector<std::shared_ptr<const Map>> maps;
        std::vector<std::shared_ptr<const TiledBodyMesh>> tiled;
        for (const Surface* one : tiles) {
            maps.push_back(one->map);
            tiled.push_back(one->tiled);
        }
        if (!touch_) {
            touch_ = std::make_unique<TouchMap>(maps);
        }
        made_ = surface.joined ? touch_->make(kind_, tiled, *surface.joined, {}, surface.radius_m)
                               : touch_->make(kind_, surface.tiled, surface.radius_m);
        model_ = {made_, made_->model.get()};
        return;
    }
    const ContactModelOptions options{.radius_m = surface.radius_m};
    model_ = surface.joined ? makeContactModel(kind_, LayeredSurface(surface.joined), options)
                            : makeContactModel(kind_, BodySurface(surface.mesh), options);
}

void BodyStylus::press(const ScenePoint& goal)
{
    if (at_.index >= surfaces_.size() || !surfaces_[at_.index].canBePressed()) {
        return;
    }
    const bool is_first = !model_;
    if (is_first) {
        makeModel();
    }
    if (made_) {
        touch_->follow(*made_, goal);
    }
    if (is_first) {
        model_->place(goal); // from straight above: nothing next to it can obstruct it
    }
    model_->update(goal);
    keepOnItsSurface(goal);
}

// A surface continues below those that cover it, and across its voids. The proxy must not slide
// there: it is pressed less deep.
void BodyStylus::keepOnItsSurface(const ScenePoint& goal)
{
    constexpr int kHalvings = 10;
    Vec3 depth = goal - at_.point;
    for (int i = 0; i < kHalvings && !isOnItsSurface(model_->state().proxy); ++i) {
        depth = depth * 0.5;
        model_->place(at_.point + depth);
    }
}

bool BodyStylus::isOnItsSurface(const ScenePoint& proxy) const
{
    if (!surface_at_) {
        return true;
    }
    const auto found = surface_at_(proxy);
    const auto& joined = surfaces_[at_.index].joined;
    return found && (*found == at_.index || (joined && surfaces_[*found].joined == joined));
}

void BodyStylus::updatePose(StylusMode mode, const ScenePoint& goal)
{
    // A press that no contact can be kept for rests on the ground that it was aimed at.
    pose_ = stylusPose(mode, model_ ? model_->state() : ContactState{}, goal,
                       mode == StylusMode::Press ? at_.point : goal, point_m_);
}

} // namespace marsview
