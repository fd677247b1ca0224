// Reads TIFFs with large compressed strips without decoding whole strips into memory.
#pragma once

#include "core/base/result.h"
#include "core/raster/sample_type.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace marsview {

/// The expected content of a TIFF's first directory.
struct TiffStripsLayout {
    std::size_t columns = 0;
    std::size_t rows = 0;
    SampleType type = SampleType::Int16;
    int band = 1;
};

/// Decodes strips row by row. GDAL decodes and caches whole strips: a map stored as one strip takes
/// its full size in memory, plus the compressed bytes. Here only the compressed bytes are in
/// memory, from the first row of a strip to its last. For one thread at a time.
class TiffStrips {
public:
    /// Empty if the file does not match or its compression is not supported here.
    static std::optional<TiffStrips> of(const std::string& path, const TiffStripsLayout& layout);
    TiffStrips(TiffStrips&&) noexcept;
    TiffStrips& operator=(TiffStrips&&) noexcept;
    ~TiffStrips();

    /// Reads whole rows of samples, in the machine's byte order, into `to`. Rows that follow the
    /// last read only need their own decoding; other rows need decoding from the beginning of the
    /// strip. The error is a sentence without the path.
    Status read(std::size_t first_row, std::size_t row_count, std::byte* to);

    /// Releases the memory kept for reading the next row.
    void rest() noexcept;

private:
    struct Impl;
    explicit TiffStrips(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace marsview
