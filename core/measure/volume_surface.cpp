#include "core/measure/volume_surface.h"

#include <cmath>

namespace marsview {

double VolumeSurface::at(GridPoint grid) const
{
    if (kind != VolumeBase::BorderPlane) {
        return level_m;
    }
    if (period > 0.0) {
        grid.column += period * std::round((middle_column - grid.column) / period);
    }
    const auto en = east_north->at(grid);
    return level_m + per_east * en[0] + per_north * en[1];
}

void BorderPlane::visit(const PathPiece& piece)
{
    for (const double elevation_m : {piece.begin_elevation_m, piece.end_elevation_m}) {
        if (std::isfinite(elevation_m)) {
            min_m = std::fmin(min_m, elevation_m);
            max_m = std::fmax(max_m, elevation_m);
        }
    }
    if (!piece.has_terrain) {
        return;
    }
    const double length_m = piece.end_m - piece.begin_m;
    const double middle_m = 0.5 * (piece.begin_elevation_m + piece.end_elevation_m);
    const Vec3 local =
        frame_.toLocal(ground_.cartesian(line_->at(0.5 * (piece.begin_m + piece.end_m)), 0.0));
    add(local.x, local.y, middle_m, length_m);
}

bool BorderPlane::solve(VolumeSurface& base) const
{
    if (!(weight_ > 0.0)) {
        return false;
    }
    const double e = sum_[0] / weight_;
    const double n = sum_[1] / weight_;
    const double z = sum_[2] / weight_;
    const double ee = square_[0] / weight_ - e * e;
    const double nn = square_[1] / weight_ - n * n;
    const double en = square_[2] / weight_ - e * n;
    const double ez = square_[3] / weight_ - e * z;
    const double nz = square_[4] / weight_ - n * z;
    const double determinant = ee * nn - en * en;
    if (!(determinant > 1e-8 * ee * nn)) {
        return false;
    }
    base.per_east = (ez * nn - nz * en) / determinant;
    base.per_north = (nz * ee - ez * en) / determinant;
    base.level_m = z - base.per_east * e - base.per_north * n;
    return true;
}

void BorderPlane::add(double e, double n, double z, double w)
{
    weight_ += w;
    sum_[0] += w * e;
    sum_[1] += w * n;
    sum_[2] += w * z;
    square_[0] += w * e * e;
    square_[1] += w * n * n;
    square_[2] += w * e * n;
    square_[3] += w * e * z;
    square_[4] += w * n * z;
}

} // namespace marsview
