#include "app/bench/terrain/terrain_bench_report.h"

#include "app/bench/svg_plot.h"
#include "app/console/text_output.h"

#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

namespace marsview {
namespace {

template <typename... Args>
void line(std::string& text, fmt::format_string<Args...> format, Args&&... args)
{
    fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
    text += '\n';
}

double number(const BenchJson& json, const char* key)
{
    return json.at(key).is_number() ? json.at(key).get<double>() : 0.0;
}

std::uint64_t count(const BenchJson& json, const char* key)
{
    return json.at(key).get<std::uint64_t>();
}

std::string word(const BenchJson& json, const char* key)
{
    return asOneLine(json.at(key).get<std::string>());
}

std::string preparing(const BenchJson& found)
{
    std::string text;
    line(text,
         "{:.1f} s, {:.1f} million samples per second, peak memory {:.0f} MB, {:.0f} MB written",
         number(found, "seconds"), number(found, "samples_per_s") / 1e6,
         number(found, "peak_memory_mb"), number(found, "written_mb"));
    return text;
}

std::string pictures(const BenchJson& found)
{
    std::string text;
    line(text, "{:<14}{:<8}{:>10}{:>10}{:>10}{:>10}{:>12}", "", "", "open ms", "first ms",
         "sharp ms", "peak MB", "kept warm");
    for (const BenchJson& row : found.at("openings")) {
        line(text, "{:<14}{:<8}{:>10.0f}{:>10.0f}{:>10.0f}{:>10.0f}{:>10.1f} %",
             row.at("is_prepared").get<bool>() ? "prepared" : "not prepared",
             row.at("is_warm").get<bool>() ? "warm" : "cold", number(row, "opened_ms"),
             number(row, "first_picture_ms"), number(row, "sharp_picture_ms"),
             number(row, "peak_memory_mb"), 100.0 * number(row, "resident_share_at_begin"));
    }
    for (const BenchJson& reason : found.at("left_out")) {
        line(text, "skipped: {}", asOneLine(reason.get<std::string>()));
    }
    return text;
}

std::string session(const BenchJson& found)
{
    std::string text;
    line(text,
         "peak memory {:.0f} MB ({:.0f} MB once open) over {} frames and {} turns of the hand",
         number(found, "peak_memory_mb"), number(found, "opened_peak_memory_mb"),
         count(found, "frames"), count(found, "turns_of_hand"));
    line(text, "tile cache at most {:.0f} MB of {:.0f} MB", number(found, "tile_cache_mb_most"),
         number(found, "tile_cache_mb_max"));
    return text;
}

std::string swipes(const BenchJson& found)
{
    std::string text;
    const std::string refusal = word(found, "scheduling_refusal");
    const std::string locking = word(found, "locking_refusal");
    line(text, "{} µs per turn, {} s per speed; scheduling {}{}; memory {}{}",
         number(found, "period_us"), number(found, "seconds"), word(found, "scheduling"),
         refusal.empty() ? "" : " (" + refusal + ")",
         found.at("memory_locked").get<bool>() ? "locked" : "not locked",
         locking.empty() ? "" : " (" + locking + ")");
    line(text, "{:>7}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>8}{:>8}{:>9}{:>9}{:>9}", "cells", "p50 µs",
         "p99", "p99.9", "max", "woken", "missed", "missed", "faults", "turns", "turns",
         "coarsest");
    line(text, "{:>7}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>8}{:>8}{:>9}{:>9}{:>9}", "/update", "", "",
         "", "", "max µs", "by us", "waking", "", "", "missing", "level");
    for (const BenchJson& row : found.at("speeds")) {
        const BenchJson& update = row.at("update");
        line(text, "{:>7}{:>8.1f}{:>8.1f}{:>8.1f}{:>8.1f}{:>9.0f}{:>9}{:>8}{:>8}{:>9}{:>9}{:>9}",
             number(row, "cells_per_update"), number(update, "p50_us"), number(update, "p99_us"),
             number(update, "p999_us"), number(update, "max_us"),
             number(row.at("waking"), "max_us"), count(row, "missed_by_update"),
             count(row, "missed_by_waking"),
             count(row, "page_faults_minor") + count(row, "page_faults_major"), count(row, "turns"),
             count(row, "turns_with_misses"), count(row, "worst_level"));
    }
    line(text, "turns by the coarsest level used, from full resolution on");
    for (const BenchJson& row : found.at("speeds")) {
        std::string levels;
        for (const BenchJson& turns : row.at("turns_by_coarsest_level")) {
            levels += fmt::format("{:>9}", turns.get<std::uint64_t>());
        }
        line(text, "{:>7}{}", number(row, "cells_per_update"), levels);
    }
    return text;
}

std::string identity(const BenchJson& found)
{
    std::string text;
    line(text, "{} × {} samples{}{}", count(found, "columns"), count(found, "rows"),
         found.at("is_whole_map").get<bool>() ? "" : " in the middle of the map",
         found.at("is_read_from_files").get<bool>() ? "" : ", tiles cut from memory");
    line(text, "{:>7}{:>10}{:>12}{:>10}{:>11}", "cells", "updates", "in contact", "fetched",
         "differing");
    for (const BenchJson& row : found.at("speeds")) {
        line(text, "{:>7}{:>10}{:>12}{:>10}{:>11}", number(row, "cells_per_update"),
             count(row, "updates"), count(row, "in_contact"), count(row, "tiles_fetched"),
             count(row, "differing_proxies"));
    }
    return text;
}

std::string growth(const BenchJson& found)
{
    std::string text;
    std::string head = fmt::format("{:>14}  {:<6}", "triangles", "");
    for (const BenchJson& speed : found.at("cells_per_update")) {
        head += fmt::format("{:>8} c{:>7}", speed.get<double>(), "×");
    }
    line(text, "nanoseconds per update, by cells per update, relative to the smallest part");
    line(text, "{}", head);
    for (const BenchJson& size : found.at("sizes")) {
        std::string row =
            fmt::format("{:>14}  {:<6}", count(size, "triangle_count"), word(size, "storage"));
        for (std::size_t s = 0; s < size.at("growth").size(); ++s) {
            row += fmt::format("{:>10.0f}{:>7.2f}", size.at("ns_per_update")[s].get<double>(),
                               size.at("growth")[s].get<double>());
        }
        line(text, "{}", row);
    }
    if (found.at("whole_map_left_out").is_string()) {
        line(text, "the whole map is skipped: {}", word(found, "whole_map_left_out"));
    }
    line(text, "growth at most × {:.2f}", number(found, "growth_most"));
    return text;
}

// One of those that `pictures` is made of.
std::string picture(const BenchJson& found)
{
    std::string text;
    line(text, "{}, {}: open after {:.0f} ms, first picture {:.0f} ms, sharp {:.0f} ms",
         found.at("is_prepared").get<bool>() ? "prepared" : "not prepared",
         found.at("is_warm").get<bool>() ? "warm" : "cold", number(found, "opened_ms"),
         number(found, "first_picture_ms"), number(found, "sharp_picture_ms"));
    return text;
}

std::string remote(const BenchJson& found)
{
    std::string text;
    line(text, "to open: {} requests, {:.2f} MB", count(found, "requests_to_open"),
         number(found, "bytes_to_open") / 1e6);
    line(text, "there and to single samples: {} requests, {:.2f} MB, {:.3f} % of the file",
         count(found, "requests"), number(found, "bytes") / 1e6,
         100.0 * number(found, "share_of_file"));
    return text;
}

std::string frames(const BenchJson& found)
{
    std::string text;
    line(text, "{}, {} × {} pixels", word(found, "graphics_driver"), count(found, "width_px"),
         count(found, "height_px"));
    for (const BenchJson& map : found.at("maps")) {
        line(text, "{}: {} triangles, median {:.1f} ms, p95 {:.1f} ms", word(map, "file"),
             count(map, "triangle_count"), number(map, "median_ms"), number(map, "p95_ms"));
        for (const BenchJson& flight : map.at("flights")) {
            line(text, "  {:<7}{:>8.1f} ms{:>8.1f} ms{:>11.0f} triangles{:>6.1f} px",
                 word(flight, "name"), number(flight, "median_ms"), number(flight, "p95_ms"),
                 number(flight, "triangles_median"), number(flight, "error_median_px"));
        }
    }
    if (found.at("median_ratio").is_number()) {
        line(text, "median × {:.2f}, p95 × {:.2f}", number(found, "median_ratio"),
             number(found, "p95_ratio"));
    }
    return text;
}

} // namespace

std::string terrainReport(std::string_view measurement, const BenchJson& found)
{
    return measurement == "prepare"    ? preparing(found)
           : measurement == "picture"  ? picture(found)
           : measurement == "open"     ? pictures(found)
           : measurement == "session"  ? session(found)
           : measurement == "swipes"   ? swipes(found)
           : measurement == "identity" ? identity(found)
           : measurement == "growth"   ? growth(found)
           : measurement == "remote"   ? remote(found)
                                       : frames(found);
}

std::string growthPlot(const BenchJson& found, const std::string& note)
{
    Plot plot{.title = "Cost of a contact update against the size of the map",
              .note = note,
              .x_label = "triangles",
              .y_label = "µs per update",
              .y_floor = 0.01,
              .floor_label = "less",
              .panels = {}};
    const BenchJson& speeds = found.at("cells_per_update");
    for (std::size_t s = 0; s < speeds.size(); ++s) {
        PlotPanel panel{.title = fmt::format("{} cells per update", speeds[s].get<double>()),
                        .series = {}};
        for (const char* storage : {"held", "tiles"}) {
            PlotSeries series{.name = storage, .points = {}, .first_label = "", .last_label = ""};
            for (const BenchJson& size : found.at("sizes")) {
                if (size.at("storage") == storage) {
                    const double us = size.at("ns_per_update")[s].get<double>() / 1e3;
                    series.points.push_back(
                        {static_cast<double>(count(size, "triangle_count")), us});
                    (series.points.size() == 1 ? series.first_label : series.last_label) =
                        fmt::format("{:.2f}", us);
                }
            }
            panel.series.push_back(std::move(series));
        }
        plot.panels.push_back(std::move(panel));
    }
    return asSvg(plot);
}

} // namespace marsview
