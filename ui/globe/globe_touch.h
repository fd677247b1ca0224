// The Touch tool on the globe: the stylus that the pointer moves.
#pragma once

#include "core/session/body_terrain.h"
#include "haptics/interaction/body_stylus.h"
#include "ui/controllers/detached_jobs.h"

#include <QObject>

#include <memory>
#include <optional>

namespace marsview {

/// The mouse has a stylus while the tool is chosen and the pointer is over the terrain. What it
/// presses into is made on a worker thread when the tool is chosen first, and made again where the
/// exaggeration changes. GUI thread.
class GlobeTouch final : public QObject {
    Q_OBJECT

public:
    explicit GlobeTouch(QObject* parent = nullptr);
    ~GlobeTouch() override;

    /// Lifts the stylus where anything changed.
    void setScene(const BodyScene& scene, double exaggeration);
    void setChosen(bool is_chosen);
    bool isChosen() const noexcept { return is_chosen_; }
    void setModel(ContactModelKind model);
    /// What the stylus presses into is being made.
    bool isPreparing() const noexcept { return preparing_ != nullptr; }
    /// It is there.
    bool isReady() const noexcept { return is_ready_; }

    void setPressing(bool is_pressing) { buttons_.is_pressing = is_pressing; }
    bool isPressing() const noexcept { return buttons_.is_pressing; }
    void deepen(double factor) { stylus_.deepen(factor); }
    /// The pointer, a button or the camera changed: where the pointer is on the terrain, and how
    /// long a point of the screen is there.
    void follow(const std::optional<BodyAim>& at, double point_m);

    /// Of the mouse, in the body-fixed frame; empty while lifted or not chosen.
    const std::optional<StylusPose>& pose() const noexcept { return stylus_.pose(); }
    /// The local vertical at the stylus.
    const Vec3& up() const noexcept { return stylus_.up(); }

Q_SIGNALS:
    /// pose() may have changed.
    void moved();
    void preparingChanged(bool is_preparing);
    /// Why the terrain cannot be touched.
    void failed(const QString& reason);

private:
    void prepare();
    void cancel();

    BodyStylus stylus_;
    StylusButtons buttons_;
    BodyScene scene_;
    double exaggeration_ = 1.0;
    bool is_chosen_ = false;
    bool is_ready_ = false; // for exaggeration_
    std::shared_ptr<JobMonitor> preparing_;
    std::optional<BodyAim> at_; // and again when it can be pressed
    double point_m_ = 1.0;
    DetachedJobs jobs_;
};

} // namespace marsview
