#include "tests/core/contact/nested_maps.h"

#include "app/bench/reference/fractal_heights.h"
#include "core/contact/layered_surface.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/core/mesh/mesh_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace marsview::test {
namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

const char* const kTransverse = "+proj=tmerc +lat_0=18 +lon_0=226 +R=3396190 +units=m";
const char* const kPolar = "+proj=stere +lat_0=90 +lon_0=0 +R=3396190 +units=m";
const char* const kPlate = "+proj=longlat +R=3396190";

BodyMap fine(std::size_t columns, std::size_t rows, double cell_m, double relief_m)
{
    const double left = -0.5 * cell_m * static_cast<double>(columns);
    const double top = 0.5 * cell_m * static_cast<double>(rows);
    return {"Fine", kTransverse, columns, rows, {left, cell_m, 0, top, 0, -cell_m}, relief_m};
}

BodyMap whole(std::size_t columns, std::size_t rows)
{
    BodyMap map = wholeMars(columns, rows);
    map.crs = kPlate;
    return map;
}

// The straight way from a place on the ellipsoid along its normal meets the plane of a face inside
// it: how far from the place.
std::optional<double>
meets(const std::array<ScenePoint, 3>& points, const ScenePoint& place, const Vec3& up)
{
    using L = long double;
    struct V {
        L x, y, z;
    };
    const auto minus = [](const ScenePoint& a, const ScenePoint& b) {
        return V{L(a.x) - L(b.x), L(a.y) - L(b.y), L(a.z) - L(b.z)};
    };
    const auto times = [](const V& a, const V& b) {
        return V{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    };
    const auto product = [](const V& a, const V& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    const V n{up.x, up.y, up.z};
    const V a = minus(points[0], place);
    const V b = minus(points[1], place);
    const V c = minus(points[2], place);
    const L w0 = product(n, times(b, c));
    const L w1 = product(n, times(c, a));
    const L w2 = product(n, times(a, b));
    const L sum = w0 + w1 + w2;
    if (!(sum > 0) || w0 < 0 || w1 < 0 || w2 < 0) {
        return std::nullopt;
    }
    return static_cast<double>((w0 * product(a, n) + w1 * product(b, n) + w2 * product(c, n)) /
                               sum);
}

} // namespace

std::vector<NestedMaps> nestedMaps(const std::vector<std::string>& names)
{
    const NestedMap coarse{whole(36, 18)};
    BodyMap polar{"Polar", kPolar, 31, 27, {-150000, 10000, 0, 130000, 0, -10000}, 2000.0};
    // Its samples are samples of the map below it, and others on its edges.
    BodyMap aligned{"Aligned", kPlate, 11, 9, {200, 5, 0, 60, 0, -5}, 2000.0};
    std::vector<NestedMaps> all{
        {"Fine", {{fine(41, 33, 10000, 500.0), 200.0}, coarse}},
        {"FineWithVoids", {{fine(41, 33, 10000, 500.0), 200.0, true}, coarse}},
        {"FineInACell", {{fine(23, 21, 200, 50.0), 3000.0}, coarse}},
        {"FineLower", {{fine(41, 33, 10000, 500.0), -4000.0}, coarse}},
        {"OverThePole", {{polar, 200.0}, coarse}},
        {"OverThePoleWithVoids", {{polar, 200.0, true}, coarse}},
        {"Aligned", {{aligned, 200.0}, {whole(72, 36)}}},
        {"AlignedWithVoids", {{aligned, -200.0, true}, {whole(72, 36)}}},
        {"CoarseOverFine", {{fine(5, 4, 500000, 500.0), 9000.0}, {whole(90, 45)}}},
        {"TheSameHeights", {{aligned, 0.0, false, true}, {whole(72, 36), 0.0, false, true}}},
        {"TheSameHeightsWithVoids",
         {{aligned, 0.0, true, true}, {whole(72, 36), 0.0, false, true}}},
    };
    if (!names.empty()) {
        std::erase_if(all, [&names](const NestedMaps& maps) {
            return std::find(names.begin(), names.end(), maps.name) == names.end();
        });
    }
    return all;
}

NestedMaps crossingMaps()
{
    return {"Crossing",
            {{fine(41, 33, 10000, 500.0), 200.0, true},
             {fine(21, 17, 30000, 3000.0), 1000.0, true},
             {whole(72, 36)}}};
}

NestedMaps beyondMaps()
{
    BodyMap beside = fine(41, 33, 10000, 500.0);
    beside.terms[0] += 205000.0;
    return {"Beyond", {{beside}, {fine(37, 29, 10000, 500.0)}}};
}

NestedMaps levelStep()
{
    BodyMap lower = whole(180, 90);
    lower.relief_m = 0.0;
    return {"LevelStep", {{fine(41, 33, 1000, 0.0), 200.0}, {lower}}};
}

std::shared_ptr<const FilledHeightfield> heightsOf(const NestedMap& nested)
{
    const BodyMap& map = nested.map;
    std::vector<float> heights = fractalHeights(map.columns, map.rows, 7);
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    const float middle = 0.5F * (*low + *high);
    const float scale = static_cast<float>(map.relief_m) / std::max(*high - *low, 1e-6F);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const std::size_t column = i % map.columns;
        const std::size_t row = i / map.columns;
        if (nested.is_plain) {
            // Of the sample's center.
            const double longitude =
                map.terms[0] + map.terms[1] * (static_cast<double>(column) + 0.5);
            const double latitude = map.terms[3] + map.terms[5] * (static_cast<double>(row) + 0.5);
            heights[i] = static_cast<float>(
                std::round(1000.0 * std::sin(0.7 * longitude) * std::cos(1.1 * latitude)));
        } else {
            heights[i] = (heights[i] - middle) * scale + static_cast<float>(nested.raised_m);
        }
        // Single ones, groups, at the border, and two that touch at a corner only.
        if (nested.has_voids &&
            ((column == 3 && row == 3) || (column == 6 && row == 5) || (column == 0 && row == 6) ||
             (column + 2 > map.columns && row > 4 && row < 8) ||
             (column > 5 && column < 9 && row > 5 && row < 8) || (column == 4 && row == 5))) {
            heights[i] = kVoid;
        }
    }
    return filledTerrain(map.columns, heights);
}

