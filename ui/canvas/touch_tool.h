// The Touch tool: the stylus that the pointer moves, and the stylus of a device shown instead.
#pragma once

#include "haptics/interaction/stylus.h"
#include "ui/canvas/shown_scene.h"
#include "ui/canvas/view_projection.h"

#include <QObject>
#include <QPointF>
#include <QTimer>

#include <cstdint>
#include <optional>

namespace marsview {

/// The mouse has a stylus whenever the pointer is over the terrain; it is shown while the tool is
/// chosen.
class TouchTool final : public QObject {
    Q_OBJECT

public:
    /// Both outlive this.
    TouchTool(const ShownScene& scene, const ViewProjection& projection);

    void setModel(ContactModelKind model);
    ContactModelKind model() const noexcept { return stylus_.model(); }
    /// The terrain or its exaggeration changed. follow() afterwards.
    void updateGround();
    void setChosen(bool is_chosen) { is_chosen_ = is_chosen; }

    /// Where the pointer is over the map, and not over an overlay.
    void setPointer(std::optional<QPointF> position) { pointer_ = position; }
    const std::optional<QPointF>& pointer() const noexcept { return pointer_; }
    /// The pointer, a button, the camera or the terrain changed: moves the stylus. Where finer
    /// terrain has arrived since the last call, a hand that has not moved since it began to press
    /// presses again.
    void follow();

    void setPressing(bool is_pressing);
    bool isPressing() const noexcept { return buttons_.is_pressing; }
    /// The key that grabs acts for the device where one is shown as it is pressed, otherwise for
    /// the mouse. Returns whether the device's grab begins or ends.
    bool setGrabbing(bool is_grabbing);
    /// With the mouse.
    bool isGrabbing() const noexcept { return buttons_.is_grabbing; }
    /// The pressing depth, deeper if factor > 1.
    void deepen(double factor);
    /// The hand moved over the terrain.
    void noteMotion() { has_hand_moved_ = true; }

    /// Of the mouse; empty while lifted.
    const std::optional<StylusPose>& pose() const noexcept { return stylus_.pose(); }
    /// Scene height of the place that the stylus grabbed to pan.
    double grabbedHeight() const noexcept { return grabbed_z_m_; }
    bool isOverTerrain() const noexcept { return is_over_terrain_; }

    /// Where a haptic device has its stylus. False where nothing changes.
    bool showDevice(const std::optional<StylusPose>& pose);
    const std::optional<StylusPose>& device() const noexcept { return device_; }
    /// The stylus drawn: the device's, unless the mouse presses or grabs with this tool.
    const std::optional<StylusPose>& shown() const noexcept;
    /// Whether the mouse or the device presses into the terrain.
    bool isTouching() const noexcept;

Q_SIGNALS:
    /// Something of pose() or shown() may have changed.
    void moved();
    /// A stylus has to be drawn or removed.
    void redrawNeeded();

private:
    void refresh();
    std::uint64_t arrivals() const;

    const ShownScene& scene_;
    const ViewProjection& projection_;
    Stylus stylus_;
    StylusButtons buttons_;
    std::optional<StylusPose> device_;
    std::optional<QPointF> pointer_;
    QTimer refresh_timer_; // runs while finer terrain may arrive below the stylus
    double grabbed_z_m_ = 0.0;
    std::uint64_t aimed_arrivals_ = 0; // when the stylus was last aimed
    bool is_chosen_ = false;
    bool is_device_grabbing_ = false;
    bool is_over_terrain_ = false;
    bool has_hand_moved_ = false; // since it began to press
};

} // namespace marsview
