// The triangles of a map on its body, implied by its samples.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/body/body_positions.h"
#include "core/body/tiled_body_nodes.h"
#include "core/levels/tiled_terrain.h"
#include "core/mesh/triangle_tree.h"
#include "core/terrain/filled_heightfield.h"
#include "core/terrain/pole_cap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace marsview {

class PinnedSamples;

/// Of a vertex, a face or a corner of maps on a body: a planet at 200 m has more than 2^32 corners.
using BodyIndex = std::uint64_t;
using BodyFace = std::array<BodyIndex, 3>;

/// The corners at a vertex, as in TriangleMesh::fan().
class FanCorners {
public:
    static constexpr std::size_t kCountMax = 8;

    void add(BodyIndex corner) noexcept { corners_[count_++] = corner; }
    const BodyIndex* begin() const noexcept { return corners_.data(); }
    const BodyIndex* end() const noexcept { return corners_.data() + count_; }
    BodyIndex front() const noexcept { return corners_.front(); }
    BodyIndex back() const noexcept { return corners_[count_ - 1]; }
    std::size_t size() const noexcept { return count_; }

private:
    std::array<BodyIndex, kCountMax> corners_{};
    std::size_t count_ = 0;
};

/// A sample by its column and row in the positions. Vertices of a pole and places without a sample
/// have rows beyond the last.
struct BodySample {
    std::uint32_t column;
    std::uint32_t row;
};

/// The edges of a vertex, in the order of its corners, each of which lies between two of them:
/// after the last comes the first, unless the vertex is at the border, which has one more edge.
struct VertexRing {
    static constexpr std::size_t kCountMax = FanCorners::kCountMax + 1;
    std::array<BodyIndex, kCountMax> vertices; // at their ends
    std::array<Vec3, kCountMax> along;         // to their ends
    std::size_t count = 0;
};

/// The same queries as TriangleMesh, without storing a triangle: each cell of the grid is cut from
/// sample (column, row) to (column + 1, row + 1), with vertices at the samples' positions on the
/// body and straight edges between them. The columns of a map around the body meet, and triangles
/// from the last circle of samples to the pole close it (PoleCap). A cell of size c lies below the
/// curved surface by up to c² / 8R.
///
/// The height of a pole is the mean of up to eight evenly spaced samples of the circle, or
/// of the row that lies at the pole, if the map has one.
///
/// Faces 2i and 2i + 1 are the lower and the upper one of cell i, those of the poles come last.
/// Vertex i is sample (i mod columns, i div columns) of the positions; those of the poles come
/// last. A *corner* is 3 × face + 0, 1 or 2, as in TriangleMesh. Allocates nothing after
/// construction. Of a map in memory it is immutable, for any thread, and takes 60 bytes per 64
/// cells in addition to the samples. Of a map in tiles (TiledBodyMesh) it is as constant as its
/// terrain, and for the thread that has that.
class BodyMesh {
public:
    using Index = BodyIndex;
    static constexpr BodyIndex kNone = std::numeric_limits<BodyIndex>::max();
    static constexpr double kCoordinateMaxM = 1e12;

    /// Heights are multiplied by `exaggeration`, above 0. Errors: those of BodyPositions; TooLarge
    /// above 700 million cells; Canceled. Takes about 20 ns per sample.
    static Result<std::shared_ptr<const BodyMesh>>
    build(std::shared_ptr<const FilledHeightfield> heights,
          const Georeference& georeference,
          double exaggeration,
          JobMonitor& monitor,
          const std::optional<Ellipsoid>& scene = std::nullopt);

    std::size_t vertexCount() const noexcept { return vertex_count_; }
    std::size_t faceCount() const noexcept { return face_count_; }
    const BodyPositions& positions() const noexcept { return *positions_; }
    const Ellipsoid& ellipsoid() const noexcept { return positions_->ellipsoid(); }
    double exaggeration() const noexcept { return exaggeration_; }
    std::uint32_t cellColumns() const noexcept { return cell_columns_; }
    std::uint32_t cellRows() const noexcept { return rows_ - 1; }
    bool isTiled() const noexcept { return nodes_ != nullptr; }
    /// Of a map in tiles; otherwise null.
    const TileHeights* tileHeights() const noexcept
    {
        return nodes_ ? &nodes_->heights() : nullptr;
    }
    /// Of a map in tiles: the samples that do not depend on them; null without any.
    const std::shared_ptr<const PinnedSamples>& pins() const noexcept { return pins_; }
    /// The same map in tiles with the samples that these vertices depend on pinned, with the
    /// heights that its terrain has now.
    std::shared_ptr<const BodyMesh> withPins(std::span<const BodyIndex> vertices) const;

