// Pictures that are ready in time while something moves, and as fine as can be when nothing does.
#pragma once

#include "core/view/frame_governor.h"
#include "ui/render/supersampled_picture.h"
#include "ui/render/terrain_renderer.h"

#include <chrono>
#include <memory>
#include <optional>

namespace marsview {

/// After so long without a motion the picture becomes sharp.
inline constexpr std::chrono::milliseconds kStillAfter{120};

/// While shading is still being made, a sharp picture is drawn again at most this often.
inline constexpr std::chrono::milliseconds kNewsInterval{250};

/// How much a picture may take.
enum class PictureStage {
    Moving, // ready in time, as fine as that allows
    Sharp,  // a threshold of one pixel, see planAtRest()
    Smooth, // and with smooth edges
};

/// The picture to paint.
struct PictureRequest {
    OrbitCamera camera;
    Viewport viewport;
    PictureStage stage = PictureStage::Moving;
    PictureStage last_stage = PictureStage::Smooth; // after which no better one follows
    bool is_touching = false;                       // see FrameRequest
    bool is_kept = false;                           // for TerrainRenderer::present()
    std::optional<CameraPose> body_pose{}; // replaces `camera` where layers lie on their body
};

/// Chooses the detail of each picture by what the ones before took (core/view/frame_governor.h).
/// Use with the renderer's context current; must not outlive the renderer.
class GovernedPicture {
public:
    explicit GovernedPicture(TerrainRenderer& renderer);

    /// The time that a frame may take while something moves.
    void setTarget(Milliseconds target) { target_ = target; }

    /// Draws into `target` and waits until it is done, so that it knows how long that took.
    DrawReport paint(const PictureRequest& request, const DrawStyle& style, unsigned target);

    /// A finer picture than the smooth one of `request`, which was kept last; null where
    /// neighboring pixels of that differ little.
    std::unique_ptr<SupersampledPicture> finer(const PictureRequest& request,
                                               const DrawStyle& style);

    /// Of the last picture.
    const FramePlan& plan() const noexcept { return plan_; }
    Milliseconds duration() const noexcept { return duration_; }

private:
    TerrainRenderer& renderer_;
    Milliseconds target_{33.0};
    FrameCost cost_;
    FramePlan moving_plan_; // of the last picture in motion
    FramePlan plan_;
    Milliseconds duration_{0.0};
};

} // namespace marsview
