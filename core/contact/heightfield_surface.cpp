#include "core/contact/heightfield_surface.h"

#include "core/base/check.h"
#include "core/contact/heightfield_cast.h"
#include "core/contact/resident_heights.h"

namespace marsview {

template <typename Heights>
BasicHeightfieldSurface<Heights>::BasicHeightfieldSurface(std::shared_ptr<const Terrain> terrain,
                                                          const SceneFrame& frame,
                                                          double exaggeration)
    : terrain_(std::move(terrain))
    , heights_(*terrain_, exaggeration)
    , frame_(frame)
    , exaggeration_(exaggeration)
    , column_{frame.east_per_column, frame.north_per_column, 0.0}
    , row_{frame.east_per_row, frame.north_per_row, 0.0}
{
    for (std::size_t i = 0; i < kSpokes.size(); ++i) {
        spokes_[i] = column_ * static_cast<double>(kSpokes[i].column) +
                     row_ * static_cast<double>(kSpokes[i].row);
    }
    MARSVIEW_CHECK(terrain_ && exaggeration > 0.0 && std::isfinite(exaggeration));
    constexpr std::size_t kSideMax = std::size_t{1} << 30;
    MARSVIEW_CHECK(terrain_->columns() < kSideMax && terrain_->rows() < kSideMax);
    const double determinant = column_.x * row_.y - column_.y * row_.x;
    MARSVIEW_CHECK(determinant != 0.0 && std::isfinite(determinant));
    last_column_ = static_cast<std::int32_t>(terrain_->columns() - 1);
    last_row_ = static_cast<std::int32_t>(terrain_->rows() - 1);
    is_mirrored_ = determinant > 0.0; // rows count downward, so the usual frame is negative
    turn_ = is_mirrored_ ? 1.0 : -1.0;
    third_corner_ = is_mirrored_ ? std::array{2, 1} : std::array{1, 2};
    lower_right_corner_ = is_mirrored_ ? std::array{1, 2} : std::array{2, 1};
    const Vec3 diagonal = column_ + row_;
    const double by_area = 1.0 / (determinant * determinant);
    metric_ = {{{dot(column_, column_) * by_area, -dot(diagonal, row_) * by_area},
                {dot(row_, row_) * by_area, -dot(diagonal, column_) * by_area},
                {dot(diagonal, diagonal) * by_area, dot(column_, row_) * by_area}}};
    // A straight path across the map crosses three features per cell: four times that, plus what
    // short paths from one peak of a checkerboard to the next may need.
    const auto across = static_cast<std::uint32_t>(terrain_->columns() + terrain_->rows());
    steps_max_ = 4096U + 12U * std::min(across, 1U << 27U);
}

template <typename Heights>
bool BasicHeightfieldSurface<Heights>::isOverVoid(const ScenePoint& point) const noexcept
{
    const InCell at = cellOf(frame_.toGrid(point));
    const bool is_upper = at.u >= at.v;
    const auto is_void = [&](double weight, std::size_t columns, std::size_t rows) {
        return weight > 0.0 && terrain_->isVoid(static_cast<std::size_t>(at.column) + columns,
                                                static_cast<std::size_t>(at.row) + rows);
    };
    return is_void(1.0 - std::max(at.u, at.v), 0, 0) || is_void(std::min(at.u, at.v), 1, 1) ||
           is_void(std::abs(at.u - at.v), is_upper ? 1 : 0, is_upper ? 0 : 1);
}

template <typename Heights>
auto BasicHeightfieldSurface<Heights>::initialContact() const noexcept -> Contact
{
    Contact contact;
    contact.feature = ContactFeature::Vertex;
    contact.vertex = {last_column_ / 2, last_row_ / 2};
    return contact;
}

// A straight path that is clamped to the grid bends where it crosses the lines of the border.
template <typename Heights>
auto BasicHeightfieldSurface<Heights>::legs(const ScenePoint& from,
                                            const ScenePoint& to) const noexcept
    -> SurfaceLegs<BasicHeightfieldSurface>
{
    SurfaceLegs<BasicHeightfieldSurface> legs;
    const auto last = goal(to);
    if (!last) {
        return legs;
    }
    const GridPoint a = frame_.toGrid(from);
    const GridPoint b = frame_.toGrid(to);
    std::array<double, SurfaceLegs<BasicHeightfieldSurface>::kLegsMax - 1> shares{};
    std::size_t count = 0;
    const auto add_crossing = [&](double begin, double end, double line) {
        if ((begin < line) != (end < line) && begin != line && end != line) {
            const double share = (line - begin) / (end - begin);
            if (share > 0.0 && share < 1.0) {
                std::size_t at = count++;
                for (; at > 0 && shares[at - 1] > share; --at) {
                    shares[at] = shares[at - 1];
                }
                shares[at] = share;
            }
        }
    };
    add_crossing(a.column, b.column, 0.0);
    add_crossing(a.column, b.column, static_cast<double>(last_column_));
    add_crossing(a.row, b.row, 0.0);
    add_crossing(a.row, b.row, static_cast<double>(last_row_));
    for (std::size_t i = 0; i < count; ++i) {
        const GridPoint grid{a.column + shares[i] * (b.column - a.column),
                             a.row + shares[i] * (b.row - a.row)};
        const ScenePoint point = from + (to - from) * shares[i];
        if (const auto bent = clamped(grid, frame_.toScene(grid, point.z))) {
            legs.ends[legs.count++] = *bent;
        }
    }
    legs.ends[legs.count++] = *last;
    return legs;
}

template <typename Heights>
auto BasicHeightfieldSurface<Heights>::castFrom(const Contact& contact,
                                                Face over,
                                                const Goal& goal) const noexcept -> Cast
{
    const InCell start = within(contact, over);
    return HeightfieldCast<Heights>(*this, start, heightAt(start), over.is_upper, goal).cast();
}

template <typename Heights>
auto BasicHeightfieldSurface<Heights>::castFree(const Goal& from, const Goal& to) const noexcept
    -> Cast
{
    // High above the whole terrain nothing needs to be checked.
    if (std::min(from.scene.z, to.scene.z) >
        exaggeration_ * terrain_->maximum(terrain_->levelCount() - 1, 0, 0)) {
        return {};
    }
    return HeightfieldCast<Heights>(*this, cellOf(from.grid), from.scene.z, std::nullopt, to)
        .cast();
}

template class BasicHeightfieldSurface<FilledHeights>;
template class BasicHeightfieldSurface<PlainHeights<std::int16_t>>;
template class BasicHeightfieldSurface<PlainHeights<float>>;
template class BasicHeightfieldSurface<ResidentHeights<void>>;
template class BasicHeightfieldSurface<ResidentHeights<std::int16_t>>;
template class BasicHeightfieldSurface<ResidentHeights<float>>;

} // namespace marsview
