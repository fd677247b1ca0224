#include "core/raster/open_raster.h"

#include <fmt/format.h>
#include <utility>

namespace marsview {

Result<OpenRaster> openRaster(const RasterSpec& spec)
{
    Result<RasterFile> file = RasterFile::open(spec.path, spec.band);
    if (!file) {
        return std::move(file).error();
    }
    Result<RasterInfo> info = infoWithOverrides(file->info(), spec);
    if (!info) {
        return std::move(info).error();
    }
    return OpenRaster{.spec = spec, .file = std::move(*file), .info = std::move(*info)};
}

Result<RasterInfo> infoWithOverrides(const RasterInfo& file_info, const RasterSpec& spec)
{
    Result<RasterInfo> info = withOverrides(file_info, spec.overrides);
    if (!info) {
        return Error{info.error().code, fmt::format("{}: {}", spec.path, info.error().message)};
    }
    return info;
}

Georeference georeferenceOf(const RasterInfo& info)
{
    return georeferenceOf(info, info.columns, info.rows);
}

Georeference georeferenceOf(const RasterInfo& info, std::size_t columns, std::size_t rows)
{
    const GeoTransform transform = info.transform.value_or(GeoTransform{});
    if (columns == info.columns && rows == info.rows) {
        return {columns, rows, transform, info.crs};
    }
    // A transform that can be inverted can be inverted with larger pixels too.
    const double wider = static_cast<double>(info.columns) / static_cast<double>(columns);
    const double higher = static_cast<double>(info.rows) / static_cast<double>(rows);
    GeoTransform::Terms terms = transform.terms();
    for (const std::size_t along_rows : {1U, 4U}) {
        terms[along_rows] *= wider;
        terms[along_rows + 1] *= higher;
    }
    return {columns, rows, GeoTransform::fromTerms(terms).value(), info.crs};
}

} // namespace marsview
