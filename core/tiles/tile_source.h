// Interfaces for reading the tiles of a raster.
#pragma once

#include "core/base/result.h"
#include "core/tiles/tile.h"

#include <memory>
#include <string>

namespace marsview {

/// Reads and decodes tiles. For one thread at a time, a loader thread: it waits for disk or
/// network.
class TileReader {
public:
    virtual ~TileReader() = default;
    TileReader(const TileReader&) = delete;
    TileReader& operator=(const TileReader&) = delete;

    /// `id` must be in the layout. Returns a complete tile or an error.
    virtual Result<Tile> read(const TileId& id) = 0;

protected:
    TileReader() = default;
};

/// A raster that can be read in tiles. Immutable; any thread.
class TileSource {
public:
    virtual ~TileSource() = default;
    TileSource(const TileSource&) = delete;
    TileSource& operator=(const TileSource&) = delete;

    virtual const TileLayout& layout() const noexcept = 0;
    /// The user's path or address, for messages.
    virtual const std::string& name() const noexcept = 0;
    /// A new reader for another thread.
    virtual Result<std::unique_ptr<TileReader>> open() const = 0;

protected:
    TileSource() = default;
};

} // namespace marsview
