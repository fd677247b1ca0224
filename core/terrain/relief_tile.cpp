// Notation. A texel covers the samples [x0, x1) × [y0, y1). Along a row of samples, the slopes
// between x0 - 1/2 and x1 - 1/2 sum up to the difference of the heights there, each the mean of its
// two neighbors. So only the samples on either side of texel borders count along a row, and
// likewise along a column; beyond the map and in voids the next valid sample replaces them. For the
// mean elevation all samples count. Where the sides of a map meet, its rows continue with the
// samples of the other side, for as many texels as a tile's border has.

#include "core/terrain/relief_tile.h"

#include "core/base/check.h"
#include "core/raster/raster_file.h"
#include "core/terrain/sample_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace marsview {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

double middleOf(const Heightfield& heightfield)
{
    const HeightRange range = heightfield.range().value_or(HeightRange{});
    return (range.minimum_m + range.maximum_m) / 2.0;
}

// The height at a border between two samples, and its position, in samples after the border.
struct BorderHeight {
    float height = kNan;
    float position = 0.0F;
};

BorderHeight between(float before, float after)
{
    if (std::isnan(before)) {
        return {after, 0.5F};
    }
    return std::isnan(after) ? BorderHeight{before, -0.5F}
                             : BorderHeight{(before + after) * 0.5F, 0.0F};
}

// Sums over a texel.
struct Sums {
    float per_column = 0.0F; // slopes, meters per sample
    float column_count = 0.0F;
    float per_row = 0.0F;
    float row_count = 0.0F;
    float sample_count = 0.0F;
    double height_m = 0.0; // over the base
};

// The texels of a tile that overlap the map, along one axis.
struct TexelSpan {
    std::size_t begin = 0;
    std::size_t end = 0;
};

TexelSpan texelsOnMap(std::size_t tile, std::size_t level, std::size_t samples, MapSides sides)
{
    const std::size_t step = std::size_t{1} << level;
    const std::size_t count = (samples + step - 1) / step; // texels of the whole map
    const std::size_t first = tile * ReliefTile::kTexels;  // of them, without the border
    const std::size_t border = ReliefTile::kBorder;
    MARSVIEW_CHECK(first < count);
    const bool meet = sides == MapSides::Meet;
    return {.begin = first >= border || meet ? 0 : border,
            .end = std::min(ReliefTile::kSide, count - first + border + (meet ? border : 0))};
}

// The end of the samples that tiles of that level cover along a row.
std::size_t rowEnd(std::size_t columns, std::size_t level, MapSides sides)
{
    return sides == MapSides::Meet ? columns + (ReliefTile::kBorder << level) : columns;
}

// Texels outside the map copy the nearest one on it, so that filters do not fade out there.
void extend(ReliefTile::Level& level, const TexelSpan& columns, const TexelSpan& rows)
{
    for (std::size_t j = 0; j < level.side; ++j) {
        const std::size_t row = std::clamp(j, rows.begin, rows.end - 1);
        for (std::size_t i = 0; i < level.side; ++i) {
            const std::size_t column = std::clamp(i, columns.begin, columns.end - 1);
            const std::size_t to = j * level.side + i;
            const std::size_t from = row * level.side + column;
            level.texels[to] = level.texels[from];
        }
    }
}

