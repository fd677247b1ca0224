#include "ui/render/body_atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace marsview {
namespace {

// Cubes are counted with 16 bits.
constexpr double kCubesMax = 32000.0;

// Where relief's directions are on the body: a slope (east, north) of the relief is the gradient
// east · first + north · second there.
struct Directions {
    Vec3 east;
    Vec3 north;
};

Directions directionsOf(const BodyGrid::Steps& steps, const SceneFrame& frame)
{
    const Vec3 normal = cross(steps.column, steps.row);
    const double area_square = std::max(dot(normal, normal), 1e-300);
    const Vec3 per_column = cross(steps.row, normal) * (1.0 / area_square);
    const Vec3 per_row = cross(normal, steps.column) * (1.0 / area_square);
    return {.east = per_column * frame.east_per_column + per_row * frame.east_per_row,
            .north = per_column * frame.north_per_column + per_row * frame.north_per_row};
}

} // namespace

BodyLattice BodyLattice::reaching(double distance_m)
{
    return {.side_m = std::exp2(std::ceil(std::log2(distance_m / kCubesMax)))};
}

BodyLattice::Split BodyLattice::split(const Vec3& point) const noexcept
{
    Split split{};
    const std::array<double, 3> values{point.x, point.y, point.z};
    for (std::size_t i = 0; i < values.size(); ++i) {
        split.cube[i] = std::round(values[i] / side_m);
        split.within[i] = values[i] - split.cube[i] * side_m;
    }
    return split;
}

std::array<float, 2> poleHeights(const DrawnSurface& surface, std::size_t top_level)
{
    std::array<float, kNodeSide * kNodeSide> heights{};
    std::vector<TileId> missing;
    readNode(surface, {top_level, 0, 0}, heights, missing);
    const auto mean = [&](std::size_t row) {
        const auto* first = heights.data() + row * kNodeSide;
        return std::accumulate(first, first + kNodeSide, 0.0F) / static_cast<float>(kNodeSide);
    };
    return {mean(0), mean(kNodeSide - 1)};
}

std::array<float, 3>
placeOnCover(const BodyCover& cover, const Vec3& point, std::optional<GridPoint>& start)
{
    const std::optional<GridPoint> before = start;
    start = cover.locator->find(point, start);
    if (!start) {
        return {};
    }
    if (before && cover.locator->grid().closes()) { // on the turn that is nearest to the last point
        const auto turn = static_cast<double>(cover.locator->grid().columns() - 1);
        start->column += turn * std::round((before->column - start->column) / turn);
    }
    return {static_cast<float>(start->column / cover.last_column),
            static_cast<float>(start->row / cover.last_row), 1.0F};
}

BodyAtlas::BodyAtlas(std::size_t slot_columns, std::size_t slot_rows)
    : columns_(slot_columns)
    , rows_(slot_rows)
    , slots_(slot_columns, slot_rows)
{
    constexpr std::array<GLint, kTextures> kFormats{GL_RGBA32F, GL_RGBA16I, GL_RGB16F, GL_RGB16F};
    glActiveTexture(GL_TEXTURE0);
    for (unsigned i = 0; i < kTextures; ++i) {
        glBindTexture(GL_TEXTURE_2D, textures_[i].id());
        const bool is_whole = kFormats[i] == GL_RGBA16I;
        glTexImage2D(GL_TEXTURE_2D, 0, kFormats[i], static_cast<GLsizei>(slot_columns * kNodeSide),
                     static_cast<GLsizei>(slot_rows * kNodeSide), 0,
                     is_whole ? GL_RGBA_INTEGER : GL_RGBA, is_whole ? GL_SHORT : GL_FLOAT, nullptr);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    }
}

void BodyAtlas::reserveCovers(std::size_t count)
{
    if (count <= cover_textures_.size()) {
        return;
    }
    glActiveTexture(GL_TEXTURE0);
    while (cover_textures_.size() < count) {
        cover_textures_.emplace_back();
        cover_places_.emplace_back(4 * kVertices);
        glBindTexture(GL_TEXTURE_2D, cover_textures_.back().id());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, static_cast<GLsizei>(columns_ * kNodeSide),
                     static_cast<GLsizei>(rows_ * kNodeSide), 0, GL_RGBA, GL_FLOAT, nullptr);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    }
    slots_ = NodeSlots(columns_, rows_); // all are filled again
    slots_.beginRound();
}

std::optional<NodeSlots::Place> BodyAtlas::place(const LayerNode& node,
                                                 const BodySubject& subject,
                                                 std::uint64_t generation,
                                                 std::vector<TileId>& missing)
{
    return slots_.place(node, {.generation = generation, .exaggeration = subject.exaggeration},
                        missing, [&](const NodeSlots::Place& place, std::vector<TileId>& lacking) {
                            const NodeState state = fill(node.node, subject, lacking);
                            send(place);
                            return state;
                        });
}

