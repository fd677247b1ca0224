#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <span>

namespace marsview::test {
namespace {

// A folder and the folders of the project that it may include from. Longer paths come first.
struct Layer {
    std::string_view folder;
    std::vector<std::string_view> may_include;
};

const std::vector<Layer>& layers()
{
    static const std::vector<Layer> kLayers{
        {"core/base/", {"core/base/"}},
        {"core/geo/", {"core/base/", "core/geo/"}},
        {"core/files/", {"core/base/", "core/geo/", "core/files/"}},
        {"core/formats/", {"core/base/", "core/geo/", "core/files/", "core/formats/"}},
        {"core/raster/",
         {"core/base/", "core/geo/", "core/files/", "core/formats/", "core/raster/"}},
        {"core/sources/", {"core/base/", "core/files/", "core/raster/", "core/sources/"}},
        {"core/tiles/", {"core/base/", "core/geo/", "core/files/", "core/raster/", "core/tiles/"}},
        {"core/terrain/",
         {"core/base/", "core/geo/", "core/raster/", "core/tiles/", "core/terrain/"}},
        {"core/levels/",
         {"core/base/", "core/geo/", "core/files/", "core/raster/", "core/sources/", "core/tiles/",
          "core/terrain/", "core/levels/"}},
        {"core/prepare/",
         {"core/base/", "core/geo/", "core/files/", "core/raster/", "core/sources/", "core/tiles/",
          "core/terrain/", "core/levels/", "core/prepare/"}},
        {"core/mesh/", {"core/base/", "core/geo/frames.h", "core/mesh/"}},
        {"core/body/",
         {"core/base/", "core/geo/", "core/raster/", "core/terrain/", "core/levels/", "core/mesh/",
          "core/body/"}},
        {"core/contact/",
         {"core/base/", "core/geo/", "core/raster/", "core/terrain/", "core/levels/", "core/mesh/",
          "core/body/", "core/contact/"}},
        {"core/measure/",
         {"core/base/", "core/geo/", "core/raster/", "core/tiles/", "core/terrain/",
          "core/measure/"}},
        {"core/vector/", {"core/base/", "core/geo/", "core/files/", "core/vector/"}},
        {"core/contours/",
         {"core/base/", "core/geo/", "core/files/", "core/raster/", "core/contours/"}},
        {"core/names/", {"core/base/", "core/geo/", "core/vector/", "core/names/"}},
        {"core/view/", {"core/base/", "core/geo/", "core/raster/", "core/terrain/", "core/view/"}},
        {"core/json/", {"core/base/", "core/geo/", "core/json/"}},
        {"core/annotations/",
         {"core/base/", "core/geo/", "core/files/", "core/measure/", "core/vector/", "core/view/",
          "core/json/", "core/annotations/"}},
        {"core/globe/",
         {"core/base/", "core/geo/", "core/terrain/", "core/body/", "core/view/", "core/globe/"}},
        {"core/flight/", {"core/base/", "core/geo/", "core/view/", "core/globe/", "core/flight/"}},
        {"core/session/", {"core/"}},
        {"core/feather/",
         {"core/base/", "core/geo/", "core/raster/", "core/tiles/", "core/terrain/", "core/levels/",
          "core/session/", "core/feather/"}},
        {"core/graticule/",
         {"core/base/", "core/geo/", "core/view/", "core/globe/", "core/session/",
          "core/graticule/"}},
        {"haptics/", {"core/", "haptics/"}},
        {"ui/render/opengl/", {"core/", "ui/render/opengl/"}},
        {"ui/render/", {"core/", "ui/render/"}},
        {"ui/text/", {"core/", "haptics/", "ui/text/"}},
        {"ui/widgets/", {"core/", "ui/text/", "ui/widgets/"}},
        {"ui/canvas/",
         {"core/", "haptics/", "ui/render/", "ui/text/", "ui/widgets/", "ui/canvas/"}},
        {"ui/drawing/",
         {"core/", "ui/render/", "ui/text/", "ui/widgets/", "ui/canvas/", "ui/drawing/"}},
        {"ui/plots/", {"core/", "ui/text/", "ui/plots/"}},
        {"ui/controllers/",
         {"core/", "haptics/", "ui/text/", "ui/widgets/", "ui/drawing/", "ui/canvas/",
          "ui/controllers/"}},
        {"ui/overlay/",
         {"core/", "ui/render/", "ui/text/", "ui/widgets/", "ui/drawing/", "ui/canvas/",
          "ui/controllers/", "ui/globe/", "ui/overlay/"}},
        {"ui/project/",
         {"core/", "haptics/", "ui/text/", "ui/widgets/", "ui/drawing/", "ui/canvas/",
          "ui/controllers/", "ui/project/"}},
        {"ui/dialogs/",
         {"core/", "haptics/", "ui/text/", "ui/widgets/", "ui/controllers/", "ui/dialogs/"}},
        {"ui/panels/",
         {"core/", "haptics/", "ui/text/", "ui/widgets/", "ui/drawing/", "ui/plots/",
          "ui/controllers/", "ui/panels/"}},
        {"ui/pictures/",
         {"core/", "ui/render/", "ui/widgets/", "ui/canvas/", "ui/overlay/", "ui/globe/",
          "ui/pictures/"}},
        {"ui/views/",
         {"core/", "ui/render/", "ui/text/", "ui/widgets/", "ui/canvas/", "ui/controllers/",
          "ui/overlay/", "ui/pictures/", "ui/views/"}},
        {"ui/report/",
         {"core/", "ui/render/", "ui/text/", "ui/widgets/", "ui/plots/", "ui/canvas/",
          "ui/controllers/", "ui/overlay/", "ui/pictures/", "ui/report/"}},
        {"ui/globe/",
         {"core/", "haptics/", "ui/render/", "ui/text/", "ui/widgets/", "ui/drawing/", "ui/canvas/",
          "ui/controllers/", "ui/globe/"}},
        {"ui/window/",
         {"core/", "haptics/", "ui/text/", "ui/widgets/", "ui/canvas/", "ui/controllers/",
          "ui/overlay/", "ui/panels/", "ui/window/"}},
        {"ui/commands/",
         {"core/", "haptics/", "ui/text/", "ui/widgets/", "ui/drawing/", "ui/canvas/",
          "ui/controllers/", "ui/overlay/", "ui/project/", "ui/dialogs/", "ui/panels/", "ui/views/",
          "ui/report/", "ui/window/", "ui/globe/", "ui/pictures/", "ui/commands/"}},
        {"ui/", {"core/", "haptics/", "ui/"}},
        {"app/console/", {"core/", "haptics/", "ui/render/", "app/console/"}},
        {"app/bench/reference/", {"core/", "app/bench/reference/"}},
        {"app/bench/", {"core/", "haptics/", "ui/render/", "app/console/", "app/bench/"}},
        {"app/documents/", {"core/base/", "app/console/", "app/documents/"}},
        {"app/cli/",
         {"core/", "haptics/", "ui/render/", "app/console/", "app/bench/", "app/documents/",
          "app/cli/"}},
        {"app/gui/", {"core/", "haptics/", "ui/", "app/gui/"}},
        {"app/probe/", {"core/files/", "app/probe/"}},
        {"app/library/", {"core/", "app/library/"}},
        {"app/python/", {"core/", "ui/render/", "app/console/", "app/python/"}},
        {"tests/architecture/", {"tests/"}},
        {"tests/support/", {"core/", "app/bench/reference/", "tests/support/"}},
        {"tests/core/", {"core/", "app/bench/reference/", "tests/"}},
        {"tests/haptics/", {"core/", "haptics/", "tests/"}},
        {"tests/cli/",
         {"core/", "haptics/", "app/console/", "app/cli/", "app/gui/window_arguments.h", "tests/"}},
        {"tests/bench/", {"core/", "haptics/", "app/bench/", "tests/"}},
        {"tests/render/", {"core/", "ui/render/", "app/bench/reference/", "tests/"}},
        {"tests/ui/", {"core/", "haptics/", "ui/", "app/gui/", "tests/"}},
        {"tests/", {"core/", "haptics/", "ui/", "tests/"}},
    };
    return kLayers;
}

constexpr std::array<std::string_view, 6> kOurs{"core/", "haptics/", "ui/",
                                                "app/",  "tests/",   "resources/"};

bool startsWithAny(std::string_view text, std::span<const std::string_view> starts)
{
    return std::any_of(starts.begin(), starts.end(),
                       [text](std::string_view start) { return text.starts_with(start); });
}

// <QWidget>, <QtCore/qglobal.h>, <qpa/…>: in this project only Qt's headers are named like this.
bool isQt(std::string_view header)
{
    return (header.size() > 1 && header[0] == 'Q' &&
            std::isupper(static_cast<unsigned char>(header[1])) != 0) ||
           header.starts_with("Qt") || header.starts_with("qpa/");
}

bool isGdal(std::string_view header)
{
    constexpr std::array<std::string_view, 7> kStarts{"gdal", "ogr",        "cpl_", "vrt",
                                                      "gnm",  "memdataset", "proj"};
    return startsWithAny(header, kStarts);
}

bool mayUseQt(std::string_view path)
{
    constexpr std::array<std::string_view, 2> kFolders{"app/gui/", "tests/ui/"};
    return startsWithAny(path, kFolders) ||
           (path.starts_with("ui/") && !path.starts_with("ui/render/"));
}

bool mayUseGdal(std::string_view path)
{
    constexpr std::array<std::string_view, 10> kFolders{"core/geo/",
                                                        "core/files/",
                                                        "core/formats/",
                                                        "core/raster/",
                                                        "core/sources/",
                                                        "core/prepare/",
                                                        "core/vector/",
                                                        "core/contours/",
                                                        "app/bench/reference/computed_raster.",
                                                        "tests/support/faulty_driver/"};
    return startsWithAny(path, kFolders);
}

std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(" \t");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first);
}

} // namespace

