#include "app/bench/view_bench.h"

#include "app/console/long_job.h"
#include "app/console/machine.h"
#include "core/base/check.h"
#include "core/globe/body_navigation.h"
#include "core/session/body_terrain.h"
#include "ui/render/governed_picture.h"
#include "ui/render/offscreen_picture.h"
#include "ui/render/opengl/frame_buffer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <fmt/format.h>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;

// A visible difference between neighboring areas, of 255.
constexpr int kVisibleLevels = 8;

// Between pixels at which colors are measured. A mean takes 17 rays.
constexpr std::size_t kCenterStride = 3;
constexpr std::size_t kMeanStride = 8;

// A pixel of the smooth picture, as in the window.

// Notified on the renderer's threads when shading is ready. It may outlive the bench.
class News {
public:
    void post()
    {
        {
            const std::lock_guard lock(mutex_);
            has_news_ = true;
        }
        arrived_.notify_all();
    }
    // Waits for a notification since the last call, or until `end`.
    void waitUntil(Clock::time_point end)
    {
        std::unique_lock lock(mutex_);
        arrived_.wait_until(lock, end, [this] { return has_news_; });
        has_news_ = false;
    }

private:
    std::mutex mutex_;
    std::condition_variable arrived_;
    bool has_news_ = false;
};

ColorDifference differenceOf(const Picture& a, const Picture& b)
{
    MARSVIEW_CHECK(a.rgb.size() == b.rgb.size());
    ColorDifference difference;
    double sum = 0.0;
    std::size_t visible = 0;
    std::array<std::size_t, 256> counts{};
    for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
        int most = 0;
        for (std::size_t channel = i; channel < i + 3; ++channel) {
            const int levels = std::abs(int{a.rgb[channel]} - int{b.rgb[channel]});
            sum += levels;
            ++counts[static_cast<std::size_t>(levels)];
            most = std::max(most, levels);
        }
        visible += most > kVisibleLevels ? 1U : 0U;
    }
    const auto values = static_cast<double>(a.rgb.size());
    difference.mean_levels = sum / values;
    difference.share_visible = 3.0 * static_cast<double>(visible) / values;
    double below = 0.0;
    for (std::size_t levels = 0; levels < counts.size(); ++levels) {
        difference.p99_levels += below < 0.99 * values && levels > 0 ? 1 : 0;
        below += static_cast<double>(counts[levels]);
        difference.max_levels =
            counts[levels] > 0 ? static_cast<int>(levels) : difference.max_levels;
    }
    return difference;
}

// From where a picture is drawn.
struct FlownView {
    OrbitCamera camera; // as in RestingPose
    std::optional<CameraPose> body_pose{};
};

// Draws one map as ui/canvas/terrain_view.cpp does, on its body as ui/globe/globe_view.cpp does.
class ViewBench {
public:
    ViewBench(const Scene& scene,
              double exaggeration,
              const ViewBenchOptions& options,
              News& news,
              JobMonitor& monitor)
        : scene_(scene)
        , exaggeration_(exaggeration)
        , options_(options)
        , news_(news)
        , monitor_(monitor)
        , buffer_(options.viewport)
        , picture_(*scene.renderer)
        , ground_{.box = scene.box(exaggeration),
                  .pixel_m = std::min(scene.map->georeference().pixelWidthMeters(),
                                      scene.map->georeference().pixelHeightMeters()),
                  .height = [this](double east_m, double north_m) {
                      return scene_.ground(east_m, north_m, exaggeration_);
                  }}
    {
        picture_.setTarget(options.target);
        style_.exaggeration = exaggeration;
        if (scene.body_grid) {
            const HeightRange range = scene.map->heightfield().range().value_or(HeightRange{});
            body_ground_ = BodyFlightGround{
                .limits = bodyLimits(*scene.body_grid, range.minimum_m * exaggeration,
                                     range.maximum_m * exaggeration),
                .pixel_m = ground_.pixel_m,
                .height = [terrain = BodyTerrain(scene.map, scene.body_grid),
                           exaggeration](const GeographicPoint& place) {
                    return exaggeration * terrain.height(place);
                }};
        }
    }
    ViewBench(const ViewBench&) = delete;
    ViewBench& operator=(const ViewBench&) = delete;

    bool canDraw() const { return buffer_.isComplete(); }

    FlownView view(Flight flight, double t) const
    {
        if (!body_ground_) {
            return {scene_.bounded(cameraOn(flight, t, ground_, options_.viewport), exaggeration_)};
        }
        const Ellipsoid& ellipsoid = body_ground_->limits.ellipsoid;
        const BodyCamera camera =
            constrained(bodyCameraOn(flight, t, *body_ground_, options_.viewport),
                        body_ground_->limits, body_ground_->height);
        return {.camera = {.target = targetOf(camera, ellipsoid),
                           .distance_m = camera.distance_m,
                           .azimuth = camera.azimuth,
                           .tilt = camera.tilt,
                           .field_of_view = camera.field_of_view},
                .body_pose = poseOf(camera, ellipsoid)};
    }

