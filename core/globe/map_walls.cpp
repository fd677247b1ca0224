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
constexpr std::size_t kEdgesMax = 3000;

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

std::size_t powerOf(std::size_t step)
{
    std::size_t power = 0;
    while (std::size_t{1} << power < step) {
        ++power;
    }
    return power;
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

// The samples of a node at some step, with one more around them: which are void.
class MapWalls::Outline {
public:
    Outline(const Heightfield& heightfield, const BodyGrid& grid, const Key& key)
        : heightfield_(heightfield)
        , grid_(grid)
        , step_(key.step)
        , side_(kCells << key.node.level)
        , first_column_(key.node.column * side_)
        , first_row_(key.node.row * side_)
        , columns_(cellsFrom(first_column_, grid.columns()))
        , rows_(cellsFrom(first_row_, grid.rows()))
    {
        if (heightfield.isTiled() && heightfield.hasVoids()) {
            cursor_.emplace(*heightfield.tiles(), heightfield.scale(), TileAccess::Resident);
            level_ = std::min(powerOf(step_), heightfield.tiles()->layout().topLevel());
        }
        stride_ = columns_ + 3;
        has_.assign(stride_ * (rows_ + 3), true);
        for (std::size_t j = 0; j < rows_ + 3; ++j) {
            const std::size_t apart = isInside(j, rows_ + 3) ? stride_ - 1 : 1;
            for (std::size_t i = 0; i < stride_; i += apart) {
                has_[j * stride_ + i] = hasData(i, j);
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

    // Vertices are counted from the one before the node's first.
    bool hasData(std::size_t i, std::size_t j)
    {
        std::size_t column = this->column(i - std::min<std::size_t>(i, 1));
        std::size_t row = this->row(j - std::min<std::size_t>(j, 1));
        const std::size_t last_column = grid_.columns() - 1;
        if (i == 0) {
            if (column == 0 && !grid_.closes()) {
                return false;
            }
            column = column == 0 ? last_column - std::min(step_, last_column) : column - step_;
        } else if (i == columns_ + 2 && this->column(columns_) == last_column) {
            if (!grid_.closes()) {
                return false;
            }
            column = std::min(step_, last_column);
        }
        const std::size_t last_row = grid_.rows() - 1;
        if (j == 0) {
            if (row == 0) {
                return grid_.poleAtFirstRow() != BodyGrid::Pole::None;
            }
            row -= step_;
        } else if (j == rows_ + 2 && this->row(rows_) == last_row) {
            return grid_.poleAtLastRow() != BodyGrid::Pole::None;
        }
        if (!heightfield_.hasVoids()) {
            return true;
        }
        const std::size_t sample = grid_.rasterColumn(column);
        return cursor_ ? !std::isnan(cursor_->vertex(level_, sample, row))
                       : !heightfield_.samples().isVoid(sample, row);
    }

    bool has(std::size_t i, std::size_t j) const { return has_[j * stride_ + i]; }
    bool hasUpper(std::size_t i, std::size_t j) const
    {
        return has(i, j) && has(i + 1, j) && has(i + 1, j + 1);
    }
    bool hasLower(std::size_t i, std::size_t j) const
    {
        return has(i, j) && has(i, j + 1) && has(i + 1, j + 1);
    }

    const Heightfield& heightfield_;
    const BodyGrid& grid_;
    std::size_t step_;
    std::size_t side_; // of the node, samples
    std::size_t first_column_;
    std::size_t first_row_;
    std::size_t columns_;
    std::size_t rows_;
    std::size_t stride_ = 0;
    std::vector<bool> has_;
    std::optional<TileCursor> cursor_; // of a tiled map with voids
    std::size_t level_ = 0;            // of its tiles
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
        build(key, kept);
        corner_count_ += count(kept.walls);
    }
    return kept.walls;
}

void MapWalls::build(const Key& key, Kept& kept) const
{
    for (Walls& quadrant : kept.walls) {
        quadrant.corners.clear();
        quadrant.triangles.clear();
    }
    const Outline outline(*heightfield_, *grid_, key);
    const std::vector<GridEdge> edges = outline.edges();
    const std::size_t cell = std::size_t{1} << key.node.level;
    if (edges.size() > kEdgesMax && key.step < cell) {
        build({key.node, 2 * key.step}, kept);
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
