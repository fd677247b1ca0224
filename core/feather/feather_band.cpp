#include "core/feather/feather_band.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/feather/grid_ends.h"
#include "core/feather/near_marks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kSide = FeatherBand::kSide;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
static_assert(kSide == kTileSide); // a square is a tile
static_assert(kSide * kSide - 1 <= std::numeric_limits<std::uint16_t>::max());

// The samples of a map for one thread. Errors of tiles are noted.
class SampleReader {
public:
    explicit SampleReader(const Heightfield& heightfield)
        : heightfield_(heightfield)
    {}

    // In meters; NaN for voids.
    double at(std::size_t column, std::size_t row)
    {
        if (!heightfield_.isTiled()) {
            return heightfield_.sample(column, row);
        }
        const Tile* tile = tileAt(column / kTileSide, row / kTileSide);
        if (tile == nullptr || tile->samples.isVoid(column % kTileSide, row % kTileSide)) {
            return static_cast<double>(kNaN);
        }
        return heightfield_.scale().height(tile->samples.raw(column % kTileSide, row % kTileSide));
    }
    const std::optional<Error>& error() const noexcept { return error_; }

private:
    const Tile* tileAt(std::size_t column, std::size_t row)
    {
        const TileId id{.kind = TileKind::Samples,
                        .level = 0,
                        .column = static_cast<std::uint32_t>(column),
                        .row = static_cast<std::uint32_t>(row)};
        const auto known = tiles_.find(id);
        if (known != tiles_.end()) {
            return known->second.get();
        }
        constexpr std::size_t kTilesMax = 16; // a square and those around it
        if (tiles_.size() >= kTilesMax) {
            tiles_.clear();
        }
        auto tile = heightfield_.tiles()->raster().get(id);
        if (!tile) {
            error_ = tile.error();
        }
        return tiles_.emplace(id, tile ? *tile : nullptr).first->second.get();
    }

    const Heightfield& heightfield_;
    std::unordered_map<TileId, std::shared_ptr<const Tile>, TileIdHash> tiles_;
    std::optional<Error> error_;
};

// A sample near an end.
struct Found {
    std::uint16_t place = 0;
    float share = 0.0F; // of its own height
    float own_m = 0.0F;
    float below_m = 0.0F; // NaN: no map lies below
};
using FoundSquares = std::unordered_map<std::size_t, std::vector<Found>>;

// 0 at an end, 1 from `cells` cells on, and smooth.
double shareAt(std::uint32_t squared_distance, std::size_t cells)
{
    const double t = std::sqrt(static_cast<double>(squared_distance)) / static_cast<double>(cells);
    return t * t * (3.0 - 2.0 * t);
}

class BandBuilder {
public:
    BandBuilder(const BodyTerrain& map,
                std::span<const BodyTerrain> below,
                std::size_t cells,
                JobMonitor& monitor)
        : map_(*map.map())
        , below_(below)
        , cells_(cells)
        , ends_(gridEnds(map_.georeference()))
        , square_columns_((ends_.columns + kSide - 1) / kSide)
        , square_rows_((ends_.rows + kSide - 1) / kSide)
        , monitor_(monitor)
    {}

    Status run()
    {
        eachSquare(0.0, 0.9, [this](std::size_t square) { look(square); });
        if (!stopped() && has_places_without_ && has_places_with_) {
            eachSquare(0.9, 1.0, [this](std::size_t square) { fadeOut(square); });
        }
        if (error_) {
            return *error_;
        }
        if (monitor_.isCanceled()) {
            return Error{ErrorCode::Canceled, "blending was canceled"};
        }
        return Done{};
    }

    std::size_t squareColumns() const noexcept { return square_columns_; }
    const FoundSquares& found() const noexcept { return found_; }

private:
    // A part of the grid; in a map around its body, columns beyond the last or first one, too.
    struct Area {
        std::ptrdiff_t column = 0;
        std::ptrdiff_t row = 0;
        std::size_t columns = 0;
        std::size_t rows = 0;

        Area widened(std::size_t by) const
        {
            return {column - static_cast<std::ptrdiff_t>(by), row - static_cast<std::ptrdiff_t>(by),
                    columns + 2 * by, rows + 2 * by};
        }
    };
    enum class Sample : std::uint8_t { Outside, Valid, Void };

    bool stopped() const { return has_failed_ || monitor_.isCanceled(); }

    void fail(const Error& error)
    {
        const std::scoped_lock lock(mutex_);
        error_ = error_.value_or(error);
        has_failed_ = true;
    }

