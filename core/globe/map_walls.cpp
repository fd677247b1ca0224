#include "core/globe/map_walls.h"

#include "core/terrain/triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kCells = DetailErrors::kNodeCells;

// A node with more edges than this gets longer ones: voids are like noise there.
constexpr std::size_t kEdgesMax = 12000;

// Those of the nodes that are kept, 60 MB.
constexpr std::size_t kCornersMax = 3'000'000;

// A map below counts so many cells beyond its outermost samples: places on it are that exact.
constexpr double kBeyondCells = 0.05;

struct GridEdge {
    std::size_t quadrant;
    std::array<std::array<std::size_t, 2>, 2> ends; // vertices of the outline: column, row
};

std::size_t count(const MapWalls::NodeWalls& walls)
{
    std::size_t corners = 0;
    for (const MapWalls::Walls& quadrant : walls) {
        corners += quadrant.corners.size();
    }
    return corners;
}

} // namespace

bool mayEnd(const BodyGrid& grid, const BlockMeans& means, const DetailNode& node)
{
    const std::size_t side = kCells << node.level;
    const std::size_t left = node.column * side;
    const std::size_t top = node.row * side;
    const std::size_t right = left + side;
    const std::size_t bottom = top + side;
    const bool is_at_side = left == 0 || right >= grid.columns() - 1;
    if (is_at_side && !grid.closes()) {
        return true;
    }
    if ((top == 0 && grid.poleAtFirstRow() == BodyGrid::Pole::None) ||
        (bottom >= grid.rows() - 1 && grid.poleAtLastRow() == BodyGrid::Pole::None)) {
        return true;
    }
    std::size_t level = 0;
    while (level + 1 < means.levelCount() && (means.blockSamples() << (level + 3)) <= side) {
        ++level;
    }
    const std::size_t block = means.blockSamples() << level;
    const GridView<const float> blocks = means.means(level);
    // The samples next to the node count: triangles there may be void.
    const std::size_t reach = side / kCells;
    const auto first = [&](std::size_t sample) {
        return (sample - std::min(sample, reach)) / block;
    };
    const auto last = [&](std::size_t sample, std::size_t count) {
        return std::min((sample + reach) / block, count - 1);
    };
    for (std::size_t row = first(top); row <= last(bottom, blocks.rows()); ++row) {
        for (std::size_t column = first(left); column <= last(right, blocks.columns()); ++column) {
            if (means.share(level, column, row) < 1.0F) {
                return true;
            }
        }
        // The samples next to it are at the other end of a map around the body.
        if (is_at_side && std::min(means.share(level, 0, row),
                                   means.share(level, blocks.columns() - 1, row)) < 1.0F) {
            return true;
        }
    }
    return false;
}

// The triangles between every so many samples of a node, with those next to it: which have data.
class MapWalls::Outline {
public:
    Outline(const Heightfield& heightfield,
            const BodyGrid& grid,
            const BlockMeans& means,
            const Key& key)
        : heightfield_(heightfield)
        , grid_(grid)
        , means_(means)
        , step_(key.step)
        , side_(kCells << key.node.level)
        , first_column_(key.node.column * side_)
        , first_row_(key.node.row * side_)
        , columns_(cellsFrom(first_column_, grid.columns()))
        , rows_(cellsFrom(first_row_, grid.rows()))
    {
        if (heightfield.isTiled() && heightfield.hasVoids()) {
            cursor_.emplace(*heightfield.tiles(), heightfield.scale(), TileAccess::Resident);
        }
        while (block_level_ + 1 < means.levelCount() &&
               (means.blockSamples() << (block_level_ + 4)) <= step_) {
            ++block_level_;
        }
        stride_ = columns_ + 2;
        triangles_.assign(stride_ * (rows_ + 2), kBoth);
        for (std::size_t j = 0; j < rows_ + 2; ++j) {
            const std::size_t apart = isInside(j, rows_ + 2) ? stride_ - 1 : 1;
            for (std::size_t i = 0; i < stride_; i += apart) {
                triangles_[j * stride_ + i] = trianglesIn(columnsOf(i), rowsOf(j));
            }
        }
    }

