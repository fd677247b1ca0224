// Which of GDAL's drivers this program uses, and how far each is trusted.
#pragma once

#include <optional>
#include <string>

namespace marsview {

/// Leaves out drivers of formats that hold no elevations: web services, radar and optical imagery,
/// scanned charts, documents, pictures for the web. The list in the .cpp is the only one.
void leaveOutDrivers();

/// Names, ended by a null pointer, of drivers that read simple formats with code of GDAL's own:
/// they open files in this process. What any other driver opens is tried in a child process first.
const char* const* plainDrivers();

/// Whether damaged files of that format have been read in numbers without a crash: plain drivers,
/// and common formats with libraries that are tested against damaged files. Files of others are
/// read in the child process for longer.
bool isWellTested(const std::string& driver);

/// The name of a driver that recognises the file by its beginning, without opening it.
std::optional<std::string> recognisingDriverFor(const std::string& name);

/// The name of the driver that was left out, where it recognises the file; for a sentence.
std::optional<std::string> leftOutDriverFor(const std::string& name);

/// The version of GDAL in use, "3.6.2".
std::string gdalVersion();

} // namespace marsview
