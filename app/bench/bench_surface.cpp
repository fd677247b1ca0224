#include "app/bench/bench_surface.h"

#include "app/bench/reference/local_minimum.h"
#include "app/bench/reference/reference_proxy.h"
#include "core/body/body_positions.h"
#include "core/contact/body_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace marsview {
namespace {

class FlatIdeal final : public IdealProxy {
public:
    FlatIdeal(const HeightfieldSurface& surface, double piece_cells)
        : reference_(surface, piece_cells)
    {}
    ScenePoint place(const ScenePoint& goal) override { return reference_.place(goal).proxy; }
    ScenePoint update(const ScenePoint& goal) override { return reference_.update(goal).proxy; }
    std::uint64_t unfinishedCount() const override { return reference_.unfinishedCount(); }

private:
    ReferenceProxy reference_;
};

// A model that gets the goal's motion in small pieces.
class CutIdeal final : public IdealProxy {
public:
    CutIdeal(std::unique_ptr<ContactModel> model, double piece_m)
        : model_(std::move(model))
        , piece_m_(piece_m)
    {}
    ScenePoint place(const ScenePoint& goal) override
    {
        last_ = goal;
        return note(model_->place(goal));
    }
    ScenePoint update(const ScenePoint& goal) override
    {
        const Vec3 way = goal - last_;
        const double pieces = std::max(1.0, std::ceil(length(way) / piece_m_));
        for (double piece = 1.0; piece < pieces; piece += 1.0) {
            note(model_->update(last_ + way * (piece / pieces)));
        }
        last_ = goal;
        return note(model_->update(goal));
    }
    std::uint64_t unfinishedCount() const override { return unfinished_count_; }

private:
    ScenePoint note(const ContactState& state)
    {
        unfinished_count_ += state.counters.cut_short > 0 ? 1U : 0U;
        return state.proxy;
    }

    std::unique_ptr<ContactModel> model_;
    double piece_m_;
    ScenePoint last_{};
    std::uint64_t unfinished_count_ = 0;
};

class FlatSurface final : public BenchSurface {
public:
    explicit FlatSurface(HeightfieldSurface surface)
        : surface_(std::move(surface))
    {}
    double cellM() const override { return ReferenceProxy::cellMeters(surface_.frame()); }
    std::vector<ScenePoint> strokes(const StrokeOptions& options) const override
    {
        return strokesOfAHand(surface_, options);
    }
    std::unique_ptr<ContactModel> model(ContactModelKind kind,
                                        const ContactModelOptions& options) const override
    {
        return makeContactModel(kind, surface_, options);
    }
    std::unique_ptr<IdealProxy> ideal(double piece_cells) const override
    {
        return std::make_unique<FlatIdeal>(surface_, piece_cells);
    }
    ScenePoint seen(const ScenePoint& goal) const override { return clampedGoal(surface_, goal); }
    double steepestCosineAt(const ScenePoint& proxy, const ScenePoint& goal) const override
    {
        return steepestCosine(surface_, proxy, goal);
    }

private:
    HeightfieldSurface surface_;
};

class SurfaceOnBody final : public BenchSurface {
public:
    SurfaceOnBody(HeightfieldSurface flat, Georeference georeference, BodySurface surface)
        : flat_(std::move(flat))
        , georeference_(std::move(georeference))
        , surface_(std::move(surface))
    {}
    double cellM() const override { return ReferenceProxy::cellMeters(flat_.frame()); }
    std::vector<ScenePoint> strokes(const StrokeOptions& options) const override
    {
        std::vector<ScenePoint> goals = strokesOfAHand(flat_, options);
        const Ellipsoid& ellipsoid = surface_.mesh()->positions().ellipsoid();
        for (ScenePoint& goal : goals) {
            const auto place = georeference_.toGeographic(flat_.frame().toGrid(goal));
            const BodyPositions::Foot foot = footOf(ellipsoid, *place); // the map has a body
            const Vec3 at = foot.surface_m + foot.normal * goal.z;
            goal = {at.x, at.y, at.z};
        }
        return goals;
    }
    std::unique_ptr<ContactModel> model(ContactModelKind kind,
                                        const ContactModelOptions& options) const override
    {
        return makeContactModel(kind, surface_, options);
    }
    std::unique_ptr<IdealProxy> ideal(double piece_cells) const override
    {
        return std::make_unique<CutIdeal>(makeContactModel(ContactModelKind::SurfaceWalk, surface_),
                                          piece_cells * cellM());
    }
    ScenePoint seen(const ScenePoint& goal) const override { return goal; }
    double steepestCosineAt(const ScenePoint& proxy, const ScenePoint& goal) const override
    {
        return steepestCosine(*surface_.mesh(), georeference_, proxy, goal);
    }

private:
    HeightfieldSurface flat_; // where the hand is, on the map
    Georeference georeference_;
    BodySurface surface_;
};

} // namespace