    std::size_t column(std::size_t i) const
    {
        return std::min(first_column_ + i * step_, grid_.columns() - 1);
    }
    std::size_t row(std::size_t j) const
    {
        return std::min(first_row_ + j * step_, grid_.rows() - 1);
    }
    std::size_t columns() const { return columns_; } // cells
    std::size_t rows() const { return rows_; }
    bool isExact() const { return !cursor_ || cursor_->isExact(); }

    // The edges of triangles with data next to triangles without.
    std::vector<GridEdge> edges() const
    {
        std::vector<GridEdge> edges;
        for (std::size_t j = 0; j < rows_; ++j) {
            const std::size_t apart = columns_ > 1 && isInside(j, rows_) ? columns_ - 1 : 1;
            for (std::size_t i = 0; i < columns_; i += apart) {
                const bool upper = hasUpper(i + 1, j + 1);
                const bool lower = hasLower(i + 1, j + 1);
                const std::size_t quadrant = 2 * half(j) + half(i);
                const auto add = [&](std::array<std::size_t, 2> a, std::array<std::size_t, 2> b) {
                    edges.push_back({quadrant, {a, b}});
                };
                if (upper && !hasLower(i + 1, j)) {
                    add({i, j}, {i + 1, j});
                }
                if (upper && !hasLower(i + 2, j + 1)) {
                    add({i + 1, j}, {i + 1, j + 1});
                }
                if (lower && !hasUpper(i, j + 1)) {
                    add({i, j}, {i, j + 1});
                }
                if (lower && !hasUpper(i + 1, j + 2)) {
                    add({i, j + 1}, {i + 1, j + 1});
                }
                if (upper != lower) {
                    add({i, j}, {i + 1, j + 1});
                }
            }
        }
        return edges;
    }

private:
    // Bits of a cell: its triangles with data.
    static constexpr std::uint8_t kUpper = 1;
    static constexpr std::uint8_t kLower = 2;
    static constexpr std::uint8_t kBoth = kUpper | kLower;

    // The samples of a line of cells, from its first to its last ones. Both are the same next to a
    // pole, where the triangles have one row.
    struct Span {
        std::size_t first = 0;
        std::size_t last = 0;
    };

    std::size_t cellsFrom(std::size_t first, std::size_t samples) const
    {
        return (std::min(side_, samples - 1 - first) + step_ - 1) / step_;
    }
    // Whether a map without voids ends in a line of this index at its ends alone.
    bool isInside(std::size_t index, std::size_t count) const
    {
        return !heightfield_.hasVoids() && index > 0 && index + 1 < count;
    }
    std::size_t half(std::size_t cell) const { return 2 * cell * step_ < side_ ? 0 : 1; }

    // Cells are counted from the one before the node's first. Nothing beyond the map.
    std::optional<Span> columnsOf(std::size_t i) const
    {
        const std::size_t last = grid_.columns() - 1;
        if (i == 0 && first_column_ == 0) {
            return grid_.closes() ? std::optional(Span{(last - 1) / step_ * step_, last})
                                  : std::nullopt;
        }
        if (i > columns_ && column(columns_) == last) {
            return grid_.closes() ? std::optional(Span{0, std::min(step_, last)}) : std::nullopt;
        }
        const std::size_t first = first_column_ + i * step_ - step_;
        return Span{first, std::min(first + step_, last)};
    }
    std::optional<Span> rowsOf(std::size_t j) const
    {
        const std::size_t last = grid_.rows() - 1;
        const auto at_pole = [](BodyGrid::Pole pole, std::size_t row) {
            return pole != BodyGrid::Pole::None ? std::optional(Span{row, row}) : std::nullopt;
        };
        if (j == 0 && first_row_ == 0) {
            return at_pole(grid_.poleAtFirstRow(), 0);
        }
        if (j > rows_ && row(rows_) == last) {
            return at_pole(grid_.poleAtLastRow(), last);
        }
        const std::size_t first = first_row_ + j * step_ - step_;
        return Span{first, std::min(first + step_, last)};
    }

