// The triangles of the globe's layers, for the stylus of the mouse and for a haptic device.
#pragma once

#include "core/session/body_terrain.h"
#include "haptics/interaction/body_stylus.h"
#include "ui/controllers/detached_jobs.h"

#include <QObject>
#include <QString>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// Made on a worker thread when the mouse or a device needs them, and again where the layers or the
/// exaggeration change; until then the earlier ones are kept. Maps on top of each other are joined
/// to one surface, which takes longer: for new layers they can be touched one by one until then.
/// GUI thread.
class GlobeMeshes final : public QObject {
    Q_OBJECT

public:
    enum class User : std::size_t { Mouse, Device };

    /// One surface for each map of the scene.
    struct Ground {
        BodyScene scene;
        double exaggeration = 1.0;
        std::vector<BodyStylus::Surface> surfaces;
        /// Why maps on top of each other are touched one by one; empty while they are being joined,
        /// and afterwards if they are.
        QString why_apart{};

        /// The surface with that index and those that it is joined with, the uppermost first.
        std::vector<std::size_t> joinedWith(std::size_t index) const;
    };

    explicit GlobeMeshes(QObject* parent = nullptr);
    ~GlobeMeshes() override;

    void setScene(const BodyScene& scene, double exaggeration);
    void setWanted(User user, bool is_wanted);

    bool isPreparing() const noexcept { return preparing_ != nullptr; }
    /// ground() is that of the scene of now.
    bool isReady() const noexcept { return is_ready_; }
    /// And what lies on top of each other in it is joined, or cannot be.
    bool isComplete() const noexcept { return is_ready_ && is_complete_; }
    /// The latest; empty before the first, and if a scene cannot be touched.
    const std::optional<Ground>& ground() const noexcept { return ground_; }
    /// Why the scene cannot be touched.
    const QString& problem() const noexcept { return problem_; }

Q_SIGNALS:
    /// Another scene or exaggeration: isReady() is false.
    void sceneChanged();
    void groundChanged();
    void preparingChanged(bool is_preparing);
    /// problem(), when the terrain is to be touched.
    void failed(const QString& problem);

private:
    bool isWanted() const noexcept { return is_wanted_[0] || is_wanted_[1]; }
    void prepare();
    void cancel();
    void take(std::optional<Ground> ground, const QString& problem);
    void takeJoined(const Ground& ground);

    BodyScene scene_;
    double exaggeration_ = 1.0;
    std::array<bool, 2> is_wanted_{};
    bool is_ready_ = false;
    bool is_complete_ = false;
    std::optional<Ground> ground_;
    QString problem_;
    std::shared_ptr<JobMonitor> preparing_; // of ground_
    std::shared_ptr<JobMonitor> joining_;   // of its maps; null while preparing
    DetachedJobs jobs_;
};

/// The same map at the same place, with the same edges.
bool isSameMap(const BodyTerrain& a, const BodyTerrain& b);
bool areSameMaps(const BodyScene& a, const BodyScene& b);

} // namespace marsview
