// The globe as a haptic device touches it.
#pragma once

#include "core/session/body_terrain.h"
#include "haptics/interaction/body_stylus.h"
#include "ui/controllers/hand_scene.h"

#include <cstdint>

namespace marsview {

class GlobeView;

/// The globe outlives it.
class GlobeHandScene final : public HandScene {
    Q_OBJECT

public:
    explicit GlobeHandScene(GlobeView& globe, QObject* parent = nullptr);

    bool isOnBody() const override { return true; }
    void setInUse(bool is_in_use) override;

    std::vector<std::shared_ptr<const Map>> maps() const override;
    double exaggeration() const override;
    bool canTouch(std::size_t index) const override;
    QString whyNone() const override;
    std::optional<std::size_t> mapAt(const ScenePoint& hand) const override;
    void touch(std::size_t index) override;
    void release() override { touched_.reset(); }
    std::optional<std::size_t> touched() const override;
    bool isTouched(std::size_t index) const override;
    QString whyApart() const override;
    std::shared_ptr<ServoMap> make(ContactModelKind kind) const override;

    void fit(const WorkspaceBox& workspace, LoopSettings& settings) override;
    bool keepsWorkspace() override;
    LinkStep
    follow(const LoopFrame& loop, const WorkspaceBox& workspace, LoopSettings& settings) override;
    std::optional<WorkspaceBox> strokes(const WorkspaceBox& workspace) const override;
    double highestTerrainIn(const WorkspaceBox& rectangle) const override;

    bool isEmpty() const override;
    WorkspaceFrame fittedFrame(const WorkspaceBox& workspace) const override;
    HeightRange heightRange() const override;
    double heightOf(const ScenePoint& place) const override;

    void show(const std::optional<StylusPose>& pose) override;
    const std::optional<StylusPose>& shownStylus() const override;
    bool isInPicture(const ScenePoint& place) const override;
    bool isMoving() const override;
    SceneCamera cameraGoal() const override;
    void flyTo(const SceneCamera& camera) override;
    void flyToPlace(const ScenePoint& place) override;
    bool isPlacing() const override;
    void pressStylus(const ScenePoint& place) override;
    void releaseStylus() override;

private:
    // A map where it is, or several that are joined to one surface, the uppermost first; the same
    // ones at another exaggeration.
    struct Touched {
        std::vector<BodyTerrain> maps;
        std::uint64_t map_id = 0;
        std::shared_ptr<const LayeredMesh> joined{}; // the latest
        double radius_m = 1.0;
        std::vector<std::shared_ptr<const TiledBodyMesh>> tiled{}; // of which it has been made
        std::unique_ptr<TouchMap> tiles{};                         // of these maps, or null
    };

    std::vector<BodyTerrain> surfaceOf(std::size_t index) const;
    std::vector<std::shared_ptr<const TiledBodyMesh>> tiledOf(std::size_t index) const;

    BodyGround ground() const;

    GlobeView& globe_;
    std::optional<Touched> touched_;
    BodyCameraLink link_;
};

} // namespace marsview
