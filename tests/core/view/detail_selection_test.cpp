#include "core/view/detail_selection.h"
#include "tests/support/make_terrain.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace marsview {
namespace {

constexpr std::size_t kNode = DetailErrors::kNodeCells;
constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

struct DrawnMap {
    std::string name;
    Heightfield field;
    SceneFrame frame;
    std::shared_ptr<const SurfaceAnalysis> analysis;

    DrawnMap(std::string map_name, Heightfield heightfield, const SceneFrame& map_frame)
        : name(std::move(map_name))
        , field(std::move(heightfield))
        , frame(map_frame)
        , analysis(test::analyzed(field))
    {}

    SceneBox box(double exaggeration) const
    {
        return sceneBox(frame, field.columns(), field.rows(), field.range().value(), exaggeration);
    }
    double cell_m() const // NOLINT(readability-identifier-naming)
    {
        return std::max(std::hypot(frame.east_per_column, frame.north_per_column),
                        std::hypot(frame.east_per_row, frame.north_per_row));
    }
};

SceneFrame askewFrame(std::size_t columns, std::size_t rows)
{
    SceneFrame frame = test::northUpFrame(columns, rows, 1.0);
    frame.east_per_column = 24.0;
    frame.north_per_column = 18.0;
    frame.east_per_row = -15.0;
    frame.north_per_row = 22.0;
    return frame;
}

std::vector<DrawnMap> maps(test::Random& random)
{
    std::vector<DrawnMap> all;
    const auto add = [&](const char* name, std::size_t columns, std::size_t rows,
                         const test::HeightFunction& height, bool is_askew) {
        all.emplace_back(name, test::floatTerrain(columns, rows, height),
                         is_askew ? askewFrame(columns, rows)
                                  : test::northUpFrame(columns, rows, 30.0));
    };
    const auto fractal = [&](std::size_t columns, std::size_t rows) {
        return test::heightsFrom(test::fractalHeights(random, columns, rows, 2500.0, 0.5), columns);
    };
    add("fractal", 1500, 1100, fractal(1500, 1100), false);
    add("fractal askew", 777, 1300, fractal(777, 1300), true);
    add(
        "cliff", 1025, 900, [](std::size_t c, std::size_t) { return c < 600 ? 0.0 : 4000.0; },
        false);
    const auto mountains = fractal(1400, 1400);
    add(
        "plain next to mountains", 1400, 1400,
        [&](std::size_t c, std::size_t r) {
            return c + 2 * r > 1600 ? 0.001 * static_cast<double>(c) : mountains(c, r);
        },
        false);
    add("small", 33, 34, fractal(33, 34), false);
    add("smallest", 2, 2, fractal(2, 2), false);
    add("strip", 3, 5000, fractal(3, 5000), true);
    add(
        "even", 600, 700, [](auto...) { return 12.0; }, false);
    const auto holed = fractal(900, 900);
    add(
        "voids", 900, 900,
        [&](std::size_t c, std::size_t r) {
            const bool is_hole = c > 300 && c < 520 && r > 100 && r < 433;
            const bool is_corner = c + r < 400;
            return is_hole || is_corner || random.chance(0.03) ? kNan : holed(c, r);
        },
        false);
    return all;
}

struct Shot {
    DetailView view;
    DetailTarget target;
};

// Cameras inside the map's box, next to it and far away.
Shot randomShot(test::Random& random, const DrawnMap& map)
{
    constexpr std::array<double, 9> kExaggerations{0.001, 0.1,  1.0,   1.0,   1.0,
                                                   2.0,   10.0, 100.0, 1000.0};
    Shot shot;
    DetailView& view = shot.view;
    view.exaggeration = kExaggerations.at(random.below(kExaggerations.size()));
    const SceneBox box = map.box(view.exaggeration);
    const double size = std::hypot(box.maximum.x - box.minimum.x, box.maximum.y - box.minimum.y);
    const double margin = random.chance(0.2) ? 0.5 * size : 0.0;
    const double x = random.uniform(box.minimum.x - margin, box.maximum.x + margin);
    const double y = random.uniform(box.minimum.y - margin, box.maximum.y + margin);
    const double ground = map.field.height(map.frame.toGrid({x, y, 0.0})) * view.exaggeration;
    view.camera = {.target = {x, y, std::isnan(ground) ? box.center().z : ground},
                   .distance_m = size * std::pow(10.0, random.uniform(-3.5, 1.0)),
                   .azimuth = Angle::degrees(random.uniform(0.0, 360.0)),
                   .tilt = Angle::degrees(random.chance(0.2) ? 0.0 : random.uniform(0.0, 85.0)),
                   .field_of_view = Angle::degrees(random.uniform(20.0, 70.0))};
    view.viewport = {.width = 100 + static_cast<int>(random.below(1200)),
                     .height = 100 + static_cast<int>(random.below(900))};
    constexpr std::array<double, 4> kErrors{0.5, 1.0, 2.0, 8.0};
    shot.target.error_px = kErrors.at(random.below(kErrors.size()));
    shot.target.texel_px = random.chance(0.3) ? 2.0 : 1.0;
    return shot;
}

// The ranges of detail_selection.h, recomputed in double from its formulas.
class Ranges {
public:
    Ranges(const DrawnMap& map, const Shot& shot)
        : map_(map)
        , shot_(shot)
    {
        const double pixels = shot.view.viewport.height /
                              (2.0 * std::tan(shot.view.camera.field_of_view.radians() / 2.0));
        const double range_per_size =
            shot.target.error_px > kErrorPxAtRest ? kRangePerSizeMoving : kRangePerSize;
        const DetailErrors& errors = map.analysis->errors;
        sizes_.resize(errors.levelCount());
        for (std::size_t level = 1; level < errors.levelCount(); ++level) {
            const std::size_t columns = errors.columns(level);
            const std::size_t rows = errors.rows(level);
            sizes_[level].resize((columns + 1) * (rows + 1));
            for (std::size_t row = 0; row < rows; ++row) {
                for (std::size_t column = 0; column < columns; ++column) {
                    double least = std::max(range_per_size * diagonal({level, column, row}),
                                            kRangeTwoBelow * largestTwoBelow({level, column, row}));
                    raise(level, column, row, least);
                    for (std::size_t r = 2 * row; level > 1 && r <= 2 * row + 2; ++r) {
                        for (std::size_t c = 2 * column; c <= 2 * column + 2; ++c) {
                            if (c <= errors.columns(level - 1) && r <= errors.rows(level - 1)) {
                                least = std::max(least, 1.5 * size(level - 1, c, r));
                            }
                        }
                    }
                    raise(level, column, row, least);
                }
            }
        }
        range_per_error_ = pixels * shot.view.exaggeration / shot.target.error_px;
        range_per_texel_ = pixels / (shot.target.texel_px * kMorphEnd);
    }

