#include "app/bench/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace marsview {
namespace {

// Pixels.
constexpr double kPanelWidth = 430.0;
constexpr double kPanelHeight = 270.0;
constexpr double kLeft = 74.0;
constexpr double kRight = 24.0;
constexpr double kGapX = 34.0;
constexpr double kGapY = 54.0;
constexpr double kTitleHeight = 58.0;
constexpr double kLegendRow = 22.0;
constexpr double kLegendColumn = 178.0;
constexpr double kBottom = 56.0;
constexpr double kFloorRow = 8.0; // per series, below the axis's lowest power of ten
constexpr double kMarker = 4.2;

struct Tone {
    const char* light;
    const char* dark;
};

// Okabe and Ito's color-blind safe colors; darker on light pages, lighter on dark ones.
constexpr std::array<Tone, 8> kTones{{{"#0072b2", "#4aa8e0"},
                                      {"#d55e00", "#f2864a"},
                                      {"#00855f", "#2fc99c"},
                                      {"#a8478a", "#e08cc4"},
                                      {"#9a7400", "#e6b422"},
                                      {"#2b2b2b", "#d9d9d9"},
                                      {"#3a8fc4", "#8fd0f5"},
                                      {"#7a7a7a", "#a6a6a6"}}};

std::string escaped(std::string_view text)
{
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    }
    return result;
}

