#include "core/files/gdal_drivers.h"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace marsview {
namespace {

// Formats without elevations. A user who needs one of them converts it with gdal_translate.
constexpr std::array kLeftOut{
    // Web services and databases: not files, and slow or endless to query.
    "WCS",
    "WMS",
    "WMTS",
    "OGCAPI",
    "PLMOSAIC",
    "PLSCENES",
    "DAAS",
    "EEDAI",
    "NGW",
    "HTTP",
    "STACTA",
    "STACIT",
    "PostGISRaster",
    "Rasterlite",
    "MBTiles",
    "ESRIC",
    // Documents, drawings, and images without elevations.
    "PDF",
    "CAD",
    "KMLSUPEROVERLAY",
    "HEIF",
    "WEBP",
    "GIF",
    "BIGGIF",
    "XPM",
    "SGI",
    "TGA",
    "CALS",
    // Scanned maps and charts.
    "RPFTOC",
    "ECRGTOC",
    "BSB",
    "RIK",
    "OZI",
    "MAP",
    "ADRG",
    "SRP",
    "CTG",
    // Radar and optical imagery.
    "SAR_CEOS",
    "CEOS",
    "JAXAPALSAR",
    "GFF",
    "ESAT",
    "DIMAP",
    "AirSAR",
    "RS2",
    "SAFE",
    "SENTINEL2",
    "COSAR",
    "TSX",
    "COASP",
    "CPG",
    "L1B",
    "MSGN",
    "TIL",
    "DOQ1",
    "DOQ2",
    "FAST",
    "NDF",
    "EIR",
    "DIPEx",
    "GSC",
    "IRIS",
};

// OpenGuard checks the ways in which files of these formats refer to other files.
constexpr std::array<const char*, 15> kPlainDrivers{
    "GTiff", "SRTMHGT", "DTED", "USGSDEM", "AAIGrid", "GRASSASCIIGrid", "EHdr", "ENVI",
    "ISIS3", "ISIS2",   "PDS",  "PDS4",    "VICAR",   "GSBG",           nullptr};

// In addition to kPlainDrivers. HDF4, HDF5, netCDF, GRIB, FITS and others have crashed on damaged
// files.
constexpr std::array kWellTested{"HFA", "JP2OpenJPEG", "PNG", "JPEG", "COG"};

std::vector<GDALDriver*>& leftOut()
{
    // They live as long as the program, and so does the list that refers to them.
    static auto& drivers = *new std::vector<GDALDriver*>; // NOLINT: never deleted
    return drivers;
}

} // namespace

void leaveOutDrivers()
{
    GDALDriverManager& manager = *GetGDALDriverManager();
    for (const char* name : kLeftOut) {
        if (GDALDriver* driver = manager.GetDriverByName(name)) {
            manager.DeregisterDriver(driver);
            leftOut().push_back(driver);
        }
    }
}

const char* const* plainDrivers()
{
    return kPlainDrivers.data();
}

bool isWellTested(const std::string& driver)
{
    const auto is_it = [&driver](const char* name) { return name != nullptr && driver == name; };
    return std::any_of(kPlainDrivers.begin(), kPlainDrivers.end(), is_it) ||
           std::any_of(kWellTested.begin(), kWellTested.end(), is_it);
}

std::optional<std::string> recognizingDriverFor(const std::string& name)
{
    GDALDriverManager& manager = *GetGDALDriverManager();
    GDALOpenInfo header(name.c_str(), GA_ReadOnly | GDAL_OF_RASTER);
    for (int i = 0; i < manager.GetDriverCount(); ++i) {
        const GDALDriver& driver = *manager.GetDriver(i);
        if (driver.pfnIdentify != nullptr && driver.pfnIdentify(&header) == TRUE) {
            return driver.GetDescription();
        }
    }
    return std::nullopt;
}

std::optional<std::string> leftOutDriverFor(const std::string& name)
{
    GDALOpenInfo header(name.c_str(), GA_ReadOnly);
    constexpr std::string_view kSgi = "\x01\xDA"; // whose driver only recognizes what it opens
    if (std::string_view(reinterpret_cast<const char*>(header.pabyHeader),
                         static_cast<std::size_t>(header.nHeaderBytes))
            .starts_with(kSgi)) {
        return "SGI";
    }
    for (const GDALDriver* driver : leftOut()) {
        if (driver->pfnIdentify != nullptr && header.nHeaderBytes > 0 &&
            driver->pfnIdentify(&header) == TRUE) {
            return driver->GetDescription();
        }
    }
    return std::nullopt;
}

std::string gdalVersion()
{
    return GDALVersionInfo("RELEASE_NAME");
}

} // namespace marsview
