// Triangle meshes from files. Own readers because contact needs vertices and triangles exactly as
// they are in the file, and people an error that names the line or byte.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/mesh/triangle_mesh.h"

#include <memory>
#include <string>

namespace marsview {

/// Reads the triangles of an OBJ, PLY (ascii, binary of either byte order) or STL (ascii, binary)
/// file; the file extension, in either case, selects the format. Coordinates are taken as scene
/// meters.
/// - Polygons are cut into fans from their first corner, which is right for planar convex ones;
///   TriangleMesh::build is likely to refuse others as intersecting.
/// - STL has no shared vertices: corners with equal coordinates become one. Other formats keep
///   their vertices.
/// - Normals, colors, textures, groups and materials are skipped, and so are OBJ's lines and
///   points. Its curves and free-form surfaces are refused.
/// If a file cannot be read, ends early or has other content, the error names the file, the line or
/// byte, and the content found there.
Result<TriangleSoup> readTriangles(const std::string& path, JobMonitor& monitor);

/// Reads, multiplies z by the exaggeration and checks: a mesh that can be touched, or why not.
Result<std::shared_ptr<const TriangleMesh>>
loadMesh(const std::string& path, double exaggeration, JobMonitor& monitor);

} // namespace marsview
