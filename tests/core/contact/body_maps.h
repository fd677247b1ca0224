// Small maps of all kinds on their bodies, for tests.
#pragma once

#include "core/body/body_mesh.h"
#include "core/geo/georeference.h"
#include "core/mesh/triangle_mesh.h"
#include "tests/support/random.h"

#include <cstddef>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace marsview::test {

struct BodyMap {
    std::string name;
    std::string crs;
    std::size_t columns;
    std::size_t rows;
    GeoTransform::Terms terms;
    double relief_m; // from the lowest to the highest sample
    friend std::ostream& operator<<(std::ostream& out, const BodyMap& map)
    {
        return out << map.name;
    }
};

BodyMap wholeMars(std::size_t columns, std::size_t rows);
/// Around the body, a belt, parts of it, mirrored, over a pole, with odd and even columns.
std::vector<BodyMap> bodyMaps();

Georeference georeferenceOf(const BodyMap& map);
std::shared_ptr<const FilledHeightfield> fractalMap(const BodyMap& map);
std::shared_ptr<const BodyMesh> bodyMesh(const BodyMap& map, double exaggeration);
/// A face of a small mesh.
MeshFace listedFace(const BodyFace& face);
/// The same triangles as a list.
std::shared_ptr<const TriangleMesh> listedMesh(const BodyMesh& mesh);

/// A hand that wanders over a map.
struct BodyWalker {
    const BodyMesh& mesh;
    Random& random;
    double column;
    double row;

    /// A goal near the surface, mostly below it, a few cells from the last one; around the seam,
    /// over the poles and beyond the border too.
    ScenePoint next(double step_cells);
};

} // namespace marsview::test
