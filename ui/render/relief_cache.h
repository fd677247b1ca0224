// The relief of the nodes that are drawn, at the driver's.
#pragma once

#include "ui/render/lru_slots.h"
#include "ui/render/opengl/gl_objects.h"
#include "ui/render/relief_loader.h"

#include <cstddef>
#include <functional>
#include <optional>

namespace marsview {

/// Texture arrays with a layer a tile, made as they are needed. Tiles that are missing are made in
/// the background; the relief of a larger node around replaces them.
class ReliefCache {
public:
    struct Found {
        std::size_t page = 0;
        std::size_t layer = 0; // of the page
        DetailNode node;       // whose relief it is: the wanted one or one around it
        // Of its heights, see ReliefTile.
        double height_middle_m = 0.0;
        double height_reach_m = 1.0;
    };

    /// Tiles of one texture array.
    static constexpr std::size_t kPageTiles = 32;

    /// `tile_count` is a multiple of kPageTiles.
    ReliefCache(std::size_t tile_count, std::function<void()> notify);

    std::size_t size() const noexcept { return slots_.size(); }
    std::size_t pageCount() const noexcept { return pages_.size(); }

    /// Uploads a tile that is already loaded.
    void keep(const LayerNode& key, const ReliefTile& tile) { upload(key, tile); }
    /// The same only until the tile for that key has been made, which find() asks for.
    void keepInPlaceOf(const LayerNode& key, const ReliefTile& tile);
    /// Uploads at most `upload_max` finished tiles and begins to collect requests for missing ones.
    /// Tiles found from now on stay until the next call.
    void beginRound(std::size_t upload_max);
    /// The finest relief available for a node; missing tiles are requested. `top` is the level of
    /// the map's single largest node. Empty while no relief is available.
    std::optional<Found> find(const ReliefRequest& wanted, std::size_t top);
    /// Has the missing tiles made. Returns true when there is nothing to wait for.
    bool endRound();
    /// Why some of it cannot be made at present. After endRound().
    const std::optional<Error>& problem() const noexcept { return loader_.problem(); }
    bool isLoading() const { return loader_.isLoading(); }
    /// Waits until all that is missing is made. After endRound().
    void waitForPending() { loader_.waitForPending(); }

    /// Whether two levels of the texture are mixed.
    enum class Mixing { OneLevel, TwoLevels };

    /// A page to a texture unit. Its channels are those of ReliefTexel, ±32767 as ±1.
    void bind(std::size_t page, GLenum unit, Mixing mixing) const;

private:
    struct Heights {
        double middle_m = 0.0;
        double reach_m = 1.0;
    };

    void upload(const LayerNode& key, const ReliefTile& tile);
    bool isReplaced(const LayerNode& key) const;

    LruSlots<LayerNode, LayerNodeHash> slots_;
    std::vector<std::optional<GlTexture>> pages_; // created when their first tile arrives
    std::vector<Heights> heights_;                // by slot
    std::vector<ReliefRequest> missing_;
    std::vector<LayerNode> replaced_; // by others until they are made
    ReliefLoader loader_;
};

} // namespace marsview
