#include "core/body/layer_patch.h"

#include "core/mesh/mesh_cast_definitions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace marsview {
namespace {

constexpr auto nextCorner = BodyMesh::nextCorner;
constexpr auto previousCorner = BodyMesh::previousCorner;

// Where on an edge a function of the ellipsoid's normal is 0, which is nearly linear: a share of
// the way from `from` to `to`.
template <typename F>
double zeroOn(const Ellipsoid& body, const ScenePoint& from, const ScenePoint& to, F&& function)
{
    double low = 0.0;
    double high = 1.0;
    double at_low = function(verticalAt(body, from).up);
    double at_high = function(verticalAt(body, to).up);
    double share = 0.5;
    int kept = 0; // the end that the last round kept: -1 the low one, 1 the high one
    constexpr int kRoundsMax = 60;
    for (int i = 0; i < kRoundsMax && at_low != at_high; ++i) {
        const double before = share;
        share = (low * at_high - high * at_low) / (at_high - at_low);
        const double value = function(verticalAt(body, from + (to - from) * share).up);
        if (value == 0.0 || std::abs(share - before) < 1e-15) {
            break;
        }
        // The Illinois variant of false position: an end that is kept twice counts half.
        if ((value > 0.0) == (at_high > 0.0)) {
            high = share;
            at_high = value;
            at_low *= kept == -1 ? 0.5 : 1.0;
            kept = -1;
        } else {
            low = share;
            at_low = value;
            at_high *= kept == 1 ? 0.5 : 1.0;
            kept = 1;
        }
    }
    return share;
}

} // namespace

LayerPatch::LayerPatch(const std::vector<std::shared_ptr<const BodyMesh>>& maps)
{
    for (const auto& mesh : maps) {
        maps_.push_back({.mesh = mesh,
                         .first_vertex = map_vertices_,
                         .first_face = map_faces_,
                         .is_gone = FaceMarks(*mesh)});
        map_vertices_ += mesh->vertexCount();
        map_faces_ += mesh->faceCount();
    }
}

std::size_t LayerPatch::mapOf(BodyIndex face) const noexcept
{
    std::size_t map = maps_.size() - 1;
    while (face < maps_[map].first_face) {
        --map;
    }
    return map;
}

std::size_t LayerPatch::mapOfVertex(BodyIndex vertex) const noexcept
{
    std::size_t map = maps_.size() - 1;
    while (vertex < maps_[map].first_vertex) {
        --map;
    }
    return map;
}

bool LayerPatch::isGone(BodyIndex face) const noexcept
{
    if (isCut(face)) {
        return cut_[face - map_faces_].is_gone;
    }
    const Map& map = maps_[mapOf(face)];
    return map.is_gone[face - map.first_face];
}

BodyFace LayerPatch::face(BodyIndex face) const noexcept
{
    if (isCut(face)) {
        return cut_[face - map_faces_].vertices;
    }
    const Map& map = maps_[mapOf(face)];
    const BodyFace own = map.mesh->face(face - map.first_face);
    return {own[0] + map.first_vertex, own[1] + map.first_vertex, own[2] + map.first_vertex};
}

ScenePoint LayerPatch::point(BodyIndex vertex) const noexcept
{
    if (vertex >= map_vertices_) {
        return points_[vertex - map_vertices_];
    }
    const Map& map = maps_[mapOfVertex(vertex)];
    return map.mesh->vertex(vertex - map.first_vertex);
}

Vec3 LayerPatch::up(BodyIndex vertex) const
{
    return vertex >= map_vertices_ ? ups_[vertex - map_vertices_]
                                   : verticalAt(ellipsoid(), point(vertex)).up;
}

BodyIndex LayerPatch::across(BodyIndex corner) const noexcept
{
    const BodyIndex face = corner / 3;
    if (isCut(face)) {
        return cut_[face - map_faces_].across[corner % 3];
    }
    if (const auto link = links_.find(corner); link != links_.end()) {
        return link->second;
    }
    const Map& map = maps_[mapOf(face)];
    const BodyIndex beyond = map.mesh->across(corner - 3 * map.first_face);
    return beyond == kNone ? kNone : beyond + 3 * map.first_face;
}

