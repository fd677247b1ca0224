#include "core/body/layer_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr BodyIndex kNone = LayerPatch::kNone;
constexpr auto nextCorner = BodyMesh::nextCorner;
constexpr auto previousCorner = BodyMesh::previousCorner;

// Vertices of a border are put onto what is nearer than this share of its shortest edge.
constexpr double kSnapShare = 1e-5;

// No part of an edge that is split is shorter than this share of the rest of it.
constexpr double kShareMin = 1e-4;

constexpr const char* kCannotCut = "the border of a map cannot be cut out of the maps below it";
constexpr const char* kLeadsBeyond = "the border of a map leads beyond the maps below it";

struct RimEdge {
    BodyIndex face; // of the upper map, to the left
    BodyIndex from;
    BodyIndex to;
};

Error cannotCut(const char* why)
{
    return {ErrorCode::Unsupported, why};
}

Error tooLarge(const char* does, std::size_t limit)
{
    return {ErrorCode::TooLarge,
            fmt::format("{} more than {} million triangles of the maps below it, one of which is "
                        "larger than memory",
                        does, limit / 1'000'000)};
}

// One map over those below it.
class MapCut {
public:
    MapCut(LayerPatch& patch, std::size_t index, const LayerLimits& limits, JobMonitor& monitor)
        : patch_(patch)
        , index_(index)
        , map_(patch.maps()[index])
        , limits_(limits)
        , monitor_(monitor)
    {}

    Status run()
    {
        removeVoids();
        findRim();
        if (Status placed = placeRim(); !placed) {
            return placed;
        }
        if (below_.empty()) {
            return removeHidden();
        }
        std::vector<std::vector<BodyIndex>> ways;
        for (const RimEdge& edge : rim_) {
            if (monitor_.isCanceled()) {
                return canceled();
            }
            auto way = patch_.connect(below_.at(edge.from), below_.at(edge.to), tolerance_);
            if (!way || way->size() < 2) {
                return cannotCut(kCannotCut);
            }
            if (is_over_tiles_ && patch_.cutFaces().size() > limits_.cut_faces_max) {
                return tooLarge("the border of a map crosses", limits_.cut_faces_max);
            }
            ways.push_back(std::move(*way));
        }
        return link(ways);
    }

private:
    static Error canceled() { return {ErrorCode::Canceled, "joining the maps was canceled"}; }

    // Faces without data are left out where a map below has a surface.
    void removeVoids()
    {
        if (!map_.mesh->hasVoids()) {
            return;
        }
        const auto count = map_.mesh->faceCount();
        for (BodyIndex face = 0; face < count; ++face) {
            if (!map_.mesh->isFilled(face)) {
                continue;
            }
            const auto [a, b, c] = map_.mesh->points(face);
            if (patch_.find(index_ + 1, a + ((b - a) + (c - a)) * (1.0 / 3.0))) {
                patch_.removeFace(map_.first_face + face);
            }
        }
    }

    // In the order of the border, so that each edge begins near the one before it.
    void findRim()
    {
        std::vector<RimEdge> edges;
        std::unordered_map<BodyIndex, std::vector<std::size_t>> from;
        const auto look_at = [&](BodyIndex own) {
            if (map_.is_gone[own]) {
                return;
            }
            for (BodyIndex i = 0; i < 3; ++i) {
                const BodyIndex beyond = map_.mesh->across(3 * own + i);
                if (beyond != kNone && !map_.is_gone[beyond / 3]) {
                    continue;
                }
                const BodyIndex face = map_.first_face + own;
                const BodyFace vertices = patch_.face(face);
                from[vertices[(i + 1) % 3]].push_back(edges.size());
                edges.push_back({face, vertices[(i + 1) % 3], vertices[(i + 2) % 3]});
                if (beyond != kNone) {
                    patch_.setAcross(3 * face + i, kNone);
                }
            }
        };
        if (map_.mesh->isTiled()) { // without voids
            map_.mesh->eachFaceAtBorder(look_at);
        } else {
            const auto count = map_.mesh->faceCount();
            for (BodyIndex own = 0; own < count; ++own) {
                look_at(own);
            }
        }
        std::vector<bool> is_taken(edges.size(), false);
        for (std::size_t begin = 0; begin < edges.size(); ++begin) {
            for (std::size_t at = begin; !is_taken[at];) {
                is_taken[at] = true;
                rim_.push_back(edges[at]);
                for (const std::size_t next : from[edges[at].to]) {
                    if (!is_taken[next]) {
                        at = next;
                        break;
                    }
                }
            }
        }
        double shortest = std::numeric_limits<double>::infinity();
        for (const RimEdge& edge : rim_) {
            shortest = std::min(shortest, length(patch_.up(edge.to) - patch_.up(edge.from)));
        }
        tolerance_ = kSnapShare * shortest;
    }

