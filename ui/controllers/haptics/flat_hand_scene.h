// The flat map as a haptic device touches it.
#pragma once

#include "haptics/terrain/touch_map.h"
#include "ui/controllers/hand_scene.h"

#include <memory>

namespace marsview {

class TerrainView;

/// The view outlives it.
class FlatHandScene final : public HandScene {
    Q_OBJECT

public:
    explicit FlatHandScene(TerrainView& view, QObject* parent = nullptr);

    bool isOnBody() const override { return false; }
    void setInUse(bool /*is_in_use*/) override {}

    std::vector<std::shared_ptr<const Map>> maps() const override;
    double exaggeration() const override;
    bool canTouch(std::size_t /*index*/) const override { return true; }
    QString whyNone() const override { return {}; }
    std::optional<std::size_t> mapAt(const ScenePoint& hand) const override;
    void touch(std::size_t index) override;
    void release() override { map_.reset(); }
    std::optional<std::size_t> touched() const override;
    bool isTouched(std::size_t index) const override { return touched() == index; }
    QString whyApart() const override { return {}; }
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
    double heightOf(const ScenePoint& place) const override { return place.z; }

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
    NavigationLimits limits() const;

    TerrainView& view_;
    std::unique_ptr<TouchMap> map_; // that is touched
    FlatCameraLink link_;
};

} // namespace marsview
