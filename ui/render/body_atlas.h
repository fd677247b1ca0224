// The vertices of the nodes that are drawn on a body, at the driver's.
#pragma once

#include "core/body/body_grid.h"
#include "core/body/body_locator.h"
#include "core/geo/scene_frame.h"
#include "core/terrain/drawn_surface.h"
#include "core/view/camera.h"
#include "ui/render/lru_slots.h"
#include "ui/render/opengl/gl_objects.h"
#include "ui/render/opengl/gl_program.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// Positions as floats that resolve a hundredth of a millimeter per 300 km of the body's radius:
/// cubes of a lattice, counted, and a position within one.
struct BodyLattice {
    double side_m = 1.0; // a power of two

    /// For points as far from the body's center.
    static BodyLattice reaching(double distance_m);

    struct Split {
        std::array<double, 3> cube;   // whole numbers
        std::array<double, 3> within; // meters
    };
    Split split(const Vec3& point) const noexcept;
};

/// A map that covers another one on the body.
struct BodyCover {
    std::shared_ptr<const BodyLocator> locator;
    double last_column = 1.0; // of its raster
    double last_row = 1.0;
    double width_m = 0.0;
    double height_m = 0.0;

    BodyCover(std::shared_ptr<const BodyLocator> located, std::size_t columns, std::size_t rows);

    /// Shares of the map by which it and a map with such cells are both drawn at an edge: as much
    /// as places on it may be off, and a little more.
    struct Overlap {
        double columns = 0.0;
        double rows = 0.0;
    };
    Overlap overlap(double cell_m) const;
    /// Where a place far outside lies in the plane of the map's middle, as placeOnCover(); nothing
    /// near or on the map, or if it is not small.
    std::optional<std::array<float, 3>> farPlace(const Vec3& point) const;
    /// The width of a turn around the body, of that of the raster; 0 if it does not go around.
    double turn() const
    {
        return locator->grid().closes()
                   ? static_cast<double>(locator->grid().columns() - 1) / last_column
                   : 0.0;
    }

private:
    double sizeM() const { return std::max(width_m, height_m); }

    Vec3 middle_;
    Vec3 per_column_; // shares of the map a meter from its middle
    Vec3 per_row_;
};

/// A map as it is drawn on its body.
struct BodySubject {
    const DrawnSurface* surface = nullptr;
    const BodyGrid* grid = nullptr;
    SceneFrame frame; // that relief is made in
    BodyLattice lattice;
    double exaggeration = 1.0;
    std::array<float, 2> pole_heights_m{}; // over the base: at the first and the last row
    std::vector<BodyCover> covers{};       // the lowest first, at most kCoversMax
};

/// Where a point lies on a cover: shares of the way from its first to its last sample, and 1; or
/// zeros where it is far from it. `start` is where the last point was, and becomes where this is.
std::array<float, 3>
placeOnCover(const BodyCover& cover, const Vec3& point, std::optional<GridPoint>& start);

/// The mean heights over the base of a map's first and last row, from some of their samples that
/// are always in memory.
std::array<float, 2> poleHeights(const DrawnSurface& surface, std::size_t top_level);

/// Textures of squares of 33 × 33 vertices. Filled on demand, in some 100 µs a node.
class BodyAtlas {
public:
    BodyAtlas(std::size_t slot_columns, std::size_t slot_rows);

    void beginRound() { slots_.beginRound(); }
    /// Makes room for the places of vertices on so many covers.
    void reserveCovers(std::size_t count);
    /// As HeightAtlas::place().
    std::optional<NodeSlots::Place> place(const LayerNode& node,
                                          const BodySubject& subject,
                                          std::uint64_t generation,
                                          std::vector<TileId>& missing);

    /// Textures by unit from `first`: positions within a cube and heights over the base; cubes; and
    /// what a step to the relief's east and north is on the body.
    static constexpr unsigned kTextures = 4;
    /// Then those of places on covers, as many as there is room for.
    void bind(GLenum first) const;

private:
    NodeState
    fill(const DetailNode& node, const BodySubject& subject, std::vector<TileId>& missing);
    void fillCover(std::size_t index, const DetailNode& node, const BodySubject& subject);
    void send(const NodeSlots::Place& place) const;

    static constexpr std::size_t kVertices = kNodeSide * kNodeSide;

    std::size_t columns_; // of slots
    std::size_t rows_;
    NodeSlots slots_;
    std::array<GlTexture, kTextures> textures_;
    std::array<float, kVertices> heights_{};
    std::array<float, 4 * kVertices> within_{};
    std::array<std::int16_t, 4 * kVertices> cubes_{};
    std::array<float, 3 * kVertices> east_{};
    std::array<float, 3 * kVertices> north_{};
    // One a cover.
    std::vector<GlTexture> cover_textures_;
    std::vector<std::vector<float>> cover_places_;
};

/// What programs that draw on a body need besides the flat scene's, for the program in use. The
/// atlas' textures are bound from `first_unit` on.
void setBodyUniforms(const GlProgram& program,
                     const CameraPose& pose,
                     const BodySubject& subject,
                     GLint first_unit);

} // namespace marsview