// Four at a time, for vector instructions.
float sumOf(const float* values, std::ptrdiff_t count)
{
    std::array<float, 4> sums{};
    std::ptrdiff_t i = 0;
    for (; i + 4 <= count; i += 4) {
        for (std::size_t k = 0; k < 4; ++k) {
            sums[k] += values[i + static_cast<std::ptrdiff_t>(k)];
        }
    }
    for (; i < count; ++i) {
        sums[0] += values[i];
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

// Rows of samples in memory.
class HeldRows {
public:
    explicit HeldRows(const Heightfield& heightfield)
        : heightfield_(heightfield)
        , base_m_(middleOf(heightfield))
    {}

    std::size_t columns() const { return heightfield_.columns(); }
    std::size_t rows() const { return heightfield_.rows(); }
    bool hasVoids() const { return heightfield_.hasVoids(); }
    double baseMeters() const { return base_m_; }
    void read(std::size_t first_column, std::size_t row, std::span<float> heights) const
    {
        readHeights(heightfield_, first_column, row, base_m_, heights);
    }

private:
    const Heightfield& heightfield_;
    double base_m_;
};

// A window of one level of a tiled map, assembled from its tiles.
class WindowRows {
public:
    // The level's samples [first_column, first_column + columns) × likewise. A window that reaches
    // beyond the last column continues with the first one.
    static Result<WindowRows>
    load(const Heightfield& heightfield, TileKind kind, std::size_t level, const GridWindow& window)
    {
        const TileLayout& layout = heightfield.tiles()->layout();
        WindowRows rows;
        rows.columns_ = layout.columnsAt(kind, level);
        rows.rows_ = layout.rowsAt(kind, level);
        rows.window_ = window;
        // Of the map, not of the window: every tile of a map with voids has a void mask.
        rows.has_voids_ = layout.has_voids;
        rows.heights_.resize(window.columns * window.rows);
        rows.base_m_ = middleOf(heightfield);
        const std::size_t end = window.column + window.columns;
        for (std::size_t first = 0; first < end; first += rows.columns_) {
            if (const Status loaded = rows.loadTurn(heightfield, kind, level, first); !loaded) {
                return loaded.error();
            }
        }
        return rows;
    }

    std::size_t columns() const { return columns_; }
    std::size_t rows() const { return rows_; }
    bool hasVoids() const { return has_voids_; }
    double baseMeters() const { return base_m_; }
    void read(std::size_t first_column, std::size_t row, std::span<float> heights) const
    {
        const std::size_t turn = first_column < window_.column ? columns_ : 0;
        const float* from = heights_.data() + (row - window_.row) * window_.columns +
                            (first_column + turn - window_.column);
        std::copy_n(from, heights.size(), heights.begin());
    }

private:
    // The part of the window on the map whose first column is `first` in columns of the window.
    Status
    loadTurn(const Heightfield& heightfield, TileKind kind, std::size_t level, std::size_t first)
    {
        const TiledRaster& raster = heightfield.tiles()->raster();
        const ElevationScale scale = heightfield.scale();
        const std::size_t left = std::max(window_.column, first) - first;
        const std::size_t right = std::min(window_.column + window_.columns - first, columns_);
        if (left >= right) {
            return Done{};
        }
        for (std::size_t tile_row = window_.row / kTileSide;
             tile_row <= (window_.row + window_.rows - 1) / kTileSide; ++tile_row) {
            for (std::size_t tile_column = left / kTileSide; tile_column <= (right - 1) / kTileSide;
                 ++tile_column) {
                const auto tile = raster.get({.kind = kind,
                                              .level = static_cast<std::uint8_t>(level),
                                              .column = static_cast<std::uint32_t>(tile_column),
                                              .row = static_cast<std::uint32_t>(tile_row)});
                if (!tile) {
                    return tile.error();
                }
                copy((*tile)->samples, first + tile_column * kTileSide, tile_row * kTileSide,
                     scale);
            }
        }
        return Done{};
    }

    // The part of the window that a tile covers, whose first sample is (tile_column, tile_row).
    void copy(const SampleGrid& samples,
              std::size_t tile_column,
              std::size_t tile_row,
              const ElevationScale& scale)
    {
        has_voids_ = has_voids_ || samples.hasVoids();
        const std::size_t left = std::max(tile_column, window_.column);
        const std::size_t right =
            std::min(tile_column + samples.columns(), window_.column + window_.columns);
        const std::size_t upper = std::max(tile_row, window_.row);
        const std::size_t lower = std::min(tile_row + samples.rows(), window_.row + window_.rows);
        samples.visit([&](auto view) {
            for (std::size_t row = upper; row < lower; ++row) {
                float* to = heights_.data() + (row - window_.row) * window_.columns;
                for (std::size_t column = left; column < right; ++column) {
                    const double raw =
                        static_cast<double>(view(column - tile_column, row - tile_row));
                    to[column - window_.column] =
                        samples.isVoid(column - tile_column, row - tile_row)
                            ? kNan
                            : static_cast<float>(scale.height(raw) - base_m_);
                }
            }
        });
    }

    std::size_t columns_ = 0; // of the level
    std::size_t rows_ = 0;
    GridWindow window_;
    bool has_voids_ = false;
    double base_m_ = 0.0;
    std::vector<float> heights_; // over the base; NaN for voids
};

template <typename Rows>
class TileMaker {
public:
    TileMaker(const Rows& source, const ReliefTileId& id, MapSides sides)
        : source_(source)
        , sides_(sides)
        , step_(static_cast<std::ptrdiff_t>(std::size_t{1} << id.level))
        , first_column_(firstSample(id.column))
        , first_row_(firstSample(id.row))
        , columns_(static_cast<std::ptrdiff_t>(source.columns()))
        , row_end_(static_cast<std::ptrdiff_t>(rowEnd(source.columns(), id.level, sides)))
        , rows_(static_cast<std::ptrdiff_t>(source.rows()))
        , row_(static_cast<std::size_t>(kSideSamples * step_ + 2), kNan)
        , row_before_(row_)
        , border_above_(row_.size())
        , border_below_(row_.size())
    {}

    // Calls use(row of texels, sums) for all rows that touch the map.
    template <typename Use>
    void run(const Use& use)
    {
        std::vector<Sums> sums(ReliefTile::kSide);
        const auto side = static_cast<std::ptrdiff_t>(ReliefTile::kSide);
        for (std::ptrdiff_t j = 0; j < side; ++j) {
            const std::ptrdiff_t y0 = first_row_ + j * step_;
            if (y0 + step_ <= 0 || y0 >= rows_) {
                is_border_known_ = false;
                continue;
            }
            std::fill(sums.begin(), sums.end(), Sums{});
            sumAlongRows(y0, sums);
            sumAlongColumns(sums);
            use(static_cast<std::size_t>(j), sums);
        }
    }

private:
    static constexpr auto kSideSamples = static_cast<std::ptrdiff_t>(ReliefTile::kSide);

    std::ptrdiff_t firstSample(std::size_t tile) const
    {
        return (static_cast<std::ptrdiff_t>(tile * ReliefTile::kTexels) -
                static_cast<std::ptrdiff_t>(ReliefTile::kBorder)) *
               step_;
    }

    // The samples of a row from the one before the tile to the one after it; NaN outside the map.
    void readRow(std::ptrdiff_t row, std::vector<float>& heights) const
    {
        const bool meet = sides_ == MapSides::Meet;
        std::ptrdiff_t begin =
            meet ? first_column_ - 1 : std::max<std::ptrdiff_t>(first_column_ - 1, 0);
        const std::ptrdiff_t end =
            std::min(first_column_ + kSideSamples * step_, row_end_ - (meet ? 0 : 1)) + 1;
        if (row < 0 || row >= rows_ || begin >= end) {
            std::fill(heights.begin(), heights.end(), kNan);
            return;
        }
        while (begin < end) {
            const std::ptrdiff_t column = (begin % columns_ + columns_) % columns_;
            const std::ptrdiff_t count = std::min(end - begin, columns_ - column);
            source_.read(
                static_cast<std::size_t>(column), static_cast<std::size_t>(row),
                std::span(heights).subspan(static_cast<std::size_t>(begin - (first_column_ - 1)),
                                           static_cast<std::size_t>(count)));
            begin += count;
        }
    }

    void sumAlongRows(std::ptrdiff_t y0, std::vector<Sums>& sums)
    {
        if (!is_border_known_) {
            readRow(y0 - 1, row_before_);
        }
        const std::ptrdiff_t y1 = std::min(y0 + step_, rows_);
        for (std::ptrdiff_t y = std::max<std::ptrdiff_t>(y0, 0); y < y1; ++y) {
            readRow(y, row_);
            if (y == y0 && !is_border_known_) {
                setBorder(row_before_, row_, border_above_);
            } else if (y == 0) {
                setBorder(std::vector<float>(row_.size(), kNan), row_, border_above_);
            }
            for (std::size_t i = 0; i < sums.size(); ++i) {
                const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(i) * step_;
                // The map's last texel may be narrower.
                const std::ptrdiff_t width = std::min(step_, row_end_ - first_column_ - first);
                if (width > 0) {
                    addRow(row_.data() + first + 1, width, sums[i]);
                }
            }
            std::swap(row_, row_before_);
        }
        // row_before_ is the texels' last row now.
        readRow(y1, row_);
        setBorder(row_before_, row_, border_below_);
        row_height_ = static_cast<float>(y1 - std::max<std::ptrdiff_t>(y0, 0));
    }

    // One row of samples of one texel; samples[-1] and samples[width] belong to its neighbors.
    void addRow(const float* samples, std::ptrdiff_t width, Sums& sums) const
    {
        const BorderHeight left = between(samples[-1], samples[0]);
        const BorderHeight right = between(samples[width - 1], samples[width]);
        const float length = static_cast<float>(width) + right.position - left.position;
        const float slope = (right.height - left.height) / length;
        if (length > 0.0F && !std::isnan(slope)) {
            sums.per_column += slope;
            sums.column_count += 1.0F;
        }
        if (!source_.hasVoids()) {
            sums.height_m += static_cast<double>(sumOf(samples, width));
            sums.sample_count += static_cast<float>(width);
            return;
        }
        for (std::ptrdiff_t i = 0; i < width; ++i) {
            if (!std::isnan(samples[i])) {
                sums.height_m += static_cast<double>(samples[i]);
                sums.sample_count += 1.0F;
            }
        }
    }

    static void setBorder(const std::vector<float>& before,
                          const std::vector<float>& after,
                          std::vector<BorderHeight>& border)
    {
        for (std::size_t i = 0; i < border.size(); ++i) {
            border[i] = between(before[i], after[i]);
        }
    }

    void sumAlongColumns(std::vector<Sums>& sums)
    {
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const std::size_t begin = i * static_cast<std::size_t>(step_) + 1;
            for (std::size_t x = begin; x < begin + static_cast<std::size_t>(step_); ++x) {
                const BorderHeight& above = border_above_[x];
                const BorderHeight& below = border_below_[x];
                const float length = row_height_ + below.position - above.position;
                const float slope = (below.height - above.height) / length;
                if (length > 0.0F && !std::isnan(slope)) {
                    sums[i].per_row += slope;
                    sums[i].row_count += 1.0F;
                }
            }
        }
        std::swap(border_above_, border_below_);
        is_border_known_ = true;
    }

    const Rows& source_;
    MapSides sides_;
    std::ptrdiff_t step_;
    std::ptrdiff_t first_column_;
    std::ptrdiff_t first_row_;
    std::ptrdiff_t columns_;
    std::ptrdiff_t row_end_; // beyond the last column where sides meet
    std::ptrdiff_t rows_;
    std::vector<float> row_; // entry 0 is the sample before the tile's first
    std::vector<float> row_before_;
    std::vector<BorderHeight> border_above_;
    std::vector<BorderHeight> border_below_;
    bool is_border_known_ = false; // border_above_ is that of the next row of texels
    float row_height_ = 1.0F;
};

std::int16_t snorm16(float share)
{
    return static_cast<std::int16_t>(std::lrintf(std::clamp(share, -1.0F, 1.0F) * 32767.0F));
}

// Computes the level with half as many texels per side.
void halve(const ReliefTile::Level& finer, ReliefTile::Level& level)
{
    level.side = finer.side / 2;
    level.texels.resize(level.side * level.side);
    for (std::size_t j = 0; j < level.side; ++j) {
        for (std::size_t i = 0; i < level.side; ++i) {
            const ReliefTexel* above = finer.texels.data() + 2 * j * finer.side + 2 * i;
            const ReliefTexel* below = above + finer.side;
            const auto mean = [&](std::int16_t ReliefTexel::*value) {
                const int sum =
                    above[0].*value + above[1].*value + below[0].*value + below[1].*value;
                return static_cast<std::int16_t>((sum + 2) >> 2);
            };
            level.texels[j * level.side + i] = {.east = mean(&ReliefTexel::east),
                                                .north = mean(&ReliefTexel::north),
                                                .height = mean(&ReliefTexel::height),
                                                .share = mean(&ReliefTexel::share)};
        }
    }
}

// Mean elevations over the base of a tile's texels, and the corresponding texels.
class TexelHeights {
public:
    explicit TexelHeights(std::size_t count)
        : heights_m_(count)
    {}

    void set(std::size_t texel, float height_m)
    {
        heights_m_[texel] = height_m;
        low_m_ = std::min(low_m_, height_m);
        high_m_ = std::max(high_m_, height_m);
    }

    // Scales them to 16 bits, weighted by the texels' shares.
    void writeTo(ReliefTile& tile, double base_m) const
    {
        if (low_m_ < high_m_) {
            const double half_m =
                (static_cast<double>(high_m_) - static_cast<double>(low_m_)) / 2.0;
            tile.height_middle_m = base_m + static_cast<double>(low_m_) + half_m;
            tile.height_reach_m = half_m;
        } else {
            tile.height_middle_m = base_m + (low_m_ > high_m_ ? 0.0 : static_cast<double>(low_m_));
        }
        const auto middle_m = static_cast<float>(tile.height_middle_m - base_m);
        const auto reach_m = static_cast<float>(tile.height_reach_m);
        ReliefTile::Level& finest = tile.levels.front();
        for (std::size_t i = 0; i < heights_m_.size(); ++i) {
            ReliefTexel& texel = finest.texels[i];
            texel.height = snorm16((heights_m_[i] - middle_m) / reach_m * (texel.share / 32767.0F));
        }
    }

private:
    std::vector<float> heights_m_;
    float low_m_ = std::numeric_limits<float>::infinity();
    float high_m_ = -std::numeric_limits<float>::infinity();
};

template <typename Rows>
ReliefTile tileFrom(const Rows& source,
                    const SceneFrame& frame,
                    const ReliefTileId& id,
                    double slope_max,
                    MapSides sides)
{
    MARSVIEW_CHECK(slope_max > 0.0);
    // Gradients transform by the inverse transpose of the frame's linear part.
    const double determinant =
        frame.east_per_column * frame.north_per_row - frame.east_per_row * frame.north_per_column;
    const auto east_of_column = static_cast<float>(frame.north_per_row / determinant / slope_max);
    const auto east_of_row = static_cast<float>(-frame.north_per_column / determinant / slope_max);
    const auto north_of_column = static_cast<float>(-frame.east_per_row / determinant / slope_max);
    const auto north_of_row = static_cast<float>(frame.east_per_column / determinant / slope_max);

    const bool has_voids = source.hasVoids();
    const TexelSpan columns = texelsOnMap(id.column, id.level, source.columns(), sides);
    const TexelSpan rows = texelsOnMap(id.row, id.level, source.rows(), MapSides::End);
    const std::size_t row_end = rowEnd(source.columns(), id.level, sides);
    // The number of a texel's samples on the map: fewer at its last column and row.
    const auto samples_of = [&](std::size_t texel, std::size_t tile, std::size_t samples) {
        const std::size_t step = std::size_t{1} << id.level;
        const std::size_t first = (tile * ReliefTile::kTexels + texel - ReliefTile::kBorder) * step;
        return static_cast<float>(std::min(step, samples - first));
    };
    ReliefTile tile;
    ReliefTile::Level& finest = tile.levels.front();
    finest.side = ReliefTile::kSide;
    finest.texels.resize(finest.side * finest.side);
    TexelHeights heights(finest.texels.size());
    TileMaker(source, id, sides).run([&](std::size_t row, const std::vector<Sums>& sums) {
        const float row_samples = samples_of(row, id.row, source.rows());
        for (std::size_t column = columns.begin; column < columns.end; ++column) {
            const Sums& texel = sums[column];
            const std::size_t at = row * finest.side + column;
            const float share =
                has_voids
                    ? texel.sample_count / (row_samples * samples_of(column, id.column, row_end))
                    : 1.0F;
            const float weight_c = texel.column_count > 0.0F ? share / texel.column_count : 0.0F;
            const float weight_r = texel.row_count > 0.0F ? share / texel.row_count : 0.0F;
            const float per_column = texel.per_column * weight_c;
            const float per_row = texel.per_row * weight_r;
            finest.texels[at] = {
                .east = snorm16(per_column * east_of_column + per_row * east_of_row),
                .north = snorm16(per_column * north_of_column + per_row * north_of_row),
                .height = 0,
                .share = snorm16(share)};
            if (texel.sample_count > 0.0F) {
                heights.set(at, static_cast<float>(texel.height_m /
                                                   static_cast<double>(texel.sample_count)));
            }
        }
    });
    heights.writeTo(tile, source.baseMeters());
    extend(finest, columns, rows);
    for (std::size_t level = 1; level < ReliefTile::kLevels; ++level) {
        halve(tile.levels[level - 1], tile.levels[level]);
    }
    return tile;
}

// The existing samples for a tile: its own and one more on all sides.
GridWindow windowOf(const ReliefTileId& id, std::size_t columns, std::size_t rows, MapSides sides)
{
    const std::size_t step = std::size_t{1} << id.level;
    const auto span = [step](std::size_t tile, std::size_t count) {
        const std::size_t border = ReliefTile::kBorder * step + 1;
        const std::size_t first = tile * ReliefTile::kTexels * step;
        const std::size_t begin = first > border ? first - border : 0;
        return std::pair(begin,
                         std::min(first + ReliefTile::kTexels * step + border, count) - begin);
    };
    const auto [row, row_count] = span(id.row, rows);
    if (sides == MapSides::End) {
        const auto [column, column_count] = span(id.column, columns);
        return {column, row, column_count, row_count};
    }
    const std::size_t border = ReliefTile::kBorder * step + 1;
    const std::size_t first = id.column * ReliefTile::kTexels * step;
    const std::size_t end =
        std::min(first + ReliefTile::kTexels * step + border, rowEnd(columns, id.level, sides) + 1);
    const std::size_t count = end + border - first;
    return count < columns
               ? GridWindow{(first + columns - border % columns) % columns, row, count, row_count}
               : GridWindow{0, row, columns, row_count};
}

} // namespace