    double at(std::size_t level, std::size_t column, std::size_t row) const
    {
        const auto error =
            static_cast<double>(map_.analysis->errors.cornerError(level, column, row));
        const double texel_m = level > kReliefLevelMin
                                   ? map_.cell_m() * static_cast<double>(kNode << level) /
                                         static_cast<double>(kReliefTexels)
                                   : 0.0;
        return std::max(
            {size(level, column, row), range_per_error_ * error, range_per_texel_ * texel_m});
    }

    // Between the corners of that level's node which contains a position, counted in samples.
    double between(const DetailNode& node, double column, double row) const
    {
        const auto side = static_cast<double>(kNode << node.level);
        const double u = column / side - static_cast<double>(node.column);
        const double v = row / side - static_cast<double>(node.row);
        const double above = at(node.level, node.column, node.row) * (1.0 - u) +
                             at(node.level, node.column + 1, node.row) * u;
        const double below = at(node.level, node.column, node.row + 1) * (1.0 - u) +
                             at(node.level, node.column + 1, node.row + 1) * u;
        return above * (1.0 - v) + below * v;
    }

    // The morph weight of a vertex of that level within `node` toward the next level.
    double
    weight(const DetailNode& node, std::size_t level, const ScenePoint& p, double c, double r) const
    {
        if (level + 1 >= map_.analysis->errors.levelCount()) {
            return 0.0;
        }
        const std::size_t up = level + 1 - node.level;
        const double range = between({level + 1, node.column >> up, node.row >> up}, c, r);
        return std::clamp((length(p - eyeOf(shot_.view.camera)) / range - 1.0) / (kMorphEnd - 1.0),
                          0.0, 1.0);
    }

private:
    double size(std::size_t level, std::size_t column, std::size_t row) const
    {
        return sizes_[level][row * (map_.analysis->errors.columns(level) + 1) + column];
    }

