// Triangle meshes from files.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/mesh/triangle_mesh.h"

#include <memory>
#include <string>

namespace marsview {

/// Reads the triangles of an OBJ, PLY (ascii, binary of either byte order) or STL (ascii, binary)
/// file; which one, its ending tells, in either case. Coordinates are taken as scene metres.
/// - Polygons are cut into fans from their first corner, which is right for planar convex ones;
///   others are likely to be refused as intersecting by TriangleMesh::build.
/// - STL has no shared vertices: corners with equal coordinates become one. Others are taken as
///   they are.
/// - Normals, colours, textures, groups and materials are skipped; so are OBJ's lines and points,
///   while its curves and free-form surfaces are refused.
/// A file that cannot be read, or ends early, or holds something else gives one sentence with the
/// file, the line or byte, and what was found there.
Result<TriangleSoup> readTriangles(const std::string& path, JobMonitor& monitor);

/// Reads, multiplies z by the exaggeration and checks: a mesh that can be touched, or why not.
Result<std::shared_ptr<const TriangleMesh>>
loadMesh(const std::string& path, double exaggeration, JobMonitor& monitor);

} // namespace marsview