    ScenePoint vertex(BodyIndex index) const noexcept { return pointOf(sampleOf(index)); }
    BodyFace face(BodyIndex index) const noexcept
    {
        const std::array<BodySample, 3> at = samplesOf(index);
        return {vertexOf(at[0]), vertexOf(at[1]), vertexOf(at[2])};
    }
    std::array<ScenePoint, 3> points(BodyIndex face) const noexcept
    {
        const std::array<BodySample, 3> at = samplesOf(face);
        return {pointOf(at[0]), pointOf(at[1]), pointOf(at[2])};
    }
    Vec3 normal(BodyIndex face) const noexcept
    {
        const auto [a, b, c] = points(face);
        return cross(b - a, c - a);
    }
    BodyIndex across(BodyIndex corner) const noexcept;
    FanCorners fan(BodyIndex vertex) const noexcept;
    /// `corners` is fan(vertex), `point` is its position.
    VertexRing
    ring(BodyIndex vertex, const ScenePoint& point, const FanCorners& corners) const noexcept;
    bool isAtBorder(BodyIndex vertex) const noexcept
    {
        return across(previousCorner(fan(vertex).front())) == kNone;
    }
    BodyIndex vertexAt(BodyIndex corner) const noexcept
    {
        return vertexOf(samplesOf(corner / 3)[corner % 3]);
    }
    /// The vertices of the edge opposite a corner, from the next corner to the previous one.
    std::array<BodyIndex, 2> edgeEnds(BodyIndex corner) const noexcept
    {
        const std::array<BodySample, 3> at = samplesOf(corner / 3);
        const BodyIndex number = corner % 3;
        return {vertexOf(at[number == 2 ? 0 : number + 1]),
                vertexOf(at[number == 0 ? 2 : number - 1])};
    }
    /// The lesser of the corners opposite the edge between two vertices of a face.
    BodyIndex cornerAtEdge(BodyIndex a, BodyIndex b) const noexcept;

    // Faces by their samples: over the edges of cells that do not lie across the seam, a walk finds
    // the next vertex by adding, without a division by the number of columns.

    /// The samples of a face's corners.
    std::array<BodySample, 3> samplesOf(BodyIndex face) const noexcept
    {
        const auto [column, row] = cellOf(face / 2);
        if (row >= rows_ - 1) {
            return samplesOfCap(face);
        }
        const std::uint32_t next = nextColumn(column);
        const bool is_upper = face % 2 == 1;
        const BodySample far{next, row + 1};
        const BodySample third = is_upper ? BodySample{next, row} : BodySample{column, row + 1};
        const bool is_far_second = is_upper != is_mirrored_;
        return {{{column, row}, is_far_second ? far : third, is_far_second ? third : far}};
    }
    BodyIndex vertexOf(const BodySample& sample) const noexcept
    {
        return BodyIndex{sample.row} * columns_ + sample.column;
    }
    ScenePoint pointOf(const BodySample& sample) const noexcept
    {
        return sample.row < rows_ ? sampleAt(sample.column, sample.row)
                                  : pointOfCap(vertexOf(sample));
    }
    /// The samples of a face if step() finds its neighbors from them; otherwise three for which it
    /// finds none: those of a pole's triangles, and of cells across the seam.
    std::array<BodySample, 3> stepsFrom(BodyIndex face) const noexcept
    {
        constexpr BodySample kNowhere{std::uint32_t{1} << 30U, 0};
        const std::array<BodySample, 3> at = samplesOf(face);
        const bool is_plain = face < firstCapFace() && at[0].column + 1 != columns_;
        return is_plain ? at : std::array{kNowhere, kNowhere, kNowhere};
    }
    /// From a face's corner over the edge between the two others: the far corner of the next face,
    /// in the same cell or in the one beside it. Not isSample() if that face must be found by
    /// across().
    static BodySample
    step(const BodySample& from, const BodySample& a, const BodySample& b) noexcept
    {
        return {a.column + b.column - from.column, a.row + b.row - from.row};
    }
    bool isSample(const BodySample& sample) const noexcept
    {
        return sample.column < columns_ && sample.row < rows_;
    }
    /// The corner at the first of a face's samples, which are in the order of its corners and from
    /// stepsFrom() or step().
    BodyIndex cornerOf(const std::array<BodySample, 3>& at) const noexcept
    {
        const std::uint32_t column = std::min({at[0].column, at[1].column, at[2].column});
        const std::uint32_t row = std::min({at[0].row, at[1].row, at[2].row});
        const bool is_upper = at[0].row + at[1].row + at[2].row == 3 * row + 1;
        const bool is_right = at[0].column > column;
        const bool is_below = at[0].row > row;
        return cellCorner(column, row, is_upper,
                          is_right != is_below ? kThird
                          : is_right           ? kFar
                                               : kFirst);
    }