std::vector<std::shared_ptr<const BodyMesh>> meshesOf(const NestedMaps& maps, double exaggeration)
{
    std::vector<std::shared_ptr<const BodyMesh>> meshes;
    for (const NestedMap& nested : maps.maps) {
        JobMonitor monitor;
        auto mesh = BodyMesh::build(heightsOf(nested), georeferenceOf(nested.map), exaggeration,
                                    monitor, Ellipsoid{3396190.0, 3376200.0});
        EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().message);
        meshes.push_back(std::move(mesh).value());
    }
    return meshes;
}

TriangleSoup listOf(const LayeredMesh& mesh)
{
    TriangleSoup soup;
    for (BodyIndex i = 0; i < mesh.vertexCount(); ++i) {
        soup.vertices.push_back(mesh.vertex(i));
    }
    for (BodyIndex face = 0; face < mesh.faceCount(); ++face) {
        if (!mesh.isGone(face)) {
            soup.faces.push_back(listedFace(mesh.face(face)));
        }
    }
    return soup;
}

int contactsAsOnList(const std::shared_ptr<const LayeredMesh>& mesh,
                     const BodyMesh& upper,
                     ContactModelKind kind)
{
    JobMonitor monitor;
    const auto listed = TriangleMesh::build(listOf(*mesh), monitor);
    EXPECT_TRUE(listed);
    if (!listed) {
        return 0;
    }
    const auto model = makeContactModel(kind, LayeredSurface(mesh));
    const auto other = makeContactModel(kind, MeshSurface(*listed));
    Random random(3);
    const double cell_m = cellOf(upper);
    ScenePoint goal = mesh->highAbove(placeNear(upper, random));
    model->update(goal);
    other->update(goal);
    int contacts = 0;
    const std::size_t cut_faces = mesh->faceCount() - mesh->firstCutFace();
    for (int i = 0; i < 300; ++i) {
        const auto face =
            mesh->firstCutFace() + static_cast<std::uint32_t>(random.below(cut_faces));
        const auto [a, b, c] = mesh->points(face);
        const ScenePoint middle = a + ((b - a) + (c - a)) * (1.0 / 3.0);
        const Vec3 up = verticalAt(mesh->ellipsoid(), middle).up;
        goal = goal + (middle - goal) * (i % 10 == 0 ? 1.0 : random.uniform(0.0, 0.2)) +
               up * (0.1 * cell_m * random.uniform(-1.0, 0.2));
        const ContactState here = model->update(goal);
        const ContactState there = other->update(goal);
        EXPECT_LE(length(here.proxy - there.proxy), 1e-6 * cell_m) << i;
        EXPECT_EQ(here.counters.cut_short, 0U) << i;
        contacts += here.is_in_contact ? 1 : 0;
        if (here.is_in_contact && i % 50 == 0 && kind != ContactModelKind::GodObject) {
            EXPECT_LE(bruteDistance(**listed, here.proxy), 1e-6) << i;
        }
    }
    return contacts;
}

