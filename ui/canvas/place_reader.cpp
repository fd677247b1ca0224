#include "ui/canvas/place_reader.h"

#include <QWidget>

#include <chrono>

namespace marsview {
namespace {

using std::chrono::milliseconds;

// The pointer rests if it has not moved for so long.
constexpr milliseconds kRestInterval{120};

// The interval at which samples that were requested are looked for.
constexpr milliseconds kPointerInterval{40};

// The pointer is read for so long after it moved, in place of the stylus of a device.
constexpr milliseconds kLeadInterval{2000};

} // namespace

PlaceReader::PlaceReader(const ReadParts& parts)
    : parts_(parts)
{
    rest_timer_.setSingleShot(true);
    connect(&rest_timer_, &QTimer::timeout, this, &PlaceReader::readSamples);
    lead_timer_.setSingleShot(true);
    connect(&lead_timer_, &QTimer::timeout, this, &PlaceReader::report);
}

bool PlaceReader::isCrosshairShown() const
{
    const bool is_keyboard_here = parts_.view.hasFocus() || is_read_elsewhere_;
    return is_crosshair_allowed_ && !parts_.scene.isEmpty() && !is_dragging_ && is_keyboard_here &&
           (!parts_.touch.pointer() || is_keyboard_used_) && !isStylusRead();
}

bool PlaceReader::isStylusRead() const
{
    return parts_.touch.device() && !lead_timer_.isActive();
}

// The pointer or the crosshair has moved: even with a device, it is read for a while.
void PlaceReader::lead()
{
    if (parts_.touch.device()) {
        lead_timer_.start(kLeadInterval);
    }
}

std::optional<GroundPoint> PlaceReader::groundRead() const
{
    if (isStylusRead()) {
        return parts_.scene.groundBelow(parts_.touch.device()->proxy);
    }
    if (isCrosshairShown()) {
        // A ridge in front of the place would be read instead of it.
        if (typed_place_ && typed_place_->goal == parts_.camera.goal()) {
            return parts_.scene.groundBelow(typed_place_->place);
        }
        return parts_.projection.placeUnder(parts_.projection.center());
    }
    const auto& pointer = parts_.touch.pointer();
    return pointer ? parts_.projection.placeUnder(*pointer) : std::nullopt;
}

ReadingSource PlaceReader::source() const
{
    return isStylusRead()       ? ReadingSource::Stylus
           : isCrosshairShown() ? ReadingSource::Crosshair
                                : ReadingSource::Pointer;
}

std::optional<RayHit> PlaceReader::reading() const
{
    const std::optional<GroundPoint> ground = groundRead();
    return ground ? std::optional(parts_.scene.onTopmost(*ground)) : std::nullopt;
}

void PlaceReader::notePointer(QPointF position)
{
    if (parts_.touch.pointer() != position) { // otherwise it is reported again
        is_keyboard_used_ = false;
        lead();
    }
}

void PlaceReader::forgetPointer()
{
    if (parts_.touch.pointer()) {
        parts_.touch.setPointer(std::nullopt);
        parts_.touch.follow();
    }
    report();
}

void PlaceReader::noteStep()
{
    setKeyboardUsed(parts_.view.hasFocus());
}

void PlaceReader::setKeyboardUsed(bool is_used)
{
    if (is_used) {
        lead();
    }
    if (is_used != is_keyboard_used_) {
        is_keyboard_used_ = is_used;
        report();
    }
}

void PlaceReader::noteTypedPlace(const ScenePoint& place)
{
    typed_place_ = {.place = place, .goal = parts_.camera.goal()};
    setKeyboardUsed(true);
    report();
}

void PlaceReader::setReadElsewhere(bool is_read)
{
    is_read_elsewhere_ = is_read;
    report();
}

void PlaceReader::setCrosshairAllowed(bool is_allowed)
{
    is_crosshair_allowed_ = is_allowed;
    report();
}

void PlaceReader::report()
{
    const bool is_crosshair = isCrosshairShown();
    if (is_crosshair != was_crosshair_shown_) {
        was_crosshair_shown_ = is_crosshair;
        Q_EMIT crosshairChanged(is_crosshair);
    }
    const auto ground = groundRead();
    Q_EMIT readingChanged(ground ? std::optional(parts_.scene.onTopmost(*ground)) : std::nullopt);
    // A ray takes what is loaded. Where the pointer rests, the samples themselves are read.
    if (ground && !parts_.scene.layers()[ground->index].map->heightfield().isExact(ground->grid)) {
        rest_timer_.start(kRestInterval);
    }
}

void PlaceReader::readSamples()
{
    const auto ground = groundRead();
    if (!ground) {
        return;
    }
    const Heightfield& heightfield = parts_.scene.layers()[ground->index].map->heightfield();
    if (!heightfield.isExact(ground->grid)) {
        static_cast<void>(heightfield.height(ground->grid)); // requests it
        if (heightfield.tiles()->isLoading()) {
            rest_timer_.start(kPointerInterval);
            return;
        }
    }
    // It was loaded before or just now, or cannot be read.
    if (heightfield.isExact(ground->grid)) {
        parts_.touch.follow();
        report();
    }
}

} // namespace marsview