std::vector<ScenePoint> strokesOfAHand(const HeightfieldSurface& surface,
                                       const StrokeOptions& options)
{
    std::mt19937_64 random(options.seed);
    const auto uniform = [&random](double from, double to) {
        return from + (to - from) * static_cast<double>(random() >> 11U) * 0x1p-53;
    };
    const SceneFrame& frame = surface.frame();
    const double cell_m = ReferenceProxy::cellMeters(frame);
    const double last_column = static_cast<double>(surface.terrain()->columns() - 1);
    const double last_row = static_cast<double>(surface.terrain()->rows() - 1);
    constexpr double kMargin = 1.0 / 32.0; // fraction of the map in which the hand turns back
    const auto is_inside = [&](const ScenePoint& p) {
        const GridPoint grid = frame.toGrid(p);
        return grid.column > kMargin * last_column && grid.row > kMargin * last_row &&
               grid.column < (1.0 - kMargin) * last_column && grid.row < (1.0 - kMargin) * last_row;
    };
    const ScenePoint center = frame.toScene({last_column / 2.0, last_row / 2.0}, 0.0);
    std::vector<ScenePoint> goals;
    for (std::size_t update = 0; update < options.update_count;) {
        ScenePoint p = frame.toScene({uniform(2.0 * kMargin, 1.0 - 2.0 * kMargin) * last_column,
                                      uniform(2.0 * kMargin, 1.0 - 2.0 * kMargin) * last_row},
                                     0.0);
        double heading = uniform(-std::numbers::pi, std::numbers::pi);
        double above = std::max(options.low, 0.0);
        const auto add = [&] {
            p.z = surface.height(frame.toGrid(p)) + above * cell_m;
            goals.push_back(p);
        };
        add();
        for (std::size_t i = 0; i < options.stroke_count && update < options.update_count;
             ++i, ++update) {
            heading += uniform(-0.05, 0.05);
            const auto step = [&] {
                return Vec3{options.speed * cell_m * std::cos(heading),
                            options.speed * cell_m * std::sin(heading), 0.0};
            };
            if (!is_inside(p + step())) {
                heading = std::atan2(center.y - p.y, center.x - p.x) + uniform(-0.6, 0.6);
            }
            p = p + step();
            const double share =
                0.5 + 0.5 * std::sin(static_cast<double>(update) * options.speed * 0.013);
            const double wanted = options.low + (options.high - options.low) * share;
            above += std::clamp(wanted - above, -options.speed, options.speed);
            add();
        }
    }
    return goals;
}

BenchSurfaceMaker flatBenchSurfaces(std::shared_ptr<const FilledHeightfield> terrain,
                                    const SceneFrame& frame)
{
    return [terrain = std::move(terrain),
            frame](double scale) -> Result<std::shared_ptr<const BenchSurface>> {
        return std::shared_ptr<const BenchSurface>(
            std::make_shared<FlatSurface>(HeightfieldSurface{terrain, frame, scale}));
    };
}

BenchSurfaceMaker bodyBenchSurfaces(std::shared_ptr<const FilledHeightfield> terrain,
                                    const Georeference& georeference,
                                    JobMonitor& monitor)
{
    return [terrain = std::move(terrain), georeference,
            &monitor](double scale) -> Result<std::shared_ptr<const BenchSurface>> {
        auto mesh = BodyMesh::build(terrain, georeference, scale, monitor);
        if (!mesh) {
            return std::move(mesh).error();
        }
        return std::shared_ptr<const BenchSurface>(std::make_shared<SurfaceOnBody>(
            HeightfieldSurface{terrain, georeference.sceneFrame(), scale}, georeference,
            BodySurface(std::move(mesh).value())));
    };
}

} // namespace marsview
