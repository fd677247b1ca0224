// Makes relief tiles on its own threads.
#pragma once

#include "core/base/result.h"
#include "core/terrain/relief_tile.h"
#include "ui/render/height_atlas.h"
#include "ui/render/terrain_layer.h"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace marsview {

/// A tile to be made.
struct ReliefRequest {
    LayerNode key; // the node that wears it
    std::shared_ptr<const Heightfield> heightfield;
    SceneFrame frame;
    double slope_max = 1.0;
    MapSides sides = MapSides::End;
};

struct ReliefResult {
    LayerNode key;
    ReliefTile tile;
};

/// The tile that is drawn over a node. Its `level` >= kReliefLevelMin.
ReliefTileId reliefTileOf(const DetailNode& node);

/// All members are for the thread that owns it; the threads that make tiles are its own.
class ReliefLoader {
public:
    /// `notify` is called on a loader's thread after every tile, and when one that could not be
    /// read may be wanted again; it may be empty.
    explicit ReliefLoader(std::function<void()> notify);
    /// Waits for the tiles that are being made, a few milliseconds.
    ~ReliefLoader();
    ReliefLoader(const ReliefLoader&) = delete;
    ReliefLoader& operator=(const ReliefLoader&) = delete;

    /// Replaces the pending requests with these, the most urgent first. Returns how many of them
    /// are pending: tiles that failed to load a moment ago are not tried again at once.
    std::size_t request(std::vector<ReliefRequest> requests);
    /// Why something that was wanted last cannot be made at present.
    const std::optional<Error>& problem() const noexcept { return problem_; }
    /// At most `count_max` finished tiles, each handed out once.
    std::vector<ReliefResult> take(std::size_t count_max);
    /// True while something is wanted or being made.
    bool isLoading() const;
    /// Waits until no tile is requested or being made.
    void waitForPending();

private:
    struct Failure {
        LayerNode key;
        std::chrono::steady_clock::time_point retry_at;
        Error error;
        bool is_reported = false; // that it may be tried again
    };

    void run();
    std::optional<std::chrono::steady_clock::time_point> nextRetry() const;
    bool takeDueRetries();

    std::function<void()> notify_;
    mutable std::mutex mutex_;
    std::condition_variable has_work_;
    std::condition_variable has_result_;
    std::vector<ReliefRequest> wanted_; // the most urgent last
    std::vector<LayerNode> in_work_;
    std::vector<ReliefResult> finished_;
    std::vector<Failure> failures_;
    std::optional<Error> problem_; // the owner's
    bool is_stopping_ = false;
    std::vector<std::jthread> threads_;
};

} // namespace marsview