NodeState
BodyAtlas::fill(const DetailNode& node, const BodySubject& subject, std::vector<TileId>& missing)
{
    const BodyGrid& grid = *subject.grid;
    const DrawnSurface& surface = *subject.surface;
    NodeState state = readNode(surface, node, heights_, missing);
    const auto place = [&node](std::size_t index, std::size_t i, std::size_t samples) {
        return std::min((index * DetailErrors::kNodeCells + i) << node.level, samples - 1);
    };
    // The column that closes the map has the heights of the first one.
    const std::size_t last = place(node.column, kNodeSide - 1, grid.columns());
    if (last + 1 == grid.columns() && grid.rasterColumn(last) == 0) {
        std::array<float, kVertices> first{};
        if (readNode(surface, {node.level, 0, node.row}, first, missing) == NodeState::Coarser) {
            state = NodeState::Coarser;
        }
        for (std::size_t vertex = 0; vertex < kVertices; ++vertex) {
            if (place(node.column, vertex % kNodeSide, grid.columns()) == last) {
                heights_[vertex] = first[vertex - vertex % kNodeSide];
            }
        }
    }
    for (std::size_t vertex = 0; vertex < kVertices; ++vertex) {
        const std::size_t column = place(node.column, vertex % kNodeSide, grid.columns());
        const std::size_t row = place(node.row, vertex / kNodeSide, grid.rows());
        if (grid.isPole(row)) {
            heights_[vertex] = subject.pole_heights_m[row == 0 ? 0 : 1];
        }
        const double height_m = surface.baseMeters() + static_cast<double>(heights_[vertex]);
        const BodyLattice::Split split =
            subject.lattice.split(grid.at(column, row, subject.exaggeration * height_m));
        const Directions directions = directionsOf(grid.steps(column, row), subject.frame);
        const auto put = [vertex](auto& values, const Vec3& v) {
            values[3 * vertex] = static_cast<float>(v.x);
            values[3 * vertex + 1] = static_cast<float>(v.y);
            values[3 * vertex + 2] = static_cast<float>(v.z);
        };
        put(east_, directions.east);
        put(north_, directions.north);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            within_[4 * vertex + axis] = static_cast<float>(split.within[axis]);
            cubes_[4 * vertex + axis] = static_cast<std::int16_t>(split.cube[axis]);
        }
        within_[4 * vertex + 3] = heights_[vertex];
    }
    for (std::size_t i = 0; i < cover_places_.size(); ++i) {
        fillCover(i, node, subject);
    }
    return state;
}

void BodyAtlas::fillCover(std::size_t index, const DetailNode& node, const BodySubject& subject)
{
    std::vector<float>& places = cover_places_[index];
    std::fill(places.begin(), places.end(), 0.0F);
    if (index >= subject.covers.size()) {
        return;
    }
    const BodyCover& cover = subject.covers[index];
    const BodyGrid& grid = *subject.grid;
    const auto cells = static_cast<double>(std::size_t{1} << node.level);
    const double margin_m = 2.0 * grid.diagonalMaxM(cells, cells);
    const auto sample = [&node](std::size_t first, std::size_t i, std::size_t count) {
        return std::min((first * DetailErrors::kNodeCells + i) << node.level, count - 1);
    };
    std::optional<GridPoint> row_start;
    for (std::size_t j = 0; j < kNodeSide; ++j) {
        std::optional<GridPoint> start = row_start;
        bool is_first = true;
        for (std::size_t i = 0; i < kNodeSide; ++i) {
            const Vec3 foot = grid.at(sample(node.column, i, grid.columns()),
                                      sample(node.row, j, grid.rows()), 0.0);
            if (!cover.locator->isNear(foot, margin_m)) {
                continue;
            }
            const std::array<float, 3> place = placeOnCover(cover, foot, start);
            std::copy(place.begin(), place.end(),
                      places.begin() + static_cast<std::ptrdiff_t>(4 * (j * kNodeSide + i)));
            if (std::exchange(is_first, false)) {
                row_start = start;
            }
        }
    }
}

// Through the first unit alone: the others have what the picture is drawn with.
void BodyAtlas::send(const NodeSlots::Place& place) const
{
    glActiveTexture(GL_TEXTURE0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    const auto send_to = [&](std::size_t texture, GLenum format, GLenum type, const void* texels) {
        glBindTexture(GL_TEXTURE_2D, textures_[texture].id());
        glTexSubImage2D(GL_TEXTURE_2D, 0, place.x, place.y, static_cast<GLsizei>(kNodeSide),
                        static_cast<GLsizei>(kNodeSide), format, type, texels);
    };
    send_to(0, GL_RGBA, GL_FLOAT, within_.data());
    send_to(1, GL_RGBA_INTEGER, GL_SHORT, cubes_.data());
    send_to(2, GL_RGB, GL_FLOAT, east_.data());
    send_to(3, GL_RGB, GL_FLOAT, north_.data());
    for (std::size_t i = 0; i < cover_textures_.size(); ++i) {
        glBindTexture(GL_TEXTURE_2D, cover_textures_[i].id());
        glTexSubImage2D(GL_TEXTURE_2D, 0, place.x, place.y, static_cast<GLsizei>(kNodeSide),
                        static_cast<GLsizei>(kNodeSide), GL_RGBA, GL_FLOAT,
                        cover_places_[i].data());
    }
}

void BodyAtlas::bind(GLenum first) const
{
    for (unsigned i = 0; i < kTextures; ++i) {
        glActiveTexture(first + i);
        glBindTexture(GL_TEXTURE_2D, textures_[i].id());
    }
    for (std::size_t i = 0; i < cover_textures_.size(); ++i) {
        glActiveTexture(first + kTextures + static_cast<GLenum>(i));
        glBindTexture(GL_TEXTURE_2D, cover_textures_[i].id());
    }
}

} // namespace marsview
