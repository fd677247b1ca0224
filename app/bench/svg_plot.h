// Plots with logarithmic axes as SVG, readable on light and dark pages.
#pragma once

#include <string>
#include <vector>

namespace marsview {

struct PlotPoint {
    double x = 0.0; // > 0
    double y = 0.0; // at or below the plot's floor: drawn in its band
};

/// Points joined by a line. Series of the same place in their panels share colour and marker.
struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;
    std::string first_label; // beside the first point and the last
    std::string last_label;
};

struct PlotPanel {
    std::string title;
    std::vector<PlotSeries> series;
};

/// Panels beside and below each other, two in a row, with common axes; the legend, from the first
/// panel, above them. Eight series at most.
struct Plot {
    std::string title;
    std::string note; // below the title
    std::string x_label;
    std::string y_label;
    double y_floor = 1e-6;   // > 0; what is smaller lies in a band below the axis
    std::string floor_label; // what the band is called
    std::vector<PlotPanel> panels;
};

/// The file's text. UTF-8; no fonts, scripts or links.
std::string asSvg(const Plot& plot);

} // namespace marsview