    bool hasVoids() const noexcept
    {
        return heights_ ? heights_->heightfield().samples().hasVoids()
                        : nodes_->heights().layout().has_voids;
    }
    /// Whether a sample of the face is void.
    bool isFilled(BodyIndex face) const noexcept
    {
        const std::array<BodySample, 3> at = samplesOf(face);
        return std::any_of(at.begin(), at.end(), [this](const BodySample& sample) {
            const auto [column, row] = sample.row < rows_ ? sample : circleSample(vertexOf(sample));
            const std::size_t raster_row = row + positions_->firstRow();
            return heights_ ? heights_->isVoid(column, raster_row)
                            : terrain_->isVoid(column, raster_row);
        });
    }

    /// Calls visit(face) with the faces of the cells in the outermost rows and columns.
    template <typename F>
    void eachFaceAtBorder(F&& visit) const
    {
        for (std::uint32_t row = 0; row + 1 < rows_; ++row) {
            const bool is_whole = row == 0 || row + 2 == rows_;
            const std::uint32_t step = is_whole ? 1 : std::max<std::uint32_t>(cell_columns_ - 1, 1);
            for (std::uint32_t column = 0; column < cell_columns_; column += step) {
                const BodyIndex cell = BodyIndex{row} * cell_columns_ + column;
                visit(2 * cell);
                visit(2 * cell + 1);
            }
        }
    }

    /// Calls visit(vertex) with the vertices at the border, and with some vertex of a map without
    /// one.
    template <typename F>
    void eachVertexAtBorder(F&& visit) const
    {
        visit(BodyIndex{0});
        for (std::uint32_t row = 0; row < rows_; ++row) {
            const bool is_whole = row == 0 || row + 1 == rows_;
            for (std::uint32_t column = 0; column < columns_;
                 column += is_whole ? 1 : columns_ - 1) {
                const BodyIndex vertex = vertexOf({column, row});
                if (vertex != 0 && isAtBorder(vertex)) {
                    visit(vertex);
                }
            }
        }
    }

    static BodyIndex faceOf(BodyIndex corner) noexcept { return corner / 3; }
    static BodyIndex nextCorner(BodyIndex corner) noexcept
    {
        return corner % 3 == 2 ? corner - 2 : corner + 1;
    }
    static BodyIndex previousCorner(BodyIndex corner) noexcept
    {
        return corner % 3 == 0 ? corner + 2 : corner - 1;
    }

    /// Where a vertical path down to `point` begins above all of the map.
    ScenePoint highAbove(const ScenePoint& point) const noexcept;

    /// TriangleTree's queries: its items are blocks of cells. In place of alongSegment() and
    /// nearestFirst(), pointsAlong() and pointsNearest() call visit(face, points, t_max or limit).
    class Tree {
    public:
        const ScenePoint& middle() const noexcept { return mesh_.tree_->middle(); }
        template <typename F>
        void
        pointsAlong(const Vec3& from, const Vec3& along, double slack, F&& visit) const noexcept
        {
            const Beam beam(*mesh_.tree_, from, along, slack);
            mesh_.tree_->alongSegment(from, along, slack, [&](std::uint32_t leaf, double& t_max) {
                mesh_.eachFaceIn(leaf, beam.until(t_max), beam,
                                 [&](BodyIndex face, const std::array<ScenePoint, 3>& at) {
                                     visit(face, at, t_max);
                                 });
            });
        }
        template <typename F>
        void pointsNearest(const ScenePoint& point, F&& visit) const noexcept
        {
            mesh_.tree_->nearestFirst(point, [&](std::uint32_t leaf, double& limit) {
                const Near near(point, limit);
                mesh_.eachFaceIn(leaf, near, near,
                                 [&](BodyIndex face, const std::array<ScenePoint, 3>& at) {
                                     visit(face, at, limit);
                                 });
            });
        }
        template <typename F>
        void inBox(const ScenePoint& low, const ScenePoint& high, F&& visit) const noexcept
        {
            const Box box{low, high};
            mesh_.tree_->inBox(low, high,
                               [&](std::uint32_t leaf) { mesh_.eachFace(leaf, box, visit); });
        }