    template <typename F>
    void eachSquare(double begin, double end, F&& work)
    {
        monitor_.beginStage(begin, end);
        const std::size_t count = square_columns_ * square_rows_;
        std::atomic<std::size_t> done{0};
        parallelRanges(count, 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t square = first; square < last && !stopped(); ++square) {
                work(square);
                monitor_.report(static_cast<double>(++done) / static_cast<double>(count));
            }
        });
    }

    Area areaOf(std::size_t square) const
    {
        const std::size_t column = square % square_columns_ * kSide;
        const std::size_t row = square / square_columns_ * kSide;
        return {static_cast<std::ptrdiff_t>(column), static_cast<std::ptrdiff_t>(row),
                std::min(kSide, ends_.columns - column), std::min(kSide, ends_.rows - row)};
    }

    // The column of the grid, or nothing.
    std::optional<std::size_t> columnAt(std::ptrdiff_t column) const
    {
        if (ends_.period > 0) {
            const auto period = static_cast<std::ptrdiff_t>(ends_.period);
            return static_cast<std::size_t>((column % period + period) % period);
        }
        return column >= 0 && column < static_cast<std::ptrdiff_t>(ends_.columns)
                   ? std::optional(static_cast<std::size_t>(column))
                   : std::nullopt;
    }
    std::optional<std::size_t> rowAt(std::ptrdiff_t row) const
    {
        return row >= 0 && row < static_cast<std::ptrdiff_t>(ends_.rows)
                   ? std::optional(static_cast<std::size_t>(row))
                   : std::nullopt;
    }

    // Whether some block of samples there is not all valid.
    bool hasVoidsIn(const Area& area) const
    {
        if (!map_.heightfield().hasVoids()) {
            return false;
        }
        const BlockMeans& means = map_.analysis()->means;
        const auto side = static_cast<std::ptrdiff_t>(means.blockSamples());
        const auto last_column = area.column + static_cast<std::ptrdiff_t>(area.columns) - 1;
        const auto last_row = area.row + static_cast<std::ptrdiff_t>(area.rows) - 1;
        for (std::ptrdiff_t row = area.row;; row = std::min(row + side, last_row)) {
            for (std::ptrdiff_t column = area.column;;
                 column = std::min(column + side, last_column)) {
                const auto c = columnAt(column);
                const auto r = rowAt(row);
                if (c && r &&
                    means.share(0, *c / means.blockSamples(), *r / means.blockSamples()) < 1.0F) {
                    return true;
                }
                if (column == last_column) {
                    break;
                }
            }
            if (row == last_row) {
                return false;
            }
        }
    }

    bool isNearBorder(const Area& area) const
    {
        const auto is_near = [&](std::ptrdiff_t at, std::ptrdiff_t first, std::size_t count) {
            return at >= first && at < first + static_cast<std::ptrdiff_t>(count);
        };
        const auto has_column = [&](std::size_t column) {
            return is_near(static_cast<std::ptrdiff_t>(column), area.column, area.columns);
        };
        const auto has_row = [&](std::size_t row) {
            return is_near(static_cast<std::ptrdiff_t>(row), area.row, area.rows);
        };
        return (ends_.period == 0 && (has_column(0) || has_column(ends_.columns - 1))) ||
               (ends_.first_row && has_row(*ends_.first_row)) ||
               (ends_.last_row && has_row(*ends_.last_row));
    }

    std::vector<Sample> samplesIn(const Area& area, bool has_voids, SampleReader& reader) const
    {
        std::vector<Sample> samples(area.columns * area.rows, Sample::Outside);
        for (std::size_t j = 0; j < area.rows; ++j) {
            const auto row = rowAt(area.row + static_cast<std::ptrdiff_t>(j));
            if (!row) {
                continue;
            }
            for (std::size_t i = 0; i < area.columns; ++i) {
                if (const auto column = columnAt(area.column + static_cast<std::ptrdiff_t>(i))) {
                    samples[j * area.columns + i] =
                        has_voids && std::isnan(reader.at(*column, *row)) ? Sample::Void
                                                                          : Sample::Valid;
                }
            }
        }
        return samples;
    }

    // 1 for the samples where the map ends.
    std::vector<std::uint8_t> endsIn(const Area& area, bool has_voids, SampleReader& reader) const
    {
        const Area wider = area.widened(1);
        const std::vector<Sample> samples = samplesIn(wider, has_voids, reader);
        const auto width = static_cast<std::ptrdiff_t>(wider.columns);
        // The corners of the triangles at a sample (triangulation.h).
        const std::array<std::ptrdiff_t, 6> around{-1, 1, -width, width, -width - 1, width + 1};
        std::vector<std::uint8_t> marks(area.columns * area.rows, 0);
        for (std::size_t j = 0; j < area.rows; ++j) {
            for (std::size_t i = 0; i < area.columns; ++i) {
                const Sample* sample = samples.data() + (j + 1) * wider.columns + i + 1;
                if (*sample != Sample::Valid) {
                    continue;
                }
                const bool is_end =
                    ends_.isAtEnd(*columnAt(area.column + static_cast<std::ptrdiff_t>(i)),
                                  *rowAt(area.row + static_cast<std::ptrdiff_t>(j))) ||
                    (has_voids && std::any_of(around.begin(), around.end(), [&](std::ptrdiff_t by) {
                         return sample[by] == Sample::Void;
                     }));
                marks[j * area.columns + i] = is_end ? 1 : 0;
            }
        }
        return marks;
    }

    void look(std::size_t square)
    {
        const Area area = areaOf(square);
        const Area reached = area.widened(cells_);
        const bool has_voids = hasVoidsIn(reached.widened(1));
        if (!has_voids && !isNearBorder(reached)) {
            return;
        }
        SampleReader reader(map_.heightfield());
        const std::vector<std::uint8_t> marks = endsIn(reached, has_voids, reader);
        const std::vector<std::uint32_t> squared =
            squaredDistances({marks.data(), reached.columns, reached.rows}, cells_);
        std::vector<Found> found;
        bool has_without = false;
        bool has_with = false;
        for (std::size_t j = 0; j < area.rows && !stopped(); ++j) {
            for (std::size_t i = 0; i < area.columns; ++i) {
                const std::uint32_t distance = squared[j * area.columns + i];
                if (distance >= cells_ * cells_) {
                    continue;
                }
                const std::size_t column = static_cast<std::size_t>(area.column) + i;
                const std::size_t row = static_cast<std::size_t>(area.row) + j;
                const double own_m = reader.at(column, row);
                if (std::isnan(own_m)) {
                    continue;
                }
                const double below_m = heightBelow(column, row);
                (std::isnan(below_m) ? has_without : has_with) = true;
                found.push_back({.place = static_cast<std::uint16_t>(j * kSide + i),
                                 .share = static_cast<float>(shareAt(distance, cells_)),
                                 .own_m = static_cast<float>(own_m),
                                 .below_m = static_cast<float>(below_m)});
            }
        }
        if (reader.error()) {
            fail(*reader.error());
        }
        if (found.empty()) {
            return;
        }
        const std::scoped_lock lock(mutex_);
        has_places_without_ = has_places_without_ || has_without;
        has_places_with_ = has_places_with_ || has_with;
        count_ += found.size();
        found_.emplace(square, std::move(found));
        if (count_ > FeatherBand::kSamplesMax && !error_) {
            error_ = Error{ErrorCode::TooLarge,
                           fmt::format("blending over {} cells changes more than {} million "
                                       "samples; choose fewer cells",
                                       cells_, FeatherBand::kSamplesMax / 1'000'000)};
            has_failed_ = true;
        }
    }

    double heightBelow(std::size_t column, std::size_t row)
    {
        const auto place = map_.georeference().toGeographic(
            {static_cast<double>(column), static_cast<double>(row)});
        for (const BodyTerrain& terrain : below_) {
            const auto grid = place ? terrain.gridAt(*place) : std::nullopt;
            if (!grid) {
                continue;
            }
            const double height_m = terrain.heightOnGrid(*grid, BodyTerrain::Tiles::Waiting);
            if (!std::isnan(height_m)) {
                return height_m;
            }
            noteFailure(terrain.shown()->heightfield(), *grid);
        }
        return static_cast<double>(kNaN);
    }

    // A height that is missing because its tile cannot be read.
    void noteFailure(const Heightfield& heightfield, const GridPoint& grid)
    {
        if (!heightfield.isTiled()) {
            return;
        }
        const auto tile = [](double at, std::size_t count) {
            return static_cast<std::uint32_t>(
                static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count - 1))) /
                kTileSide);
        };
        const TileId id{.kind = TileKind::Samples,
                        .level = 0,
                        .column = tile(grid.column, heightfield.columns()),
                        .row = tile(grid.row, heightfield.rows())};
        if (const auto failure = heightfield.tiles()->raster().failure(id)) {
            fail(*failure);
        }
    }

    // Where no map lies below places nearby, the map keeps its own height more and more.
    void fadeOut(std::size_t square)
    {
        const auto found = found_.find(square);
        if (found == found_.end()) {
            return;
        }
        const Area area = areaOf(square);
        const Area reached = area.widened(cells_);
        const std::vector<std::uint8_t> marks = placesWithout(reached);
        if (std::find(marks.begin(), marks.end(), 1) == marks.end()) {
            return;
        }
        const std::vector<std::uint32_t> squared =
            squaredDistances({marks.data(), reached.columns, reached.rows}, cells_);
        for (Found& one : found->second) {
            const std::size_t at = one.place / kSide * area.columns + one.place % kSide;
            const double faded = shareAt(squared[at], cells_);
            one.share = static_cast<float>(1.0 - (1.0 - static_cast<double>(one.share)) * faded);
        }
    }

    std::vector<std::uint8_t> placesWithout(const Area& area) const
    {
        std::vector<std::uint8_t> marks(area.columns * area.rows, 0);
        for (std::size_t j = 0; j < area.rows; ++j) {
            const auto row = rowAt(area.row + static_cast<std::ptrdiff_t>(j));
            for (std::size_t i = 0; row && i < area.columns; ++i) {
                const auto column = columnAt(area.column + static_cast<std::ptrdiff_t>(i));
                marks[j * area.columns + i] = column && isWithout(*column, *row) ? 1 : 0;
            }
        }
        return marks;
    }

    bool isWithout(std::size_t column, std::size_t row) const
    {
        const auto square = found_.find(row / kSide * square_columns_ + column / kSide);
        if (square == found_.end()) {
            return false;
        }
        const auto place = static_cast<std::uint16_t>(row % kSide * kSide + column % kSide);
        const auto& all = square->second;
        const auto one = std::lower_bound(
            all.begin(), all.end(), place,
            [](const Found& sample, std::uint16_t wanted) { return sample.place < wanted; });
        return one != all.end() && one->place == place && std::isnan(one->below_m);
    }

    const Map& map_;
    std::span<const BodyTerrain> below_;
    std::size_t cells_;
    GridEnds ends_;
    std::size_t square_columns_;
    std::size_t square_rows_;
    JobMonitor& monitor_;
    std::mutex mutex_; // guards what follows, while squares are looked at
    FoundSquares found_;
    std::size_t count_ = 0;
    bool has_places_without_ = false;
    bool has_places_with_ = false;
    std::optional<Error> error_;
    std::atomic<bool> has_failed_{false};
};

} // namespace

