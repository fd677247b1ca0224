// Reading lists of names.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/names/gazetteer.h"

#include <memory>
#include <string>

namespace marsview {

/// The names that are installed with the program for a body: those of the IAU for Mars and the
/// Moon. Null for other bodies and if the file is missing. Reads the file the first time. Any
/// thread.
std::shared_ptr<const Gazetteer> bundledGazetteer(const Body& body);

/// The points of a vector file as names. The name is in the field "name", "feature_name" or
/// "clean_name", or else in the first field with text. A field "diameter_m" has the size in
/// meters, "diameter", "diameter_km" or "size_km" in kilometers. Coordinates without a CRS are
/// degrees of longitude and latitude on `body`, of its usual kind of latitude; the body of the
/// result is `body` then.
///
/// Errors are those of readVectorFile(), and Invalid if no point has a name, if the coordinates are
/// not on the body, or if neither the file nor `body` states one. Blocks on the disk: not for the
/// GUI thread.
Result<std::shared_ptr<const Gazetteer>>
readGazetteer(const std::string& path, const Body* body, JobMonitor& monitor);

} // namespace marsview
