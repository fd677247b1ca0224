#include "app/bench/closed_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace marsview {
namespace {

constexpr double kCellM = 1.0;

// From the lowest to the highest sample.
SceneBox boxOf(const ServoMap& map, const ClosedLoop::HeightOf& height_m)
{
    const Georeference& grid = map.frame.georeference();
    const SceneFrame& frame = map.frame.frame();
    const double last_column = static_cast<double>(grid.columns() - 1);
    const double last_row = static_cast<double>(grid.rows() - 1);
    const ScenePoint a = frame.toScene({0.0, 0.0}, 0.0);
    const ScenePoint b = frame.toScene({last_column, last_row}, 0.0);
    constexpr int kProbes = 32;
    double low_m = std::numeric_limits<double>::infinity();
    double high_m = -low_m;
    for (int i = 0; i <= kProbes; ++i) {
        for (int j = 0; j <= kProbes; ++j) {
            const double z_m =
                height_m(a.x + (b.x - a.x) * i / kProbes, a.y + (b.y - a.y) * j / kProbes);
            low_m = std::min(low_m, z_m);
            high_m = std::max(high_m, z_m);
        }
    }
    return {{std::min(a.x, b.x), std::min(a.y, b.y), low_m},
            {std::max(a.x, b.x), std::max(a.y, b.y), high_m}};
}

} // namespace

ClosedLoop::ClosedLoop(ClosedLoopOptions options, std::shared_ptr<ServoMap> map, HeightOf height_m)
    : options_(std::move(options))
    , tick_options_(tickOptionsFor(options_.device))
    , hand_(options_.hand, options_.hand_begin)
    , view_(reachWithin(options_.device.workspace))
{
    settings.stiffness_n_per_m = options_.stiffness_n_per_m;
    const double across_m = boxOf(*map, height_m).diagonal_m();
    setMap(std::move(map), std::move(height_m));
    moveCamera({.target = {0.0, 0.0, 0.0}, .distance_m = 0.75 * across_m});
}

void ClosedLoop::setMap(std::shared_ptr<ServoMap> map, HeightOf height_m)
{
    settings.map = std::move(map);
    if (settings.map) {
        height_m_ = std::move(height_m);
        const Georeference& grid = settings.map->frame.georeference();
        view_.setMap({.frame = settings.map->frame.frame(),
                      .columns = grid.columns(),
                      .rows = grid.rows(),
                      .limits = navigationLimits(boxOf(*settings.map, height_m_), kCellM),
                      .height_m = height_m_});
        moveCamera(view_.camera());
    }
}

double ClosedLoop::surfaceZ() const
{
    ScenePoint at = frame().toScene(hand_.measured());
    at.z = height_m_(at.x, at.y);
    return frame().toWorkspace(at).z;
}

void ClosedLoop::moveCamera(const OrbitCamera& camera)
{
    if (settings.map) {
        view_.moveCamera(camera, settings);
    }
}

const StepResult& ClosedLoop::tick(double dt_s)
{
    hand_.advance(dt_s);
    input_.settings = &settings;
    input_.device = &options_.device;
    input_.now += std::chrono::nanoseconds(static_cast<std::int64_t>(dt_s * 1e9));
    input_.sample.position = hand_.measured();
    input_.sample.twist_rad = twist_rad_;
    input_.sample.time = input_.now;
    last_ = step(tick_options_, input_, state_, dt_s);
    hand_.push(last_.force_n);
    if (++ticks_ % options_.poll_ticks == 0 && settings.map) {
        view_.follow(state_.seen_frame, state_.frame_number, last_.mode, settings);
    }
    return last_;
}

} // namespace marsview