std::optional<std::size_t> FeatherBand::Square::find(std::size_t column, std::size_t row) const
{
    const auto place = static_cast<std::uint16_t>(row * kSide + column);
    const auto found = std::lower_bound(places.begin(), places.end(), place);
    return found != places.end() && *found == place
               ? std::optional(static_cast<std::size_t>(found - places.begin()))
               : std::nullopt;
}

Result<FeatherBand> FeatherBand::build(const BodyTerrain& map,
                                       std::span<const BodyTerrain> below,
                                       std::size_t cells,
                                       JobMonitor& monitor)
{
    MARSVIEW_CHECK(cells <= kFeatherCellsMax);
    FeatherBand band;
    if (cells == 0 || below.empty()) {
        return band;
    }
    BandBuilder builder(map, below, cells, monitor);
    if (Status built = builder.run(); !built) {
        return std::move(built).error();
    }
    band.square_columns_ = builder.squareColumns();
    for (const auto& [index, found] : builder.found()) {
        Square square;
        for (const Found& one : found) {
            if (!std::isnan(one.below_m)) {
                const auto share = static_cast<double>(one.share);
                square.places.push_back(one.place);
                square.heights_m.push_back(static_cast<float>(std::lerp(
                    static_cast<double>(one.below_m), static_cast<double>(one.own_m), share)));
                square.raised_m.push_back(square.heights_m.back() - one.own_m);
            }
        }
        if (!square.places.empty()) {
            band.size_ += square.places.size();
            band.squares_.emplace(index, std::move(square));
        }
    }
    return band;
}

const FeatherBand::Square* FeatherBand::square(std::size_t column, std::size_t row) const
{
    const auto found = squares_.find(row * square_columns_ + column);
    return found != squares_.end() ? &found->second : nullptr;
}

std::optional<float> FeatherBand::raised(std::size_t column, std::size_t row) const
{
    const Square* found = square(column / kSide, row / kSide);
    const auto index = found != nullptr ? found->find(column % kSide, row % kSide) : std::nullopt;
    return index ? std::optional(found->raised_m[*index]) : std::nullopt;
}

} // namespace marsview