    DrawReport paint(const FlownView& view, PictureStage stage)
    {
        const DrawReport report = picture_.paint({.camera = view.camera,
                                                  .viewport = options_.viewport,
                                                  .stage = stage,
                                                  .is_touching = false,
                                                  .is_kept = true,
                                                  .body_pose = view.body_pose},
                                                 style_, buffer_.id());
        scene_.renderer->presentDepth(buffer_.id(), cursorArea());
        glFinish();
        return report;
    }

    // Draws until all shading is ready, as often as the window would.
    DrawReport paintWhole(const FlownView& view, PictureStage stage)
    {
        DrawReport report = paint(view, stage);
        Clock::time_point last = Clock::now();
        while (!report.is_complete && !monitor_.isCanceled()) {
            while (scene_.renderer->isLoading() && Clock::now() < last + kNewsInterval) {
                news_.waitUntil(last + kNewsInterval);
            }
            report = paint(view, stage);
            last = Clock::now();
        }
        return report;
    }

    FlightResult fly(Flight flight)
    {
        FlightResult result;
        result.flight = flight;
        FlownView last;
        for (int i = 0; i < options_.frame_count && !monitor_.isCanceled(); ++i) {
            const Clock::time_point begin = Clock::now();
            const Milliseconds processor_begin = processorTime();
            last = view(flight, momentOf(i));
            const DrawReport report = paint(last, PictureStage::Moving);
            result.frames.push_back({.wall = Clock::now() - begin,
                                     .processor = processorTime() - processor_begin,
                                     .triangle_count = report.triangle_count,
                                     .plan = picture_.plan(),
                                     .is_complete = report.is_complete});
        }
        const Clock::time_point stop = Clock::now();
        std::this_thread::sleep_until(stop + kStillAfter);
        result.sharp_triangle_count = paintWhole(last, PictureStage::Sharp).triangle_count;
        result.sharp_after = Clock::now() - stop;
        paintWhole(last, PictureStage::Smooth);
        result.smooth_after = Clock::now() - stop;
        return result;
    }

    Result<RestingPose> rest(const FlownView& view)
    {
        const bool is_on_body = view.body_pose.has_value();
        DrawRequest request{.camera = view.camera, .viewport = options_.viewport};
        request.body_pose = view.body_pose;
        request.detail = {.error_px = options_.error_px, .texel_px = 1.0};
        const Result<OffscreenPicture> picture = drawOffscreen(
            *scene_.renderer, request, style_, is_on_body ? DepthUse::No : DepthUse::Yes);
        if (!picture) {
            return picture.error();
        }
        RestingPose pose{.camera = view.camera,
                         .triangle_count = picture->report.triangle_count,
                         .error_bound_px = picture->report.error_px,
                         .error = std::nullopt,
                         .difference = std::nullopt};
        if (!is_on_body) {
            const Heightfield& heightfield = scene_.map->heightfield();
            const SceneFrame& frame = scene_.map->georeference().sceneFrame();
            pose.error =
                measurePictureError({heightfield, frame, exaggeration_}, view.camera,
                                    options_.viewport, picture->depths_m, options_.error_px);
        }
        const std::size_t all = scene_.map->info().triangleCount();
        if (options_.is_full || all <= kFullTrianglesMax) {
            request.detail.has_every_sample = true;
            const Result<OffscreenPicture> full =
                drawOffscreen(*scene_.renderer, request, style_, DepthUse::No);
            if (!full) {
                return full.error();
            }
            pose.difference = differenceOf(picture->colors, full->colors);
            pose.difference->full_triangle_count = full->report.triangle_count;
        }
        return pose;
    }

    Result<ColorPose> colors(const OrbitCamera& camera)
    {
        const Result<LitColors> sharp = litColors(camera, 1);
        const Result<LitColors> smooth = litColors(camera, kSmoothSamples);
        if (!sharp || !smooth) {
            return sharp ? smooth.error() : sharp.error();
        }
        const TintedScene tinted{.drawn = {scene_.map->heightfield(),
                                           scene_.map->georeference().sceneFrame(), exaggeration_},
                                 .bounds = scene_.map->analysis()->bounds,
                                 .ramp = scene_.ramp(),
                                 .range = tintedRange(scene_.ramp(), scene_.map->tintRange())};
        const auto error_of = [&](const LitColors& colors, const ColorSampling& sampling) {
            return measureColorError(tinted, camera, options_.viewport,
                                     {.tint = colors.tint.colors.rgb,
                                      .light = colors.light.colors.rgb,
                                      .depths_m = sharp->tint.depths_m},
                                     sampling);
        };
        return ColorPose{.centers = error_of(*sharp, {ColorReference::Center, kCenterStride}),
                         .means = error_of(*smooth, {ColorReference::Mean, kMeanStride})};
    }

private:
    struct LitColors {
        OffscreenPicture tint; // with depths where it has one sample a pixel
        OffscreenPicture light;
    };