    private:
        friend class BodyMesh;
        explicit Tree(const BodyMesh& mesh)
            : mesh_(mesh)
        {}
        const BodyMesh& mesh_;
    };
    Tree tree() const noexcept { return Tree(*this); }

private:
    friend class TiledBodyMesh;

    using Cells = TiledBodyNodes::Cells;
    static constexpr std::uint32_t kBlockCells = TiledBodyNodes::kBlockCells; // per side
    // What a corner of a cell's face is, whatever its number: the sample of the cell, the one a row
    // and a column further, and the third.
    enum Role : std::uint8_t { kFirst, kFar, kThird };

    BodyMesh(std::shared_ptr<const BodyPositions> positions,
             const ElevationScale& scale,
             double exaggeration);

    ScenePoint sampleAt(std::uint32_t column, std::uint32_t row) const noexcept
    {
        return positions_->at(column, row, heightAt(column, row));
    }
    // In scene meters. Samples without voids are read by their type.
    double heightAt(std::uint32_t column, std::uint32_t row) const noexcept
    {
        return rasterHeight(column, row + positions_->firstRow());
    }
    double rasterHeight(std::uint32_t column, std::size_t raster_row) const noexcept
    {
        const std::size_t index = raster_row * raster_columns_ + column;
        if (int16_ != nullptr) {
            return exaggeration_ * scale_.height(static_cast<double>(int16_[index]));
        }
        if (float_ != nullptr) {
            return exaggeration_ * scale_.height(static_cast<double>(float_[index]));
        }
        return heights_ ? exaggeration_ * heights_->sample(column, raster_row)
                        : tiledHeight(column, raster_row);
    }
    double tiledHeight(std::size_t column, std::size_t raster_row) const noexcept;
    bool isInside(std::uint32_t column, std::uint32_t row) const noexcept
    {
        return row > 0 && row + 1 < rows_ && column > 0 && column + 1 < columns_;
    }
    std::uint32_t cornerNumber(bool is_upper, Role role) const noexcept
    {
        return role == kFirst ? 0U : (role == kFar) == (is_upper != is_mirrored_) ? 1U : 2U;
    }
    Role roleOf(bool is_upper, std::uint32_t number) const noexcept
    {
        return number == 0U ? kFirst : (number == 1U) == (is_upper != is_mirrored_) ? kFar : kThird;
    }
    BodyIndex cellCorner(std::uint32_t cell_column,
                         std::uint32_t cell_row,
                         bool is_upper,
                         Role role) const noexcept
    {
        const BodyIndex cell = BodyIndex{cell_row} * cell_columns_ + cell_column;
        return 3 * (2 * cell + (is_upper ? 1U : 0U)) + cornerNumber(is_upper, role);
    }
    std::uint32_t nextColumn(std::uint32_t column) const noexcept
    {
        return column + 1 == columns_ ? 0 : column + 1;
    }
    // The sample of a cell, also of those that count the faces of the poles: rows beyond the last.
    BodySample cellOf(BodyIndex cell) const noexcept
    {
        const BodyIndex row = cell / cell_columns_;
        return {static_cast<std::uint32_t>(cell - row * cell_columns_),
                static_cast<std::uint32_t>(row)};
    }
    BodySample sampleOf(BodyIndex vertex) const noexcept
    {
        const BodyIndex row = vertex / columns_;
        return {static_cast<std::uint32_t>(vertex - row * columns_),
                static_cast<std::uint32_t>(row)};
    }
    BodyIndex firstCapFace() const noexcept { return BodyIndex{2} * cell_columns_ * (rows_ - 1); }

