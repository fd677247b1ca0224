#include "core/body/body_mesh.h"

#include "core/base/check.h"
#include "core/body/pinned_samples.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <type_traits>
#include <utility>
#include <vector>

namespace marsview {

BodyMesh::BodyMesh(std::shared_ptr<const BodyPositions> positions,
                   const ElevationScale& scale,
                   double exaggeration)
    : positions_(std::move(positions))
    , exaggeration_(exaggeration)
    , scale_(scale)
    , columns_(static_cast<std::uint32_t>(positions_->columns()))
    , rows_(static_cast<std::uint32_t>(positions_->rows()))
    , cell_columns_(positions_->wraps() ? columns_ : columns_ - 1)
    , is_mirrored_(positions_->isMirrored())
    , face_count_(std::size_t{2} * cell_columns_ * (rows_ - 1))
    , blocks_per_row_((cell_columns_ + kBlockCells - 1) / kBlockCells)
    , cell_leaves_(blocks_per_row_ * ((rows_ - 1 + kBlockCells - 1) / kBlockCells))
{
    const std::array<bool, 2> closes{positions_->closesAtFirstRow(), positions_->closesAtLastRow()};
    for (std::size_t i = 0; i < caps_.size(); ++i) {
        if (closes[i]) {
            caps_[i] = {.first_face = face_count_,
                        .row = i == 0 ? 0 : rows_ - 1,
                        .exists = true,
                        .is_turned = is_mirrored_ != (i == 1)};
            face_count_ += columns_ - 2;
        }
    }
}

Result<std::shared_ptr<const BodyMesh>>
BodyMesh::build(std::shared_ptr<const FilledHeightfield> heights,
                const Georeference& georeference,
                double exaggeration,
                JobMonitor& monitor,
                const std::optional<Ellipsoid>& scene)
{
    MARSVIEW_CHECK(heights->columns() == georeference.columns() &&
                   heights->rows() == georeference.rows());
    Result<BodyPositions> positions = BodyPositions::make(georeference, monitor, scene);
    if (!positions) {
        return std::move(positions).error();
    }
    std::shared_ptr<BodyMesh> mesh(
        new BodyMesh(std::make_shared<const BodyPositions>(std::move(positions).value()),
                     heights->heightfield().scale(), exaggeration));
    mesh->heights_ = std::move(heights);
    const SampleGrid& samples = mesh->heights_->heightfield().samples();
    mesh->raster_columns_ = samples.columns();
    if (!samples.hasVoids()) {
        samples.visit([&mesh](auto view) {
            if constexpr (std::is_same_v<decltype(view), GridView<const std::int16_t>>) {
                mesh->int16_ = view.data();
            } else if constexpr (std::is_same_v<decltype(view), GridView<const float>>) {
                mesh->float_ = view.data();
            }
        });
    }
    if (Status built = mesh->buildTree(monitor); !built) {
        return std::move(built).error();
    }
    return std::shared_ptr<const BodyMesh>(std::move(mesh));
}

BodyIndex BodyMesh::across(BodyIndex corner) const noexcept
{
    const BodyIndex face = corner / 3;
    const auto [column, row] = cellOf(face / 2);
    if (row >= rows_ - 1) {
        return acrossInCap(capOf(face), corner);
    }
    const bool is_upper = face % 2 == 1;
    switch (roleOf(is_upper, static_cast<std::uint32_t>(corner % 3))) {
    case kThird: // the diagonal
        return cellCorner(column, row, !is_upper, kThird);
    case kFirst:
        if (is_upper) { // the side at the next column
            return column + 1 < cell_columns_ ? cellCorner(column + 1, row, false, kFar)
                   : positions_->wraps()      ? cellCorner(0, row, false, kFar)
                                              : kNone;
        }
        return row + 1 < rows_ - 1 ? cellCorner(column, row + 1, true, kFar)
               : caps_[1].exists   ? capCornerAtEdge(caps_[1], column)
                                   : kNone;
    case kFar:
        break;
    }
    if (is_upper) { // the side along the row
        return row > 0           ? cellCorner(column, row - 1, false, kFirst)
               : caps_[0].exists ? capCornerAtEdge(caps_[0], column)
                                 : kNone;
    }
    return column > 0            ? cellCorner(column - 1, row, true, kFirst)
           : positions_->wraps() ? cellCorner(cell_columns_ - 1, row, true, kFirst)
                                 : kNone;
}

// Even triangles have an edge of the row at the low end, odd ones at the high end. Corner 0 is at
// the low end and corner 2 at the high end.
std::array<std::uint32_t, 3> BodyMesh::capColumns(std::uint32_t triangle) const noexcept
{
    const std::uint32_t last = columns_ - 1;
    const std::uint32_t step = triangle / 2;
    return triangle % 2 == 0 ? std::array{step, step + 1, last - step}
                             : std::array{step + 1, last - step - 1, last - step};
}

BodyIndex BodyMesh::acrossInCap(const Cap& cap, BodyIndex corner) const noexcept
{
    const auto triangle = static_cast<std::uint32_t>(corner / 3 - cap.first_face);
    const auto number = static_cast<std::uint32_t>(corner % 3);
    const std::uint32_t turned = cap.is_turned && number != 0U ? 3U - number : number;
    const std::uint32_t count = columns_ - 2;
    const bool is_odd = triangle % 2 == 1;
    const auto [low, middle, high] = capColumns(triangle);
    const auto beside = [&](std::uint32_t column) {
        return cap.row == 0 ? cellCorner(column, 0, true, kFar)
                            : cellCorner(column, rows_ - 2, false, kFirst);
    };
    // Opposite corner 1 is the edge to the triangle before; an edge of the row lies opposite
    // corner 2 in even triangles and opposite corner 0 in odd ones.
    if (turned == 1U) {
        if (triangle == 0) {
            return beside(high); // from the last column to the first
        }
        // Seen from an even triangle before, this edge is opposite its corner 0.
        return capCorner(cap, triangle - 1, is_odd ? 0U : 2U);
    }
    const bool is_along_row = is_odd ? turned == 0U : turned == 2U;
    if (is_along_row) {
        return beside(is_odd ? middle : low);
    }
    if (triangle + 1 == count) {
        return beside(is_odd ? low : middle);
    }
    return capCorner(cap, triangle + 1, 1U);
}

// The corner of the cap opposite the edge from a column to the next.
BodyIndex BodyMesh::capCornerAtEdge(const Cap& cap, std::uint32_t column) const noexcept
{
    const std::uint32_t count = columns_ - 2;
    if (column + 1 == columns_) {
        return capCorner(cap, 0, 1U);
    }
    if (2 * column < count) {
        return capCorner(cap, 2 * column, 2U);
    }
    const std::uint32_t odd = 2 * (columns_ - 2 - column) + 1;
    if (odd < count) {
        return capCorner(cap, odd, 0U);
    }
    return capCorner(cap, count - 1, (count - 1) % 2 == 1 ? 2U : 0U);
}

BodyIndex BodyMesh::cornerAtEdge(BodyIndex a, BodyIndex b) const noexcept
{
    // The first end is further up or, in its row, further left.
    const BodyIndex first = std::min(a, b);
    const auto [column, row] = sampleOf(first);
    const BodyIndex step = std::max(a, b) - first;
    if (column + 1 < columns_) {
        if (step == 1 && row > 0) { // along a row: the cell above
            return cellCorner(column, row - 1, false, kFirst);
        }
        if (step == columns_ && column > 0) { // along a column: the cell to the left
            return cellCorner(column - 1, row, true, kFirst);
        }
        if (step == BodyIndex{columns_} + 1) { // a diagonal
            return cellCorner(column, row, false, kThird);
        }
    }
    for (const BodyIndex corner : fan(a)) {
        const BodyIndex next = nextCorner(corner);
        const BodyIndex previous = previousCorner(corner);
        if (vertexAt(next) == b) {
            return std::min(previous, across(previous));
        }
        if (vertexAt(previous) == b) {
            return std::min(next, across(next));
        }
    }
    return 0; // not edges of one face
}

FanCorners BodyMesh::fan(BodyIndex vertex) const noexcept
{
    const auto [column, row] = sampleOf(vertex);
    FanCorners corners;
    if (isInside(column, row)) {
        const std::array<BodyIndex, 6> around{cellCorner(column, row, false, kFirst),
                                              cellCorner(column, row, true, kFirst),
                                              cellCorner(column, row - 1, false, kThird),
                                              cellCorner(column - 1, row - 1, true, kFar),
                                              cellCorner(column - 1, row - 1, false, kFar),
                                              cellCorner(column - 1, row, true, kThird)};
        for (std::size_t i = 0; i < around.size(); ++i) {
            corners.add(around[is_mirrored_ ? around.size() - 1 - i : i]);
        }
        return corners;
    }
    // Any of its corners, then clockwise to the border or once around, then counter-clockwise.
    const bool has_cell_right = column < cell_columns_;
    const std::uint32_t cell_column = has_cell_right ? column : column - 1;
    const BodyIndex some = row + 1 < rows_  ? has_cell_right
                                                  ? cellCorner(cell_column, row, false, kFirst)
                                                  : cellCorner(cell_column, row, true, kThird)
                            : has_cell_right ? cellCorner(cell_column, row - 1, false, kThird)
                                            : cellCorner(cell_column, row - 1, false, kFar);
    BodyIndex first = some;
    for (std::size_t i = 0; i < FanCorners::kCountMax; ++i) {
        const BodyIndex before = across(previousCorner(first));
        if (before == kNone) {
            break;
        }
        first = previousCorner(before);
        if (first == some) {
            break;
        }
    }
    BodyIndex corner = first;
    for (std::size_t i = 0; i < FanCorners::kCountMax; ++i) {
        corners.add(corner);
        const BodyIndex beyond = across(nextCorner(corner));
        if (beyond == kNone) {
            break;
        }
        corner = nextCorner(beyond);
        if (corner == first) {
            break;
        }
    }
    return corners;
}

VertexRing
BodyMesh::ring(BodyIndex vertex, const ScenePoint& point, const FanCorners& corners) const noexcept
{
    const auto [column, row] = sampleOf(vertex);
    VertexRing ring;
    if (isInside(column, row)) {
        const auto add = [&](std::uint32_t c, std::uint32_t r) {
            ring.vertices[ring.count] = vertexOf({c, r});
            ring.along[ring.count++] = sampleAt(c, r) - point;
        };
        add(column, row + 1);
        add(column + 1, row + 1);
        add(column + 1, row);
        add(column, row - 1);
        add(column - 1, row - 1);
        add(column - 1, row);
        if (is_mirrored_) { // the same from the first one on, the other way around
            std::reverse(ring.vertices.begin() + 1, ring.vertices.begin() + 6);
            std::reverse(ring.along.begin() + 1, ring.along.begin() + 6);
        }
        return ring;
    }
    for (const BodyIndex corner : corners) {
        ring.vertices[ring.count++] = vertexAt(nextCorner(corner));
    }
    if (const BodyIndex end = vertexAt(previousCorner(corners.back())); end != ring.vertices[0]) {
        ring.vertices[ring.count++] = end;
    }
    for (std::size_t i = 0; i < ring.count; ++i) {
        ring.along[i] = this->vertex(ring.vertices[i]) - point;
    }
    return ring;
}

ScenePoint BodyMesh::highAbove(const ScenePoint& point) const noexcept
{
    const auto [up, height_m] = verticalAt(positions_->ellipsoid(), point);
    // Above the highest sample by more than the rounding of coordinates.
    const double rise_m = highest_m_ - height_m + 1e-3 * std::abs(highest_m_) + 1.0;
    return point + up * std::max(rise_m, 1.0);
}

// To the bit as of a map in memory, if the sample's tile is in memory.
double BodyMesh::tiledHeight(std::size_t column, std::size_t raster_row) const noexcept
{
    const auto c = static_cast<std::int32_t>(column);
    const auto r = static_cast<std::int32_t>(raster_row);
    double height_m = 0.0;
    if (const double* pinned_m =
            pins_ ? pins_->find(column, raster_row - positions_->firstRow()) : nullptr) {
        height_m = *pinned_m;
    } else if (const std::int16_t* raw = tile_type_ == SampleType::Int16
                                             ? terrain_->plainSample<std::int16_t>(c, r)
                                             : nullptr) {
        height_m = scale_.height(static_cast<double>(*raw));
    } else if (const float* value = tile_type_ == SampleType::Float32
                                        ? terrain_->plainSample<float>(c, r)
                                        : nullptr) {
        height_m = scale_.height(static_cast<double>(*value));
    } else {
        height_m = terrain_->sample(column, raster_row);
    }
    return std::clamp(exaggeration_ * height_m, nodes_->lowest(), nodes_->highest());
}

std::shared_ptr<const BodyMesh> BodyMesh::withPins(std::span<const BodyIndex> vertices) const
{
    MARSVIEW_CHECK(terrain_ != nullptr);
    std::vector<PinnedSamples::Sample> samples;
    samples.reserve(vertices.size());
    for (const BodyIndex vertex : vertices) {
        const auto [column, row] = sampleOf(vertex);
        samples.push_back({column, row, terrain_->sample(column, row + positions_->firstRow())});
    }
    auto mesh = std::make_shared<BodyMesh>(*this);
    mesh->pins_ = std::make_shared<const PinnedSamples>(columns_, samples);
    return mesh;
}

Status BodyMesh::buildTree(JobMonitor& monitor)
{
    const auto cap_faces = static_cast<std::uint32_t>(face_count_ - firstCapFace());
    const std::uint32_t cap_blocks = (cap_faces + kCapFaces - 1) / kCapFaces;
    std::vector<TriangleTree::Bounds> bounds(cell_leaves_ + cap_blocks);
    for (std::uint32_t block_row = 0; block_row * kBlockCells < rows_ - 1; ++block_row) {
        monitor.report(static_cast<double>(block_row) * kBlockCells / static_cast<double>(rows_));
        if (monitor.isCanceled()) {
            return Error{ErrorCode::Canceled, "laying the map on its body was canceled"};
        }
        for (std::uint32_t block_column = 0; block_column < blocks_per_row_; ++block_column) {
            TriangleTree::Bounds& block = bounds[block_row * blocks_per_row_ + block_column];
            const std::uint32_t row_last = std::min((block_row + 1) * kBlockCells, rows_ - 1);
            const std::uint32_t column_last =
                std::min((block_column + 1) * kBlockCells, cell_columns_);
            for (std::uint32_t row = block_row * kBlockCells; row <= row_last; ++row) {
                for (std::uint32_t column = block_column * kBlockCells; column <= column_last;
                     ++column) {
                    block.add(sampleAt(column == columns_ ? 0 : column, row));
                }
            }
        }
    }
    for (std::uint32_t block = cell_leaves_; block < bounds.size(); ++block) {
        eachCapFace(block, [&](BodyIndex face) {
            for (const ScenePoint& point : points(face)) {
                bounds[block].add(point);
            }
        });
    }
    highest_m_ = exaggeration_ * heights_->maximum(heights_->levelCount() - 1, 0, 0);
    tree_ = std::make_shared<const TriangleTree>(bounds);
    return Done{};
}

} // namespace marsview
