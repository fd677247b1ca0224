#include "ui/render/body_atlas.h"

#include "core/globe/body_camera.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <string>
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

constexpr double kOverlapCells = 0.05;
constexpr double kOverlapMax = 0.1; // of the map

// Of a body's radius: on the ground of maps up to this size, planes are good enough.
constexpr double kSmallMap = 0.1;
// How far from the middle of a map its plane is used, in its sizes. Within that, and on a map that
// is not small, places are found among its samples, and those further away are too near to it.
constexpr double kFarShare = 1.0;

GLfloat asFloat(double value)
{
    return static_cast<GLfloat>(value);
}

// The pole that the triangles next to the first or last row end at, and its height.
std::array<GLfloat, 4>
poleFromEye(const CameraPose& pose, const BodySubject& subject, BodyGrid::Pole pole, float height_m)
{
    const double height =
        subject.exaggeration * (subject.surface->baseMeters() + static_cast<double>(height_m));
    const Vec3 p = subject.grid->atPole(pole, height) - pose.eye;
    return {asFloat(p.x), asFloat(p.y), asFloat(p.z), height_m};
}

// Where other maps lie over this one.
void setCovers(const GlProgram& program, const BodySubject& subject, GLint first_unit)
{
    for (std::size_t i = 0; i < subject.covers.size(); ++i) {
        const BodyCover& cover = subject.covers[i];
        const auto set_pole = [&](std::size_t pole, BodyGrid::Pole at) {
            std::optional<GridPoint> start;
            const std::array<float, 3> place =
                placeOnCover(cover, subject.grid->atPole(at, 0.0), start);
            const std::string name =
                fmt::format("u_cover_pole[{}]", pole * subject.covers.size() + i);
            glUniform3fv(program.uniform(name.c_str()), 1, place.data());
        };
        set_pole(0, subject.grid->poleAtFirstRow());
        set_pole(1, subject.grid->poleAtLastRow());
        const std::string element = fmt::format("[{}]", i);
        glUniform1i(program.uniform(("u_cover_place" + element).c_str()),
                    first_unit + static_cast<GLint>(BodyAtlas::kTextures + i));
        glUniform1f(program.uniform(("u_cover_turn" + element).c_str()), asFloat(cover.turn()));
        constexpr float kEverywhere = 1e6F;
        const BodyGrid& above = cover.locator->grid();
        const BodyCover::Overlap overlap = cover.overlap(subject.grid->stepMaxM());
        const float columns = asFloat(overlap.columns);
        const float rows = asFloat(overlap.rows);
        glUniform2f(program.uniform(("u_cover_overlap" + element).c_str()), columns, rows);
        const bool has_first_pole = above.poleAtFirstRow() != BodyGrid::Pole::None;
        const bool has_last_pole = above.poleAtLastRow() != BodyGrid::Pole::None;
        glUniform4f(
            program.uniform(("u_cover_range" + element).c_str()),
            above.closes() ? -kEverywhere : columns, above.closes() ? kEverywhere : 1.0F - columns,
            has_first_pole ? -kEverywhere : rows, has_last_pole ? kEverywhere : 1.0F - rows);
    }
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

BodyCover::BodyCover(std::shared_ptr<const BodyLocator> located,
                     std::size_t columns,
                     std::size_t rows)
    : locator(std::move(located))
    , last_column(static_cast<double>(columns - 1))
    , last_row(static_cast<double>(rows - 1))
{
    const BodyGrid& grid = locator->grid();
    const std::size_t column = grid.columns() / 2;
    const std::size_t row = grid.rows() / 2;
    const BodyGrid::Steps steps = grid.steps(column, row);
    width_m = last_column * length(steps.column);
    height_m = last_row * length(steps.row);
    const Vec3 normal = cross(steps.column, steps.row);
    const double area_square = std::max(dot(normal, normal), 1e-300);
    per_column_ = cross(steps.row, normal) * (1.0 / (area_square * last_column));
    per_row_ = cross(normal, steps.column) * (1.0 / (area_square * last_row));
    middle_ = grid.at(column, row, 0.0) - steps.column * static_cast<double>(column) -
              steps.row * static_cast<double>(row);
}

// Places between vertices are off by as much as a chord lies below the surface.
BodyCover::Overlap BodyCover::overlap(double cell_m) const
{
    const double chord_m = std::min(cell_m, sizeM());
    const double error_m = chord_m * chord_m / (8.0 * locator->grid().ellipsoid().equatorial_m);
    const auto share = [error_m](double last, double length_m) {
        return std::min(kOverlapCells / last + error_m / std::max(length_m, 1e-9), kOverlapMax);
    };
    return {.columns = share(last_column, width_m), .rows = share(last_row, height_m)};
}

std::optional<std::array<float, 3>> BodyCover::farPlace(const Vec3& point) const
{
    if (sizeM() > kSmallMap * locator->grid().ellipsoid().equatorial_m) {
        return std::nullopt;
    }
    const double column = dot(point - middle_, per_column_);
    const double row = dot(point - middle_, per_row_);
    if (std::max(std::abs(column - 0.5), std::abs(row - 0.5)) < kFarShare) {
        return std::nullopt;
    }
    return std::array{static_cast<float>(column), static_cast<float>(row), 1.0F};
}

std::array<float, 3>
placeOnCover(const BodyCover& cover, const Vec3& point, std::optional<GridPoint>& start)
{
    if (const auto place = cover.farPlace(point)) {
        return *place;
    }
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

void setBodyUniforms(const GlProgram& program,
                     const CameraPose& pose,
                     const BodySubject& subject,
                     GLint first_unit)
{
    constexpr std::array<const char*, BodyAtlas::kTextures> kTextures{"u_near", "u_far", "u_east",
                                                                      "u_north"};
    for (std::size_t i = 0; i < kTextures.size(); ++i) {
        glUniform1i(program.uniform(kTextures[i]), first_unit + static_cast<GLint>(i));
    }
    const Ellipsoid& ellipsoid = subject.grid->ellipsoid();
    const double axes = ellipsoid.equatorial_m / ellipsoid.polar_m;
    const BodyLattice::Split eye = subject.lattice.split(pose.eye);
    glUniform3f(program.uniform("u_eye_far"), asFloat(eye.cube[0]), asFloat(eye.cube[1]),
                asFloat(eye.cube[2]));
    glUniform3f(program.uniform("u_eye_near"), asFloat(eye.within[0]), asFloat(eye.within[1]),
                asFloat(eye.within[2]));
    glUniform1f(program.uniform("u_lattice"), asFloat(subject.lattice.side_m));
    glUniform1f(program.uniform("u_axes_squared"), asFloat(axes * axes));
    glUniform1f(program.uniform("u_exaggeration"), asFloat(subject.exaggeration));

    const BodyPlace target = placeOf(pose.eye + pose.axes.forward * pose.distance_m, ellipsoid);
    const LocalAxes local = localAxes(ellipsoid, target.foot);
    std::array<GLfloat, 9> columns{};
    std::size_t i = 0;
    for (const Vec3& axis : {local.east, local.north, local.up}) {
        for (const double value : {axis.x, axis.y, axis.z}) {
            columns[i++] = asFloat(value);
        }
    }
    glUniformMatrix3fv(program.uniform("u_target"), 1, GL_FALSE, columns.data());

    const std::array<GLfloat, 4> first =
        poleFromEye(pose, subject, subject.grid->poleAtFirstRow(), subject.pole_heights_m.front());
    const std::array<GLfloat, 4> last =
        poleFromEye(pose, subject, subject.grid->poleAtLastRow(), subject.pole_heights_m.back());
    glUniform4fv(program.uniform("u_pole[0]"), 1, first.data());
    glUniform4fv(program.uniform("u_pole[1]"), 1, last.data());
    setCovers(program, subject, first_unit);
}

} // namespace marsview