    /// What closes a pole.
    struct Cap {
        BodyIndex first_face = 0;
        BodyIndex first_vertex = 0; // that is not of the circle
        std::uint32_t row = 0;      // of the circle
        std::size_t pole_row = 0;   // of the raster: its samples give the height of the pole
        bool exists = false;
        bool is_turned = false;         // its second and third corner are exchanged
        std::optional<ScenePoint> pole; // unless it depends on tiles
    };
    const Cap& capOf(BodyIndex face) const noexcept
    {
        return caps_[1].exists && face >= caps_[1].first_face ? caps_[1] : caps_[0];
    }
    const Cap& capOfVertex(BodyIndex vertex) const noexcept
    {
        return caps_[1].exists && vertex >= caps_[1].first_vertex ? caps_[1] : caps_[0];
    }
    // A vertex of the cap's own numbers, and back.
    BodyIndex capVertex(const Cap& cap, std::uint32_t number) const noexcept
    {
        return number < columns_ ? vertexOf({number, cap.row})
                                 : cap.first_vertex + (number - columns_);
    }
    PoleCap::Place placeInCap(const Cap& cap, BodyIndex vertex) const noexcept
    {
        return cap_shape_.placeOf(columns_ + static_cast<std::uint32_t>(vertex - cap.first_vertex));
    }
    // The sample of the circle that a vertex of a pole lies below.
    BodySample circleSample(BodyIndex vertex) const noexcept
    {
        const Cap& cap = capOfVertex(vertex);
        return {placeInCap(cap, vertex).sample, cap.row};
    }
    std::array<BodySample, 3> samplesOfCap(BodyIndex face) const noexcept;
    ScenePoint pointOfCap(BodyIndex vertex) const noexcept;
    ScenePoint poleOf(const Cap& cap) const noexcept;
    ScenePoint poleAt(const Cap& cap, double height_m) const noexcept;
    // From a corner's number in the cap's shape to the mesh, and back.
    BodyIndex capCorner(const Cap& cap, std::uint32_t corner) const noexcept
    {
        return 3 * (cap.first_face + corner / 3) + turnedNumber(cap, corner % 3);
    }
    static std::uint32_t turnedNumber(const Cap& cap, std::uint32_t number) noexcept
    {
        return cap.is_turned && number != 0U ? 3U - number : number;
    }
    BodyIndex acrossInCap(const Cap& cap, BodyIndex corner) const noexcept;
    BodyIndex cornerOfCap(BodyIndex vertex) const noexcept;
    TriangleTree::Bounds capBounds(std::uint32_t leaf) const noexcept;

    // The blocks of cells in a leaf of the tree, which has no triangles of a pole: one of a map in
    // memory, those that `nodes` may meet of a map in tiles.
    template <typename Nodes, typename F>
    void eachBlock(std::uint32_t leaf, const Nodes& nodes, F&& visit) const noexcept
    {
        if (nodes_) {
            nodes_->eachBlock(leaf, nodes, visit);
            return;
        }
        const std::uint32_t column = leaf % blocks_per_row_ * kBlockCells;
        const std::uint32_t row = leaf / blocks_per_row_ * kBlockCells;
        visit(Cells{column, row, std::min(kBlockCells, cell_columns_ - column),
                    std::min(kBlockCells, rows_ - 1 - row)});
    }
    template <typename F>
    void eachCapFace(std::uint32_t leaf, F&& visit) const noexcept
    {
        const BodyIndex begin = firstCapFace() + BodyIndex{leaf - cell_leaves_} * kCapFaces;
        const BodyIndex end = std::min<BodyIndex>(begin + kCapFaces, face_count_);
        for (BodyIndex face = begin; face < end; ++face) {
            visit(face);
        }
    }
    template <typename Nodes, typename F>
    void eachFace(std::uint32_t leaf, const Nodes& nodes, F&& visit) const noexcept
    {
        if (leaf >= cell_leaves_) {
            eachCapFace(leaf, visit);
            return;
        }
        eachBlock(leaf, nodes, [&](const Cells& cells) {
            for (std::uint32_t r = cells.row; r < cells.row + cells.rows; ++r) {
                const BodyIndex begin = 2 * (BodyIndex{r} * cell_columns_ + cells.column);
                for (BodyIndex face = begin; face < begin + BodyIndex{2} * cells.columns; ++face) {
                    visit(face);
                }
            }
        });
    }
    static constexpr std::uint32_t kCapFaces = 8; // of a leaf