BodyIndex LayerPatch::cornerAt(BodyIndex vertex) const noexcept
{
    if (const auto known = corners_.find(vertex); known != corners_.end()) {
        const BodyIndex corner = known->second;
        if (!isGone(corner / 3) && vertexAt(corner) == vertex) {
            return corner;
        }
    }
    if (vertex < map_vertices_) {
        const Map& map = maps_[mapOfVertex(vertex)];
        for (const BodyIndex corner : map.mesh->fan(vertex - map.first_vertex)) {
            if (!map.is_gone[corner / 3]) {
                return corner + 3 * map.first_face;
            }
        }
    }
    return kNone;
}

BodyIndex LayerPatch::turned(BodyIndex corner) const noexcept
{
    const BodyIndex beyond = across(nextCorner(corner));
    return beyond == kNone ? kNone : nextCorner(beyond);
}

BodyIndex LayerPatch::turnedBack(BodyIndex corner) const noexcept
{
    const BodyIndex before = across(previousCorner(corner));
    return before == kNone ? kNone : previousCorner(before);
}

BodyIndex LayerPatch::placeOf(BodyIndex vertex) const noexcept
{
    for (auto twin = twins_.find(vertex); twin != twins_.end(); twin = twins_.find(vertex)) {
        vertex = twin->second;
    }
    return vertex;
}

void LayerPatch::setAcross(BodyIndex corner, BodyIndex beyond)
{
    if (isCut(corner / 3)) {
        cut_[corner / 3 - map_faces_].across[corner % 3] = beyond;
    } else {
        links_[corner] = beyond;
    }
}

void LayerPatch::removeFace(BodyIndex face)
{
    if (isCut(face)) {
        cut_[face - map_faces_].is_gone = true;
    } else {
        Map& map = maps_[mapOf(face)];
        map.is_gone.set(face - map.first_face);
    }
}

void LayerPatch::removeMap(std::size_t index)
{
    maps_[index].is_gone.setAll();
    for (Face& face : cut_) {
        face.is_gone = face.is_gone || (face.origin != kNone && mapOf(face.origin) == index);
    }
}

void LayerPatch::setTwins(BodyIndex a, BodyIndex b)
{
    a = placeOf(a);
    b = placeOf(b);
    if (a != b) {
        twins_[a] = b;
    }
}

void LayerPatch::setVertex(BodyIndex corner, BodyIndex vertex)
{
    cut_[corner / 3 - map_faces_].vertices[corner % 3] = vertex;
    corners_[vertex] = corner;
}

BodyIndex LayerPatch::addVertex(const ScenePoint& point, const Vec3& up)
{
    points_.push_back(point);
    ups_.push_back(up);
    return map_vertices_ + static_cast<BodyIndex>(points_.size() - 1);
}

BodyIndex LayerPatch::addFace(const Face& face)
{
    cut_.push_back(face);
    const BodyIndex number = map_faces_ + static_cast<BodyIndex>(cut_.size() - 1);
    if (face.origin != kNone) {
        parts_[face.origin].push_back(number);
    }
    note(number);
    return number;
}

void LayerPatch::note(BodyIndex face)
{
    for (BodyIndex i = 0; i < 3; ++i) {
        corners_[cut_[face - map_faces_].vertices[i]] = 3 * face + i;
    }
}

void LayerPatch::noteAll()
{
    for (std::size_t i = 0; i < cut_.size(); ++i) {
        if (!cut_[i].is_gone) {
            note(map_faces_ + static_cast<BodyIndex>(i));
        }
    }
}

BodyIndex LayerPatch::cutCorner(BodyIndex corner)
{
    const BodyIndex old = corner / 3;
    if (isCut(old)) {
        return corner;
    }
    Face copy{.vertices = face(old), .across = {}, .origin = old};
    for (BodyIndex i = 0; i < 3; ++i) {
        copy.across[i] = across(3 * old + i);
    }
    removeFace(old);
    const BodyIndex number = addFace(copy);
    for (BodyIndex i = 0; i < 3; ++i) {
        if (copy.across[i] != kNone) {
            setAcross(copy.across[i], 3 * number + i);
        }
        links_.erase(3 * old + i);
    }
    return 3 * number + corner % 3;
}

