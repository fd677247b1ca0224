// Plots with logarithmic axes as SVG, readable on light and dark pages.
#pragma once

#include <string>
#include <vector>

namespace marsview {

struct PlotPoint {
    double x = 0.0; // > 0
    double y = 0.0; // at or below the plot's floor: drawn in its band
};

/// Points joined by a line. Series at the same index in their panels share color and marker.
struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;
    std::string first_label; // next to the first and the last point
    std::string last_label;
};

struct PlotPanel {
    std::string title;
    std::vector<PlotSeries> series;
};

/// Panels in two columns, with common axes; the legend, taken from the first panel, is above them.
/// At most eight series.
struct Plot {
    std::string title;
    std::string note; // below the title
    std::string x_label;
    std::string y_label;
    double y_floor = 1e-6;   // > 0; smaller values are drawn in a band below the axis
    std::string floor_label; // label of the band
    std::vector<PlotPanel> panels;
};

/// The file's text. UTF-8; no fonts, scripts or links.
std::string asSvg(const Plot& plot);

} // namespace marsview