    // Larger triangles than those between single samples have data if all samples in them do:
    // the picture has holes at voids that none of their corners meets.
    std::uint8_t trianglesIn(const std::optional<Span>& columns, const std::optional<Span>& rows)
    {
        if (!columns || !rows) {
            return 0;
        }
        if (!heightfield_.hasVoids() || isWhole(*columns, *rows)) {
            return kBoth;
        }
        if (cursor_ && step_ > 1) {
            return 0; // the samples between may not be in memory
        }
        const std::size_t width = columns->last - columns->first;
        const std::size_t height = rows->last - rows->first;
        std::uint8_t triangles = kBoth;
        for (std::size_t y = 0; y <= height; ++y) {
            for (std::size_t x = 0; x <= width; ++x) {
                if (!isVoid(columns->first + x, rows->first + y)) {
                    continue;
                }
                const std::size_t right = x * height;
                const std::size_t down = y * width;
                triangles &= static_cast<std::uint8_t>(right > down   ? ~kUpper
                                                       : right < down ? ~kLower
                                                                      : 0);
                if (triangles == 0) {
                    return 0;
                }
            }
        }
        return triangles;
    }

    // Whether the blocks of these samples have no voids.
    bool isWhole(const Span& columns, const Span& rows) const
    {
        const std::size_t block = means_.blockSamples() << block_level_;
        const GridView<const float> blocks = means_.means(block_level_);
        const std::size_t last_row = std::min(rows.last / block, blocks.rows() - 1);
        const std::size_t last_column = std::min(columns.last / block, blocks.columns() - 1);
        const bool has_first = grid_.rasterColumn(columns.last) < columns.last; // where it closes
        for (std::size_t row = rows.first / block; row <= last_row; ++row) {
            for (std::size_t column = columns.first / block; column <= last_column; ++column) {
                if (means_.share(block_level_, column, row) < 1.0F) {
                    return false;
                }
            }
            if (has_first && means_.share(block_level_, 0, row) < 1.0F) {
                return false;
            }
        }
        return true;
    }

    bool isVoid(std::size_t column, std::size_t row)
    {
        const std::size_t sample = grid_.rasterColumn(column);
        return cursor_ ? std::isnan(cursor_->sample(sample, row))
                       : heightfield_.samples().isVoid(sample, row);
    }

    bool hasUpper(std::size_t i, std::size_t j) const
    {
        return (triangles_[j * stride_ + i] & kUpper) != 0;
    }
    bool hasLower(std::size_t i, std::size_t j) const
    {
        return (triangles_[j * stride_ + i] & kLower) != 0;
    }

    const Heightfield& heightfield_;
    const BodyGrid& grid_;
    const BlockMeans& means_;
    std::size_t block_level_ = 0; // of the means
    std::size_t step_;
    std::size_t side_; // of the node, samples
    std::size_t first_column_;
    std::size_t first_row_;
    std::size_t columns_;
    std::size_t rows_;
    std::size_t stride_ = 0;
    std::vector<std::uint8_t> triangles_;
    std::optional<TileCursor> cursor_; // of a tiled map with voids
};

// The terrain of the maps below.
class MapWalls::Ground {
public:
    struct Place {
        float height_m = kNoLowerM;
        float sag_m = 0.0F;
    };

    explicit Ground(const std::vector<LowerMap>& maps)
    {
        for (const LowerMap& map : maps) {
            Entry& entry = entries_.emplace_back();
            entry.map = &map;
            if (map.heightfield->isTiled()) {
                entry.cursor.emplace(*map.heightfield->tiles(), map.heightfield->scale(),
                                     TileAccess::Resident);
            }
        }
    }

