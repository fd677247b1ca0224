// The programs that draw terrain and sky, compiled when they are first needed.
#pragma once

#include "core/base/result.h"
#include "core/view/terrain_look.h"
#include "ui/render/opengl/gl_program.h"

#include <map>
#include <string>

namespace marsview {

/// Colors of a ramp's texture.
inline constexpr std::size_t kRampTexels = 1024;

/// What a program is compiled for: software drivers take both sides of every branch, so that each
/// kind of picture gets a program of its own.
struct TerrainShaderKey {
    ShadingMode mode = ShadingMode::Tint;
    bool has_contours = false;
    bool has_voids = false;
    /// Colors and light are those of the point where the ray through the pixel meets the relief
    /// instead of the mesh.
    bool is_ray_corrected = false;
    int cover_count = 0; // maps that lie over this one, at most kCoversMax
    bool is_on_body = false;
    bool is_wall = false;   // of a map on its body, see core/globe/map_walls.h
    bool is_sunlit = false; // likewise: the light is fixed on the body
    auto operator<=>(const TerrainShaderKey&) const = default;
};

inline constexpr int kCoversMax = 3;

/// Rows of vertices that lie at the pole next to a map's first or last row, instead of in a row.
inline constexpr int kFirstPoleRow = 64;
inline constexpr int kLastPoleRow = 65;

/// The program's locations of the vertex attributes.
enum TerrainAttribute : unsigned {
    kCellAttribute,         // vertex: column and row within the node, 0 … 32; see kFirstPoleRow;
                            // of a wall also the elevation of the map below and its sag
    kPlaceAttribute,        // node: first sample relative to the anchor, samples a cell
    kSlotAttribute,         // node: place in the height atlas, place in the parent
    kReliefAttribute,       // node: texture coordinate = sample × x + (y, z), layer w
    kUncleAttribute,        // node: place in the grandparent
    kParentAttribute,       // node: ranges at the parent's corners
    kGrandparentAttribute,  // node: ranges at the grandparent's corners
    kColorHeightsAttribute, // node: height = relief's × x + y; share z of the mesh's own height
    kWallEndAttribute,      // corner of a wall: 1 at the top
};

class TerrainShaders {
public:
    /// Compiles the most usual program, so that a driver that cannot is found out at once.
    static Result<TerrainShaders> create();

    /// The program for `key`. The driver has compiled its like before: failing is a bug.
    const GlProgram& terrain(const TerrainShaderKey& key);
    const GlProgram& sky() const noexcept { return sky_; }

    /// The vertex stage's source, for tests that look at its results.
    static std::string vertexSource(bool is_on_body = false);

private:
    explicit TerrainShaders(GlProgram sky)
        : sky_(std::move(sky))
    {}

    std::map<TerrainShaderKey, GlProgram> terrain_;
    GlProgram sky_;
};

} // namespace marsview