    /// A straight line, as points are seen along it: sheared along its longest axis, it is the
    /// origin.
    class Beam {
    public:
        Beam(const TriangleTree& tree, const Vec3& from, const Vec3& along, double slack) noexcept
            : start_(tree.middle() + from)
        {
            const double x = std::abs(along.x);
            const double y = std::abs(along.y);
            const double z = std::abs(along.z);
            axis_ = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
            const Vec3 turned = turn(along);
            length_m_ = turned.z;
            across_ = turned.x / turned.z;
            down_ = turned.y / turned.z;
            // Far more than the rounding of points, and far less than a cell.
            constexpr double kRounding = 256.0 * std::numeric_limits<double>::epsilon();
            margin_m_ = 2.0 * slack + kRounding * (tree.reach() + length(from));
        }
        using Seen = std::array<double, 2>; // across the line
        Seen seen(const ScenePoint& point) const noexcept
        {
            const Vec3 p = turn(point - start_);
            return {p.x - across_ * p.z, p.y - down_ * p.z};
        }
        template <typename Range>
        bool mayMeet(const Range& range) const noexcept
        {
            const auto contains = [this](const std::pair<double, double>& low_high) {
                return low_high.first <= margin_m_ && low_high.second >= -margin_m_;
            };
            return contains(range(0)) && contains(range(1));
        }

        /// Its part from the start to a share of its length, for nodes.
        struct Part {
            const Beam& beam;
            const double& share;

            bool mayMeetBox(const TiledBodyNodes::Corners& corners, double beyond_m) const noexcept
            {
                TriangleTree::Bounds seen;
                for (const ScenePoint& corner : corners) {
                    const Vec3 p = beam.turn(corner - beam.start_);
                    seen.add({p.x - beam.across_ * p.z, p.y - beam.down_ * p.z, p.z});
                }
                const double along_m = beam.margin_m_ + beyond_m;
                const double beside_m = along_m + beyond_m; // the shear is at most one to one
                const double end_m = share * beam.length_m_;
                return seen.low.x <= beside_m && seen.high.x >= -beside_m &&
                       seen.low.y <= beside_m && seen.high.y >= -beside_m &&
                       seen.low.z <= std::max(end_m, 0.0) + along_m &&
                       seen.high.z >= std::min(end_m, 0.0) - along_m;
            }
        };
        Part until(const double& share) const noexcept { return {*this, share}; }

    private:
        Vec3 turn(const Vec3& v) const noexcept
        {
            return axis_ == 2 ? v : axis_ == 0 ? Vec3{v.y, v.z, v.x} : Vec3{v.z, v.x, v.y};
        }

        ScenePoint start_;
        int axis_;
        double length_m_; // along the axis
        double across_;
        double down_;
        double margin_m_;
    };

    /// A point, with the squared distance to the nearest place found so far.
    class Near {
    public:
        Near(const ScenePoint& point, const double& limit) noexcept
            : point_(point)
            , limit_(limit)
        {}
        using Seen = std::array<double, 3>;
        Seen seen(const ScenePoint& point) const noexcept
        {
            const Vec3 to = point - point_;
            return {to.x, to.y, to.z};
        }
        template <typename Range>
        bool mayMeet(const Range& range) const noexcept
        {
            double least = 0.0;
            for (std::size_t i = 0; i < 3; ++i) {
                const auto [low, high] = range(i);
                const double beyond = std::max({low, -high, 0.0});
                least += beyond * beyond;
            }
            constexpr double kRounding = 1e-12; // more than that of distances
            return (1.0 - kRounding) * least <= limit_;
        }
        bool mayMeetBox(const TiledBodyNodes::Corners& corners, double beyond_m) const noexcept
        {
            std::array<std::pair<double, double>, 3> ranges;
            ranges.fill({std::numeric_limits<double>::infinity(),
                         -std::numeric_limits<double>::infinity()});
            for (const ScenePoint& corner : corners) {
                const Seen to = seen(corner);
                for (std::size_t i = 0; i < ranges.size(); ++i) {
                    ranges[i] = {std::min(ranges[i].first, to[i] - beyond_m),
                                 std::max(ranges[i].second, to[i] + beyond_m)};
                }
            }
            return mayMeet([&](std::size_t i) { return ranges[i]; });
        }

    private:
        const ScenePoint& point_;
        const double& limit_;
    };