    // That of the uppermost one with data there.
    Place under(const Vec3& foot, const Vec3& normal)
    {
        for (Entry& entry : entries_) {
            if (entry.map->locator->isNear(foot, 0.0)) {
                if (const std::optional<Place> place = on(entry, foot, normal)) {
                    return *place;
                }
            }
        }
        return {};
    }
    bool isExact() const
    {
        return std::all_of(entries_.begin(), entries_.end(), [](const Entry& entry) {
            return !entry.cursor || entry.cursor->isExact();
        });
    }

private:
    struct Entry {
        const LowerMap* map = nullptr;
        std::optional<TileCursor> cursor; // of a tiled map
        std::optional<GridPoint> last;
    };

    static std::optional<Place> on(Entry& entry, const Vec3& foot, const Vec3& normal)
    {
        const BodyGrid& grid = entry.map->locator->grid();
        entry.last = entry.map->locator->find(foot, entry.last);
        if (!entry.last) {
            return std::nullopt;
        }
        GridPoint at = *entry.last;
        const auto last_column = static_cast<double>(grid.columns() - 1);
        const auto last_row = static_cast<double>(grid.rows() - 1);
        if (grid.closes()) {
            at.column -= last_column * std::floor(at.column / last_column);
        }
        if (grid.poleAtFirstRow() != BodyGrid::Pole::None) {
            at.row = std::max(at.row, 0.0);
        }
        if (grid.poleAtLastRow() != BodyGrid::Pole::None) {
            at.row = std::min(at.row, last_row);
        }
        if (!(at.column >= -kBeyondCells && at.column <= last_column + kBeyondCells &&
              at.row >= -kBeyondCells && at.row <= last_row + kBeyondCells)) {
            return std::nullopt;
        }
        const auto cell = [](double value, std::size_t samples) {
            return std::min(static_cast<std::size_t>(std::max(value, 0.0)), samples - 2);
        };
        const std::size_t c = cell(at.column, grid.columns());
        const std::size_t r = cell(at.row, grid.rows());
        const double u = std::clamp(at.column - static_cast<double>(c), 0.0, 1.0);
        const double v = std::clamp(at.row - static_cast<double>(r), 0.0, 1.0);
        const auto sample = [&](std::size_t column, std::size_t row) {
            const std::size_t of_raster = grid.rasterColumn(column);
            return entry.cursor ? entry.cursor->sample(of_raster, row)
                                : entry.map->heightfield->sample(of_raster, row);
        };
        const double height_m = heightInCell(
            {sample(c, r), sample(c + 1, r), sample(c, r + 1), sample(c + 1, r + 1)}, u, v);
        if (std::isnan(height_m)) {
            return std::nullopt;
        }
        const auto off = [&](std::size_t column, std::size_t row) {
            return dot(grid.at(column, row, 0.0) - foot, normal);
        };
        const double sag_m =
            heightInCell({off(c, r), off(c + 1, r), off(c, r + 1), off(c + 1, r + 1)}, u, v);
        return Place{static_cast<float>(height_m), static_cast<float>(sag_m)};
    }

    std::vector<Entry> entries_;
};

std::size_t MapWalls::KeyHash::operator()(const Key& key) const noexcept
{
    std::uint64_t h = key.step * 0x9E3779B97F4A7C15ULL + key.node.level;
    h = (h ^ (h >> 29U)) * 0xBF58476D1CE4E5B9ULL + key.node.column;
    h = (h ^ (h >> 32U)) * 0x94D049BB133111EBULL + key.node.row;
    return static_cast<std::size_t>(h ^ (h >> 31U));
}

MapWalls::MapWalls(std::shared_ptr<const Heightfield> heightfield,
                   std::shared_ptr<const BodyGrid> grid,
                   std::vector<LowerMap> lower)
    : heightfield_(std::move(heightfield))
    , grid_(std::move(grid))
    , lower_(std::move(lower))
{}

