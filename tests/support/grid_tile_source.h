// Tiles of a map in memory: the reference for everything that reads tiles.
#pragma once

#include "core/terrain/filled_heightfield.h"
#include "core/tiles/tile_source.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace marsview::test {

/// Samples at all levels by decimation, with the fills of FilledHeightfield; means by brute force.
/// Counts reads, and fails or waits on demand. Any thread.
class GridTileSource final : public TileSource {
public:
    struct Options {
        std::string name = "map in memory";
        std::size_t mean_levels = 0;
        bool is_remote = false; // reported by the source
        /// Called on the reading thread before each tile, outside all locks. May wait; its result
        /// is the outcome of the read. Empty: every read succeeds.
        std::function<std::optional<Error>(const TileId&)> before_read{};
        /// Called by open(). Empty: it succeeds.
        std::function<std::optional<Error>()> before_open{};
    };

    explicit GridTileSource(const Heightfield& heightfield);
    GridTileSource(const Heightfield& heightfield, Options options);

    const TileLayout& layout() const noexcept override { return layout_; }
    const std::string& name() const noexcept override { return options_.name; }
    Result<std::unique_ptr<TileReader>> open() const override;

    /// The tile as readers return it, without counting or hooks.
    Tile tile(const TileId& id) const;

    const Heightfield& heightfield() const noexcept { return heightfield_; }
    /// Reads started, including failed ones.
    std::uint64_t readCount() const noexcept { return read_count_; }
    std::uint64_t openCount() const noexcept { return open_count_; }

private:
    class Reader;

    Tile samplesTile(const TileId& id) const;
    Tile meansTile(const TileId& id) const;

    Heightfield heightfield_;
    std::optional<FilledHeightfield> filled_; // nonempty if there are voids
    Options options_;
    TileLayout layout_;
    mutable std::atomic<std::uint64_t> read_count_{0};
    mutable std::atomic<std::uint64_t> open_count_{0};
};

} // namespace marsview::test