BodyIndex LayerPatch::partAtEdge(BodyIndex face, BodyIndex from, BodyIndex to) const
{
    const auto look_at = [&](BodyIndex number) {
        const BodyFace vertices = this->face(number);
        for (BodyIndex i = 0; i < 3; ++i) {
            if (vertices[(i + 1) % 3] == from && vertices[(i + 2) % 3] == to) {
                return 3 * number + i;
            }
        }
        return kNone;
    };
    if (!isGone(face)) {
        return look_at(face);
    }
    if (const auto parts = parts_.find(face); parts != parts_.end()) {
        for (const BodyIndex part : parts->second) {
            if (!isGone(part)) {
                if (const BodyIndex corner = look_at(part); corner != kNone) {
                    return corner;
                }
            }
        }
    }
    return kNone;
}

BodyIndex LayerPatch::cornerAtEdge(BodyIndex from, BodyIndex to) const
{
    const BodyIndex place = placeOf(to);
    const BodyIndex first = cornerAt(from);
    BodyIndex corner = first;
    while (corner != kNone) {
        if (placeOf(vertexAt(nextCorner(corner))) == place) {
            return previousCorner(corner);
        }
        corner = turned(corner);
        if (corner == first) {
            return kNone;
        }
    }
    for (corner = first; corner != kNone; corner = turnedBack(corner)) {
        if (placeOf(vertexAt(nextCorner(corner))) == place) {
            return previousCorner(corner);
        }
    }
    return kNone;
}

BodyIndex LayerPatch::splitEdgeAt(BodyIndex corner, const Vec3& up)
{
    return splitEdge(corner, shareBeside(corner, up), up);
}

BodyIndex LayerPatch::splitEdge(BodyIndex corner, double share, const Vec3& up)
{
    corner = cutCorner(corner);
    BodyIndex beyond = across(corner);
    if (beyond != kNone) {
        beyond = cutCorner(beyond);
    }
    // Each side becomes two faces: (tip, from, middle), in place, and (tip, middle, to).
    struct Side {
        BodyIndex first = 0;
        BodyIndex second = 0;
        BodyIndex middle = 0;
    };
    const auto split = [this](BodyIndex at, BodyIndex middle) {
        const Face old = cut_[at / 3 - map_faces_];
        const BodyIndex tip = at % 3;
        const BodyIndex from = (tip + 1) % 3;
        const BodyIndex to = (tip + 2) % 3;
        const BodyIndex first = at / 3;
        const BodyIndex second = addFace({.vertices = {old.vertices[tip], middle, old.vertices[to]},
                                          .across = {kNone, old.across[from], 3 * first + 1},
                                          .origin = old.origin});
        if (old.across[from] != kNone) {
            setAcross(old.across[from], 3 * second + 1);
        }
        cut_[first - map_faces_] = {.vertices = {old.vertices[tip], old.vertices[from], middle},
                                    .across = {kNone, 3 * second + 2, old.across[to]},
                                    .origin = old.origin};
        if (old.across[to] != kNone) {
            setAcross(old.across[to], 3 * first + 2);
        }
        note(first);
        return Side{first, second, middle};
    };
    const auto between = [this](BodyIndex from, BodyIndex to, double at) {
        const ScenePoint begin = point(from);
        return begin + (point(to) - begin) * at;
    };
    const BodyIndex from = vertexAt(nextCorner(corner));
    const BodyIndex to = vertexAt(previousCorner(corner));
    const BodyIndex middle = addVertex(between(from, to, share), up);
    if (beyond == kNone) {
        const Side here = split(corner, middle);
        return 3 * here.second + 1;
    }
    const BodyIndex other_from = vertexAt(previousCorner(beyond));
    const BodyIndex other_to = vertexAt(nextCorner(beyond));
    BodyIndex other_middle = middle;
    if (other_from != from || other_to != to) {
        other_middle = addVertex(between(other_from, other_to, share), up);
        setTwins(other_middle, middle);
    }
    const Side here = split(corner, middle);
    const Side there = split(beyond, other_middle);
    setAcross(3 * here.first, 3 * there.second);
    setAcross(3 * there.second, 3 * here.first);
    setAcross(3 * here.second, 3 * there.first);
    setAcross(3 * there.first, 3 * here.second);
    return 3 * here.second + 1;
}