ReliefTile makeReliefTile(const Heightfield& heightfield,
                          const SceneFrame& frame,
                          const ReliefTileId& id,
                          double slope_max,
                          MapSides sides)
{
    return tileFrom(HeldRows(heightfield), frame, id, slope_max, sides);
}

// Sixteen or four means replace the samples of a texel: detail within a mean cancels in the texel's
// slope, except for half a mean at either end.
Result<ReliefTile> loadReliefTile(const Heightfield& heightfield,
                                  const SceneFrame& frame,
                                  const ReliefTileId& id,
                                  double slope_max,
                                  MapSides sides)
{
    if (!heightfield.isTiled()) {
        return makeReliefTile(heightfield, frame, id, slope_max, sides);
    }
    const TileLayout& layout = heightfield.tiles()->layout();
    const std::size_t finer = layout.is_remote ? 1 : 2; // levels
    const std::size_t level = std::min(std::max(id.level, finer) - finer, layout.mean_levels);
    const TileKind kind = level == 0 ? TileKind::Samples : TileKind::Means;
    const ReliefTileId within{.level = id.level - level, .column = id.column, .row = id.row};
    const Result<WindowRows> rows = WindowRows::load(
        heightfield, kind, level,
        windowOf(within, layout.columnsAt(kind, level), layout.rowsAt(kind, level), sides));
    if (!rows) {
        return rows.error();
    }
    // Slopes do not depend on the origin of the frame.
    const auto step = static_cast<double>(std::size_t{1} << level);
    SceneFrame coarse = frame;
    coarse.east_per_column *= step;
    coarse.east_per_row *= step;
    coarse.north_per_column *= step;
    coarse.north_per_row *= step;
    return tileFrom(*rows, coarse, within, slope_max, sides);
}

} // namespace marsview
