#include "tests/core/contact/body_maps.h"

#include "app/bench/reference/fractal_heights.h"
#include "tests/core/contact/contact_terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace marsview::test {

BodyMap wholeMars(std::size_t columns, std::size_t rows)
{
    const double step = 360.0 / static_cast<double>(columns);
    const double down = 180.0 / static_cast<double>(rows);
    return {"WholeMars", "IAU_2015:49900", columns, rows, {0, step, 0, 90, 0, -down}, 8000.0};
}

std::vector<BodyMap> bodyMaps()
{
    BodyMap odd = wholeMars(45, 22);
    odd.name = "WholeMarsOdd";
    return {
        wholeMars(48, 24),
        odd,
        {"Fewest", "IAU_2015:49900", 3, 2, {0, 120, 0, 90, 0, -90}, 8000.0},
        {"Westward", "IAU_2015:49900", 40, 20, {360, -9, 0, 90, 0, -9}, 8000.0},
        {"Northward", "IAU_2015:49900", 40, 20, {0, 9, 0, -90, 0, 9}, 8000.0},
        {"Registered", "IAU_2015:49900", 37, 19, {-5, 10, 0, 95, 0, -10}, 8000.0},
        {"Belt", "IAU_2015:49900", 40, 12, {-180, 9, 0, 50, 0, -9}, 8000.0},
        {"Cap", "IAU_2015:49900", 40, 8, {-180, 9, 0, 90, 0, -9}, 8000.0},
        {"Part", "EPSG:4326", 30, 20, {6, 0.1, 0, 47, 0, -0.1}, 3000.0},
        {"Utm", "EPSG:32611", 33, 21, {390045, 30, 0, 3797505, 0, -30}, 400.0},
        {"UtmMirrored", "EPSG:32611", 33, 21, {390045, -30, 0, 3797505, 0, -30}, 400.0},
        {"OverThePole",
         "+proj=stere +lat_0=-90 +lon_0=0 +R=1737400 +units=m",
         31,
         30,
         {-155000, 10000, 0, 150000, 0, -10000},
         5000.0},
    };
}

Georeference georeferenceOf(const BodyMap& map)
{
    return {map.columns, map.rows, *GeoTransform::fromTerms(map.terms), *Crs::fromText(map.crs)};
}

std::shared_ptr<const FilledHeightfield> fractalMap(const BodyMap& map)
{
    std::vector<float> heights = fractalHeights(map.columns, map.rows, 7);
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    const float middle = 0.5F * (*low + *high);
    const float scale = static_cast<float>(map.relief_m) / std::max(*high - *low, 1e-6F);
    for (float& height : heights) {
        height = (height - middle) * scale;
    }
    return filledTerrain(map.columns, heights);
}

std::shared_ptr<const BodyMesh> bodyMesh(const BodyMap& map, double exaggeration)
{
    JobMonitor monitor;
    const auto mesh = BodyMesh::build(fractalMap(map), georeferenceOf(map), exaggeration, monitor);
    EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().message);
    return *mesh;
}

MeshFace listedFace(const BodyFace& face)
{
    return {static_cast<std::uint32_t>(face[0]), static_cast<std::uint32_t>(face[1]),
            static_cast<std::uint32_t>(face[2])};
}

std::shared_ptr<const TriangleMesh> listedMesh(const BodyMesh& mesh)
{
    TriangleSoup soup;
    for (BodyIndex v = 0; v < mesh.vertexCount(); ++v) {
        soup.vertices.push_back(mesh.vertex(v));
    }
    for (BodyIndex f = 0; f < mesh.faceCount(); ++f) {
        soup.faces.push_back(listedFace(mesh.face(f)));
    }
    JobMonitor monitor;
    const auto listed = TriangleMesh::build(std::move(soup), monitor);
    EXPECT_TRUE(listed) << (listed ? "" : listed.error().message);
    return *listed;
}

ScenePoint BodyWalker::next(double step_cells)
{
    column += random.uniform(-step_cells, step_cells);
    row += random.uniform(-step_cells, step_cells);
    const double columns = static_cast<double>(mesh.positions().columns());
    const double rows = static_cast<double>(mesh.positions().rows());
    if (mesh.positions().wraps()) {
        column -= columns * std::floor(column / columns);
    }
    column = std::clamp(column, 0.0, columns - 1.0);
    row = std::clamp(row, 0.0, rows - 1.0);
    const auto c = static_cast<std::size_t>(column);
    const auto r = static_cast<std::size_t>(row);
    const BodyIndex vertex = r * mesh.positions().columns() + c;
    const ScenePoint at = mesh.vertex(vertex);
    const Vec3 up = mesh.positions().at(c, r, 1.0) - mesh.positions().at(c, r, 0.0);
    const auto fan = mesh.fan(vertex);
    const ScenePoint beside = mesh.vertex(mesh.vertexAt(BodyMesh::nextCorner(fan.front())));
    const double cell_m = length(beside - at);
    return at + (beside - at) * random.uniform(-1.0, 1.0) +
           up * (cell_m * random.uniform(-1.0, 0.3));
}

} // namespace marsview::test
