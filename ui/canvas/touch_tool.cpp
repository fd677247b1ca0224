#include "ui/canvas/touch_tool.h"

#include <chrono>
#include <utility>

namespace marsview {
namespace {

// How often finer terrain is looked for below a stylus that presses.
constexpr std::chrono::milliseconds kTouchInterval{33};

} // namespace

TouchTool::TouchTool(const ShownScene& scene, const ViewProjection& projection)
    : scene_(scene)
    , projection_(projection)
{
    refresh_timer_.setInterval(kTouchInterval);
    connect(&refresh_timer_, &QTimer::timeout, this, &TouchTool::refresh);
}

void TouchTool::setModel(ContactModelKind model)
{
    stylus_.setModel(model);
    Q_EMIT redrawNeeded();
    Q_EMIT moved();
}

void TouchTool::updateGround()
{
    stylus_.setGround(scene_.ground(), scene_.style.exaggeration);
}

// Tiles that arrive after this was read may change what a ray hits.
std::uint64_t TouchTool::arrivals() const
{
    std::uint64_t count = 0;
    for (const ShownLayer& layer : scene_.layers()) {
        const Heightfield& heightfield = layer.map->heightfield();
        count += heightfield.isTiled() ? heightfield.tiles()->raster().generation() : 0;
    }
    return count;
}

void TouchTool::follow()
{
    const bool was_shown = shown().has_value();
    const bool has_arrived = std::exchange(aimed_arrivals_, arrivals()) != aimed_arrivals_;
    const auto ground = pointer_ && !scene_.isEmpty() ? projection_.groundUnder(*pointer_)
                                                      : std::optional<GroundPoint>();
    if (ground) {
        const ScenePoint at = scene_.placeOf(*ground);
        const bool was_panning = stylus_.pose() && stylus_.pose()->mode == StylusMode::Pan;
        stylus_.aim(*ground, buttons_, projection_.metersPerPoint(at));
        if (!was_panning && stylus_.pose()->mode == StylusMode::Pan) {
            grabbed_z_m_ = at.z; // the grabbed point stays under the pointer
        }
        if (has_arrived && !has_hand_moved_) {
            stylus_.pressAnew();
        }
    } else if (!buttons_.is_pressing && !buttons_.is_grabbing) {
        stylus_.lift();
    }
    is_over_terrain_ = ground.has_value();
    if (stylus_.isWaiting() != refresh_timer_.isActive()) {
        refresh_timer_.isActive() ? refresh_timer_.stop() : refresh_timer_.start();
    }
    if (was_shown || shown()) {
        Q_EMIT redrawNeeded();
    }
    Q_EMIT moved();
}

void TouchTool::setPressing(bool is_pressing)
{
    buttons_.is_pressing = is_pressing;
    if (is_pressing) {
        has_hand_moved_ = false;
    }
}

bool TouchTool::setGrabbing(bool is_grabbing)
{
    if (is_grabbing == (buttons_.is_grabbing || is_device_grabbing_)) {
        return false;
    }
    if (is_grabbing ? device_.has_value() : is_device_grabbing_) {
        is_device_grabbing_ = is_grabbing;
        return true;
    }
    buttons_.is_grabbing = is_grabbing;
    follow();
    return false;
}

void TouchTool::deepen(double factor)
{
    stylus_.deepen(factor);
    follow();
}

void TouchTool::refresh()
{
    if (!stylus_.isWaiting()) {
        refresh_timer_.stop();
    } else if (arrivals() != aimed_arrivals_) {
        follow();
    } else if (stylus_.refresh()) {
        if (!has_hand_moved_) {
            stylus_.pressAnew();
        }
        Q_EMIT redrawNeeded();
        Q_EMIT moved();
    }
}

bool TouchTool::showDevice(const std::optional<StylusPose>& pose)
{
    if (pose == device_) {
        return false;
    }
    device_ = pose;
    Q_EMIT redrawNeeded();
    Q_EMIT moved();
    return true;
}

const std::optional<StylusPose>& TouchTool::shown() const noexcept
{
    static const std::optional<StylusPose> kNone;
    const auto& mouse = is_chosen_ ? stylus_.pose() : kNone;
    const bool is_mouse_at_work = mouse && mouse->mode != StylusMode::Hover;
    return device_ && !is_mouse_at_work ? device_ : mouse;
}

bool TouchTool::isTouching() const noexcept
{
    return buttons_.is_pressing || (device_ && device_->is_in_contact);
}

} // namespace marsview