double LayerPatch::shareBeside(BodyIndex corner, const Vec3& up) const
{
    const BodyIndex from = vertexAt(nextCorner(corner));
    const BodyIndex to = vertexAt(previousCorner(corner));
    const Vec3 along = this->up(to) - this->up(from);
    return zeroOn(ellipsoid(), point(from), point(to),
                  [&](const Vec3& at) { return dot(at - up, along); });
}

std::optional<BodyIndex> LayerPatch::walkTo(BodyIndex face, const Vec3& up) const
{
    // A straight way meets few faces; more are those of a walk that goes around in circles.
    constexpr int kStepsMax = 1'000'000;
    for (int step = 0; step < kStepsMax; ++step) {
        const BodyFace vertices = this->face(face);
        const std::array<Vec3, 3> at{this->up(vertices[0]), this->up(vertices[1]),
                                     this->up(vertices[2])};
        constexpr double kRounding = 1e-14;
        double farthest = kRounding;
        BodyIndex way = 3;
        for (BodyIndex i = 0; i < 3; ++i) {
            const Vec3& a = at[(i + 1) % 3];
            const Vec3& b = at[(i + 2) % 3];
            const double beyond = -areaOf(a, b, up) / length(b - a);
            if (beyond > farthest) {
                farthest = beyond;
                way = i;
            }
        }
        if (way == 3) {
            return face;
        }
        const BodyIndex next = across(3 * face + way);
        if (next == kNone) {
            return std::nullopt;
        }
        face = next / 3;
    }
    return std::nullopt;
}

std::optional<BodyIndex> LayerPatch::find(std::size_t first, const ScenePoint& point) const
{
    const BodyVertical vertical = verticalAt(ellipsoid(), point);
    constexpr double kDepthShare = 0.9;
    const double depth_m =
        kDepthShare * std::min(ellipsoid().equatorial_m, ellipsoid().polar_m) + vertical.height_m;
    for (std::size_t i = first; i < maps_.size(); ++i) {
        const Map& map = maps_[i];
        const auto cast = castSegment(*map.mesh, {.base = map.mesh->highAbove(point)},
                                      MeshEnd{point - vertical.up * depth_m, {}});
        if (!cast.hit) {
            continue;
        }
        const BodyIndex face = cast.hit->face + map.first_face;
        if (!isGone(face)) {
            return face;
        }
        if (const auto parts = parts_.find(face); parts != parts_.end()) {
            for (const BodyIndex part : parts->second) {
                if (!isGone(part)) {
                    if (const auto found = walkTo(part, vertical.up)) {
                        return found;
                    }
                }
            }
        }
    }
    return std::nullopt;
}