    Status placeRim()
    {
        std::size_t outside = 0;
        for (std::size_t i = 0; i < rim_.size(); ++i) {
            const BodyIndex vertex = rim_[i].from;
            if (below_.contains(vertex)) {
                continue;
            }
            if (monitor_.isCanceled()) {
                return canceled();
            }
            const Vec3 up = patch_.up(vertex);
            std::optional<BodyIndex> face;
            if (i > 0 && rim_[i - 1].to == vertex && below_.contains(rim_[i - 1].from)) {
                const BodyIndex near = patch_.cornerAt(below_.at(rim_[i - 1].from));
                face = near == kNone ? std::nullopt : patch_.walkTo(near / 3, up);
            }
            if (!face) {
                face = patch_.find(index_ + 1, patch_.point(vertex));
            }
            if (!face) {
                ++outside;
                continue;
            }
            below_[vertex] = patch_.insert(*face, up, tolerance_);
        }
        return outside == 0 || below_.empty() ? Status(Done{}) : Status(cannotCut(kLeadsBeyond));
    }

    // The map covers each of those below as a whole or not at all.
    Status removeHidden()
    {
        for (std::size_t i = index_ + 1; i < patch_.maps().size(); ++i) {
            const LayerPatch::Map& other = patch_.maps()[i];
            std::size_t looked_at = 0;
            std::size_t covered = 0;
            other.mesh->eachVertexAtBorder([&](BodyIndex vertex) {
                ++looked_at;
                covered += isOver(other.mesh->vertex(vertex)) ? 1U : 0U;
            });
            if (covered != 0 && covered != looked_at) {
                return cannotCut(kLeadsBeyond);
            }
            if (covered != 0) {
                patch_.removeMap(i);
            }
        }
        return Done{};
    }

    bool isOver(const ScenePoint& point) const
    {
        const auto found = patch_.find(index_, point);
        return found && !patch_.isCut(*found) && patch_.mapOf(*found) == index_;
    }

