// Where a map has a surface: so that maps below it can be cut away there.
#pragma once

#include "core/terrain/block_means.h"
#include "ui/render/opengl/gl_objects.h"

#include <cstdint>

namespace marsview {

/// Squares of samples over the whole map, at several levels. A square of the first one is a sample
/// if the map is in memory and has at most 2048 of them along a side. A square is valid if all of
/// its samples are, and triangles between the middles of valid squares have a surface. A texel says
/// what is known of the cell between four squares; see the shader.
class CoverTexture {
public:
    CoverTexture(const Heightfield& heightfield, const BlockMeans& means);

    static constexpr int kLevelMax = 6;

    /// Of a texel.
    enum CellBit : std::uint8_t {
        UpperTriangle = 1, // has a surface
        LowerTriangle = 2,
        Surrounded = 4, // all cells within one cell have one, and at all finer levels too
        Bare = 8,       // no cell within one cell has one, nor at any finer level
    };

    void bind(GLenum unit) const;

    /// Texture coordinates of a position, which is given as the share of the way from the first to
    /// the last sample: share × scale + offset. The texel of a cell comes one after that of its
    /// first square.
    struct Placement {
        double column_scale = 0.0;
        double row_scale = 0.0;
        double column_offset = 0.25;
        double row_offset = 0.25;
        double square_samples = 1.0; // along a side, at level 0
        int level_max = 0;
        bool has_voids = false;
    };
    const Placement& placement() const noexcept { return placement_; }

private:
    GlTexture texture_;
    Placement placement_;
};

} // namespace marsview