BodyIndex LayerPatch::insert(BodyIndex face, const Vec3& up, double tolerance)
{
    const BodyIndex first = cutCorner(3 * face);
    const BodyFace vertices = this->face(first / 3);
    const std::array<Vec3, 3> at{this->up(vertices[0]), this->up(vertices[1]),
                                 this->up(vertices[2])};
    for (std::size_t i = 0; i < 3; ++i) {
        if (length(up - at[i]) <= tolerance) {
            return vertices[i];
        }
    }
    for (BodyIndex i = 0; i < 3; ++i) {
        const Vec3& a = at[(i + 1) % 3];
        const Vec3 along = at[(i + 2) % 3] - a;
        if (areaOf(a, at[(i + 2) % 3], up) <= tolerance * length(along)) {
            const double share = dot(up - a, along) / dot(along, along);
            return vertexAt(splitEdgeAt(first + i, normalized(a + along * share)));
        }
    }
    // On the face, straight above or below.
    const Ellipsoid& body = ellipsoid();
    const double a2 = body.equatorial_m * body.equatorial_m;
    const double b2 = body.polar_m * body.polar_m;
    const double size = std::sqrt(a2 * (up.x * up.x + up.y * up.y) + b2 * up.z * up.z);
    const ScenePoint foot{a2 * up.x / size, a2 * up.y / size, b2 * up.z / size};
    const ScenePoint p0 = point(vertices[0]);
    const Vec3 normal = cross(point(vertices[1]) - p0, point(vertices[2]) - p0);
    const BodyIndex middle = addVertex(foot + up * (dot(normal, p0 - foot) / dot(normal, up)), up);
    const Face old = cut_[first / 3 - map_faces_];
    const BodyIndex own = first / 3;
    // (0, 1, middle) in place, (1, 2, middle), (2, 0, middle).
    const BodyIndex second = addFace({.vertices = {old.vertices[1], old.vertices[2], middle},
                                      .across = {kNone, 3 * own, old.across[0]},
                                      .origin = old.origin});
    const BodyIndex third = addFace({.vertices = {old.vertices[2], old.vertices[0], middle},
                                     .across = {3 * own + 1, 3 * second, old.across[1]},
                                     .origin = old.origin});
    cut_[second - map_faces_].across[0] = 3 * third + 1;
    cut_[own - map_faces_] = {.vertices = {old.vertices[0], old.vertices[1], middle},
                              .across = {3 * second + 1, 3 * third, old.across[2]},
                              .origin = old.origin};
    for (const auto& [corner, beyond] :
         {std::pair(3 * second + 2, old.across[0]), std::pair(3 * third + 2, old.across[1]),
          std::pair(3 * own + 2, old.across[2])}) {
        if (beyond != kNone) {
            setAcross(beyond, corner);
        }
    }
    note(own);
    return middle;
}

std::optional<std::vector<BodyIndex>>
LayerPatch::connect(BodyIndex from, BodyIndex to, double tolerance)
{
    std::vector<BodyIndex> way{from};
    const BodyIndex goal = placeOf(to);
    const Vec3 end = up(to);
    constexpr std::size_t kWayMax = 10'000'000;
    while (way.size() < kWayMax) {
        const BodyIndex first = cornerAt(way.back());
        const Vec3 begin = up(way.back());
        const Vec3 along = end - begin;
        const double distance = length(along);
        BodyIndex through = kNone; // a vertex on the way
        BodyIndex crossed = kNone; // the corner at `begin` of the face that the way leads over
        if (first == kNone) {
            return std::nullopt;
        }
        BodyIndex corner = first;
        do {
            const BodyIndex a = vertexAt(nextCorner(corner));
            const BodyIndex b = vertexAt(previousCorner(corner));
            if (placeOf(a) == goal || placeOf(b) == goal) {
                way.push_back(to);
                return way;
            }
            const Vec3 to_a = up(a);
            const Vec3 to_b = up(b);
            const double beside_a = areaOf(begin, end, to_a) / distance;
            const double beside_b = areaOf(begin, end, to_b) / distance;
            const double ahead_a = dot(to_a - begin, along) / distance;
            const double ahead_b = dot(to_b - begin, along) / distance;
            if (std::abs(beside_a) <= tolerance && ahead_a > 0.0 && ahead_a < distance) {
                through = a;
            } else if (std::abs(beside_b) <= tolerance && ahead_b > 0.0 && ahead_b < distance) {
                through = b;
            } else if (beside_a < 0.0 && beside_b > 0.0 &&
                       ahead_a * beside_b - ahead_b * beside_a > 0.0) {
                crossed = corner;
            }
            corner = turned(corner);
            if (corner == kNone) {
                return std::nullopt;
            }
        } while (corner != first && through == kNone);
        if (through == kNone) {
            if (crossed == kNone) {
                return std::nullopt;
            }
            const Vec3 a = up(vertexAt(nextCorner(crossed)));
            const Vec3 b = up(vertexAt(previousCorner(crossed)));
            const double beside_a = areaOf(begin, end, a);
            const double beside_b = areaOf(begin, end, b);
            const double share = beside_a / (beside_a - beside_b);
            through = vertexAt(splitEdgeAt(crossed, normalized(a + (b - a) * share)));
        }
        way.push_back(through);
    }
    return std::nullopt;
}

} // namespace marsview
