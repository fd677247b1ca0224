#include "core/body/body_mesh.h"

#include "core/base/check.h"
#include "core/body/pinned_samples.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
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
    , cap_shape_(columns_)
    , face_count_(std::size_t{2} * cell_columns_ * (rows_ - 1))
    , vertex_count_(std::size_t{columns_} * rows_)
    , blocks_per_row_((cell_columns_ + kBlockCells - 1) / kBlockCells)
    , cell_leaves_(blocks_per_row_ * ((rows_ - 1 + kBlockCells - 1) / kBlockCells))
{
    const std::array<bool, 2> closes{positions_->closesAtFirstRow(), positions_->closesAtLastRow()};
    const std::size_t first_row = positions_->firstRow();
    for (std::size_t i = 0; i < caps_.size(); ++i) {
        if (closes[i]) {
            const std::size_t circle_row = first_row + (i == 0 ? 0 : rows_ - 1);
            const bool has_row_at_pole = positions_->hasRowAtPole(i == 0);
            caps_[i] = {.first_face = face_count_,
                        .first_vertex = vertex_count_,
                        .row = i == 0 ? 0 : rows_ - 1,
                        .pole_row = !has_row_at_pole ? circle_row
                                    : i == 0         ? circle_row - 1
                                                     : circle_row + 1,
                        .exists = true,
                        .is_turned = is_mirrored_ != (i == 1),
                        .pole = std::nullopt};
            face_count_ += cap_shape_.faceCount();
            vertex_count_ += cap_shape_.innerVertexCount();
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
               : caps_[1].exists   ? capCorner(caps_[1], cap_shape_.cornerAtCircle(column))
                                   : kNone;
    case kFar:
        break;
    }
    if (is_upper) { // the side along the row
        return row > 0           ? cellCorner(column, row - 1, false, kFirst)
               : caps_[0].exists ? capCorner(caps_[0], cap_shape_.cornerAtCircle(column))
                                 : kNone;
    }
    return column > 0            ? cellCorner(column - 1, row, true, kFirst)
           : positions_->wraps() ? cellCorner(cell_columns_ - 1, row, true, kFirst)
                                 : kNone;
}

std::array<BodySample, 3> BodyMesh::samplesOfCap(BodyIndex face) const noexcept
{
    const Cap& cap = capOf(face);
    const std::array<std::uint32_t, 3> numbers =
        cap_shape_.face(static_cast<std::uint32_t>(face - cap.first_face));
    std::array<BodySample, 3> at;
    for (std::uint32_t i = 0; i < 3; ++i) {
        at[turnedNumber(cap, i)] = sampleOf(capVertex(cap, numbers[i]));
    }
    return at;
}

BodyIndex BodyMesh::acrossInCap(const Cap& cap, BodyIndex corner) const noexcept
{
    const auto face = static_cast<std::uint32_t>(corner / 3 - cap.first_face);
    const auto number = static_cast<std::uint32_t>(corner % 3);
    const PoleCap::Beyond beyond = cap_shape_.across(3 * face + turnedNumber(cap, number));
    return !beyond.is_outside ? capCorner(cap, beyond.at)
           : cap.row == 0     ? cellCorner(beyond.at, 0, true, kFar)
                              : cellCorner(beyond.at, rows_ - 2, false, kFirst);
}

ScenePoint BodyMesh::pointOfCap(BodyIndex vertex) const noexcept
{
    const Cap& cap = capOfVertex(vertex);
    const auto [column, share] = placeInCap(cap, vertex);
    const ScenePoint pole = cap.pole ? *cap.pole : poleOf(cap);
    return pole + (sampleAt(column, cap.row) - pole) * share;
}

ScenePoint BodyMesh::poleOf(const Cap& cap) const noexcept
{
    double sum_m = 0.0;
    for (std::uint32_t i = 0; i < cap_shape_.poleSampleCount(); ++i) {
        sum_m += rasterHeight(cap_shape_.poleSample(i), cap.pole_row);
    }
    return poleAt(cap, sum_m / cap_shape_.poleSampleCount());
}

ScenePoint BodyMesh::poleAt(const Cap& cap, double height_m) const noexcept
{
    const double z = positions_->ellipsoid().polar_m + height_m;
    return {0.0, 0.0, positions_->at(0, cap.row, 0.0).z < 0.0 ? -z : z};
}

BodyIndex BodyMesh::cornerAtEdge(BodyIndex a, BodyIndex b) const noexcept
{
    // The first end is further up or, in its row, further left.
    const BodyIndex first = std::min(a, b);
    const auto [column, row] = sampleOf(first);
    const BodyIndex step = std::max(a, b) - first;
    const bool is_of_cells = first + step < BodyIndex{columns_} * rows_;
    if (is_of_cells && column + 1 < columns_) {
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

BodyIndex BodyMesh::cornerOfCap(BodyIndex vertex) const noexcept
{
    const Cap& cap = capOfVertex(vertex);
    const auto number = columns_ + static_cast<std::uint32_t>(vertex - cap.first_vertex);
    return capCorner(cap, cap_shape_.cornerAt(number));
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
    const BodyIndex some = row >= rows_      ? cornerOfCap(vertex)
                           : row + 1 < rows_ ? has_cell_right
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
    if (const double* pinned_m = pins_ ? pins_->find(column, raster_row) : nullptr) {
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
    std::set<std::pair<std::size_t, std::uint32_t>> wanted; // row of the raster, column
    for (const BodyIndex vertex : vertices) {
        BodySample sample = sampleOf(vertex);
        if (sample.row >= rows_) {
            const Cap& cap = capOfVertex(vertex);
            for (std::uint32_t i = 0; i < cap_shape_.poleSampleCount(); ++i) {
                wanted.emplace(cap.pole_row, cap_shape_.poleSample(i));
            }
            sample = circleSample(vertex);
        }
        wanted.emplace(sample.row + positions_->firstRow(), sample.column);
    }
    std::vector<PinnedSamples::Sample> samples;
    samples.reserve(wanted.size());
    for (const auto& [row, column] : wanted) {
        samples.push_back({column, static_cast<std::uint32_t>(row), terrain_->sample(column, row)});
    }
    auto mesh = std::make_shared<BodyMesh>(*this);
    mesh->pins_ = std::make_shared<const PinnedSamples>(columns_, samples);
    return mesh;
}

TriangleTree::Bounds BodyMesh::capBounds(std::uint32_t leaf) const noexcept
{
    TriangleTree::Bounds bounds;
    eachCapFace(leaf, [&](BodyIndex face) {
        for (const BodySample& sample : samplesOf(face)) {
            if (!nodes_) {
                bounds.add(pointOf(sample));
                continue;
            }
            // Wherever its sample and the pole may be.
            const BodyIndex vertex = vertexOf(sample);
            const bool is_of_circle = sample.row < rows_;
            const Cap& cap = capOf(face);
            const auto [column, share] =
                is_of_circle ? PoleCap::Place{sample.column, 1.0} : placeInCap(cap, vertex);
            for (const double height_m : {nodes_->lowest(), nodes_->highest()}) {
                for (const double pole_m : {nodes_->lowest(), nodes_->highest()}) {
                    const ScenePoint pole = poleAt(cap, pole_m);
                    bounds.add(pole + (positions_->at(column, cap.row, height_m) - pole) * share);
                }
            }
        }
    });
    return bounds;
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
    for (Cap& cap : caps_) {
        if (cap.exists) {
            cap.pole = poleOf(cap);
        }
    }
    for (std::uint32_t block = cell_leaves_; block < bounds.size(); ++block) {
        bounds[block] = capBounds(block);
    }
    highest_m_ = exaggeration_ * heights_->maximum(heights_->levelCount() - 1, 0, 0);
    tree_ = std::make_shared<const TriangleTree>(bounds);
    return Done{};
}

} // namespace marsview
