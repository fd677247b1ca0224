#include "ui/render/relief_cache.h"

#include <algorithm>

namespace marsview {
namespace {

// Levels of the texture. A texel of t pixels, filtered, spreads over a width whose variance is
// t²/4; that of a pixel is 1/12. They are the same at t = 0.58, 0.8 levels below the texels of a
// pixel that the driver chooses, and a bit finer where a pixel is longer than wide on the ground.
// Pictures in motion have one level and no bias: software drivers find that level faster.
constexpr GLfloat kSharper = -1.0F;

GlTexture allocatedPage()
{
    GlTexture texture;
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture.id());
    auto side = static_cast<GLsizei>(ReliefTile::kSide);
    for (GLint level = 0; level < static_cast<GLint>(ReliefTile::kLevels); ++level, side /= 2) {
        glTexImage3D(GL_TEXTURE_2D_ARRAY, level, GL_RGBA16_SNORM, side, side,
                     static_cast<GLsizei>(ReliefCache::kPageTiles), 0, GL_RGBA, GL_SHORT, nullptr);
    }
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL,
                    static_cast<GLint>(ReliefTile::kLevels) - 1);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

} // namespace

ReliefCache::ReliefCache(std::size_t tile_count, std::function<void()> notify)
    : slots_(tile_count)
    , pages_(tile_count / kPageTiles)
    , heights_(tile_count)
    , loader_(std::move(notify))
{}

void ReliefCache::keepInPlaceOf(const LayerNode& key, const ReliefTile& tile)
{
    upload(key, tile);
    replaced_.push_back(key);
}

bool ReliefCache::isReplaced(const LayerNode& key) const
{
    return std::find(replaced_.begin(), replaced_.end(), key) != replaced_.end();
}

void ReliefCache::beginRound(std::size_t upload_max)
{
    slots_.beginRound();
    for (const ReliefResult& result : loader_.take(upload_max)) {
        upload(result.key, result.tile);
        std::erase(replaced_, result.key);
    }
    missing_.clear();
}

std::optional<ReliefCache::Found> ReliefCache::find(const ReliefRequest& wanted, std::size_t top)
{
    LayerNode key = wanted.key;
    bool is_missing = false;
    while (true) {
        const auto slot = slots_.find(key);
        if (!is_missing && (!slot || isReplaced(key))) {
            const bool is_known =
                std::any_of(missing_.begin(), missing_.end(),
                            [&](const ReliefRequest& other) { return other.key == key; });
            // What would find no room is not asked for: the larger one stays.
            if (!is_known && (slot || slots_.usedCount() + missing_.size() < slots_.size())) {
                missing_.push_back(wanted);
            }
        }
        if (slot) {
            return Found{.page = *slot / kPageTiles,
                         .layer = *slot % kPageTiles,
                         .node = key.node,
                         .height_middle_m = heights_[*slot].middle_m,
                         .height_reach_m = heights_[*slot].reach_m};
        }
        is_missing = true;
        if (key.node.level >= std::max(top, kReliefLevelMin)) {
            return std::nullopt;
        }
        key.node = {key.node.level + 1, key.node.column / 2, key.node.row / 2};
    }
}

bool ReliefCache::endRound()
{
    return loader_.request(missing_) == 0;
}

void ReliefCache::bind(std::size_t page, GLenum unit, Mixing mixing) const
{
    glActiveTexture(unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, pages_[page] ? pages_[page]->id() : 0);
    glTexParameterf(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_LOD_BIAS,
                    mixing == Mixing::OneLevel ? 0.0F : kSharper);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER,
                    mixing == Mixing::OneLevel ? GL_LINEAR_MIPMAP_NEAREST
                                               : GL_LINEAR_MIPMAP_LINEAR);
}

void ReliefCache::upload(const LayerNode& key, const ReliefTile& tile)
{
    const auto known = slots_.find(key);
    const auto slot = known ? known : slots_.assign(key);
    if (!slot) {
        return; // all are in this picture; it will be asked for again
    }
    heights_[*slot] = {.middle_m = tile.height_middle_m, .reach_m = tile.height_reach_m};
    std::optional<GlTexture>& page = pages_[*slot / kPageTiles];
    if (!page) {
        page = allocatedPage();
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_ARRAY, page->id());
    GLint n = 0;
    for (const ReliefTile::Level& level : tile.levels) {
        const auto side = static_cast<GLsizei>(level.side);
        static_assert(sizeof(ReliefTexel) == 4 * sizeof(GLshort));
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, n++, 0, 0, static_cast<GLint>(*slot % kPageTiles),
                        side, side, 1, GL_RGBA, GL_SHORT, level.texels.data());
    }
}

} // namespace marsview