const MapWalls::NodeWalls& MapWalls::of(const DetailNode& node,
                                        std::size_t step,
                                        const BlockMeans& means,
                                        std::uint64_t generation)
{
    static const NodeWalls kNone;
    if (!mayEnd(*grid_, means, node)) {
        return kNone;
    }
    if (corner_count_ > kCornersMax) {
        kept_.clear();
        corner_count_ = 0;
    }
    const Key key{node, step};
    const auto [place, is_new] = kept_.try_emplace(key);
    Kept& kept = place->second;
    if (is_new || (!kept.is_final && kept.generation != generation)) {
        kept.generation = generation;
        corner_count_ -= count(kept.walls);
        build(key, means, kept);
        corner_count_ += count(kept.walls);
    }
    return kept.walls;
}

void MapWalls::build(const Key& key, const BlockMeans& means, Kept& kept) const
{
    for (Walls& quadrant : kept.walls) {
        quadrant.corners.clear();
        quadrant.triangles.clear();
    }
    const Outline outline(*heightfield_, *grid_, means, key);
    const std::vector<GridEdge> edges = outline.edges();
    const std::size_t cell = std::size_t{1} << key.node.level;
    if (edges.size() > kEdgesMax && key.step < cell) {
        build({key.node, 2 * key.step}, means, kept);
        return;
    }
    Ground ground(lower_);
    const std::size_t stride = outline.columns() + 1;
    struct Post {
        std::optional<Ground::Place> place;
        std::array<std::optional<std::uint16_t>, kQuadrantCount> corner; // the lower one
    };
    std::vector<Post> posts(stride * (outline.rows() + 1));
    // In cells of the node, whose last vertices may all lie at the map's last column or row.
    const auto in_cells = [cell](std::size_t sample, std::size_t first, std::size_t samples) {
        const std::size_t whole = (sample - first) / cell;
        const std::size_t from = first + whole * cell;
        const std::size_t to = std::min(from + cell, samples - 1);
        return static_cast<float>(
            static_cast<double>(whole) +
            (to > from ? static_cast<double>(sample - from) / static_cast<double>(to - from)
                       : 0.0));
    };
    const std::size_t side = kCells << key.node.level;
    for (const GridEdge& edge : edges) {
        bool has_ground = false;
        for (const auto& [i, j] : edge.ends) {
            std::optional<Ground::Place>& place = posts[j * stride + i].place;
            if (!place) {
                const std::size_t column = outline.column(i);
                const std::size_t row = outline.row(j);
                place = ground.under(grid_->at(column, row, 0.0), grid_->normal(column, row));
            }
            has_ground = has_ground || place->height_m != kNoLowerM;
        }
        if (!has_ground) {
            continue;
        }
        Walls& walls = kept.walls[edge.quadrant];
        const auto corner = [&](const std::array<std::size_t, 2>& end) {
            const auto [i, j] = end;
            Post& post = posts[j * stride + i];
            std::optional<std::uint16_t>& index = post.corner[edge.quadrant];
            if (!index) {
                index = static_cast<std::uint16_t>(walls.corners.size());
                WallCorner made{
                    .column = in_cells(outline.column(i), key.node.column * side, grid_->columns()),
                    .row = in_cells(outline.row(j), key.node.row * side, grid_->rows()),
                    .lower_m = post.place->height_m,
                    .sag_m = post.place->sag_m};
                walls.corners.push_back(made);
                made.is_top = 1.0F;
                walls.corners.push_back(made);
            }
            return *index;
        };
        const std::uint16_t first = corner(edge.ends[0]);
        const std::uint16_t second = corner(edge.ends[1]);
        const auto above = [](std::uint16_t index) {
            return static_cast<std::uint16_t>(index + 1);
        };
        walls.triangles.insert(walls.triangles.end(),
                               {first, second, above(second), first, above(second), above(first)});
    }
    kept.is_final = outline.isExact() && ground.isExact();
}

} // namespace marsview
