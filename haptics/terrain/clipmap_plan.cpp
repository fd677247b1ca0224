#include "haptics/terrain/clipmap_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_map>

namespace marsview {
namespace {

// The fraction of the loaders' throughput for the corridor; the rest is a reserve for unforeseen
// motion.
constexpr double kShareOfLoaders = 0.7;
// Width in tiles across the corridor, for turns of the hand.
constexpr double kCorridorTiles = 3.0;
constexpr int kPathPieces = 24;
// Lower limit of the time until the hand reaches a tile other than its own, in seconds.
constexpr double kBeside = 1e-3;
// From this level on, all tiles that a window covers are requested: LevelFile keeps those levels.
constexpr std::size_t kCheapLevel = 3;

double tileWidth(std::size_t level)
{
    return static_cast<double>(kTileSide << level);
}

std::size_t finestLevelInTime(const TileLayout& layout,
                              const HandMotion& motion,
                              const WindowPlanOptions& options)
{
    const double samples_per_s = std::abs(motion.columns_per_s) + std::abs(motion.rows_per_s);
    std::size_t level = 0;
    while (level < layout.topLevel() && kCorridorTiles * samples_per_s / tileWidth(level) >
                                            kShareOfLoaders * options.tiles_per_s) {
        ++level;
    }
    return level;
}

// The extent of a window around a center, along one axis.
struct Span {
    std::int64_t first;
    std::int64_t end;
};

std::int64_t onTurn(std::int64_t tile, std::size_t tiles)
{
    const auto count = static_cast<std::int64_t>(tiles);
    return (tile % count + count) % count;
}

struct Urgency {
    double seconds;       // until the hand is near
    std::size_t fineness; // coarse first
    double distance;      // from the hand's position at that time, in tiles
    auto key() const { return std::tie(seconds, fineness, distance); }
};

} // namespace

ClipmapPlan
planWindow(const TileLayout& layout, const HandMotion& motion, const WindowPlanOptions& options)
{
    ClipmapPlan plan;
    const std::size_t top = layout.topLevel();
    plan.finest_level = finestLevelInTime(layout, motion, options);
    const auto inside = [](double at, std::size_t count) {
        return at >= 0.0 ? std::min(at, static_cast<double>(count - 1)) : 0.0; // also for NaN
    };
    // Around the body a column may lie beyond the ends, on the turn of the hand.
    const auto hand_at = [&](double seconds) {
        const double column = motion.at.column + seconds * motion.columns_per_s;
        const bool is_around = options.sides.wraps && std::isfinite(column);
        return GridPoint{is_around ? column : inside(column, layout.columns),
                         inside(motion.at.row + seconds * motion.rows_per_s, layout.rows)};
    };
    // Near a pole many columns are as wide as a row.
    const double column_share = std::clamp(motion.column_share, 0.0, 1.0);
    const GridPoint hand = hand_at(0.0);
    std::unordered_map<TileId, Urgency, TileIdHash> wanted;
    for (std::size_t k = 0; k <= top; ++k) {
        const double width = tileWidth(k);
        const std::size_t side = k == 0 ? options.sides.finest : options.sides.coarser;
        // The tiles around the hand stay covered.
        const double lead = std::max(static_cast<double>(side) / 2.0 - 2.0, 0.0) * width;
        const GridPoint ahead = hand_at(0.5 * options.lookahead_s);
        const GridPoint center{hand.column + std::clamp(ahead.column - hand.column, -lead, lead),
                               hand.row + std::clamp(ahead.row - hand.row, -lead, lead)};
        plan.centers.push_back(center);
        if (k < plan.finest_level || k == top) {
            continue;
        }
        const auto span = [&](double at, std::size_t tiles) {
            const std::size_t first = Clipmap::firstTile(at, k, tiles, std::min(side, tiles));
            return Span{static_cast<std::int64_t>(first),
                        static_cast<std::int64_t>(first + std::min(side, tiles))};
        };
        const std::size_t tile_columns = layout.tileColumns(TileKind::Samples, k);
        Span columns = span(center.column, tile_columns);
        if (options.sides.wraps && side < tile_columns) {
            const std::int64_t first = Clipmap::firstTileAround(center.column, k, side);
            columns = {first, first + static_cast<std::int64_t>(side)};
        }
        const Span rows = span(center.row, layout.tileRows(TileKind::Samples, k));
        for (std::int64_t row = rows.first; row < rows.end; ++row) {
            for (std::int64_t column = columns.first; column < columns.end; ++column) {
                // Distance from the hand's path in tiles; 0 inside.
                const auto beside = [&](double seconds) {
                    const GridPoint at = hand_at(seconds);
                    const auto along = [&](double position, std::int64_t tile) {
                        const double from = position / width - static_cast<double>(tile);
                        return std::max({-from, from - 1.0, 0.0});
                    };
                    return std::max(column_share * along(at.column, column), along(at.row, row));
                };
                const double distance = beside(0.0);
                double seconds = 2.0 * options.lookahead_s;
                if (distance == 0.0) {
                    seconds = 0.0;
                } else if (distance <= 1.0) {
                    seconds = options.lookahead_s;
                }
                for (int i = 0; distance > 0.0 && i <= kPathPieces; ++i) {
                    const double t = options.lookahead_s * i / kPathPieces;
                    if (beside(t) <= 0.5) {
                        seconds = std::clamp(t, kBeside, seconds);
                        break;
                    }
                }
                if (seconds <= options.lookahead_s || k >= kCheapLevel) {
                    const TileId id{TileKind::Samples, static_cast<std::uint8_t>(k),
                                    static_cast<std::uint32_t>(onTurn(column, tile_columns)),
                                    static_cast<std::uint32_t>(row)};
                    wanted.emplace(id, Urgency{seconds, top - k, distance});
                }
            }
        }
    }
    for (const auto& [id, urgency] : wanted) {
        plan.tiles.push_back(id);
    }
    std::sort(plan.tiles.begin(), plan.tiles.end(), [&](const TileId& a, const TileId& b) {
        const auto place = [](const TileId& id) { return std::tie(id.level, id.row, id.column); };
        const Urgency& u = wanted.at(a);
        const Urgency& v = wanted.at(b);
        return u.key() != v.key() ? u.key() < v.key() : place(a) < place(b);
    });
    return plan;
}

} // namespace marsview
