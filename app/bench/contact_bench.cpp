#include "app/bench/contact_bench.h"

#include "app/bench/tick_clock.h"
#include "app/console/quantile.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>
#include <thread>
#include <utility>

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;

// Heights of contact goals and free-space goals above the surface, in cells.
constexpr double kDeepCells = -5.0;
constexpr double kShallowCells = -2.0;
constexpr double kLowCells = 20.0;
constexpr double kHighCells = 60.0;

// Cosines up to this are within rounding; larger ones lead closer to the goal.
constexpr double kCosineMax = 1e-6;

// Fewer updates are not significant, regardless of the time limit.
constexpr std::size_t kUpdatesMin = 50;

// A path of the hand, with its ideal if it is below the surface.
struct Way {
    double speed = 0.0;
    double scale = 1.0;
    bool is_free = false;
    std::vector<ScenePoint> goals{};
    std::vector<ScenePoint> ideal{};
};

double angleDegrees(const Vec3& a, const Vec3& b)
{
    return std::atan2(length(cross(a, b)), dot(a, b)) * 180.0 / std::numbers::pi;
}

double meanOf(const std::vector<double>& values)
{
    double sum = 0.0;
    for (const double value : values) {
        sum += value;
    }
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

class ContactBench {
public:
    /// `surfaces`: of all the scales in `options`, of which there is one at least.
    ContactBench(std::map<double, std::shared_ptr<const BenchSurface>> surfaces,
                 const ContactBenchOptions& options,
                 JobMonitor& monitor)
        : surfaces_(std::move(surfaces))
        , options_(options)
        , monitor_(monitor)
        , cell_m_(surfaces_.begin()->second->cellM())
    {}

    Result<ContactBenchResult> run()
    {
        // The ideal takes most of the time.
        constexpr double kIdealShare = 0.7;
        monitor_.beginStage(0.0, kIdealShare);
        std::vector<Way> ways = makeWays();
        if (options_.has_contact) {
            findIdeals(ways);
        }
        monitor_.beginStage(kIdealShare, 1.0);
        ContactBenchResult result;
        result.cell_m = cell_m_;
        result.clock_ns = clock_.readingNanoseconds();
        result.unfinished_count = unfinished_count_;
        for (std::size_t i = 0; i < ways.size() && !monitor_.isCanceled(); ++i) {
            for (ContactBenchRow& row : measure(ways[i])) {
                result.rows.push_back(std::move(row));
            }
            monitor_.report(static_cast<double>(i + 1) / static_cast<double>(ways.size()));
        }
        if (monitor_.isCanceled()) {
            return Error{ErrorCode::Canceled, "measuring was canceled"};
        }
        return result;
    }

private:
    const BenchSurface& surfaceAt(double scale) const { return *surfaces_.at(scale); }

    // Whether a stroke begins with this goal of the path.
    bool isPlaced(std::size_t goal) const { return goal % (options_.stroke_count + 1) == 0; }
    std::size_t updatesOf(const Way& way) const
    {
        const std::size_t per_stroke = options_.stroke_count + 1;
        return way.goals.size() - (way.goals.size() + per_stroke - 1) / per_stroke;
    }

    std::vector<Way> makeWays() const
    {
        std::vector<Way> ways;
        for (const bool is_free : {false, true}) {
            if (is_free ? !options_.has_free : !options_.has_contact) {
                continue;
            }
            for (const double scale : options_.scales) {
                for (const double speed : options_.speeds) {
                    ways.push_back({.speed = speed, .scale = scale, .is_free = is_free});
                    ways.back().goals =
                        surfaceAt(scale).strokes({.speed = speed,
                                                  .low = is_free ? kLowCells : kDeepCells,
                                                  .high = is_free ? kHighCells : kShallowCells,
                                                  .update_count = options_.update_count,
                                                  .stroke_count = options_.stroke_count,
                                                  .seed = options_.seed});
                }
            }
        }
        return ways;
    }

    // The slowest first, so that the cores finish at about the same time.
    void findIdeals(std::vector<Way>& ways)
    {
        std::vector<Way*> order;
        double pieces = 0.0;
        for (Way& way : ways) {
            if (!way.is_free) {
                order.push_back(&way);
                pieces += way.speed;
            }
        }
        std::sort(order.begin(), order.end(),
                  [](const Way* a, const Way* b) { return a->speed > b->speed; });
        std::mutex mutex;
        double done = 0.0;
        parallelRanges(order.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                Way& way = *order[i];
                const std::uint64_t unfinished = findIdeal(way, pieces);
                const std::lock_guard lock(mutex);
                unfinished_count_ += unfinished;
                done += way.speed;
                monitor_.report(done / pieces);
            }
        });
    }

    std::uint64_t findIdeal(Way& way, double pieces) const
    {
        // The larger part of the available time, since the path is long.
        constexpr double kShare = 0.6;
        const double cores =
            std::max(1.0, static_cast<double>(std::thread::hardware_concurrency()));
        const std::chrono::duration<double> time(options_.seconds_max * kShare * cores *
                                                 std::max(way.speed / pieces, 1e-3));
        const Clock::time_point begin = Clock::now();
        const auto reference = surfaceAt(way.scale).ideal(options_.piece_cells);
        for (std::size_t i = 0; i < way.goals.size(); ++i) {
            way.ideal.push_back(isPlaced(i) ? reference->place(way.goals[i])
                                            : reference->update(way.goals[i]));
            const bool is_late = options_.seconds_max > 0.0 && Clock::now() - begin > time;
            if (monitor_.isCanceled() || (is_late && way.ideal.size() >= kUpdatesMin)) {
                break;
            }
        }
        way.goals.resize(way.ideal.size());
        return reference->unfinishedCount();
    }

    std::vector<ContactBenchRow> measure(const Way& way)
    {
        const BenchSurface& surface = surfaceAt(way.scale);
        const ContactModelOptions model_options{.radius_m = options_.radius_cells * cell_m_};
        struct Runner {
            std::unique_ptr<ContactModel> model;
            ContactBenchRow row;
            std::vector<std::uint64_t> ticks; // of each update, the minimum of all repeats
        };
        std::vector<Runner> runners;
        for (const ContactModelKind kind : options_.models) {
            Runner runner{surface.model(kind, model_options), {}, {}};
            runner.row.model = kind;
            runner.row.speed = way.speed;
            runner.row.scale = way.scale;
            runner.row.is_free = way.is_free;
            runner.row.update_count = updatesOf(way);
            runner.row.ns_mean = std::numeric_limits<double>::infinity();
            runner.ticks.assign(updatesOf(way), std::numeric_limits<std::uint64_t>::max());
            assess(*runner.model, surface, way, runner.row);
            if (!way.is_free) {
                runner.row.errors->lag = lagOf(*surface.model(kind, model_options), way);
            }
            runners.push_back(std::move(runner));
        }
        // In turn, so that disturbances on the machine affect all models alike.
        for (int repeat = 0; repeat < options_.repeat_count && !monitor_.isCanceled(); ++repeat) {
            for (Runner& runner : runners) {
                runner.row.ns_mean = std::min(runner.row.ns_mean, batchMean(*runner.model, way));
            }
            for (Runner& runner : runners) {
                timeEach(*runner.model, way, runner.ticks);
            }
        }
        std::vector<ContactBenchRow> rows;
        for (Runner& runner : runners) {
            std::vector<double> ns;
            ns.reserve(runner.ticks.size());
            for (const std::uint64_t ticks : runner.ticks) {
                ns.push_back(clock_.nanoseconds(ticks));
            }
            runner.row.ns_p50 = quantile(ns, 0.5);
            runner.row.ns_p99 = quantile(ns, 0.99);
            runner.row.ns_p999 = quantile(ns, 0.999);
            runner.row.ns_max = quantile(ns, 1.0);
            rows.push_back(std::move(runner.row));
        }
        return rows;
    }

    // Computes the counts and the distances of the proxies from the ideal.
    void assess(ContactModel& model,
                const BenchSurface& surface,
                const Way& way,
                ContactBenchRow& row) const
    {
        std::vector<double> positions;
        std::vector<double> angles;
        std::vector<double> distances;
        std::size_t within_half = 0;
        std::size_t within_1e5 = 0;
        std::size_t minima = 0;
        for (std::size_t i = 0; i < way.goals.size(); ++i) {
            const ScenePoint goal = surface.seen(way.goals[i]);
            if (isPlaced(i)) {
                model.place(way.goals[i]);
                continue;
            }
            const ContactState state = model.update(way.goals[i]);
            row.vertices += state.counters.vertices;
            row.faces += state.counters.faces;
            row.casts += state.counters.casts;
            row.cells += state.counters.cells;
            row.far_edges += state.counters.far_edges;
            row.far_edge_updates += state.counters.far_edges > 0 ? 1.0 : 0.0;
            row.far_loops += state.counters.far_loops;
            row.cut_short += state.counters.cut_short;
            row.contact_updates += state.is_in_contact ? 1.0 : 0.0;
            if (way.is_free) {
                continue;
            }
            const Vec3 force = state.proxy - goal;
            const Vec3 ideal_force = way.ideal[i] - goal;
            const double off = length(state.proxy - way.ideal[i]) / cell_m_;
            positions.push_back(off);
            within_half += off <= 0.5 ? 1U : 0U;
            within_1e5 += off <= 1e-5 ? 1U : 0U;
            angles.push_back(angleDegrees(force, ideal_force));
            distances.push_back(std::abs(length(force) - length(ideal_force)) / cell_m_);
            minima += surface.steepestCosineAt(state.proxy, goal) <= kCosineMax ? 1U : 0U;
        }
        const double count = static_cast<double>(updatesOf(way));
        for (double* const sum :
             {&row.vertices, &row.faces, &row.casts, &row.cells, &row.far_edges,
              &row.far_edge_updates, &row.far_loops, &row.cut_short, &row.contact_updates}) {
            *sum /= count;
        }
        if (way.is_free) {
            return;
        }
        ContactErrors errors;
        errors.within_half_cell = static_cast<double>(within_half) / count;
        errors.within_1e5_cell = static_cast<double>(within_1e5) / count;
        errors.position_mean = meanOf(positions);
        errors.position_p99 = quantile(positions, 0.99);
        errors.position_max = quantile(positions, 1.0);
        errors.force_mean_deg = meanOf(angles);
        errors.force_p99_deg = quantile(angles, 0.99);
        errors.distance_mean = meanOf(distances);
        if (row.model != ContactModelKind::VirtualProxy) {
            errors.at_minimum = static_cast<double>(minima) / count;
        }
        row.errors = errors;
    }

    double lagOf(ContactModel& model, const Way& way) const
    {
        constexpr std::size_t kEvery = 32;
        constexpr int kHeldMax = 256;
        constexpr double kAtRestCells = 1e-9;
        std::vector<double> lags;
        for (std::size_t i = 0; i < way.goals.size(); ++i) {
            const ScenePoint begin =
                isPlaced(i) ? model.place(way.goals[i]).proxy : model.update(way.goals[i]).proxy;
            if (i % kEvery != kEvery - 1) {
                continue;
            }
            ScenePoint last = begin;
            for (int held = 0; held < kHeldMax; ++held) {
                const ScenePoint next = model.update(way.goals[i]).proxy;
                const bool is_at_rest = length(next - last) < kAtRestCells * cell_m_;
                last = next;
                if (is_at_rest) {
                    break;
                }
            }
            lags.push_back(length(last - begin) / cell_m_);
        }
        return meanOf(lags);
    }

    // Reads the clock only at each end of a stroke.
    double batchMean(ContactModel& model, const Way& way) const
    {
        double sum = 0.0; // keeps the compiler from removing the calls
        std::uint64_t ticks = 0;
        std::uint64_t begin = 0;
        for (std::size_t i = 0; i < way.goals.size();) {
            model.place(way.goals[i++]);
            begin = TickClock::now();
            for (; i < way.goals.size() && !isPlaced(i); ++i) {
                sum += model.update(way.goals[i]).proxy.z;
            }
            ticks += TickClock::now() - begin;
        }
        kept_.store(sum, std::memory_order_relaxed);
        return clock_.nanoseconds(ticks) / static_cast<double>(updatesOf(way));
    }

    void timeEach(ContactModel& model, const Way& way, std::vector<std::uint64_t>& least) const
    {
        double sum = 0.0;
        auto at = least.begin();
        for (std::size_t i = 0; i < way.goals.size();) {
            model.place(way.goals[i++]);
            std::uint64_t last = TickClock::now();
            for (; i < way.goals.size() && !isPlaced(i); ++i, ++at) {
                sum += model.update(way.goals[i]).proxy.z;
                const std::uint64_t now = TickClock::now();
                *at = std::min(*at, now - last);
                last = now;
            }
        }
        kept_.store(sum, std::memory_order_relaxed);
    }

    std::map<double, std::shared_ptr<const BenchSurface>> surfaces_;
    const ContactBenchOptions& options_;
    JobMonitor& monitor_;
    TickClock clock_;
    double cell_m_;
    std::uint64_t unfinished_count_ = 0;
    mutable std::atomic<double> kept_{0.0};
};

} // namespace

Result<ContactBenchResult> benchContact(const BenchSurfaceMaker& surfaces,
                                        const ContactBenchOptions& options,
                                        JobMonitor& monitor)
{
    std::map<double, std::shared_ptr<const BenchSurface>> by_scale;
    for (const double scale : options.scales) {
        Result<std::shared_ptr<const BenchSurface>> made = surfaces(scale);
        if (!made) {
            return std::move(made).error();
        }
        by_scale.emplace(scale, std::move(made).value());
    }
    return ContactBench(std::move(by_scale), options, monitor).run();
}

} // namespace marsview
