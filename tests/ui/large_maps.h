// Small maps that are opened as if they were too large for memory.
#pragma once

#include "tests/support/grid_tile_source.h"
#include "ui/controllers/map_opener.h"

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// Previews and tiles are the program's own; preparing lasts until the test ends it. Outlives the
/// windows that use it.
class LargeMaps {
public:
    /// For the options of a window.
    MapOpener opener();

    /// Lets current and later preparations finish, with `failure` as their result if given.
    void finishPreparing(const std::optional<Error>& failure = std::nullopt);
    /// Makes later preparations wait again.
    void holdPreparing();
    /// Maps prepared from now on have disappeared when they are opened.
    void losePrepared();
    /// Makes the first previews coarse.
    void makeRoughPreviews() { are_previews_rough_ = true; }
    /// Blocks reads of tiles of the finest level until it is called with false.
    void holdTiles(bool is_held);
    /// Blocks reads of tiles of all levels until it is called with false. The GUI thread would wait
    /// forever, so its reads fail in the meantime.
    void holdAllTiles(bool is_held);
    /// The number of tiles read by the GUI thread.
    int guiReadCount() const;
    /// Makes reads of tiles of the finest level fail until it is called with false.
    void failTiles(bool is_failing);
    /// Unused tiles have to be read again.
    void forgetTiles() { tiles_->clear(); }

    /// A map in tiles, prepared or not.
    Result<std::shared_ptr<const Map>>
    openTiled(const RasterSpec& spec, const MapResources& resources, JobMonitor& monitor);

    int begunCount() const;
    int stoppedCount() const;
    /// The prepared files, in order.
    std::vector<std::string> prepared() const;

private:
    bool isPrepared(const RasterSpec& spec) const;
    Result<std::shared_ptr<const Map>>
    preview(const RasterSpec& spec, const DecimationLimits& limits, JobMonitor& monitor) const;
    Status prepare(const RasterSpec& spec, JobMonitor& monitor);
    std::optional<Error> beforeRead(const TileId& id);
    std::shared_ptr<TileCache> tiles_ = std::make_shared<TileCache>(TileCacheOptions{});
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    bool is_finishing_ = false;
    bool is_losing_ = false;
    bool are_previews_rough_ = false;
    bool are_tiles_held_ = false;
    bool are_all_tiles_held_ = false;
    int gui_read_count_ = 0;
    bool are_tiles_failing_ = false;
    std::optional<Error> failure_;
    int begun_count_ = 0;
    int stopped_count_ = 0;
    std::vector<std::string> prepared_;
};

} // namespace marsview