    void raise(std::size_t level, std::size_t column, std::size_t row, double least)
    {
        const std::size_t stride = map_.analysis->errors.columns(level) + 1;
        for (const std::size_t corner :
             {row * stride + column, row * stride + column + 1, (row + 1) * stride + column,
              (row + 1) * stride + column + 1}) {
            sizes_[level][corner] = std::max(sizes_[level][corner], least);
        }
    }

    // The largest range of the nodes two levels below `node`, which must stay apart; 0 below level
    // 3.
    double largestTwoBelow(const DetailNode& node) const
    {
        double largest = 0.0;
        if (node.level < 3) {
            return largest;
        }
        const std::size_t level = node.level - 2;
        const DetailErrors& errors = map_.analysis->errors;
        for (std::size_t row = 4 * node.row; row < std::min(4 * node.row + 4, errors.rows(level));
             ++row) {
            for (std::size_t column = 4 * node.column;
                 column < std::min(4 * node.column + 4, errors.columns(level)); ++column) {
                largest = std::max(largest, diagonal({level, column, row}));
            }
        }
        return largest;
    }

    // The distance to the box around the node's terrain, 0 if it has none.
    double diagonal(const DetailNode& node) const
    {
        const auto& bounds = map_.analysis->bounds.bounds(node.level, node.column, node.row);
        if (bounds.isEmpty()) {
            return 0.0;
        }
        const std::size_t side = kNode << node.level;
        const auto first_c = static_cast<double>(node.column * side);
        const auto first_r = static_cast<double>(node.row * side);
        const auto last_c =
            static_cast<double>(std::min((node.column + 1) * side, map_.field.columns() - 1));
        const auto last_r =
            static_cast<double>(std::min((node.row + 1) * side, map_.field.rows() - 1));
        double low_x = std::numeric_limits<double>::infinity();
        double low_y = low_x;
        double high_x = -low_x;
        double high_y = -low_x;
        for (const GridPoint corner : {GridPoint{first_c, first_r}, GridPoint{last_c, first_r},
                                       GridPoint{first_c, last_r}, GridPoint{last_c, last_r}}) {
            const ScenePoint p = map_.frame.toScene(corner, 0.0);
            low_x = std::min(low_x, p.x);
            high_x = std::max(high_x, p.x);
            low_y = std::min(low_y, p.y);
            high_y = std::max(high_y, p.y);
        }
        const double height =
            (static_cast<double>(bounds.maximum_m) - static_cast<double>(bounds.minimum_m)) *
            shot_.view.exaggeration;
        return std::hypot(high_x - low_x, high_y - low_y, height);
    }

    const DrawnMap& map_;
    const Shot& shot_;
    std::vector<std::vector<double>> sizes_;
    double range_per_error_ = 0.0;
    double range_per_texel_ = 0.0;
};

// The selected node that covers each block of level 0.
struct Cover {
    std::size_t columns;
    std::size_t rows;
    std::vector<std::size_t> owner;

