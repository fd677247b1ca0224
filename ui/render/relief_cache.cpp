#include "ui/render/relief_cache.h"

#include <algorithm>

namespace marsview {
namespace {

void allocate(
    const GlTexture& texture, std::size_t count, GLint internal, GLenum format, GLenum type)
{
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture.id());
    auto side = static_cast<GLsizei>(ReliefTile::kSide);
    for (GLint level = 0; level < static_cast<GLint>(ReliefTile::kLevels); ++level, side /= 2) {
        glTexImage3D(GL_TEXTURE_2D_ARRAY, level, internal, side, side, static_cast<GLsizei>(count),
                     0, format, type, nullptr);
    }
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL,
                    static_cast<GLint>(ReliefTile::kLevels) - 1);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

} // namespace

ReliefCache::ReliefCache(std::size_t tile_count, std::function<void()> notify)
    : slots_(tile_count)
    , loader_(std::move(notify))
{
    allocate(slopes_, tile_count, GL_RG16_SNORM, GL_RG, GL_SHORT);
}

void ReliefCache::beginRound(std::size_t upload_max)
{
    slots_.beginRound();
    for (const ReliefResult& result : loader_.take(upload_max)) {
        upload(result.key, result.tile);
    }
    missing_.clear();
}

std::optional<ReliefCache::Found> ReliefCache::find(const ReliefRequest& wanted, std::size_t top)
{
    LayerNode key = wanted.key;
    bool is_missing = false;
    while (true) {
        if (const auto slot = slots_.find(key)) {
            return Found{*slot, key.node};
        }
        if (!is_missing) {
            is_missing = true;
            const bool is_known =
                std::any_of(missing_.begin(), missing_.end(),
                            [&](const ReliefRequest& other) { return other.key == key; });
            if (!is_known) {
                missing_.push_back(wanted);
            }
        }
        if (key.node.level >= std::max(top, kReliefLevelMin)) {
            return std::nullopt;
        }
        key.node = {key.node.level + 1, key.node.column / 2, key.node.row / 2};
    }
}

bool ReliefCache::endRound()
{
    loader_.want(missing_);
    return missing_.empty();
}

void ReliefCache::bind(GLenum slope_unit, bool has_voids) const
{
    glActiveTexture(slope_unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, slopes_.id());
    if (has_voids && shares_) {
        glActiveTexture(slope_unit + 1);
        glBindTexture(GL_TEXTURE_2D_ARRAY, shares_->id());
    }
}

void ReliefCache::upload(const LayerNode& key, const ReliefTile& tile)
{
    const auto slot = slots_.find(key) ? slots_.find(key) : slots_.assign(key);
    if (!slot) {
        return; // all are in this picture; it will be asked for again
    }
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_ARRAY, slopes_.id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    GLint n = 0;
    for (const ReliefTile::Level& level : tile.levels) {
        const auto side = static_cast<GLsizei>(level.side);
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, n++, 0, 0, static_cast<GLint>(*slot), side, side, 1,
                        GL_RG, GL_SHORT, level.slopes.data());
    }
    if (tile.levels.front().shares.empty()) {
        return;
    }
    if (!shares_) {
        shares_.emplace();
        allocate(*shares_, slots_.size(), GL_R8, GL_RED, GL_UNSIGNED_BYTE);
    }
    glBindTexture(GL_TEXTURE_2D_ARRAY, shares_->id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    n = 0;
    for (const ReliefTile::Level& level : tile.levels) {
        const auto side = static_cast<GLsizei>(level.side);
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, n++, 0, 0, static_cast<GLint>(*slot), side, side, 1,
                        GL_RED, GL_UNSIGNED_BYTE, level.shares.data());
    }
}

} // namespace marsview
