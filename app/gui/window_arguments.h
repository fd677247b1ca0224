// The command line of `marsview`.
#pragma once

#include "core/base/result.h"

#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// Window size and position in pixels. From "WIDTHxHEIGHT", "WIDTHxHEIGHT+X+Y" or "+X+Y", as in X11
/// programs.
struct WindowGeometry {
    struct Extent {
        int width;
        int height;
    };
    struct Place {
        int x;
        int y;
    };
    std::optional<Extent> extent;
    std::optional<Place> place;
};

struct WindowArguments {
    /// Maps to open in this order: the last one is on top. "file://" URLs have been converted to
    /// paths.
    std::vector<std::string> maps;
    std::string screenshot; // file; empty: none
    WindowGeometry geometry;
    /// The widget style, a name of QStyleFactory in any case; empty: the program's own.
    std::string style;
    /// Qt's own ("-platform", "xcb", …), for QApplication.
    std::vector<std::string> for_qt;
    /// The output of --help or --version; the program exits after printing it.
    std::optional<std::string> answer;
};

/// `arguments` without the program's name. Requires neither Qt nor a display. The error has the
/// form "<option>: <what and why>".
Result<WindowArguments> parseWindowArguments(const std::vector<std::string>& arguments,
                                             const std::string& version);

} // namespace marsview
