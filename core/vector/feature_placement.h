// Where features lie on a map.
#pragma once

#include "core/geo/georeference.h"
#include "core/vector/feature.h"
#include "core/vector/feature_index.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace marsview {

/// From coordinates in a CRS to the scene of a map on the same body. Edges are straight in the
/// CRS of the features, as GIS draw them: on a map in another CRS they get more vertices, so that
/// they follow their true course within half a sample of the map. Lines across the seam of a map on
/// which longitude is periodic continue on the other side. Any thread.
class FeaturePlacement {
public:
    /// Without a CRS, coordinates are those of the map.
    FeaturePlacement(std::optional<Crs> crs, const Georeference& map);

    /// Scene meters east and north; empty outside the projection of the map.
    std::optional<PlanePoint> place(const MapPoint& point) const;

    /// Adds the parts of a feature under the number `id`. Vertices outside the projection are
    /// omitted and end a line. A ring that is cut becomes lines.
    void add(std::uint32_t id,
             FeatureShape shape,
             const std::vector<FeaturePart>& parts,
             PlaneFeatures& features) const;

private:
    struct Path {
        std::vector<PlanePoint> points{};
        std::vector<bool> is_course{}; // as PlaneFeatures::is_course

        void add(const PlanePoint& point, bool is_for_course);
    };
    PlanePoint scenePlace(const GridPoint& grid) const;
    void addBetween(const MapPoint& from,
                    const MapPoint& to,
                    const PlanePoint& from_place,
                    const PlanePoint& to_place,
                    int depth,
                    Path& path) const;
    void addPath(std::uint32_t id,
                 PlaneShape shape,
                 const FeaturePart& part,
                 PlaneFeatures& features) const;

    std::optional<Crs> crs_;
    Georeference map_;
    bool is_same_crs_ = false;
    std::optional<PlanePoint> turn_; // from a place to the same one a turn further east
};

} // namespace marsview
