// Where a map has a surface, coarsely: so that maps below it can be cut away there.
#pragma once

#include "core/terrain/block_means.h"
#include "ui/render/gl_objects.h"

namespace marsview {

/// A texture over the whole map, from its first to its last sample: 1 where there is a surface.
class CoverTexture {
public:
    CoverTexture(const Heightfield& heightfield, const BlockMeans& means);

    void bind(GLenum unit) const;

private:
    GlTexture texture_;
};

} // namespace marsview
