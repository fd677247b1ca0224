// Speed and accuracy of the window's pictures: flights over a map, without a window.
#pragma once

#include "app/bench/reference/color_error.h"
#include "app/bench/reference/flight.h"
#include "app/bench/reference/picture_error.h"
#include "app/console/scene.h"
#include "core/base/job_monitor.h"
#include "core/view/frame_governor.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

struct ViewBenchOptions {
    Viewport viewport{1280, 800};
    Milliseconds target{33.0};
    int frame_count = 120;              // per flight
    int pose_count = 5;                 // per flight, at which the error is measured
    double error_px = 1.0;              // at rest
    std::optional<double> exaggeration; // default: chosen for each map
    std::vector<double> color_exaggerations{0.5, 1.0, 2.0, 10.0}; // for the color measurement
    bool is_full = false; // compare with pictures of every sample, however many there are
    /// On the body the errors and colors of pictures at rest have no reference: they are left out.
    SceneKind scene = SceneKind::Flat;
};

/// One frame of a flight.
struct FlownFrame {
    Milliseconds wall{0.0};
    Milliseconds processor{0.0}; // of all threads; counted in the system's steps
    std::size_t triangle_count = 0;
    FramePlan plan;
    bool is_complete = true; // including the shading of its details
};

/// The picture at rest compared with a picture that draws every sample.
struct ColorDifference {
    double mean_levels = 0.0; // of 255, over all pixels and channels
    int p99_levels = 0;
    int max_levels = 0;
    double share_visible = 0.0; // of pixels with a channel that differs by more than 8 levels
    std::size_t full_triangle_count = 0;
};

/// A picture at rest.
struct RestingPose {
    OrbitCamera camera; // on the body: target in the body-fixed frame, angles as of BodyCamera
    std::size_t triangle_count = 0;
    double error_bound_px = 0.0;       // the renderer's bound
    std::optional<PictureError> error; // measured; nothing on the body
    std::optional<ColorDifference> difference;
};

/// The colors of one view at rest, compared with those of the surface.
struct ColorPose {
    ColorError centers; // of the sharp picture, which has one sample per pixel
    ColorError means;   // of the smooth picture that follows it
};

/// The colors of pictures at rest at one exaggeration.
struct ColorResult {
    double exaggeration = 1.0;
    std::vector<ColorPose> poses; // of all flights
};

struct FlightResult {
    Flight flight = Flight::Orbit;
    std::vector<FlownFrame> frames;
    /// Since the last frame in motion, including the delay before sharpening.
    Milliseconds sharp_after{0.0};
    Milliseconds smooth_after{0.0};
    std::size_t sharp_triangle_count = 0;
    std::vector<RestingPose> poses;
};

struct ViewBenchResult {
    std::string path;
    std::string driver;
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::size_t triangle_count = 0;
    double exaggeration = 1.0;
    Milliseconds first_picture{0.0}; // since the file was opened
    Milliseconds sharp_picture{0.0};
    std::size_t peak_memory_loaded_bytes = 0;
    std::size_t peak_memory_flown_bytes = 0;
    std::vector<FlightResult> flights;
    std::vector<ColorResult> colors;
};

/// Pictures of every sample are drawn for more triangles than this only on request.
inline constexpr std::size_t kFullTrianglesMax = 20'000'000;

/// Opens the map, flies all flights as the window would draw them, and measures pictures at rest
/// along them. Takes seconds to minutes.
Result<ViewBenchResult> benchView(const MapOptions& map, const ViewBenchOptions& options);

} // namespace marsview
