// The relief of the nodes that are drawn, at the driver's.
#pragma once

#include "ui/render/gl_objects.h"
#include "ui/render/lru_slots.h"
#include "ui/render/relief_loader.h"

#include <cstddef>
#include <functional>
#include <optional>

namespace marsview {

/// A texture array with a layer a tile. Tiles that are missing are made in the background; the
/// relief of a larger node around stands in for them.
class ReliefCache {
public:
    struct Found {
        std::size_t slot = 0;
        DetailNode node; // whose relief it is: the wanted one or one around it
    };

    ReliefCache(std::size_t tile_count, std::function<void()> notify);

    std::size_t size() const noexcept { return slots_.size(); }

    /// Sends a tile that is there already.
    void keep(const LayerNode& key, const ReliefTile& tile) { upload(key, tile); }
    /// Sends at most `upload_max` finished tiles to the driver and begins to collect what is
    /// missing. Tiles found from now on stay until the next call.
    void beginRound(std::size_t upload_max);
    /// The finest relief there is for a node; what is missing is asked for. `top` is the level of
    /// the map's single largest node. Nothing where there is none yet.
    std::optional<Found> find(const ReliefRequest& wanted, std::size_t top);
    /// Has the missing tiles made. Returns true when none is missing.
    bool endRound();
    bool isLoading() const { return loader_.isLoading(); }
    /// Waits until another tile is finished. Only after endRound() returned false.
    void wait() { loader_.waitForOne(); }

    /// Slopes to `slope_unit`, shares to the next one.
    void bind(GLenum slope_unit, bool has_voids) const;

private:
    void upload(const LayerNode& key, const ReliefTile& tile);

    LruSlots<LayerNode, LayerNodeHash> slots_;
    GlTexture slopes_;
    std::optional<GlTexture> shares_; // made for the first map that has voids
    std::vector<ReliefRequest> missing_;
    ReliefLoader loader_;
};

} // namespace marsview