    std::size_t at(std::size_t column, std::size_t row) const
    {
        return owner[row * columns + column];
    }
};

bool isDrawn(const SelectedNode& selected, std::size_t quadrant)
{
    return (selected.quadrants >> quadrant & 1U) != 0;
}

Cover coverOf(const DrawnMap& map, const DetailSelection& selection)
{
    const DetailErrors& errors = map.analysis->errors;
    Cover cover{.columns = errors.columns(0), .rows = errors.rows(0), .owner = {}};
    cover.owner.assign(cover.columns * cover.rows, kNobody);
    for (std::size_t i = 0; i < selection.nodes.size(); ++i) {
        const DetailNode& node = selection.nodes[i].node;
        EXPECT_LT(node.column, errors.columns(node.level));
        EXPECT_LT(node.row, errors.rows(node.level));
        const auto cover_nodes = [&](const DetailNode& part) {
            for (std::size_t row = part.row << part.level;
                 row < std::min((part.row + 1) << part.level, cover.rows); ++row) {
                for (std::size_t column = part.column << part.level;
                     column < std::min((part.column + 1) << part.level, cover.columns); ++column) {
                    std::size_t& owner = cover.owner[row * cover.columns + column];
                    EXPECT_EQ(owner, kNobody) << "nodes overlap";
                    owner = i;
                }
            }
        };
        if (node.level == 0) {
            EXPECT_EQ(selection.nodes[i].quadrants, kAllQuadrants);
            cover_nodes(node);
            continue;
        }
        for (std::size_t q = 0; q < kQuadrantCount; ++q) {
            if (isDrawn(selection.nodes[i], q)) {
                cover_nodes({node.level - 1, 2 * node.column + q % 2, 2 * node.row + q / 2});
            }
        }
    }
    return cover;
}

// The grid position of a node's vertex.
struct Vertex {
    std::size_t column;
    std::size_t row;
};

Vertex vertexAt(const DrawnMap& map, const DetailNode& node, std::size_t i, std::size_t j)
{
    return {.column = std::min((node.column * kNode + i) << node.level, map.field.columns() - 1),
            .row = std::min((node.row * kNode + j) << node.level, map.field.rows() - 1)};
}

ScenePoint
sceneAt(const DrawnMap& map, const DrawnSurface& surface, const Vertex& vertex, double exaggeration)
{
    const double height =
        static_cast<double>(surface.height(vertex.column, vertex.row)) + surface.baseMeters();
    return map.frame.toScene({static_cast<double>(vertex.column), static_cast<double>(vertex.row)},
                             height * exaggeration);
}

// All drawn cells of a node that have an area, void or not.
std::size_t triangleCount(const DrawnMap& map, const SelectedNode& selected)
{
    std::size_t triangles = 0;
    for (std::size_t j = 0; j < kNode; ++j) {
        for (std::size_t i = 0; i < kNode; ++i) {
            const Vertex first = vertexAt(map, selected.node, i, j);
            const Vertex last = vertexAt(map, selected.node, i + 1, j + 1);
            const bool has_area = first.column < last.column && first.row < last.row;
            const std::size_t quadrant = 2 * (2 * j / kNode) + 2 * i / kNode;
            triangles += has_area && isDrawn(selected, quadrant) ? 2U : 0U;
        }
    }
    return triangles;
}

bool isInPicture(const Shot& shot, const ScenePoint& p)
{
    const auto pixel = project(shot.view.camera, shot.view.viewport, p);
    return pixel && pixel->x > 0.0 && pixel->y > 0.0 && pixel->x < shot.view.viewport.width &&
           pixel->y < shot.view.viewport.height;
}

// All terrain in the view is covered. Checks a subset of the samples.
void expectNoGaps(const DrawnMap& map, const Shot& shot, const Cover& cover)
{
    const std::size_t stride = 1 + map.field.columns() * map.field.rows() / 40000;
    for (std::size_t i = 0; i < map.field.columns() * map.field.rows(); i += stride) {
        const std::size_t column = i % map.field.columns();
        const std::size_t row = i / map.field.columns();
        const double height = map.field.sample(column, row);
        if (std::isnan(height)) {
            continue;
        }
        const GridPoint grid{static_cast<double>(column), static_cast<double>(row)};
        if (isInPicture(shot, map.frame.toScene(grid, height * shot.view.exaggeration))) {
            EXPECT_NE(cover.at(std::min(column / kNode, cover.columns - 1),
                               std::min(row / kNode, cover.rows - 1)),
                      kNobody)
                << "gap at " << column << ", " << row;
        }
    }
}

// On an edge shared with coarser neighbors, the vertices of a node lie on their surface.
struct EdgeCheck {
    std::size_t vertices = 0;
    std::size_t off = 0;
    std::size_t levels_max = 0;
};

void checkVertices(const DrawnMap& map,
                   const Shot& shot,
                   const DetailSelection& selection,
                   const Cover& cover,
                   EdgeCheck& edges)
{
    const Ranges ranges(map, shot);
    const DrawnSurface surface(map.field, map.analysis->means);
    const double eye_factor = shot.view.exaggeration * shot.view.viewport.height /
                              (2.0 * std::tan(shot.view.camera.field_of_view.radians() / 2.0));
    const std::size_t stride = 1 + selection.nodes.size() / 150;
    for (std::size_t n = 0; n < selection.nodes.size(); n += stride) {
        const SelectedNode& selected = selection.nodes[n];
        const DetailNode& node = selected.node;
        const std::size_t level_count = map.analysis->errors.levelCount();
        const auto node_error = [&](std::size_t level) {
            const std::size_t up = level - node.level;
            return static_cast<double>(
                map.analysis->errors.nodeError({level, node.column >> up, node.row >> up}));
        };
        for (std::size_t j = 0; j <= kNode; ++j) {
            for (std::size_t i = 0; i <= kNode; ++i) {
                const Vertex vertex = vertexAt(map, node, i, j);
                const ScenePoint p = sceneAt(map, surface, vertex, shot.view.exaggeration);
                // Vertices beyond the last sample are drawn at it, each with its own range.
                const auto column = static_cast<double>((node.column * kNode + i) << node.level);
                const auto row = static_cast<double>((node.row * kNode + j) << node.level);
                const auto weight = [&](std::size_t level) {
                    return ranges.weight(node, level, p, column, row);
                };
                ASSERT_EQ(weight(node.level + 2), 0.0)
                    << "level " << node.level << " would have to morph three times at "
                    << vertex.column << ", " << vertex.row;
                // The error at its position, in pixels; void samples are not measured.
                if (!map.field.samples().isVoid(vertex.column, vertex.row)) {
                    const double to_next = weight(node.level);
                    const double to_last = weight(node.level + 1);
                    const double distance_m = length(p - eyeOf(shot.view.camera));
                    double error_m = to_next < 1.0 ? node_error(node.level) : 0.0;
                    if (to_next > 0.0 && node.level + 1 < level_count && to_last < 1.0) {
                        error_m = std::max(error_m, node_error(node.level + 1));
                    }
                    if (to_next > 0.0 && to_last > 0.0) {
                        error_m = std::max(error_m, node_error(node.level + 2));
                    }
                    const double error_px = eye_factor * error_m / distance_m;
                    ASSERT_LE(error_px, 1.0001 * shot.target.error_px) << node.level;
                    ASSERT_LE(error_px, 1.0001 * selection.error_px)
                        << "level " << node.level << ", morphed by " << to_next << " and "
                        << to_last;
                }
                // The neighbors across the edges on which the vertex lies.
                const auto block = [&](std::size_t sample, std::size_t count) {
                    return std::min(sample / kNode, count - 1);
                };
                std::size_t coarsest = node.level;
                const auto meet = [&](std::size_t c, std::size_t r) {
                    const std::size_t other = cover.at(c, r);
                    if (other != kNobody) {
                        coarsest = std::max(coarsest, selection.nodes[other].node.level);
                    }
                };
                const std::size_t block_column = block(vertex.column, cover.columns);
                const std::size_t block_row = block(vertex.row, cover.rows);
                if (i == 0 && block_column > 0) {
                    meet(block_column - 1, j == kNode && block_row > 0 ? block_row - 1 : block_row);
                }
                if (i == kNode && vertex.column < map.field.columns() - 1) {
                    meet(block_column, j == kNode && block_row > 0 ? block_row - 1 : block_row);
                }
                if (j == 0 && block_row > 0) {
                    meet(i == kNode && block_column > 0 ? block_column - 1 : block_column,
                         block_row - 1);
                }
                if (j == kNode && vertex.row < map.field.rows() - 1) {
                    meet(i == kNode && block_column > 0 ? block_column - 1 : block_column,
                         block_row);
                }
                edges.levels_max = std::max(edges.levels_max, coarsest - node.level);
                for (std::size_t level = node.level; level < coarsest; ++level) {
                    ++edges.vertices;
                    // One place uses the distance from the eye to a box, the other that to a
                    // vertex.
                    edges.off += weight(level) < 1.0 - 1e-9 ? 1U : 0U;
                }
            }
        }
    }
}

class DetailSelectionTest : public testing::Test {
protected:
    test::Random random_;
    std::vector<DrawnMap> maps_ = maps(random_);
};

TEST_F(DetailSelectionTest, CoversThePictureOnceAndMatchesOnEveryEdge)
{
    EdgeCheck edges;
    std::size_t node_count = 0;
    std::size_t quadrants_left_out = 0;
    for (const DrawnMap& map : maps_) {
        DetailSelector selector(map.analysis, map.field.columns(), map.field.rows(), map.frame);
        for (int i = 0; i < 25; ++i) {
            const Shot shot = randomShot(random_, map);
            SCOPED_TRACE(map.name + ", shot " + std::to_string(i) + ", exaggeration " +
                         std::to_string(shot.view.exaggeration));
            const DetailSelection selection = selector.select(shot.view, shot.target);
            node_count += selection.nodes.size();
            const Cover cover = coverOf(map, selection);
            expectNoGaps(map, shot, cover);
            const Ranges ranges(map, shot);
            std::size_t triangles = 0;
            double nearest_m = 0.0;
            for (const SelectedNode& selected : selection.nodes) {
                const DetailNode& node = selected.node;
                triangles += triangleCount(map, selected);
                quadrants_left_out += selected.quadrants == kAllQuadrants ? 0U : 1U;
                EXPECT_GE(selected.distance_m, nearest_m) << "nearest first";
                nearest_m = selected.distance_m;
                const std::array<std::array<std::size_t, 2>, 4> corners{
                    {{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
                for (std::size_t k = 0; k < 4; ++k) {
                    const auto [right, down] = corners.at(k);
                    if (node.level > 0) {
                        EXPECT_GE(selected.distance_m,
                                  kMorphEnd *
                                      ranges.at(node.level, node.column + right, node.row + down));
                    }
                    for (const std::size_t up : {1U, 2U}) {
                        if (node.level + up < map.analysis->errors.levelCount()) {
                            const double range =
                                ranges.at(node.level + up, (node.column >> up) + right,
                                          (node.row >> up) + down);
                            const CornerRanges& given =
                                up == 1 ? selected.parent_ranges_m : selected.grandparent_ranges_m;
                            EXPECT_NEAR(static_cast<double>(given.at(k)), range, 1e-6 * range);
                        }
                    }
                }
                // The relief belongs to the node or to an ancestor, and is fine enough for its
                // distance.
                EXPECT_GE(selected.relief.level, kReliefLevelMin);
                EXPECT_GE(selected.relief.level, node.level);
                const std::size_t up = selected.relief.level - node.level;
                EXPECT_EQ(selected.relief.column, node.column >> up);
                EXPECT_EQ(selected.relief.row, node.row >> up);
                if (selected.relief.level > kReliefLevelMin) {
                    const double texel_m = map.cell_m() *
                                           static_cast<double>(kNode << selected.relief.level) /
                                           static_cast<double>(kReliefTexels);
                    const double pixel_m =
                        2.0 * std::tan(shot.view.camera.field_of_view.radians() / 2.0) *
                        selected.distance_m / shot.view.viewport.height;
                    EXPECT_LE(texel_m, 1.0001 * shot.target.texel_px * pixel_m);
                }
            }
            EXPECT_EQ(selection.triangle_count, triangles);
            EXPECT_LE(selection.error_px, shot.target.error_px);
            checkVertices(map, shot, selection, cover, edges);
            if (HasFailure()) {
                return;
            }
        }
    }
    EXPECT_GT(quadrants_left_out, 0U);
    RecordProperty("nodes", static_cast<int>(node_count));
    RecordProperty("edge_vertices", static_cast<int>(edges.vertices));
    EXPECT_EQ(edges.off, 0U) << "of " << edges.vertices;
    EXPECT_GT(edges.vertices, 10000U);
    // Two levels of difference are possible for diagonal neighbors, and rare.
    EXPECT_GE(edges.levels_max, 1U);
    EXPECT_LE(edges.levels_max, 2U);
}

TEST_F(DetailSelectionTest, DrawsEveryCellAtFullResolution)
{
    for (const DrawnMap& map : maps_) {
        SCOPED_TRACE(map.name);
        DetailSelector selector(map.analysis, map.field.columns(), map.field.rows(), map.frame);
        for (int i = 0; i < 10; ++i) {
            Shot shot = randomShot(random_, map);
            shot.target.has_every_sample = true;
            const DetailSelection selection = selector.select(shot.view, shot.target);
            expectNoGaps(map, shot, coverOf(map, selection));
            EXPECT_EQ(selection.error_px, 0.0);
            for (const SelectedNode& selected : selection.nodes) {
                ASSERT_EQ(selected.node.level, 0U);
                for (const float range : selected.parent_ranges_m) {
                    ASSERT_GT(range, 1e20F) << "no vertex morphs";
                }
            }
        }
        // From far above, everything is in the view.
        const SceneBox box = map.box(1.0);
        const DetailSelection all = selector.select(
            {.camera = {.target = box.center(), .distance_m = 4.0 * box.diagonal_m()},
             .viewport = {.width = 400, .height = 400},
             .exaggeration = 1.0},
            {.has_every_sample = true});
        std::size_t cells = 0;
        const DetailErrors& errors = map.analysis->errors;
        for (std::size_t row = 0; row < errors.rows(0); ++row) {
            for (std::size_t column = 0; column < errors.columns(0); ++column) {
                if (!map.analysis->bounds.bounds(0, column, row).isEmpty()) {
                    cells += std::min(kNode, map.field.columns() - 1 - column * kNode) *
                             std::min(kNode, map.field.rows() - 1 - row * kNode);
                }
            }
        }
        EXPECT_EQ(all.triangle_count, 2 * cells);
    }
}

TEST_F(DetailSelectionTest, DrawsFewerTrianglesForALargerError)
{
    for (const DrawnMap& map : maps_) {
        DetailSelector selector(map.analysis, map.field.columns(), map.field.rows(), map.frame);
        for (int i = 0; i < 10; ++i) {
            Shot shot = randomShot(random_, map);
            std::size_t before = std::numeric_limits<std::size_t>::max();
            for (const double error_px : {0.25, 0.5, 1.0, 2.0, 4.0, 16.0}) {
                shot.target.error_px = error_px;
                const std::size_t count = selector.select(shot.view, shot.target).triangle_count;
                EXPECT_LE(count, before) << map.name << ", " << error_px << " px";
                before = count;
            }
        }
    }
}

// The selection does not depend on earlier selections.
TEST_F(DetailSelectionTest, DependsOnTheViewOnly)
{
    const DrawnMap& map = maps_.front();
    DetailSelector used(map.analysis, map.field.columns(), map.field.rows(), map.frame);
    for (int i = 0; i < 20; ++i) {
        const Shot shot = randomShot(random_, map);
        DetailSelector fresh(map.analysis, map.field.columns(), map.field.rows(), map.frame);
        const DetailSelection a = used.select(shot.view, shot.target);
        const DetailSelection b = fresh.select(shot.view, shot.target);
        ASSERT_EQ(a.nodes.size(), b.nodes.size());
        EXPECT_EQ(a.error_px, b.error_px);
        for (std::size_t n = 0; n < a.nodes.size(); ++n) {
            EXPECT_EQ(a.nodes[n].node, b.nodes[n].node);
            EXPECT_EQ(a.nodes[n].parent_ranges_m, b.nodes[n].parent_ranges_m);
        }
    }
}

TEST(DetailSelector, SelectsNothingOnAMapOfVoids)
{
    const DrawnMap map("void", test::floatTerrain(100, 100, [](auto...) { return kNan; }),
                       test::northUpFrame(100, 100, 10.0));
    DetailSelector selector(map.analysis, 100, 100, map.frame);
    const DetailSelection selection = selector.select(
        {.camera = {.target = {}, .distance_m = 2000.0}, .viewport = {.width = 300, .height = 200}},
        {});
    EXPECT_TRUE(selection.nodes.empty());
    EXPECT_EQ(selection.triangle_count, 0U);
}

} // namespace
} // namespace marsview
