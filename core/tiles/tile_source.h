// Where the tiles of a raster come from.
#pragma once

#include "core/base/result.h"
#include "core/tiles/tile.h"

#include <memory>
#include <string>

namespace marsview {

/// Reads and decodes tiles. For one thread at a time, and that is a loader's: it waits for disk or
/// network.
class TileReader {
public:
    virtual ~TileReader() = default;
    TileReader(const TileReader&) = delete;
    TileReader& operator=(const TileReader&) = delete;

    /// The layout contains `id`. A whole tile or an error, never a part of one.
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
    /// For messages: the path or address that the user knows.
    virtual const std::string& name() const noexcept = 0;
    /// A reader for one more thread.
    virtual Result<std::unique_ptr<TileReader>> open() const = 0;

protected:
    TileSource() = default;
};

} // namespace marsview
