// Where a map has a surface: so that maps below it can be cut away there.
#pragma once

#include "core/terrain/block_means.h"
#include "ui/render/gl_objects.h"

namespace marsview {

/// A texture over the whole map: 1 where all samples of a texel are valid, at all of its levels. A
/// texel of the first one is a sample if the map is in memory and has at most 2048 of them along a
/// side. Triangles between texels that are 1 have a surface; see the shader.
class CoverTexture {
public:
    CoverTexture(const Heightfield& heightfield, const BlockMeans& means);

    static constexpr int kLevelMax = 6;

    void bind(GLenum unit) const;

    /// Texture coordinates of a position, which is given as the share of the way from the first to
    /// the last sample: share × scale + offset.
    struct Placement {
        double column_scale = 1.0;
        double row_scale = 1.0;
        double column_offset = 0.0;
        double row_offset = 0.0;
        double texel_samples = 1.0; // along a side, at level 0
        int level_max = 0;
    };
    const Placement& placement() const noexcept { return placement_; }

private:
    GlTexture texture_;
    Placement placement_;
};

} // namespace marsview