    Result<LitColors> litColors(const OrbitCamera& camera, int samples)
    {
        DrawRequest request{.camera = camera, .viewport = options_.viewport};
        request.detail = {.error_px = options_.error_px, .texel_px = 1.0};
        request.samples = samples;
        DrawStyle style = style_;
        Result<OffscreenPicture> tint = drawOffscreen(*scene_.renderer, request, style,
                                                      samples > 1 ? DepthUse::No : DepthUse::Yes);
        style.look.mode = ShadingMode::Hillshade;
        Result<OffscreenPicture> light =
            drawOffscreen(*scene_.renderer, request, style, DepthUse::No);
        if (!tint || !light) {
            return tint ? light.error() : tint.error();
        }
        return LitColors{std::move(tint).value(), std::move(light).value()};
    }

    // The area around a cursor in the center of the picture.
    PixelArea cursorArea() const
    {
        constexpr int kSide = 64;
        const Viewport& size = options_.viewport;
        return {.left = std::max(0, (size.width - kSide) / 2),
                .bottom = std::max(0, (size.height - kSide) / 2),
                .width = std::min(kSide, size.width),
                .height = std::min(kSide, size.height)};
    }

    double momentOf(int frame) const
    {
        return options_.frame_count > 1 ? frame / (options_.frame_count - 1.0) : 0.0;
    }

    const Scene& scene_;
    double exaggeration_;
    const ViewBenchOptions& options_;
    News& news_;
    JobMonitor& monitor_;
    FrameBuffer buffer_; // like the window's
    GovernedPicture picture_;
    FlightGround ground_;
    std::optional<BodyFlightGround> body_ground_; // on the body, instead of ground_
    DrawStyle style_;
};

} // namespace

Result<ViewBenchResult> benchView(const MapOptions& map, const ViewBenchOptions& options)
{
    forgetPeakMemory();
    const Clock::time_point begin = Clock::now();
    const auto news = std::make_shared<News>();
    Result<Scene> scene = openScene(
        map, nullptr, [news] { news->post(); }, options.scene);
    if (!scene) {
        return std::move(scene).error();
    }
    scene->exaggeration = options.exaggeration.value_or(scene->exaggeration);
    const RasterInfo& info = scene->map->info();
    LongJob job("flying");
    ViewBench bench(*scene, scene->exaggeration, options, *news, job.monitor());
    if (!bench.canDraw()) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("{} × {} pixels: this driver has no frame buffer of that size",
                                 options.viewport.width, options.viewport.height)};
    }
    ViewBenchResult result;
    result.path = map.path;
    result.driver = scene->renderer->driver();
    result.columns = info.columns;
    result.rows = info.rows;
    result.triangle_count = info.triangleCount();
    result.exaggeration = scene->exaggeration;
    const FlownView opening = bench.view(Flight::Orbit, 0.0);
    bench.paint(opening, PictureStage::Moving);
    result.first_picture = Clock::now() - begin;
    bench.paintWhole(opening, PictureStage::Sharp);
    result.sharp_picture = Clock::now() - begin;
    result.peak_memory_loaded_bytes = peakMemoryBytes();
    const std::vector<double> color_exaggerations =
        options.scene == SceneKind::Flat ? options.color_exaggerations : std::vector<double>{};
    const std::size_t step_count =
        kFlights.size() + kFlights.size() * static_cast<std::size_t>(options.pose_count) *
                              (1 + color_exaggerations.size());
    std::size_t step = 0;
    const auto go_on = [&] {
        job.monitor().report(static_cast<double>(++step) / static_cast<double>(step_count));
        return !job.monitor().isCanceled();
    };
    const Error canceled{ErrorCode::Canceled, fmt::format("{}: measuring was canceled", map.path)};
    for (const Flight flight : kFlights) {
        result.flights.push_back(bench.fly(flight));
        if (!go_on()) {
            return canceled;
        }
    }
    result.peak_memory_flown_bytes = peakMemoryBytes();
    const auto pose_moment = [&](int pose) { return (pose + 0.5) / options.pose_count; };
    // Last, since the window does not draw these pictures.
    for (FlightResult& flight : result.flights) {
        for (int i = 0; i < options.pose_count; ++i) {
            Result<RestingPose> pose = bench.rest(bench.view(flight.flight, pose_moment(i)));
            if (!pose) {
                return std::move(pose).error();
            }
            flight.poses.push_back(*pose);
            if (!go_on()) {
                return canceled;
            }
        }
    }
    for (const double exaggeration : color_exaggerations) {
        ViewBench other(*scene, exaggeration, options, *news, job.monitor());
        ColorResult& colors = result.colors.emplace_back();
        colors.exaggeration = exaggeration;
        for (const Flight flight : kFlights) {
            for (int i = 0; i < options.pose_count; ++i) {
                const Result<ColorPose> pose =
                    other.colors(other.view(flight, pose_moment(i)).camera);
                if (!pose) {
                    return pose.error();
                }
                colors.poses.push_back(*pose);
                if (!go_on()) {
                    return canceled;
                }
            }
        }
    }
    return result;
}

} // namespace marsview
