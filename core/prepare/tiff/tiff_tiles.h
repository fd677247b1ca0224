// Writes the tiles of a GeoTIFF whose directories already exist.
#pragma once

#include "core/base/result.h"
#include "core/prepare/tiff/encoded_tiles.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace marsview {

/// A tiled, deflated BigTIFF that GDAL created without tiles. Tiles are appended; their offsets
/// stay in memory until flush(), which overwrites only the directories' arrays in place. If the
/// program is killed, the file opens and has at least all tiles of the last flush. For one thread
/// at a time.
class TiffTiles final : public EncodedTiles {
public:
    enum class Access : std::uint8_t { Read, Write };
    static Result<TiffTiles> open(const std::string& path, Access access = Access::Write);
    TiffTiles(TiffTiles&&) noexcept;
    TiffTiles& operator=(TiffTiles&&) noexcept;
    ~TiffTiles() override;

    /// In the file's order.
    const std::vector<TiffPage>& pages() const noexcept override;
    Status append(std::size_t page, std::size_t tile, std::span<const std::byte> encoded) override;
    Status flush() override;

    /// The size of the file in bytes.
    Result<std::uint64_t> fileBytes() const;

    Result<std::vector<std::byte>> encoded(std::size_t page, std::size_t tile) const override;
    std::uint64_t encodedBytes(std::size_t page, std::size_t tile) const override;

    /// The position of an encoded tile; 0 if it is missing.
    std::uint64_t offsetOf(std::size_t page, std::size_t tile) const;

    /// Whether the first `tiles` tiles of a page exist and end within `file_bytes`.
    bool holdsTiles(std::size_t page, std::size_t tiles, std::uint64_t file_bytes) const;

    /// Whether these tiles, which holdsTiles() has found, are intact, by the checksum of each.
    /// Reads and inflates them all, on all cores: some 300 MB/s per core.
    bool areWhole(std::size_t page, std::size_t tiles) const;

    /// Truncates or extends the file to `file_bytes`, or to the end of the last block in its
    /// directories if that is larger.
    Status trim(std::uint64_t file_bytes);

private:
    struct Impl;
    explicit TiffTiles(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// The message for a system error while writing `path`, as one sentence.
Error writeError(const std::string& path, int system_error, const std::string& otherwise);

} // namespace marsview