// 1, 10, 0.01; other powers as 10⁻⁶.
std::string powerOfTen(int exponent)
{
    if (exponent >= -3 && exponent <= 4) {
        return fmt::format("{:.{}f}", std::pow(10.0, exponent), std::max(0, -exponent));
    }
    constexpr std::array<std::string_view, 10> kDigits{"⁰", "¹", "²", "³", "⁴",
                                                       "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = exponent < 0 ? "10⁻" : "10";
    for (const char digit : std::to_string(std::abs(exponent))) {
        text += kDigits[static_cast<std::size_t>(digit - '0')];
    }
    return text;
}

// Decimal logarithms of the ends of an axis.
struct Decades {
    double low = 0.0;
    double high = 1.0;
    double span() const { return high - low; }
};

// Space next to the outermost points, for their labels.
constexpr double kRoomDecades = 0.3;

class Writer {
public:
    explicit Writer(const Plot& plot)
        : plot_(plot)
    {
        double x_least = HUGE_VAL;
        double x_most = 0.0;
        double y_most = plot.y_floor;
        for (const PlotPanel& panel : plot.panels) {
            for (const PlotSeries& series : panel.series) {
                for (const PlotPoint& point : series.points) {
                    x_least = std::min(x_least, point.x);
                    x_most = std::max(x_most, point.x);
                    y_most = std::max(y_most, point.y);
                    has_floor_ = has_floor_ || point.y <= plot.y_floor;
                }
            }
        }
        if (x_most > 0.0) {
            x_ = {std::log10(x_least) - kRoomDecades, std::log10(x_most) + kRoomDecades};
        }
        y_.low = std::round(std::log10(plot.y_floor));
        y_.high = std::max(std::ceil(std::log10(y_most)), y_.low + 1.0);
        for (const PlotPanel& panel : plot.panels) {
            series_count_ = std::max(series_count_, panel.series.size());
        }
    }

    std::string text()
    {
        const std::size_t columns = std::min<std::size_t>(2, plot_.panels.size());
        const std::size_t rows = (plot_.panels.size() + 1) / 2;
        const double width = kLeft + kRight + static_cast<double>(columns) * kPanelWidth +
                             static_cast<double>(columns - 1) * kGapX;
        const auto per_row = static_cast<std::size_t>((width - kLeft) / kLegendColumn);
        const std::size_t series = plot_.panels.empty() ? 0 : plot_.panels.front().series.size();
        const double legend =
            static_cast<double>((series + per_row - 1) / std::max<std::size_t>(per_row, 1)) *
            kLegendRow;
        const double top = kTitleHeight + legend + 30.0;
        const double height = top + static_cast<double>(rows) * kPanelHeight +
                              static_cast<double>(rows - 1) * kGapY + kBottom;
        begin(width, height);
        drawLegend(per_row);
        for (std::size_t i = 0; i < plot_.panels.size(); ++i) {
            left_ = kLeft + static_cast<double>(i % 2) * (kPanelWidth + kGapX);
            top_ = top + static_cast<double>(i / 2) * (kPanelHeight + kGapY);
            const bool is_lowest = i + 2 >= plot_.panels.size();
            drawPanel(plot_.panels[i], i % 2 == 0, is_lowest);
        }
        text_ += fmt::format(
            "<text class=\"label\" fill=\"#333333\" font-size=\"13\" text-anchor=\"middle\" "
            "x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
            (width - kRight + kLeft) / 2.0, height - 12.0, escaped(plot_.x_label));
        const double middle = (top + height - kBottom) / 2.0;
        text_ += fmt::format(
            "<text class=\"label\" fill=\"#333333\" font-size=\"13\" text-anchor=\"middle\" "
            "transform=\"translate(18 {:.1f}) rotate(-90)\">{}</text>\n",
            middle, escaped(plot_.y_label));
        text_ += "</svg>\n";
        return std::move(text_);
    }

private:
    void begin(double width, double height)
    {
        text_ = fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
            "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"Helvetica, Arial, 'DejaVu Sans', "
            "sans-serif\" role=\"img\" aria-label=\"{2}\">\n",
            width, height, escaped(plot_.title));
        text_ +=
            "<style>\n@media (prefers-color-scheme: dark) {\n"
            ".page { fill: #16181c } .panel { fill: #1e2126; stroke: #5a606a }\n"
            ".title { fill: #f2f2f2 } .label { fill: #d0d0d0 } .grid { stroke: #353a42 }\n"
            ".floor { fill: #2a2e35 }\n";
        for (std::size_t i = 0; i < kTones.size(); ++i) {
            text_ += fmt::format(
                ".line{0} {{ stroke: {1} }} .mark{0} {{ fill: {1}; stroke: "
                "#1e2126 }} .name{0} {{ fill: {1} }}\n",
                i, kTones[i].dark);
        }
        text_ += "}\n</style>\n";
        text_ += fmt::format(
            "<rect class=\"page\" fill=\"#ffffff\" width=\"{:.0f}\" "
            "height=\"{:.0f}\"/>\n",
            width, height);
        text_ += fmt::format(
            "<text class=\"title\" fill=\"#111111\" font-size=\"17\" "
            "font-weight=\"bold\" x=\"{:.1f}\" y=\"26\">{}</text>\n",
            kLeft, escaped(plot_.title));
        text_ += fmt::format(
            "<text class=\"label\" fill=\"#333333\" font-size=\"12\" x=\"{:.1f}\" "
            "y=\"46\">{}</text>\n",
            kLeft, escaped(plot_.note));
    }

    void drawLegend(std::size_t per_row)
    {
        if (plot_.panels.empty()) {
            return;
        }
        const auto& series = plot_.panels.front().series;
        for (std::size_t i = 0; i < series.size(); ++i) {
            const double x = kLeft + static_cast<double>(i % per_row) * kLegendColumn;
            const double y = kTitleHeight + 12.0 + static_cast<double>(i / per_row) * kLegendRow;
            text_ += fmt::format(
                "<line class=\"line{0}\" stroke=\"{1}\" stroke-width=\"2\" "
                "x1=\"{2:.1f}\" y1=\"{3:.1f}\" x2=\"{4:.1f}\" y2=\"{3:.1f}\"/>\n",
                i, kTones[i].light, x, y, x + 26.0);
            drawMarker(i, x + 13.0, y);
            text_ += fmt::format(
                "<text class=\"label\" fill=\"#333333\" font-size=\"13\" "
                "x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                x + 33.0, y + 4.5, escaped(series[i].name));
        }
    }

    double xAt(double value) const
    {
        return left_ + (std::log10(value) - x_.low) / x_.span() * kPanelWidth;
    }
    // Below the lowest power of ten: one row per series, so that none hides another.
    double floorBand() const
    {
        return has_floor_ ? kFloorRow * (static_cast<double>(series_count_) + 1.0) : 0.0;
    }
    double yAt(double value, std::size_t series = 0) const
    {
        const double room = kPanelHeight - floorBand();
        if (!(value > plot_.y_floor)) {
            return top_ + room + kFloorRow * (static_cast<double>(series) + 1.0);
        }
        return top_ + room - (std::log10(value) - y_.low) / y_.span() * room;
    }

    void drawPanel(const PlotPanel& panel, bool has_y_labels, bool has_x_labels)
    {
        text_ += fmt::format(
            "<rect class=\"panel\" fill=\"#fbfbfb\" stroke=\"#9a9a9a\" x=\"{:.1f}\" y=\"{:.1f}\" "
            "width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
            left_, top_, kPanelWidth, kPanelHeight);
        text_ += fmt::format(
            "<text class=\"title\" fill=\"#111111\" font-size=\"14\" "
            "x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
            left_, top_ - 9.0, escaped(panel.title));
        for (auto exponent = static_cast<int>(std::ceil(x_.low)); exponent <= x_.high; ++exponent) {
            const double x = xAt(std::pow(10.0, exponent));
            drawGrid(x, top_, x, top_ + kPanelHeight);
            if (has_x_labels) {
                drawXLabel(x, powerOfTen(exponent));
            }
        }
        // A label for each decade if there is room, otherwise for every second one.
        constexpr double kLabelsMax = 9.0;
        const int every = y_.span() > kLabelsMax ? 2 : 1;
        const auto lowest = static_cast<int>(y_.low);
        for (int exponent = lowest; exponent <= y_.high; ++exponent) {
            const double share = (exponent - y_.low) / y_.span();
            const double y = top_ + (kPanelHeight - floorBand()) * (1.0 - share);
            drawGrid(left_, y, left_ + kPanelWidth, y);
            if (has_y_labels && (exponent - lowest) % every == 0) {
                drawYLabel(y, powerOfTen(exponent));
            }
        }
        if (has_floor_) {
            text_ += fmt::format(
                "<rect class=\"floor\" fill=\"#eeeeee\" x=\"{:.1f}\" "
                "y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
                left_ + 0.5, top_ + kPanelHeight - floorBand() + 0.5, kPanelWidth - 1.0,
                floorBand() - 1.0);
            if (has_y_labels) {
                drawYLabel(top_ + kPanelHeight - floorBand() / 2.0 + 3.0, plot_.floor_label);
            }
        }
        for (std::size_t i = 0; i < panel.series.size() && i < kTones.size(); ++i) {
            drawSeries(i, panel.series[i]);
        }
    }

    void drawGrid(double x1, double y1, double x2, double y2)
    {
        text_ += fmt::format(
            "<line class=\"grid\" stroke=\"#dddddd\" x1=\"{:.1f}\" y1=\"{:.1f}\" "
            "x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n",
            x1, y1, x2, y2);
    }

    void drawXLabel(double x, const std::string& label)
    {
        text_ += fmt::format(
            "<text class=\"label\" fill=\"#333333\" font-size=\"12\" "
            "text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
            x, top_ + kPanelHeight + 18.0, escaped(label));
    }

    void drawYLabel(double y, const std::string& label)
    {
        text_ += fmt::format(
            "<text class=\"label\" fill=\"#333333\" font-size=\"12\" "
            "text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
            left_ - 7.0, y + 4.0, escaped(label));
    }

    void drawSeries(std::size_t index, const PlotSeries& series)
    {
        if (series.points.empty()) {
            return;
        }
        std::string places;
        for (const PlotPoint& point : series.points) {
            places += fmt::format("{:.1f},{:.1f} ", xAt(point.x), yAt(point.y, index));
        }
        text_ += fmt::format(
            "<polyline class=\"line{}\" fill=\"none\" stroke=\"{}\" "
            "stroke-width=\"2\" stroke-linejoin=\"round\" points=\"{}\"/>\n",
            index, kTones[index].light, places);
        for (const PlotPoint& point : series.points) {
            drawMarker(index, xAt(point.x), yAt(point.y, index));
        }
        drawEnd(index, series.points.front(), series.first_label, -8.0, "end");
        if (series.points.size() > 1) {
            drawEnd(index, series.points.back(), series.last_label, 8.0, "start");
        }
    }

    void drawEnd(std::size_t index,
                 const PlotPoint& point,
                 const std::string& label,
                 double aside,
                 const char* anchor)
    {
        text_ += fmt::format(
            "<text class=\"name{}\" fill=\"{}\" font-size=\"11\" "
            "text-anchor=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
            index, kTones[index].light, anchor, xAt(point.x) + aside, yAt(point.y, index) + 4.0,
            escaped(label));
    }

    // A shape for each series: colors alone are not accessible to everyone.
    void drawMarker(std::size_t index, double x, double y)
    {
        const std::string style =
            fmt::format("class=\"mark{0}\" fill=\"{1}\" stroke=\"#ffffff\" stroke-width=\"1\"",
                        index, kTones[index].light);
        const double r = kMarker;
        const auto polygon = [&](std::initializer_list<std::array<double, 2>> corners) {
            std::string places;
            for (const auto& [dx, dy] : corners) {
                places += fmt::format("{:.1f},{:.1f} ", x + dx * r, y + dy * r);
            }
            text_ += fmt::format("<polygon {} points=\"{}\"/>\n", style, places);
        };
        switch (index % 6) {
        case 0:
            text_ += fmt::format("<circle {} cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n", style,
                                 x, y, r);
            break;
        case 1:
            polygon({{-0.95, -0.95}, {0.95, -0.95}, {0.95, 0.95}, {-0.95, 0.95}});
            break;
        case 2:
            polygon({{0.0, -1.4}, {1.4, 0.0}, {0.0, 1.4}, {-1.4, 0.0}});
            break;
        case 3:
            polygon({{0.0, -1.3}, {1.25, 0.95}, {-1.25, 0.95}});
            break;
        case 4:
            polygon({{0.0, 1.3}, {1.25, -0.95}, {-1.25, -0.95}});
            break;
        default:
            polygon({{-0.4, -1.3},
                     {0.4, -1.3},
                     {0.4, -0.4},
                     {1.3, -0.4},
                     {1.3, 0.4},
                     {0.4, 0.4},
                     {0.4, 1.3},
                     {-0.4, 1.3},
                     {-0.4, 0.4},
                     {-1.3, 0.4},
                     {-1.3, -0.4},
                     {-0.4, -0.4}});
        }
    }

    const Plot& plot_;
    Decades x_;
    Decades y_;
    bool has_floor_ = false;
    std::size_t series_count_ = 0;
    double left_ = 0.0;
    double top_ = 0.0;
    std::string text_;
};

} // namespace

std::string asSvg(const Plot& plot)
{
    return Writer(plot).text();
}

} // namespace marsview
