// The surface of a map without the gaps of its grid: across the seam and up to the poles.
#pragma once

#include "core/geo/frames.h"
#include "core/geo/georeference.h"
#include "core/measure/cap_plane.h"
#include "core/terrain/heightfield.h"

#include <array>
#include <memory>
#include <optional>

namespace marsview {

/// Where a map goes around its body, its last and first columns are neighbors. Where its outermost
/// row is next to a pole, the triangles of a PoleCap close it there, with the elevations of
/// MeasuredTerrain. Copies share; any thread.
class ClosedSurface {
public:
    /// Some ms for a map of a hundred thousand columns that is next to a pole.
    ClosedSurface(const Georeference& georeference, const Heightfield& heightfield);

    /// The terrain to use where tiles are missing: Now uses the coarser ones that replace them,
    /// Requested does too and has them loaded, Waiting loads them.
    enum class Tiles { Now, Requested, Waiting };
    /// In meters. NaN in voids and outside the map. Columns are those of the grid, up to one more
    /// in the seam; rows may lie between an outermost row and the pole.
    double height(const GridPoint& grid, Tiles tiles = Tiles::Now) const;
    /// Whether height() reads samples of full resolution.
    bool isExact(const GridPoint& grid) const;

private:
    template <typename F>
    double heightBy(const GridPoint& grid, F&& read) const;
    template <typename F>
    double capHeight(const GridPoint& grid, F&& read) const;
    std::optional<std::size_t> capAt(double row) const;

    std::shared_ptr<const Georeference> georeference_;
    Heightfield heightfield_;
    std::shared_ptr<const CapPlane> caps_;         // the same at both poles; null without any
    std::array<std::optional<double>, 2> radii_m_; // of the first and the last row, if next to one
    double period_ = 0.0;                          // columns in a turn
};

} // namespace marsview
