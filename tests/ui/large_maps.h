// Small maps that are opened as if they were too large to be held.
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

/// Previews and tiles are the program's own; preparing takes until the test says so. Outlives the
/// windows that use it.
class LargeMaps {
public:
    /// For a window's options.
    MapOpener opener();

    /// Lets preparations of now and later come to an end. `failure` is what becomes of them.
    void finishPreparing(const std::optional<Error>& failure = std::nullopt);
    /// And later ones wait again.
    void holdPreparing();
    /// What is prepared from now on is gone when it is looked for.
    void losePrepared();
    /// Previews are rough at first.
    void makeRoughPreviews() { are_previews_rough_ = true; }
    /// Tiles of the finest level are not read until this is taken back.
    void holdTiles(bool is_held);
    /// Tiles of all levels are not read until this is taken back. The GUI's thread would wait for
    /// ever: there reading fails meanwhile.
    void holdAllTiles(bool is_held);
    /// How many tiles were read by the GUI's thread.
    int guiReadCount() const;
    /// Reading tiles of the finest level fails until this is taken back.
    void failTiles(bool is_failing);
    /// Tiles that nobody holds on to have to be read again.
    void forgetTiles() { tiles_->clear(); }

    /// A map in tiles, prepared or not.
    Result<std::shared_ptr<const Map>>
    openTiled(const RasterSpec& spec, const MapResources& resources, JobMonitor& monitor);

    int begunCount() const;
    int stoppedCount() const;
    /// The files that were prepared, in order.
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
