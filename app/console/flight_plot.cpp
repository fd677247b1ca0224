#include "app/console/flight_plot.h"

#include "core/base/round_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <string_view>
#include <utility>

namespace marsview {
namespace {

constexpr double kWidth = 1000.0;
constexpr double kLeft = 70.0;
constexpr double kRight = 24.0;
constexpr double kTop = 76.0;
constexpr double kPanelHeight = 220.0;
constexpr double kGap = 46.0;
constexpr double kBottom = 54.0;
constexpr int kRowsMax = 8;

constexpr std::string_view kPanTone = "#f6e3c5";
constexpr std::string_view kZoomTone = "#dcecd2";
constexpr std::string_view kOffTone = "#d8d8d8";
constexpr std::string_view kLabel = "fill=\"#333333\" font-size=\"12\"";

struct Series {
    std::string name;
    std::string color;
    std::vector<double> values; // one for each record
};

struct Panel {
    std::string label;
    std::vector<Series> series;
};

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void take(double value)
    {
        if (std::isfinite(value)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    // With some space, and never empty.
    Range padded(double least) const
    {
        if (!(high >= low)) {
            return {0.0, 1.0};
        }
        const double room = std::max(0.06 * (high - low), least);
        return {low - room, high + room};
    }
};

std::string escaped(std::string_view text)
{
    std::string result;
    for (const char c : text) {
        result += c == '&'   ? std::string("&amp;")
                  : c == '<' ? std::string("&lt;")
                  : c == '>' ? std::string("&gt;")
                  : c == '"' ? std::string("&quot;")
                             : std::string(1, c);
    }
    return result;
}

template <typename Value>
std::vector<double> valuesOf(const std::vector<TickRecord>& records, Value value)
{
    std::vector<double> values;
    values.reserve(records.size());
    for (const TickRecord& record : records) {
        values.push_back(value(record));
    }
    return values;
}

// How far the hand has moved the map since the first record.
struct MapMotion {
    std::vector<double> east_m;
    std::vector<double> north_m;
    std::vector<double> turn_deg;
    std::vector<double> octaves; // of its size in the workspace
};

MapMotion motionOf(const std::vector<TickRecord>& records)
{
    MapMotion motion;
    Vec3 shift_m;
    double turn_rad = 0.0;
    double octaves = 0.0;
    for (const TickRecord& record : records) {
        if (record.has_motion) {
            // The workspace has moved; the map moves against it.
            const Vec3 moved_m = record.motion.from - record.motion.to;
            if (const auto& turn = record.motion.body_turn_rad) { // along the ground there
                const Vec3 up = normalized(record.motion.from);
                const Vec3 east = normalized(cross({0.0, 0.0, 1.0}, up));
                shift_m = shift_m + Vec3{dot(moved_m, east), dot(moved_m, cross(up, east)), 0.0};
                turn_rad -= dot(*turn, up);
            } else {
                shift_m = shift_m + moved_m;
                turn_rad -= record.motion.turn_rad;
            }
            octaves -= std::log2(record.motion.scale);
        }
        motion.east_m.push_back(shift_m.x);
        motion.north_m.push_back(shift_m.y);
        motion.turn_deg.push_back(Angle::radians(turn_rad).degrees());
        motion.octaves.push_back(octaves);
    }
    return motion;
}

bool isStill(const std::vector<double>& values)
{
    return std::all_of(values.begin(), values.end(),
                       [](double value) { return std::abs(value) < 1e-9; });
}

constexpr const char* kBlack = "#111111";
constexpr const char* kBlue = "#1f6fb5";
constexpr const char* kOrange = "#c8541a";
constexpr const char* kBrown = "#8a5a2b";

std::vector<Panel> panelsOf(const std::vector<TickRecord>& records)
{
    constexpr double kMm = 1e3;
    const auto values = [&records](auto value) { return valuesOf(records, value); };
    std::vector<Panel> panels{
        {"force on the hand, N",
         {{"magnitude", kBlack, values([](const TickRecord& r) { return length(r.force_n); })},
          {"upward", kBlue, values([](const TickRecord& r) { return r.force_n.z; })},
          {"horizontal", kOrange,
           values([](const TickRecord& r) { return std::hypot(r.force_n.x, r.force_n.y); })}}},
        {"height in the workspace, mm",
         {{"surface below the hand", kBrown,
           values([](const TickRecord& r) { return kMm * r.surface_z_m; })},
          {"hand", kBlue, values([](const TickRecord& r) { return kMm * r.hand.z; })}}}};
    MapMotion motion = motionOf(records);
    const bool is_turned = !isStill(motion.turn_deg);
    const bool is_enlarged = !isStill(motion.octaves);
    if (is_turned) {
        panels.push_back({"map turned by the hand, °",
                          {{"counterclockwise", kBlack, std::move(motion.turn_deg)}}});
    }
    if (is_enlarged) {
        panels.push_back({"map enlarged by the hand, octaves",
                          {{"enlarged", kBlack, std::move(motion.octaves)}}});
    }
    // Turning and enlarging about the hand moves the place that is followed, too.
    if (!is_turned && !is_enlarged && !(isStill(motion.east_m) && isStill(motion.north_m))) {
        panels.push_back({"map moved by the hand, m",
                          {{"east", kBlack, std::move(motion.east_m)},
                           {"north", kBlue, std::move(motion.north_m)}}});
    }
    return panels;
}

class Writer {
public:
    Writer(const std::vector<TickRecord>& records, const std::string& title)
        : records_(records)
        , title_(title)
    {
        end_s_ = records.empty() ? 1.0 : std::max(secondsOf(records.back()), 1e-3);
    }

    std::string text()
    {
        const std::vector<Panel> all = panelsOf(records_);
        const double height =
            kTop + kBottom + static_cast<double>(all.size()) * (kPanelHeight + kGap) - kGap;
        text_ = fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
            "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"Helvetica, Arial, 'DejaVu Sans', "
            "sans-serif\" role=\"img\" aria-label=\"{2}\">\n"
            "<rect fill=\"#ffffff\" width=\"{0:.0f}\" height=\"{1:.0f}\"/>\n"
            "<text fill=\"#111111\" font-size=\"16\" font-weight=\"bold\" x=\"{3:.0f}\" "
            "y=\"26\">{2}</text>\n",
            kWidth, height, escaped(title_), kLeft);
        drawModeNames();
        for (std::size_t i = 0; i < all.size(); ++i) {
            top_ = kTop + static_cast<double>(i) * (kPanelHeight + kGap);
            drawPanel(all[i], i + 1 == all.size());
        }
        text_ += fmt::format(
            "<text {} text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">time, "
            "s</text>\n</svg>\n",
            kLabel, kLeft + 0.5 * plotWidth(), height - 14.0);
        return std::move(text_);
    }

private:
    static double plotWidth() { return kWidth - kLeft - kRight; }
    double secondsOf(const TickRecord& record) const
    {
        return static_cast<double>(record.time_ns - records_.front().time_ns) * 1e-9;
    }
    double xAt(double seconds) const { return kLeft + seconds / end_s_ * plotWidth(); }
    double yAt(double value) const
    {
        return top_ + (y_.high - value) / (y_.high - y_.low) * kPanelHeight;
    }

    // What a band marks; empty: no band.
    static std::string_view toneOf(const TickRecord& record)
    {
        return record.reason != ForceOffReason::None ? kOffTone
               : record.mode == StylusMode::Pan      ? kPanTone
               : record.mode == StylusMode::Zoom     ? kZoomTone
                                                     : std::string_view();
    }

    void drawModeNames()
    {
        double x = kLeft;
        for (const auto& [tone, name] :
             {std::pair(kPanTone, "panning"), std::pair(kZoomTone, "zooming and turning"),
              std::pair(kOffTone, "force off")}) {
            text_ += fmt::format(
                "<rect stroke=\"none\" fill=\"{}\" x=\"{:.1f}\" y=\"36\" width=\"14\" "
                "height=\"12\"/>"
                "<text {} x=\"{:.1f}\" y=\"46\">{}</text>\n",
                tone, x, kLabel, x + 20.0, name);
            x += 50.0 + 7.0 * static_cast<double>(std::string_view(name).size());
        }
    }

    // One band for every uninterrupted hold, and where the force is off.
    void drawBands()
    {
        for (std::size_t i = 0; i < records_.size();) {
            std::size_t end = i;
            const std::string_view tone = toneOf(records_[i]);
            while (end < records_.size() && toneOf(records_[end]) == tone) {
                ++end;
            }
            if (!tone.empty()) {
                const double x = xAt(secondsOf(records_[i]));
                const double x_end = xAt(secondsOf(records_[end - 1]));
                text_ += fmt::format(
                    "<rect fill=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
                    "height=\"{:.1f}\"/>\n",
                    tone, x, top_, std::max(x_end - x, 0.5), kPanelHeight);
            }
            i = end;
        }
    }

    void drawPanel(const Panel& panel, bool is_lowest)
    {
        Range range;
        for (const Series& series : panel.series) {
            for (const double value : series.values) {
                range.take(value);
            }
        }
        y_ = range.padded(0.02);
        text_ += fmt::format(
            "<rect fill=\"#fbfbfb\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
            "height=\"{:.1f}\"/>\n",
            kLeft, top_, plotWidth(), kPanelHeight);
        drawBands();
        const RoundTicks rows = roundTicks(y_.low, y_.high, kRowsMax);
        for (const double value : rows.values) {
            const double y = yAt(value);
            drawLine(kLeft, y, kWidth - kRight, y, value == 0.0 ? "#888888" : "#dddddd");
            text_ += fmt::format(
                "<text {} text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{}"
                "</text>\n",
                kLabel, kLeft - 7.0, y + 4.0, number(value, rows.step));
        }
        const RoundTicks columns = roundTicks(0.0, end_s_, 12);
        for (const double value : columns.values) {
            const double x = xAt(value);
            drawLine(x, top_, x, top_ + kPanelHeight, "#dddddd");
            if (is_lowest) {
                text_ += fmt::format(
                    "<text {} text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">"
                    "{}</text>\n",
                    kLabel, x, top_ + kPanelHeight + 17.0, number(value, columns.step));
            }
        }
        text_ += fmt::format(
            "<text {} text-anchor=\"middle\" transform=\"translate(18 {:.1f}) "
            "rotate(-90)\">{}</text>\n",
            kLabel, top_ + 0.5 * kPanelHeight, escaped(panel.label));
        double x = kLeft;
        for (const Series& series : panel.series) {
            drawSeries(series);
            drawLine(x, top_ - 10.0, x + 22.0, top_ - 10.0, series.color, 2.0);
            text_ += fmt::format("<text {} x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", kLabel, x + 28.0,
                                 top_ - 6.0, escaped(series.name));
            x += 60.0 + 7.0 * static_cast<double>(series.name.size());
        }
        text_ += fmt::format(
            "<rect fill=\"none\" stroke=\"#9a9a9a\" x=\"{:.1f}\" y=\"{:.1f}\" "
            "width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
            kLeft, top_, plotWidth(), kPanelHeight);
    }

    static std::string number(double value, double step)
    {
        const std::string text = fmt::format("{:.{}f}", value, decimalsOf(step));
        return text.front() == '-' ? "−" + text.substr(1) : text;
    }

    void
    drawLine(double x1, double y1, double x2, double y2, std::string_view color, double width = 1.0)
    {
        text_ += fmt::format(
            "<line stroke=\"{}\" stroke-width=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" "
            "x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n",
            color, width, x1, y1, x2, y2);
    }

    // In every half pixel the first, least, greatest and last value, so that no peak is lost.
    void drawSeries(const Series& series)
    {
        const auto slotOf = [this](const TickRecord& record) {
            return std::floor(2.0 * xAt(secondsOf(record)));
        };
        std::string points;
        const auto end_line = [&] {
            if (!points.empty()) {
                text_ += fmt::format(
                    "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\" "
                    "stroke-linejoin=\"round\" points=\"{}\"/>\n",
                    series.color, points);
            }
            points.clear();
        };
        for (std::size_t i = 0; i < records_.size();) {
            const double slot = slotOf(records_[i]);
            std::vector<double> values;
            for (; i < records_.size() && slotOf(records_[i]) == slot; ++i) {
                values.push_back(series.values[i]);
            }
            if (!std::all_of(values.begin(), values.end(),
                             [](double v) { return std::isfinite(v); })) {
                end_line();
                continue;
            }
            const auto [least, most] = std::minmax_element(values.begin(), values.end());
            const bool is_least_first = least < most;
            for (const double value : {values.front(), is_least_first ? *least : *most,
                                       is_least_first ? *most : *least, values.back()}) {
                points += fmt::format("{:.1f},{:.1f} ", 0.5 * slot, yAt(value));
            }
        }
        end_line();
    }

    const std::vector<TickRecord>& records_;
    std::string title_;
    double end_s_ = 1.0;
    double top_ = 0.0;
    Range y_;
    std::string text_;
};

} // namespace

std::string flightPlot(const std::vector<TickRecord>& records, const std::string& title)
{
    return Writer(records, title).text();
}

} // namespace marsview
