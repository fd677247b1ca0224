#include "app/gui/window_arguments.h"

#include "core/base/nearest_word.h"
#include "core/files/file_address.h"
#include "core/files/raster_path.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

constexpr int kWidthMin = 320;
constexpr int kHeightMin = 240;
constexpr int kSideMax = 8192; // supported by every OpenGL 3.3 driver

struct QtOption {
    std::string_view name; // with one dash; Qt also accepts two
    bool has_value;
};

// The options of QGuiApplication and QApplication (Qt 6), except the geometry, which is parsed
// here. The style is listed, but not passed on: the program's palettes are applied to it.
constexpr std::array kQtOptions{
    QtOption{"platform", true},      QtOption{"platformpluginpath", true},
    QtOption{"platformtheme", true}, QtOption{"plugin", true},
    QtOption{"qwindowicon", true},   QtOption{"qwindowtitle", true},
    QtOption{"icon", true},          QtOption{"title", true},
    QtOption{"display", true},       QtOption{"session", true},
    QtOption{"reverse", false},      QtOption{"fontengine", true},
    QtOption{"style", true},         QtOption{"stylesheet", true},
    QtOption{"widgetcount", false},  QtOption{"qmljsdebugger", true},
    QtOption{"nograb", false},       QtOption{"dograb", false},
    QtOption{"sync", false},
};

constexpr std::string_view kHelp = R"(Explore topographic maps of planets and moons in a window.
Usage: marsview [OPTIONS] [DEM...]
       marsview [OPTIONS] PROJECT.mvproj [DEM...]

DEM                    maps to open: files, folders of adjoining rasters, addresses (https://,
                       s3://, gs://, file://) or GDAL dataset names. Each becomes a layer; the
                       last one lies on top. Without any, the bundled map of Mars
PROJECT.mvproj         a project saved by MarsView; maps are opened on top of its layers

Options:
  -h, --help           print this help and exit
  --version            print the version and exit
  --screenshot FILE    write a picture of the window once the maps are drawn, and exit
  --size WxH           size of the window in pixels, from 320x240 to 8192x8192
  --geometry WxH+X+Y   size and position of the window

Qt's own options are accepted too, for example -style fusion, -platform xcb,
-reverse, -stylesheet FILE.
)";

std::string_view withoutDashes(std::string_view word)
{
    word.remove_prefix(word.starts_with("--") ? 2 : 1);
    return word;
}

const QtOption* qtOption(std::string_view name)
{
    const auto* const found =
        std::find_if(kQtOptions.begin(), kQtOptions.end(),
                     [name](const QtOption& option) { return option.name == name; });
    return found != kQtOptions.end() ? found : nullptr;
}