    Status link(const std::vector<std::vector<BodyIndex>>& ways)
    {
        struct Joint {
            BodyIndex upper;
            BodyIndex lower; // outside
        };
        std::vector<Joint> joints;
        std::vector<BodyIndex> inside;
        const Error failure = cannotCut(kCannotCut);
        // The upper edges are split where the lower ones are.
        std::vector<std::vector<BodyIndex>> uppers;
        for (std::size_t i = 0; i < rim_.size(); ++i) {
            const RimEdge& edge = rim_[i];
            const std::vector<BodyIndex>& way = ways[i];
            std::vector<BodyIndex> upper{edge.from};
            for (std::size_t k = 1; k + 1 < way.size(); ++k) {
                const BodyIndex corner = patch_.partAtEdge(edge.face, upper.back(), edge.to);
                if (corner == kNone) {
                    return failure;
                }
                // Ends of the edge that were put onto something near may lie beyond the vertex.
                const double share = std::clamp(patch_.shareBeside(corner, patch_.up(way[k])),
                                                kShareMin, 1.0 - kShareMin);
                upper.push_back(
                    patch_.vertexAt(patch_.splitEdge(corner, share, patch_.up(way[k]))));
            }
            upper.push_back(edge.to);
            uppers.push_back(std::move(upper));
        }
        for (std::size_t i = 0; i < rim_.size(); ++i) {
            const std::vector<BodyIndex>& way = ways[i];
            for (std::size_t k = 0; k + 1 < way.size(); ++k) {
                const BodyIndex outside = patch_.cornerAtEdge(way[k + 1], way[k]);
                if (outside == kNone) {
                    return failure;
                }
                const Joint joint{
                    .upper = patch_.partAtEdge(rim_[i].face, uppers[i][k], uppers[i][k + 1]),
                    .lower = patch_.cutCorner(outside)};
                const BodyIndex covered = patch_.cornerAtEdge(way[k], way[k + 1]);
                if (joint.upper == kNone || covered == kNone) {
                    return failure;
                }
                joints.push_back(joint);
                inside.push_back(covered);
            }
            for (std::size_t k = 0; k < way.size(); ++k) {
                twins_.emplace_back(uppers[i][k], way[k]);
            }
        }
        if (Status removed = removeCovered(inside); !removed) {
            return removed;
        }
        for (const Joint& joint : joints) {
            if (patch_.isGone(joint.lower / 3)) {
                return failure;
            }
            patch_.setAcross(joint.upper, joint.lower);
            patch_.setAcross(joint.lower, joint.upper);
        }
        for (const auto& [upper, lower] : twins_) {
            patch_.setTwins(upper, lower);
        }
        patch_.noteAll();
        return Done{};
    }

    // From the border inwards, ring by ring: there are far more covered faces than a ring has.
    Status removeCovered(const std::vector<BodyIndex>& inside)
    {
        std::unordered_set<BodyIndex> border(inside.begin(), inside.end());
        std::vector<BodyIndex> faces;
        std::size_t count = 0;
        const auto take = [&](BodyIndex face) {
            if (!patch_.isGone(face)) {
                patch_.removeFace(face);
                faces.push_back(face);
                ++count;
            }
        };
        for (const BodyIndex corner : inside) {
            take(corner / 3);
        }
        while (!faces.empty()) {
            if (monitor_.isCanceled()) {
                return canceled();
            }
            if (is_over_tiles_ && count > limits_.covered_faces_max) {
                return tooLarge("a map covers", limits_.covered_faces_max);
            }
            for (const BodyIndex face : std::exchange(faces, {})) {
                for (BodyIndex corner = 3 * face; corner < 3 * face + 3; ++corner) {
                    const BodyIndex beyond = patch_.across(corner);
                    if (beyond != kNone && !border.contains(corner)) {
                        take(beyond / 3);
                    }
                }
            }
        }
        return Done{};
    }

    LayerPatch& patch_;
    std::size_t index_;
    const LayerPatch::Map& map_;
    const LayerLimits& limits_;
    JobMonitor& monitor_;
    const bool is_over_tiles_ =
        std::any_of(patch_.maps().begin() + static_cast<std::ptrdiff_t>(index_) + 1,
                    patch_.maps().end(),
                    [](const LayerPatch::Map& map) { return map.mesh->isTiled(); });
    std::vector<RimEdge> rim_;
    double tolerance_ = 0.0;
    std::unordered_map<BodyIndex, BodyIndex> below_; // of vertices of the rim
    std::vector<std::pair<BodyIndex, BodyIndex>> twins_;
};

class Walls {
public:
    explicit Walls(LayerPatch& patch)
        : patch_(patch)
    {}

