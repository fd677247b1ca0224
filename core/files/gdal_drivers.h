// The GDAL drivers that this program uses, and how far each is trusted.
#pragma once

#include <optional>
#include <string>

namespace marsview {

/// Deregisters drivers of formats without elevations: web services, radar and optical imagery,
/// scanned charts, documents, pictures for the web. The list in the .cpp is the only one.
void leaveOutDrivers();

/// A null-terminated list of drivers that read simple formats with GDAL's own code: they open files
/// in this process. Files of any other driver are tried in a child process first.
const char* const* plainDrivers();

/// Whether damaged files of that format have been read in numbers without a crash: plain drivers,
/// and common formats with libraries that are tested against damaged files. Files of others are
/// read in the child process for longer. Not VRT, which reads files of any driver.
bool isWellTested(const std::string& driver);

/// The name of a driver that recognizes the file by its beginning, without opening it.
std::optional<std::string> recognizingDriverFor(const std::string& name);

/// The deregistered driver that recognizes the file, if any; for messages.
std::optional<std::string> leftOutDriverFor(const std::string& name);

/// The version of GDAL in use, "3.6.2".
std::string gdalVersion();

} // namespace marsview
