// Where a map has a surface, coarsely: so that maps below it can be cut away there.
#pragma once

#include "core/terrain/block_means.h"
#include "ui/render/gl_objects.h"

namespace marsview {

/// A texture over the whole map: 1 where there is a surface.
class CoverTexture {
public:
    CoverTexture(const Heightfield& heightfield, const BlockMeans& means);

    void bind(GLenum unit) const;

    /// Texture coordinates of a position, which is given as the share of the way from the first to
    /// the last sample: share × scale + offset.
    struct Placement {
        double column_scale = 1.0;
        double row_scale = 1.0;
        double column_offset = 0.0;
        double row_offset = 0.0;
    };
    const Placement& placement() const noexcept { return placement_; }

private:
    GlTexture texture_;
    Placement placement_;
};

} // namespace marsview