// Parses a whole number with an optional sign from the front of `text`, and removes it.
std::optional<int> takeNumber(std::string_view& text)
{
    std::string_view digits = text;
    if (digits.starts_with('+')) {
        digits.remove_prefix(1);
    }
    int number = 0;
    const auto [end, failure] =
        std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (failure != std::errc{}) {
        return std::nullopt;
    }
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

// Empty if the text does not have the form.
std::optional<WindowGeometry> geometryFrom(std::string_view text)
{
    WindowGeometry geometry;
    if (!text.empty() && text.front() != '+' && text.front() != '-') {
        const auto width = takeNumber(text);
        const bool has_cross = width && (text.starts_with('x') || text.starts_with('X'));
        if (has_cross) {
            text.remove_prefix(1);
        }
        const auto height = has_cross ? takeNumber(text) : std::nullopt;
        if (!height || *width < kWidthMin || *height < kHeightMin || *width > kSideMax ||
            *height > kSideMax) {
            return std::nullopt;
        }
        geometry.extent = {*width, *height};
    }
    if (!text.empty()) {
        const auto x = takeNumber(text);
        const bool has_y = x && (text.starts_with('+') || text.starts_with('-'));
        const auto y = has_y ? takeNumber(text) : std::nullopt;
        if (!y || !text.empty()) {
            return std::nullopt;
        }
        geometry.place = {*x, *y};
    }
    return geometry.extent || geometry.place ? std::optional(geometry) : std::nullopt;
}

class Parser {
public:
    Parser(const std::vector<std::string>& given, const std::string& version)
        : given_(given)
        , version_(version)
    {}

    Result<WindowArguments> parse()
    {
        while (at_ < given_.size()) {
            const std::string& word = given_[at_++];
            std::optional<Error> error;
            if (word == "--" && !are_maps_only_) {
                are_maps_only_ = true;
            } else if (!are_maps_only_ && word.size() > 1 && word.front() == '-') {
                error = takeOption(word);
            } else {
                error = takeMap(word);
            }
            if (error) {
                return *error;
            }
            if (arguments_.answer) {
                break;
            }
        }
        return std::move(arguments_);
    }

private:
    static Error usage(const std::string& what, const std::string& why)
    {
        return Error{ErrorCode::Invalid, fmt::format("{}: {}", what, why)};
    }

    std::optional<Error> takeOption(const std::string& word)
    {
        const std::size_t sign = word.find('=');
        const std::string name = word.substr(0, sign);
        std::optional<std::string> value;
        if (sign != std::string::npos) {
            value = word.substr(sign + 1);
        }
        if (name == "--help" || name == "-h") {
            arguments_.answer = std::string(kHelp);
            return std::nullopt;
        }
        if (name == "--version") {
            arguments_.answer = fmt::format("marsview {}\n", version_);
            return std::nullopt;
        }
        const bool is_geometry =
            name == "--geometry" || name == "-geometry" || name == "-qwindowgeometry";
        const bool is_style = withoutDashes(name) == "style";
        const QtOption* const of_qt = is_style ? nullptr : qtOption(withoutDashes(name));
        if (name != "--screenshot" && name != "--size" && !is_geometry && !is_style &&
            of_qt == nullptr) {
            return usage(name, "unknown option" + suggestionFor(name));
        }
        if (of_qt != nullptr) {
            arguments_.for_qt.push_back(word);
        }
        if (of_qt != nullptr && !of_qt->has_value) {
            return std::nullopt;
        }
        const bool is_separate = !value;
        if (!value) {
            if (at_ == given_.size()) {
                return usage(name, "a value is missing");
            }
            value = given_[at_++];
        }
        if (of_qt != nullptr) {
            if (is_separate) {
                arguments_.for_qt.push_back(*value);
            }
            return of_qt->name == "stylesheet" ? checkStylesheet(name, *value) : std::nullopt;
        }
        if (is_style) {
            arguments_.style = *value;
            return std::nullopt;
        }
        return name == "--screenshot" ? takeScreenshot(*value)
                                      : takeGeometry(name, *value, is_geometry);
    }

    // Qt goes on without a style sheet that it cannot read.
    static std::optional<Error> checkStylesheet(const std::string& name, const std::string& file)
    {
        const Result<std::string> path = localPathOf(file);
        if (!path) {
            return usage(name, path.error().message);
        }
        if (!std::ifstream(*path) || std::filesystem::is_directory(*path)) {
            return usage(name, *path + " is not a file that can be read");
        }
        return std::nullopt;
    }

    std::optional<Error> takeScreenshot(const std::string& file)
    {
        if (file.empty()) {
            return usage("--screenshot", "the file name is empty");
        }
        const std::string ending = lowerCase(std::filesystem::path(file).extension().string());
        if (ending != ".png" && ending != ".jpg" && ending != ".jpeg") {
            return usage("--screenshot",
                         fmt::format("\"{}\" does not end in .png or .jpg; other formats are not "
                                     "written",
                                     file));
        }
        arguments_.screenshot = file;
        return std::nullopt;
    }

    std::optional<Error>
    takeGeometry(const std::string& name, const std::string& text, bool has_place)
    {
        const auto geometry = geometryFrom(text);
        if (!geometry || (!has_place && (!geometry->extent || geometry->place))) {
            return usage(name, fmt::format("\"{}\" is not a {} from 320x240 to 8192x8192; write it "
                                           "as {}",
                                           text, has_place ? "geometry" : "size",
                                           has_place ? "1280x800+20+20" : "1280x800"));
        }
        arguments_.geometry = *geometry;
        return std::nullopt;
    }

    std::optional<Error> takeMap(const std::string& name)
    {
        if (name.empty()) {
            return usage("DEM", "an empty name was given");
        }
        Result<std::string> path = localPathOf(name);
        if (!path) {
            return path.error();
        }
        arguments_.maps.push_back(std::move(path).value());
        return std::nullopt;
    }

    // Dashes are not counted: Qt's options have one or two.
    static std::string suggestionFor(const std::string& name)
    {
        std::vector<std::string> names{"help", "version", "screenshot", "size", "geometry"};
        const std::size_t own_count = names.size();
        for (const QtOption& option : kQtOptions) {
            names.emplace_back(option.name);
        }
        const std::string nearest = nearestWord(withoutDashes(name), names);
        if (nearest.empty()) {
            return {};
        }
        const auto own_end = names.begin() + static_cast<std::ptrdiff_t>(own_count);
        const bool is_own = std::find(names.begin(), own_end, nearest) != own_end;
        return fmt::format(". Did you mean \"{}{}\"?", is_own ? "--" : "-", nearest);
    }

    const std::vector<std::string>& given_;
    const std::string& version_;
    std::size_t at_ = 0;
    bool are_maps_only_ = false;
    WindowArguments arguments_;
};

} // namespace

Result<WindowArguments> parseWindowArguments(const std::vector<std::string>& arguments,
                                             const std::string& version)
{
    return Parser(arguments, version).parse();
}

} // namespace marsview