    void add()
    {
        weldLevelEnds();
        splitCrossed();
        eachCliff([this](BodyIndex corner, BodyIndex beyond) { addWall(corner, beyond); });
        for (std::size_t i = 0; i < walls_.size(); ++i) {
            joinLeftEnd(walls_[i]);
        }
        for (const Wall& wall : walls_) {
            join(wall.high, wall.top);
            join(wall.low, wall.bottom);
        }
        for (const auto& [a, b] : vertical_) {
            join(a, b);
        }
        patch_.noteAll();
        separateFans();
    }

private:
    // A step of the way up at one end of a wall: the corner opposite it.
    struct Step {
        BodyIndex from;
        BodyIndex to;
        BodyIndex corner;
    };
    // Seen from free space, over the lower face: the higher face's edge leads from left to right.
    struct Wall {
        BodyIndex high; // corners opposite the edge, in both faces
        BodyIndex low;
        BodyIndex top = kNone; // in the wall's faces
        BodyIndex bottom = kNone;
        std::vector<Step> left{};
        std::vector<Step> right{};
    };

    // Rise of one vertex over its twin, without the rounding of heights.
    double rise(BodyIndex upper, BodyIndex lower) const
    {
        return upper == lower ? 0.0
                              : dot(patch_.point(upper) - patch_.point(lower), patch_.up(lower));
    }
    void join(BodyIndex a, BodyIndex b)
    {
        patch_.setAcross(a, b);
        patch_.setAcross(b, a);
    }

    // Each edge between faces of two maps whose vertices differ. Faces may be added meanwhile.
    template <typename F>
    void eachCliff(F&& visit)
    {
        for (BodyIndex i = 0; i < patch_.cutFaces().size(); ++i) {
            for (BodyIndex k = 0; k < 3; ++k) {
                const LayerPatch::Face& face = patch_.cutFaces()[i];
                if (face.is_gone || face.origin == kNone || face.across[k] == kNone) {
                    continue;
                }
                const BodyIndex corner = 3 * (patch_.mapFaces() + i) + k;
                const BodyIndex beyond = face.across[k];
                const bool is_first = !patch_.isCut(beyond / 3) || corner < beyond;
                const bool is_cliff =
                    face.vertices[(k + 1) % 3] != patch_.vertexAt(previousCorner(beyond)) ||
                    face.vertices[(k + 2) % 3] != patch_.vertexAt(nextCorner(beyond));
                if (is_first && is_cliff) {
                    visit(corner, beyond);
                }
            }
        }
    }

    // The vertices of all cliffs at a place, from the lowest to the highest. Those at one height
    // become one.
    void weldLevelEnds()
    {
        eachCliff([this](BodyIndex corner, BodyIndex beyond) {
            for (const BodyIndex at : {nextCorner(corner), previousCorner(corner),
                                       nextCorner(beyond), previousCorner(beyond)}) {
                const BodyIndex vertex = patch_.vertexAt(at);
                auto& stack = stacks_[patch_.placeOf(vertex)];
                if (std::find(stack.begin(), stack.end(), vertex) == stack.end()) {
                    stack.push_back(vertex);
                }
            }
            const double edge_m = length(patch_.point(patch_.vertexAt(nextCorner(corner))) -
                                         patch_.point(patch_.vertexAt(previousCorner(corner))));
            shortest_m_ = std::min(shortest_m_, edge_m);
        });
        constexpr double kLevelShare = 1e-6; // of the shortest edge
        const double level_m = std::max(kLevelShare * shortest_m_, 1e-6);
        std::unordered_map<BodyIndex, BodyIndex> welded;
        for (auto& [place, stack] : stacks_) {
            std::sort(stack.begin(), stack.end(),
                      [this](BodyIndex a, BodyIndex b) { return rise(a, b) < 0.0; });
            std::vector<BodyIndex> levels;
            for (const BodyIndex vertex : stack) {
                if (levels.empty() || rise(vertex, levels.back()) > level_m) {
                    levels.push_back(vertex);
                } else if (levels.back() < patch_.mapVertices()) {
                    welded[vertex] = levels.back();
                } else {
                    for (auto& [from, to] : welded) {
                        to = to == levels.back() ? vertex : to;
                    }
                    welded[levels.back()] = vertex;
                    levels.back() = vertex;
                }
            }
            stack = std::move(levels);
        }
        for (const auto& [from, to] : welded) {
            if (from < patch_.mapVertices()) {
                const LayerPatch::Map& map = patch_.maps()[patch_.mapOfVertex(from)];
                for (const BodyIndex corner : map.mesh->fan(from - map.first_vertex)) {
                    if (!map.is_gone[corner / 3]) {
                        patch_.cutCorner(corner + 3 * map.first_face);
                    }
                }
            }
        }
        for (BodyIndex i = 0; i < patch_.cutFaces().size(); ++i) {
            for (BodyIndex k = 0; k < 3 && !patch_.cutFaces()[i].is_gone; ++k) {
                if (const auto to = welded.find(patch_.cutFaces()[i].vertices[k]);
                    to != welded.end()) {
                    patch_.setVertex(3 * (patch_.mapFaces() + i) + k, to->second);
                }
            }
        }
    }

