#include "core/raster/axis_hints.h"

#include "core/files/raster_path.h"

#include <cpl_string.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace marsview {
namespace {

struct Collection {
    std::string_view name; // in lower case
    std::string_view body;
};
constexpr std::array kCollections{
    Collection{"etopo", "Earth"}, Collection{"gtopo", "Earth"},   Collection{"srtm", "Earth"},
    Collection{"gebco", "Earth"}, Collection{"gmted", "Earth"},   Collection{"astgtm", "Earth"},
    Collection{"aster", "Earth"}, Collection{"bedrock", "Earth"}, Collection{"mola", "Mars"},
    Collection{"megt", "Mars"},   Collection{"megdr", "Mars"},    Collection{"hrsc", "Mars"},
    Collection{"lola", "Moon"},   Collection{"ldem", "Moon"},     Collection{"gld100", "Moon"},
};

bool isLetter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// A collection's name if no letter precedes it: "ETOPO1", but not "Angola".
const Body* bodyOfCollection(const std::string& text)
{
    const std::string lower = lowerCase(text);
    for (const Collection& collection : kCollections) {
        const std::size_t at = lower.find(collection.name);
        const bool begins_word = at == 0 || (at != std::string::npos && !isLetter(lower[at - 1]));
        if (begins_word) {
            return bodyNamed(collection.body);
        }
    }
    return nullptr;
}

// Io is left out: in metadata it usually means input and output.
const Body* bodyIn(const std::string& text)
{
    const Body* const body = bodyMentioned(text);
    return body != nullptr && body->name != "Io" ? body : bodyOfCollection(text);
}

struct Item {
    std::string key; // in lower case, without the part before '#'
    std::string axis;
    std::string value;
};

std::vector<Item> itemsOf(char** metadata)
{
    std::vector<Item> items;
    for (int i = 0; metadata != nullptr && metadata[i] != nullptr; ++i) {
        const std::string_view entry(metadata[i]);
        const std::size_t equals = entry.find('=');
        if (equals == std::string_view::npos) {
            continue;
        }
        const std::string_view name = entry.substr(0, equals);
        const std::size_t hash = name.find('#');
        const bool has_axis = hash != std::string_view::npos;
        items.push_back({lowerCase(std::string(has_axis ? name.substr(hash + 1) : name)),
                         std::string(has_axis ? name.substr(0, hash) : ""),
                         std::string(entry.substr(equals + 1))});
    }
    return items;
}

std::string degreeAxesIn(const std::vector<Item>& items)
{
    const auto axisWith = [&items](std::string_view begin) {
        const auto found = std::find_if(items.begin(), items.end(), [begin](const Item& item) {
            return item.key == "units" && lowerCase(item.value).starts_with(begin);
        });
        return found == items.end() ? std::string() : found->axis + " in " + found->value;
    };
    // CF has six spellings of each: degrees_east, degree_E, degreesE …
    for (const std::string_view stem : {"degrees_", "degree_", "degrees", "degree"}) {
        const std::string east = axisWith(std::string(stem) + "e");
        const std::string north = axisWith(std::string(stem) + "n");
        if (!east.empty() && !north.empty()) {
            return fmt::format("its axes are {} and {}", east, north);
        }
    }
    return {};
}

const Body* bodyInItems(const std::vector<Item>& items)
{
    for (const std::string_view key :
         {"target_name", "target", "body", "planet", "title", "long_name", "standard_name",
          "description", "tifftag_imagedescription", "source", "summary", "comment"}) {
        for (const Item& item : items) {
            const Body* const body = item.key == key ? bodyIn(item.value) : nullptr;
            if (body != nullptr) {
                return body;
            }
        }
    }
    return nullptr;
}

} // namespace

AxisHints axisHintsOf(GDALDataset& dataset, const std::string& path)
{
    const std::vector<Item> items = itemsOf(dataset.GetMetadata());
    AxisHints hints;
    hints.degree_axes = degreeAxesIn(items);
    hints.body = bodyInItems(items);
    if (hints.body == nullptr) {
        hints.body = bodyIn(std::filesystem::path(path).filename().string());
    }
    return hints;
}

} // namespace marsview
