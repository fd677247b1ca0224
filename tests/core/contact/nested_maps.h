// Fine maps over coarse ones on a body, for tests.
#pragma once

#include "core/body/layered_mesh.h"
#include "core/contact/contact_model.h"
#include "tests/core/contact/body_maps.h"
#include "tests/support/random.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace marsview::test {

struct NestedMap {
    BodyMap map;
    double raised_m = 0.0;
    bool has_voids = false;
    bool is_plain = false; // the heights of a formula of the place instead of a fractal
};

/// The uppermost first; the lowest is all of Mars.
struct NestedMaps {
    std::string name;
    std::vector<NestedMap> maps;
    friend std::ostream& operator<<(std::ostream& out, const NestedMaps& nested)
    {
        return out << nested.name;
    }
};

/// Two maps each; those with the names, or all.
std::vector<NestedMaps> nestedMaps(const std::vector<std::string>& names = {});
/// Three maps: the border of one crosses that of another over the lowest.
NestedMaps crossingMaps();
/// Two maps that overlap by a half each.
NestedMaps beyondMaps();
/// Without relief, the upper one 200 m above the lower one.
NestedMaps levelStep();
std::shared_ptr<const FilledHeightfield> heightsOf(const NestedMap& nested);
std::vector<std::shared_ptr<const BodyMesh>> meshesOf(const NestedMaps& maps,
                                                      double exaggeration = 1.0);

/// The faces that are not gone.
TriangleSoup listOf(const LayeredMesh& mesh);

/// Expects a model over joined maps to have the proxies that it has on a list of the same
/// triangles, along a path over walls and cut faces, from one part of the border of the upper map
/// to another. Returns the number of updates in contact. A god-object may float; other proxies are
/// on a face.
int contactsAsOnList(const std::shared_ptr<const LayeredMesh>& mesh,
                     const BodyMesh& upper,
                     ContactModelKind kind);

/// The mean length of a map's edges in its middle.
double cellOf(const BodyMesh& mesh);
/// A random place on the ellipsoid over the map or up to a quarter of its size beside it.
ScenePoint placeNear(const BodyMesh& mesh, Random& random);
/// The distance of a place on the ellipsoid from the nearest edge between a face of the map with
/// data and one without, or none.
double distanceToRim(const BodyMesh& mesh, const ScenePoint& place);

struct Below {
    std::size_t map = 0;
    double height_m = 0.0; // over the ellipsoid
};
/// The surface straight below or above a place on the ellipsoid, found by looking at all faces, in
/// long double.
std::optional<Below> below(const LayeredMesh& mesh, const ScenePoint& place);
std::optional<Below> uppermostBelow(const std::vector<std::shared_ptr<const BodyMesh>>& maps,
                                    const ScenePoint& place);

} // namespace marsview::test
