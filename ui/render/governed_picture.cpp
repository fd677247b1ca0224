#include "ui/render/governed_picture.h"

#include <algorithm>
#include <epoxy/gl.h>

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;

// Shading gives way with the surface, but never so far that it looks blurred.
constexpr double kTexelPxMax = 2.0;

// The target is for the whole frame; the rest is for overlays and presentation.
constexpr double kPictureShare = 0.85;

// Counted in drawn pixels: an enlarged picture shows no finer detail than these.
DetailTarget detailFor(const FramePlan& plan)
{
    return {.error_px = plan.error_px / plan.scale,
            .texel_px = std::min(plan.error_px, kTexelPxMax) / plan.scale};
}

} // namespace

GovernedPicture::GovernedPicture(TerrainRenderer& renderer)
    : renderer_(renderer)
    , cost_(renderer.isSoftware() ? softwareFrameCost() : gpuFrameCost())
{}

DrawReport
GovernedPicture::paint(const PictureRequest& request, const DrawStyle& style, unsigned target)
{
    DrawRequest draw;
    draw.camera = request.camera;
    draw.body_pose = request.body_pose;
    draw.viewport = request.viewport;
    draw.is_kept = request.is_kept;
    draw.is_hasty = request.stage == PictureStage::Moving;
    draw.is_interim = request.stage != request.last_stage;
    const double pixel_count =
        static_cast<double>(request.viewport.width) * static_cast<double>(request.viewport.height);
    const auto triangles = [&](const FramePlan& plan) {
        draw.detail = detailFor(plan);
        return renderer_.countTriangles(draw, style.exaggeration);
    };
    if (request.stage == PictureStage::Moving) {
        plan_ = planFrame(cost_,
                          {.target = target_ * kPictureShare,
                           .pixel_count = pixel_count,
                           .is_touching = request.is_touching},
                          moving_plan_, triangles);
        moving_plan_ = plan_;
    } else {
        plan_ = planAtRest(pixel_count, triangles);
    }
    draw.detail = detailFor(plan_);
    draw.scale = plan_.scale;
    // A GPU smooths edges for next to nothing.
    const bool is_smooth = request.stage == PictureStage::Smooth || !renderer_.isSoftware();
    draw.samples = is_smooth ? kSmoothSamples : 1;
    const Clock::time_point begin = Clock::now();
    const DrawReport report = renderer_.draw(draw, style, target);
    glFinish();
    duration_ = Clock::now() - begin;
    if (request.stage != PictureStage::Smooth) {
        cost_ = learned(cost_,
                        {.triangle_count = report.triangle_count,
                         .pixel_count = pixel_count * plan_.scale * plan_.scale},
                        duration_);
    }
    return report;
}

std::unique_ptr<SupersampledPicture> GovernedPicture::finer(const PictureRequest& request,
                                                            const DrawStyle& style)
{
    if (contrastOf(renderer_.keptColors(), style) <= kSmoothContrastMax) {
        return nullptr;
    }
    DrawRequest draw{
        .camera = request.camera, .viewport = request.viewport, .body_pose = request.body_pose};
    const double sample_count = kSamplesPerSide * kSamplesPerSide *
                                static_cast<double>(request.viewport.width) *
                                static_cast<double>(request.viewport.height);
    // No more triangles than samples.
    const FramePlan plan =
        planAtRest(sample_count / kTrianglesPerPixelMax, [&](const FramePlan& tried) {
            draw.detail = detailFor(tried);
            return renderer_.countTriangles(supersampled(draw, renderer_, style.exaggeration),
                                            style.exaggeration);
        });
    draw.detail = detailFor(plan);
    return std::make_unique<SupersampledPicture>(renderer_, draw, style);
}

} // namespace marsview