    struct Box {
        ScenePoint low;
        ScenePoint high;

        bool mayMeetBox(const TiledBodyNodes::Corners& corners, double beyond_m) const noexcept
        {
            TriangleTree::Bounds bounds;
            for (const ScenePoint& corner : corners) {
                bounds.add(corner);
            }
            const Vec3 around{beyond_m, beyond_m, beyond_m};
            const ScenePoint from = bounds.low - around;
            const ScenePoint to = bounds.high + around;
            return from.x <= high.x && to.x >= low.x && from.y <= high.y && to.y >= low.y &&
                   from.z <= high.z && to.z >= low.z;
        }
    };

    // The faces of a leaf that may be met.
    template <typename Nodes, typename Filter, typename F>
    void eachFaceIn(std::uint32_t leaf,
                    const Nodes& nodes,
                    const Filter& filter,
                    F&& visit) const noexcept
    {
        if (leaf >= cell_leaves_) {
            eachCapFace(leaf, [&](BodyIndex face) { visit(face, points(face)); });
            return;
        }
        eachBlock(leaf, nodes, [&](const Cells& cells) { eachFaceOfCells(cells, filter, visit); });
    }
    // The faces of those cells of a block that `filter` wants from what it sees of their corners.
    // Each point is computed and seen once.
    template <typename Filter, typename F>
    void eachFaceOfCells(const Cells& cells, const Filter& filter, F&& visit) const noexcept
    {
        constexpr std::uint32_t kSide = kBlockCells + 1;
        const auto [column, row, columns, rows] = cells;
        std::array<ScenePoint, kSide * kSide> at;
        std::array<typename Filter::Seen, kSide * kSide> seen;
        for (std::uint32_t r = 0; r <= rows; ++r) {
            for (std::uint32_t c = 0; c <= columns; ++c) {
                const std::uint32_t there = column + c;
                at[r * kSide + c] = sampleAt(there == columns_ ? 0 : there, row + r);
                seen[r * kSide + c] = filter.seen(at[r * kSide + c]);
            }
        }
        for (std::uint32_t r = 0; r < rows; ++r) {
            for (std::uint32_t c = 0; c < columns; ++c) {
                const std::uint32_t first = r * kSide + c;
                const std::uint32_t far = first + kSide + 1;
                // The range of what is seen of the corners, by coordinate.
                const auto range = [&](std::size_t i) {
                    return std::minmax(
                        {seen[first][i], seen[first + 1][i], seen[first + kSide][i], seen[far][i]});
                };
                if (!filter.mayMeet(range)) {
                    continue;
                }
                const BodyIndex lower = 2 * (BodyIndex{row + r} * cell_columns_ + column + c);
                const auto offer = [&](BodyIndex face, std::uint32_t third, bool is_far_second) {
                    visit(face, std::array{at[first], at[is_far_second ? far : third],
                                           at[is_far_second ? third : far]});
                };
                offer(lower, first + kSide, is_mirrored_);
                offer(lower + 1, first + 1, !is_mirrored_);
            }
        }
    }

    Status buildTree(JobMonitor& monitor);

    std::shared_ptr<const FilledHeightfield> heights_; // of a map in memory
    std::shared_ptr<const TiledBodyNodes> nodes_;      // these: of a map in tiles
    std::shared_ptr<const TiledTerrain> terrain_;
    std::shared_ptr<const PinnedSamples> pins_; // of these tiles, or null
    SampleType tile_type_ = SampleType::Int16;
    std::shared_ptr<const BodyPositions> positions_;
    double exaggeration_;
    ElevationScale scale_;
    const std::int16_t* int16_ = nullptr; // the samples, if they have this type and no voids
    const float* float_ = nullptr;
    std::size_t raster_columns_ = 0; // of these
    std::uint32_t columns_;
    std::uint32_t rows_;
    std::uint32_t cell_columns_;
    bool is_mirrored_;
    PoleCap cap_shape_;
    std::array<Cap, 2> caps_; // at the first and the last row
    std::size_t face_count_;
    std::size_t vertex_count_;
    std::uint32_t blocks_per_row_;
    std::uint32_t cell_leaves_; // of the tree; those of the poles come last
    double highest_m_ = 0.0;    // exaggerated
    std::shared_ptr<const TriangleTree> tree_;
};

} // namespace marsview
