#include "core/terrain/pole_cap.h"

namespace marsview {

PoleCap::PoleCap(std::uint32_t size) noexcept
{
    for (std::uint32_t vertex = 0;; size = (size + 1) / 2) {
        rings_[ring_count_++] = {.size = size, .first_vertex = vertex, .first_face = face_count_};
        vertex += size;
        face_count_ += size;
        if (size <= kInnermostMax) {
            pole_ = vertex;
            break;
        }
        face_count_ += (size + 1) / 2;
    }
}

std::uint32_t PoleCap::ringOfFace(std::uint32_t face) const noexcept
{
    std::uint32_t ring = 0;
    while (!isInnermost(ring) && face >= rings_[ring + 1].first_face) {
        ++ring;
    }
    return ring;
}

std::uint32_t PoleCap::ringOfVertex(std::uint32_t vertex) const noexcept
{
    std::uint32_t ring = 0;
    while (!isInnermost(ring) && vertex >= rings_[ring + 1].first_vertex) {
        ++ring;
    }
    return ring;
}

std::array<std::uint32_t, 3> PoleCap::face(std::uint32_t face) const noexcept
{
    const std::uint32_t ring = ringOfFace(face);
    const Ring& outer = rings_[ring];
    const std::uint32_t number = face - outer.first_face;
    const auto at = [](const Ring& of, std::uint32_t step) {
        return of.first_vertex + (step < of.size ? step : step - of.size);
    };
    if (isInnermost(ring)) {
        return {at(outer, number), at(outer, number + 1), pole_};
    }
    const Ring& inner = rings_[ring + 1];
    const std::uint32_t group = number / kParts;
    const std::uint32_t middle = at(outer, 2 * group + 1);
    switch (number % kParts) {
    case kEven:
        return {at(outer, 2 * group), middle, at(inner, group)};
    case kInner:
        return {middle, at(inner, group + 1), at(inner, group)};
    default:
        return {middle, at(outer, 2 * group + 2), at(inner, group + 1)};
    }
}

PoleCap::Beyond PoleCap::across(std::uint32_t corner) const noexcept
{
    const std::uint32_t number = corner % 3;
    const std::uint32_t ring = ringOfFace(corner / 3);
    const std::uint32_t face = corner / 3 - rings_[ring].first_face;
    if (isInnermost(ring)) {
        return acrossAtPole(ring, face, number);
    }
    const std::uint32_t group = face / kParts;
    const std::uint32_t group_last = rings_[ring + 1].size - 1;
    const bool is_odd = rings_[ring].size % 2 == 1;
    const auto inside = [&](std::uint32_t of, Part part, std::uint32_t at) {
        return Beyond{cornerOf(ring, of, part, at), false};
    };
    switch (face % kParts) {
    case kEven:
        return number == 0   ? inside(group, kInner, 1)
               : number == 2 ? outside(ring, 2 * group)
               : group > 0   ? inside(group - 1, kOdd, 0)
               : is_odd      ? inside(group_last, kInner, 2)
                             : inside(group_last, kOdd, 0);
    case kInner:
        return number == 0                     ? Beyond{cornerAtEdge(ring + 1, group), false}
               : number == 1                   ? inside(group, kEven, 0)
               : is_odd && group == group_last ? inside(0, kEven, 1)
                                               : inside(group, kOdd, 1);
    default:
        return number == 0   ? inside(group == group_last ? 0 : group + 1, kEven, 1)
               : number == 1 ? inside(group, kInner, 2)
                             : outside(ring, 2 * group + 1);
    }
}

PoleCap::Beyond
PoleCap::acrossAtPole(std::uint32_t ring, std::uint32_t step, std::uint32_t number) const noexcept
{
    const Ring& of = rings_[ring];
    const auto corner = [&of](std::uint32_t face, std::uint32_t at) {
        return Beyond{3 * (of.first_face + face) + at, false};
    };
    return number == 0   ? corner(step + 1 == of.size ? 0 : step + 1, 1)
           : number == 1 ? corner(step == 0 ? of.size - 1 : step - 1, 0)
                         : outside(ring, step);
}

PoleCap::Beyond PoleCap::outside(std::uint32_t ring, std::uint32_t step) const noexcept
{
    return ring == 0 ? Beyond{step, true} : Beyond{cornerOf(ring - 1, step, kInner, 0), false};
}

std::uint32_t PoleCap::cornerAtEdge(std::uint32_t ring, std::uint32_t step) const noexcept
{
    return isInnermost(ring) ? 3 * (rings_[ring].first_face + step) + 2
                             : cornerOf(ring, step / 2, step % 2 == 0 ? kEven : kOdd, 2);
}

std::uint32_t PoleCap::cornerAt(std::uint32_t vertex) const noexcept
{
    if (vertex == pole_) {
        return 3 * rings_[ring_count_ - 1].first_face + 2;
    }
    const std::uint32_t ring = ringOfVertex(vertex);
    return cornerOf(ring - 1, vertex - rings_[ring].first_vertex, kEven, 2);
}

PoleCap::Place PoleCap::placeOf(std::uint32_t vertex) const noexcept
{
    if (vertex == pole_) {
        return {0, 0.0};
    }
    const std::uint32_t ring = ringOfVertex(vertex);
    return {(vertex - rings_[ring].first_vertex) << ring,
            static_cast<double>(rings_[ring].size) / static_cast<double>(rings_[0].size)};
}

} // namespace marsview