double cellOf(const BodyMesh& mesh)
{
    const auto middle = static_cast<BodyIndex>(
        mesh.positions().rows() / 2 * mesh.positions().columns() + mesh.positions().columns() / 2);
    return 0.5 *
           (length(mesh.vertex(middle + 1) - mesh.vertex(middle)) +
            length(mesh.vertex(middle) -
                   mesh.vertex(middle + static_cast<std::uint32_t>(mesh.positions().columns()))));
}

ScenePoint placeNear(const BodyMesh& mesh, Random& random)
{
    const BodyPositions& positions = mesh.positions();
    const auto along = [&random](std::size_t count) {
        return random.uniform(-0.25, 1.25) * static_cast<double>(count - 1);
    };
    const double column = along(positions.columns());
    const double row = along(positions.rows());
    const auto c = static_cast<std::size_t>(
        std::clamp(column, 0.0, static_cast<double>(positions.columns() - 2)));
    const auto r =
        static_cast<std::size_t>(std::clamp(row, 0.0, static_cast<double>(positions.rows() - 2)));
    const ScenePoint at = positions.at(c, r, 0.0);
    const ScenePoint point =
        at + (positions.at(c + 1, r, 0.0) - at) * (column - static_cast<double>(c)) +
        (positions.at(c, r + 1, 0.0) - at) * (row - static_cast<double>(r));
    const BodyVertical vertical = verticalAt(positions.ellipsoid(), point);
    return point - vertical.up * vertical.height_m;
}

double distanceToRim(const BodyMesh& mesh, const ScenePoint& place)
{
    double nearest = std::numeric_limits<double>::infinity();
    const auto level = [&mesh](const ScenePoint& point) {
        const BodyVertical vertical = verticalAt(mesh.ellipsoid(), point);
        return point - vertical.up * vertical.height_m;
    };
    for (BodyIndex corner = 0; corner < 3 * mesh.faceCount(); ++corner) {
        const BodyIndex beyond = mesh.across(corner);
        if (mesh.isFilled(corner / 3) ||
            (beyond != BodyMesh::kNone && !mesh.isFilled(beyond / 3))) {
            continue;
        }
        const ScenePoint a = level(mesh.vertex(mesh.vertexAt(BodyMesh::nextCorner(corner))));
        const ScenePoint b = level(mesh.vertex(mesh.vertexAt(BodyMesh::previousCorner(corner))));
        const double share = std::clamp(dot(place - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
        // The chord lies below the ellipsoid.
        const ScenePoint nearest_on = level(a + (b - a) * share);
        nearest = std::min(nearest, length(place - nearest_on));
    }
    return nearest;
}

std::optional<Below> below(const LayeredMesh& mesh, const ScenePoint& place)
{
    const Vec3 up = verticalAt(mesh.ellipsoid(), place).up;
    std::optional<Below> highest;
    for (BodyIndex face = 0; face < mesh.faceCount(); ++face) {
        if (mesh.isGone(face) || mesh.isWall(face)) {
            continue;
        }
        const auto points = mesh.points(face);
        if (dot(points[0], up) < 0.0) {
            continue;
        }
        if (const auto height_m = meets(points, place, up);
            height_m && (!highest || *height_m > highest->height_m)) {
            highest = Below{.map = 0, .height_m = *height_m};
        }
    }
    return highest;
}

std::optional<Below> uppermostBelow(const std::vector<std::shared_ptr<const BodyMesh>>& maps,
                                    const ScenePoint& place)
{
    const Vec3 up = verticalAt(maps.front()->ellipsoid(), place).up;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        for (BodyIndex face = 0; face < maps[i]->faceCount(); ++face) {
            if (i + 1 < maps.size() && maps[i]->isFilled(face)) {
                continue;
            }
            const auto points = maps[i]->points(face);
            if (dot(points[0], up) < 0.0) {
                continue;
            }
            if (const auto height_m = meets(points, place, up)) {
                return Below{.map = i, .height_m = *height_m};
            }
        }
    }
    return std::nullopt;
}

} // namespace marsview::test
