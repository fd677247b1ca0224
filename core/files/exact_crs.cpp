#include "core/files/exact_crs.h"

#include <gdal_priv.h>

#include <utility>

namespace marsview {
namespace {

constexpr const char* kCrs = "CRS";

} // namespace

std::optional<Crs> exactCrsOf(GDALDataset& dataset)
{
    const char* wkt = dataset.GetMetadataItem(kCrs, kOwnMetadataDomain);
    if (wkt == nullptr) {
        return std::nullopt;
    }
    Result<Crs> crs = Crs::fromText(wkt);
    return crs ? std::optional<Crs>(std::move(crs).value()) : std::nullopt;
}

// GeoTIFF has keys for common CRSs of the Earth and silently drops the rest.
bool keepExactCrs(GDALDataset& dataset, const std::optional<Crs>& crs)
{
    if (!crs) {
        return true;
    }
    if (const OGRSpatialReference* reference = dataset.GetSpatialRef()) {
        const Result<Crs> kept = Crs::fromSpatialReference(*reference);
        if (kept && kept->wkt() == crs->wkt()) {
            return true;
        }
    }
    return dataset.SetMetadataItem(kCrs, crs->wkt().c_str(), kOwnMetadataDomain) == CE_None;
}

} // namespace marsview