std::vector<std::string> includesOf(std::string_view source)
{
    std::vector<std::string> includes;
    bool is_in_comment = false;
    while (!source.empty()) {
        const auto end = source.find('\n');
        std::string_view line = trimmed(source.substr(0, end));
        source = end == std::string_view::npos ? std::string_view{} : source.substr(end + 1);
        if (is_in_comment) {
            const auto close = line.find("*/");
            if (close == std::string_view::npos) {
                continue;
            }
            is_in_comment = false;
            line = trimmed(line.substr(close + 2));
        }
        if (line.starts_with("#")) {
            const std::string_view directive = trimmed(line.substr(1));
            if (directive.starts_with("include")) {
                const std::string_view rest = trimmed(directive.substr(7));
                const char closing = rest.starts_with('<') ? '>' : '"';
                const auto close = rest.find(closing, 1);
                if (close != std::string_view::npos) {
                    includes.emplace_back(closing == '>' ? rest.substr(0, close + 1)
                                                         : rest.substr(1, close - 1));
                }
            }
        }
        // In this project a comment that starts within a line also ends on that line.
        is_in_comment = line.starts_with("/*") && line.find("*/") == std::string_view::npos;
    }
    return includes;
}

std::optional<std::string> violation(std::string_view path, std::string_view include)
{
    const bool is_system = include.starts_with('<');
    const std::string_view header = is_system ? include.substr(1, include.size() - 2) : include;
    const auto refused = [&](std::string_view why) {
        return fmt::format("{} includes {}: {}", path, include, why);
    };
    if (isQt(header) && !mayUseQt(path)) {
        return refused("Qt belongs to ui (without ui/render) and app/gui");
    }
    if (isGdal(header) && !mayUseGdal(path)) {
        return refused(
            "GDAL belongs to core/geo, core/files, core/raster, core/sources and core/prepare");
    }
    if (header.starts_with("hidapi") && !path.starts_with("haptics/drivers/") &&
        !path.starts_with("tests/haptics/drivers/")) {
        return refused("hidapi belongs to haptics/drivers");
    }
    if (header.starts_with("AL/") && !path.starts_with("haptics/sound/")) {
        return refused("OpenAL belongs to haptics/sound");
    }
    if (!startsWithAny(header, kOurs)) {
        return is_system ? std::nullopt
                         : std::optional(refused("own headers are named from the source root"));
    }
    if (is_system) {
        return refused("own headers stand in quotes");
    }
    const auto layer = std::find_if(layers().begin(), layers().end(),
                                    [path](const Layer& l) { return path.starts_with(l.folder); });
    if (layer == layers().end()) {
        return refused("the file is in no layer");
    }
    if (!startsWithAny(header, layer->may_include)) {
        return refused(fmt::format("{} may include {} only", layer->folder,
                                   fmt::join(layer->may_include, ", ")));
    }
    return std::nullopt;
}

} // namespace marsview::test
