// What volumes are measured from, and the plane through the border of a polygon.
#pragma once

#include "core/measure/grid_field.h"
#include "core/measure/terrain_area.h"
#include "core/measure/terrain_path.h"

#include <array>
#include <limits>
#include <optional>

namespace marsview {

/// The elevation of the base of volumes.
struct VolumeSurface {
    VolumeBase kind = VolumeBase::None;
    double level_m = 0.0;
    double per_east = 0.0;
    double per_north = 0.0;
    std::optional<GridField<2>> east_north{}; // of grid positions
    double middle_column = 0.0;               // of the field, where columns are periodic
    double period = 0.0;

    double at(GridPoint grid) const;
};

/// Visits the terrain along the polygon's edges.
class BorderPlane final : public PathVisitor {
public:
    explicit BorderPlane(const Ground& ground, const LocalFrame& frame)
        : ground_(ground)
        , frame_(frame)
    {}

    void begin(const GroundLine& line) { line_ = &line; }

    void visit(const PathPiece& piece) override;

    /// The plane by least squares over east and north; false without enough terrain.
    bool solve(VolumeSurface& base) const;

    double min_m = std::numeric_limits<double>::quiet_NaN();
    double max_m = std::numeric_limits<double>::quiet_NaN();

private:
    void add(double e, double n, double z, double w);

    const Ground& ground_;
    LocalFrame frame_;
    const GroundLine* line_ = nullptr;
    double weight_ = 0.0;
    std::array<double, 3> sum_{};
    std::array<double, 5> square_{};
};

} // namespace marsview