    // Where the two surfaces cross between the ends of an edge, it is split there.
    void splitCrossed()
    {
        eachCliff([this](BodyIndex corner, BodyIndex beyond) {
            const double at_from =
                rise(patch_.vertexAt(nextCorner(corner)), patch_.vertexAt(previousCorner(beyond)));
            const double at_to =
                rise(patch_.vertexAt(previousCorner(corner)), patch_.vertexAt(nextCorner(beyond)));
            if ((at_from < 0.0 && at_to > 0.0) || (at_from > 0.0 && at_to < 0.0)) {
                const double share = at_from / (at_from - at_to);
                const Vec3 from = patch_.up(patch_.vertexAt(nextCorner(corner)));
                const Vec3 to = patch_.up(patch_.vertexAt(previousCorner(corner)));
                const BodyIndex middle =
                    patch_.splitEdge(corner, share, normalized(from + (to - from) * share));
                const BodyIndex vertex = patch_.vertexAt(middle);
                // The same vertex on the other side, in both of its faces.
                const BodyIndex beyond_second = patch_.across(previousCorner(middle));
                const BodyIndex first = patch_.across(nextCorner(middle));
                const BodyIndex beyond_first = patch_.across(previousCorner(first));
                patch_.setVertex(previousCorner(beyond_second), vertex);
                patch_.setVertex(nextCorner(beyond_first), vertex);
            }
        });
    }

    void addWall(BodyIndex corner, BodyIndex beyond)
    {
        const double rises =
            rise(patch_.vertexAt(nextCorner(corner)), patch_.vertexAt(previousCorner(beyond))) +
            rise(patch_.vertexAt(previousCorner(corner)), patch_.vertexAt(nextCorner(beyond)));
        Wall wall{.high = rises > 0.0 ? corner : beyond, .low = rises > 0.0 ? beyond : corner};
        const auto levels = [this](BodyIndex low, BodyIndex high) {
            std::vector<BodyIndex> way{low};
            if (low != high) {
                const auto stack = stacks_.find(patch_.placeOf(low));
                if (stack != stacks_.end()) {
                    const auto& all = stack->second;
                    const auto from = std::find(all.begin(), all.end(), low);
                    const auto to = std::find(all.begin(), all.end(), high);
                    if (from < to && to != all.end()) {
                        way.insert(way.end(), from + 1, to);
                    }
                }
                way.push_back(high);
            }
            return way;
        };
        const std::vector<BodyIndex> left = levels(patch_.vertexAt(previousCorner(wall.low)),
                                                   patch_.vertexAt(nextCorner(wall.high)));
        const std::vector<BodyIndex> right = levels(patch_.vertexAt(nextCorner(wall.low)),
                                                    patch_.vertexAt(previousCorner(wall.high)));
        std::size_t i = 0;
        std::size_t k = 0;
        while (i + 1 < left.size() || k + 1 < right.size()) {
            const bool is_left = k + 1 == right.size() ||
                                 (i + 1 < left.size() &&
                                  (i + 1) * (right.size() - 1) <= (k + 1) * (left.size() - 1));
            const BodyIndex third = is_left ? left[i + 1] : right[k + 1];
            const BodyIndex first = 3 * patch_.addFace({.vertices = {left[i], right[k], third},
                                                        .across = {kNone, kNone, kNone}});
            if (wall.bottom == kNone) {
                wall.bottom = first + 2;
            } else {
                join(wall.top, first + 2);
            }
            wall.top = is_left ? first : first + 1;
            if (is_left) {
                wall.left.push_back({left[i], left[i + 1], first + 1});
                ++i;
            } else {
                wall.right.push_back({right[k], right[k + 1], first});
                ++k;
            }
        }
        wall_at_[wall.high] = walls_.size();
        wall_at_[wall.low] = walls_.size();
        walls_.push_back(std::move(wall));
    }

