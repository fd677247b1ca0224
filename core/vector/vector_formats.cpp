#include "core/vector/vector_formats.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <fstream>

namespace marsview {
namespace {

// NAIF's numbers, which the codes of IAU_2015 consist of.
struct NaifNumber {
    std::string_view body;
    int number;
};
constexpr std::array kNaif{
    NaifNumber{"Mercury", 199},  NaifNumber{"Venus", 299},     NaifNumber{"Moon", 301},
    NaifNumber{"Mars", 499},     NaifNumber{"Phobos", 401},    NaifNumber{"Deimos", 402},
    NaifNumber{"Io", 501},       NaifNumber{"Europa", 502},    NaifNumber{"Ganymede", 503},
    NaifNumber{"Callisto", 504}, NaifNumber{"Mimas", 601},     NaifNumber{"Enceladus", 602},
    NaifNumber{"Tethys", 603},   NaifNumber{"Dione", 604},     NaifNumber{"Rhea", 605},
    NaifNumber{"Titan", 606},    NaifNumber{"Iapetus", 608},   NaifNumber{"Ariel", 701},
    NaifNumber{"Umbriel", 702},  NaifNumber{"Titania", 703},   NaifNumber{"Oberon", 704},
    NaifNumber{"Miranda", 705},  NaifNumber{"Triton", 801},    NaifNumber{"Charon", 901},
    NaifNumber{"Pluto", 999},    NaifNumber{"Ceres", 2000001}, NaifNumber{"Vesta", 2000004},
    NaifNumber{"Eros", 2000433},
};

struct Ending {
    std::string_view ending;
    VectorFormat format;
};
constexpr std::array kEndings{
    Ending{".gpkg", VectorFormat::GeoPackage}, Ending{".geojson", VectorFormat::GeoJson},
    Ending{".json", VectorFormat::GeoJson},    Ending{".kml", VectorFormat::Kml},
    Ending{".shp", VectorFormat::Shapefile},   Ending{".csv", VectorFormat::Csv},
};

std::string lowered(std::string_view text)
{
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

} // namespace

std::optional<VectorFormat> vectorFormatOf(std::string_view path)
{
    const std::string lower = lowered(path);
    const auto* const at = std::find_if(kEndings.begin(), kEndings.end(), [&](const Ending& e) {
        return lower.size() > e.ending.size() && lower.ends_with(e.ending);
    });
    return at != kEndings.end() ? std::optional(at->format) : std::nullopt;
}

const char* driverOf(VectorFormat format)
{
    switch (format) {
    case VectorFormat::GeoPackage:
        return "GPKG";
    case VectorFormat::GeoJson:
        return "GeoJSON";
    case VectorFormat::Kml:
        return "LIBKML";
    case VectorFormat::Shapefile:
        return "ESRI Shapefile";
    case VectorFormat::Csv:
        return "CSV";
    }
    return "";
}

std::optional<Crs> commonGeographic(const Body& body)
{
    std::string text = "EPSG:4326";
    if (body.name != "Earth") {
        const auto* const at = std::find_if(
            kNaif.begin(), kNaif.end(), [&](const NaifNumber& n) { return n.body == body.name; });
        if (at == kNaif.end()) {
            return std::nullopt;
        }
        text = fmt::format("IAU_2015:{}00", at->number);
    }
    Result<Crs> crs = Crs::fromText(text);
    return crs ? std::optional(std::move(*crs)) : std::nullopt;
}

const Body* bodyOfKml(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::string head(4096, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount())));
    const std::string lower = lowered(head);
    constexpr std::string_view kHint = "target=";
    const std::size_t element = lower.find("<kml");
    const std::size_t end = lower.find('>', element);
    const std::size_t hint = element == std::string::npos ? element : lower.find(kHint, element);
    if (hint == std::string::npos || end == std::string::npos || hint > end) {
        return bodyNamed("Earth");
    }
    const std::size_t begin = hint + kHint.size();
    const std::size_t stop = lower.find_first_of("\"'; >", begin);
    return bodyNamed(lower.substr(begin, stop - begin));
}

} // namespace marsview
