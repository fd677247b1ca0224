// The command line of `marsview`.
#pragma once

#include "core/base/result.h"

#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// Of a window, in pixels. From "WIDTHxHEIGHT", "WIDTHxHEIGHT+X+Y" or "+X+Y", as X11 programs have
/// it.
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
    /// Maps to open in this order: the last one lies on top. "file://" addresses are paths here.
    std::vector<std::string> maps;
    std::string screenshot; // file; empty: none
    WindowGeometry geometry;
    /// Qt's own ("-style", "fusion", …), for QApplication.
    std::vector<std::string> for_qt;
    /// What --help or --version prints; the program ends after it.
    std::optional<std::string> answer;
};

/// `arguments` without the program's name. Needs neither Qt nor a display. The error has the form
/// "<option>: <what and why>".
Result<WindowArguments> parseWindowArguments(const std::vector<std::string>& arguments,
                                             const std::string& version);

} // namespace marsview
