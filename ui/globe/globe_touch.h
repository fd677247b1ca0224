// The Touch tool on the globe: the stylus that the pointer moves.
#pragma once

#include "haptics/interaction/body_stylus.h"
#include "ui/globe/globe_meshes.h"

#include <QObject>
#include <QTimer>

#include <cstdint>
#include <optional>

namespace marsview {

/// The mouse has a stylus while the tool is chosen and the pointer is over the terrain. It is
/// lifted where the scene changes. GUI thread.
class GlobeTouch final : public QObject {
    Q_OBJECT

public:
    /// The meshes outlive it.
    explicit GlobeTouch(GlobeMeshes& meshes, QObject* parent = nullptr);

    void setChosen(bool is_chosen);
    bool isChosen() const noexcept { return is_chosen_; }
    void setModel(ContactModelKind model);
    /// There is something to press into.
    bool isReady() const noexcept { return is_chosen_ && meshes_.isReady(); }

    void setPressing(bool is_pressing);
    /// The body is held by the stylus, and moves with the pointer.
    void setGrabbing(bool is_grabbing);
    bool isGrabbing() const noexcept { return buttons_.is_grabbing; }
    bool isPressing() const noexcept { return buttons_.is_pressing; }
    /// The hand moved over the terrain.
    void noteMotion() { has_hand_moved_ = true; }
    void deepen(double factor) { stylus_.deepen(factor); }
    /// The pointer, a button or the camera changed: where the pointer is on the terrain, and how
    /// long a point of the screen is there. Where finer terrain has arrived since the last call, a
    /// hand that has not moved since it began to press presses again.
    void follow(const std::optional<BodyAim>& at, double point_m);

    /// Of the mouse, in the body-fixed frame; empty while lifted or not chosen.
    const std::optional<StylusPose>& pose() const noexcept { return stylus_.pose(); }
    /// The local vertical at the stylus.
    const Vec3& up() const noexcept { return stylus_.up(); }

Q_SIGNALS:
    /// pose() may have changed.
    void moved();
    /// Finer terrain has arrived: where the pointer is on it may have changed.
    void aimOutdated();

private:
    void takeGround();
    void refresh();
    std::uint64_t arrivals() const;

    GlobeMeshes& meshes_;
    BodyStylus stylus_;
    StylusButtons buttons_;
    bool is_chosen_ = false;
    std::optional<BodyAim> at_; // and again when it can be pressed
    double point_m_ = 1.0;
    QTimer refresh_timer_; // runs while finer terrain may arrive below the stylus
    std::uint64_t aimed_arrivals_ = 0;
    bool has_hand_moved_ = false; // since it began to press
};

} // namespace marsview
