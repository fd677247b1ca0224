// Reading TIFFs whose samples lie in large compressed strips, without holding a strip.
#pragma once

#include "core/base/result.h"
#include "core/raster/sample_type.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace marsview {

/// What is expected of a TIFF's first directory.
struct TiffStripsLayout {
    std::size_t columns = 0;
    std::size_t rows = 0;
    SampleType type = SampleType::Int16;
    int band = 1;
};

/// Decodes strips row by row. GDAL decodes a strip as a whole and keeps it: a map stored as one
/// strip takes its own size in memory there, and that of the compressed bytes. Here those alone are
/// held, from the first row of a strip to its last. For one thread at a time.
class TiffStrips {
public:
    /// Nothing where the file is something else, or compressed in ways that are not known here.
    static std::optional<TiffStrips> of(const std::string& path, const TiffStripsLayout& layout);
    TiffStrips(TiffStrips&&) noexcept;
    TiffStrips& operator=(TiffStrips&&) noexcept;
    ~TiffStrips();

    /// Whole rows of samples, in the machine's byte order, to `to`. Rows that follow those read
    /// before cost their own decoding; others that of the strip from its beginning. The error is a
    /// sentence without the path.
    Status read(std::size_t first_row, std::size_t row_count, std::byte* to);

    /// Gives back what is held for the row that comes next.
    void rest() noexcept;

private:
    struct Impl;
    explicit TiffStrips(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace marsview
