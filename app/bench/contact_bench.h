// Speed and accuracy of contact models: a simulated hand wanders over a map.
#pragma once

#include "app/bench/bench_surface.h"
#include "app/bench/reference/reference_proxy.h"
#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/contact/contact_model.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

struct ContactBenchOptions {
    std::vector<ContactModelKind> models{kContactModelKinds.begin(), kContactModelKinds.end()};
    std::vector<double> speeds{0.1, 1.0, 10.0, 20.0, 50.0}; // cells per update
    std::vector<double> scales{0.1, 1.0, 5.0, 20.0};        // vertical scale factors
    std::size_t update_count = 4000;
    /// Number of updates after which the hand is lifted and put down elsewhere.
    std::size_t stroke_count = 500;
    /// Shortens rows so that the whole run takes about this long; 0 for no limit.
    double seconds_max = 0.0;
    int repeat_count = 3;
    bool has_contact = true;   // rows with goals below the surface
    bool has_free = true;      // rows with goals above it
    double radius_cells = 0.1; // of the sphere of virtual-proxy
    double piece_cells = ReferenceProxy::kPieceCells;
    std::uint64_t seed = 7; // of the hand's paths
};

/// Errors against the ideal. Lengths in cells.
struct ContactErrors {
    double within_half_cell = 0.0; // share of updates
    double within_1e5_cell = 0.0;
    double position_mean = 0.0;
    double position_p99 = 0.0;
    double position_max = 0.0;
    double force_mean_deg = 0.0; // between the directions from goal to proxy
    double force_p99_deg = 0.0;
    double distance_mean = 0.0; // of the absolute difference of the distances to the goal
    /// How far the proxy would still move if the goal stopped.
    double lag = 0.0;
    /// Fraction of updates that end at a local minimum of the distance to the goal; empty for a
    /// model whose proxy does not rest on the surface.
    std::optional<double> at_minimum;
};

/// One model at one speed and vertical scale. Counts are means per update, without placing the
/// proxy.
struct ContactBenchRow {
    ContactModelKind model = ContactModelKind::ProxyGraph;
    double speed = 0.0;
    double scale = 1.0;
    bool is_free = false;
    std::size_t update_count = 0;
    double ns_mean = 0.0; // of all updates in one run, without reading the clock in between
    double ns_p50 = 0.0;  // of single updates
    double ns_p99 = 0.0;
    double ns_p999 = 0.0;
    double ns_max = 0.0;
    double vertices = 0.0;
    double faces = 0.0;
    double casts = 0.0;
    double cells = 0.0;
    double far_edges = 0.0;
    double far_edge_updates = 0.0; // share of updates with a far-edge crossing
    double far_loops = 0.0;
    double cut_short = 0.0;
    double contact_updates = 0.0;        // share
    std::optional<ContactErrors> errors; // where the goals are below the surface
};

struct ContactBenchResult {
    double cell_m = 1.0;
    double clock_ns = 0.0; // duration of one clock reading; included in the times of single updates
    std::vector<ContactBenchRow> rows;
    /// Descents of the ideal that reached their step limit. If not 0, the errors are wrong.
    std::uint64_t unfinished_count = 0;
};

/// First computes the ideal of every path, on all cores; then runs all models in turn, on this
/// thread. Errors: those of `surfaces`; Canceled.
Result<ContactBenchResult> benchContact(const BenchSurfaceMaker& surfaces,
                                        const ContactBenchOptions& options,
                                        JobMonitor& monitor);

} // namespace marsview