    // Around the place at its left end clockwise, through free space, to the wall at the other
    // side.
    void joinLeftEnd(const Wall& wall)
    {
        for (const Step& step : wall.left) {
            const BodyIndex begin = previousCorner(wall.low);
            BodyIndex corner = begin;
            do {
                const BodyIndex side = previousCorner(corner);
                if (const auto next = wall_at_.find(side); next != wall_at_.end()) {
                    const auto& steps = walls_[next->second].right;
                    const auto found =
                        std::find_if(steps.begin(), steps.end(), [&step](const Step& other) {
                            return other.from == step.from && other.to == step.to;
                        });
                    if (found != steps.end()) {
                        vertical_.emplace_back(step.corner, found->corner);
                        break;
                    }
                }
                corner = patch_.turnedBack(corner);
            } while (corner != kNone && corner != begin);
        }
    }

    // Where faces of a vertex do not hang together, they get vertices of their own.
    void separateFans()
    {
        std::unordered_set<BodyIndex> seen;    // corners of cut faces
        std::unordered_set<BodyIndex> has_one; // vertices
        for (BodyIndex i = 0; i < patch_.cutFaces().size(); ++i) {
            for (BodyIndex k = 0; k < 3; ++k) {
                const BodyIndex begin = 3 * (patch_.mapFaces() + i) + k;
                if (patch_.cutFaces()[i].is_gone || seen.contains(begin)) {
                    continue;
                }
                std::vector<BodyIndex> fan{begin};
                BodyIndex corner = patch_.turned(begin);
                for (; corner != kNone && corner != begin; corner = patch_.turned(corner)) {
                    fan.push_back(corner);
                }
                if (corner == kNone) {
                    for (corner = patch_.turnedBack(begin); corner != kNone;
                         corner = patch_.turnedBack(corner)) {
                        fan.push_back(corner);
                    }
                }
                const BodyIndex vertex = patch_.vertexAt(begin);
                const bool is_first = has_one.insert(vertex).second;
                const BodyIndex own =
                    is_first ? vertex : patch_.addVertex(patch_.point(vertex), patch_.up(vertex));
                for (const BodyIndex at : fan) {
                    const BodyIndex cut = is_first ? at : patch_.cutCorner(at);
                    if (!is_first) {
                        patch_.setVertex(cut, own);
                    }
                    seen.insert(cut);
                }
            }
        }
    }

    LayerPatch& patch_;
    std::unordered_map<BodyIndex, std::vector<BodyIndex>> stacks_; // by place
    double shortest_m_ = std::numeric_limits<double>::infinity();
    std::vector<Wall> walls_;
    std::unordered_map<BodyIndex, std::size_t> wall_at_; // of the corners that walls join
    std::vector<std::pair<BodyIndex, BodyIndex>> vertical_;
};

} // namespace

Status cutOut(LayerPatch& patch, std::size_t index, const LayerLimits& limits, JobMonitor& monitor)
{
    return MapCut(patch, index, limits, monitor).run();
}

void addWalls(LayerPatch& patch)
{
    Walls(patch).add();
}

} // namespace marsview
