#include "app/documents/program_facts.h"

namespace marsview {
namespace {

constexpr DocumentedFact kExitStatuses[] = {
    {"0", "Success."},
    {"1", "Failure. One line on standard error names the file or option and the reason."},
    {"2", "Wrong usage."},
};

constexpr DocumentedFact kVariables[] = {
    {"MARSVIEW_CACHE_DIR", "Folder for prepared maps and downloaded tiles."},
    {"MARSVIEW_CACHE_MB",
     "Memory for decoded tiles, in megabytes. Default: a quarter of the machine's memory."},
    {"MARSVIEW_HELD_MB",
     "Maps up to this size in megabytes are read into memory whole. Default: a quarter of the "
     "machine's memory."},
    {"MARSVIEW_OPEN_SECONDS",
     "Time limit for opening a file whose format is not a plain elevation format. Default: 10 "
     "seconds, and one more for every 10 MB."},
    {"MARSVIEW_OPEN_MB", "Memory limit for opening such a file, in megabytes. Default: 1024."},
    {"MARSVIEW_PLUGIN_PATH", "Folders with device plugins, separated by colons."},
    {"MARSVIEW_OPENHAPTICS_LIBRARY",
     "The OpenHaptics library to load instead of the installed one."},
    {"MARSVIEW_FORCEDIMENSION_LIBRARY",
     "The Force Dimension library (libdhd) to load instead of the installed one."},
    {"GDAL_CACHEMAX, GDAL_NUM_THREADS, …",
     "GDAL's own settings are respected, including those in its configuration file."},
};

constexpr DocumentedFact kFiles[] = {
    {"~/.cache/marsview/maps", "Prepared maps and downloaded tiles."},
    {"~/.local/share/marsview/plugins", "Device plugins of the user."},
    {"~/.config/marsview/devices", "Parameters of devices, as JSON files."},
    {"~/.config/MarsView/MarsView.conf", "Preferences of the window."},
};

constexpr std::string_view kConventions[] = {
    "Results are written to standard output, everything else to standard error. No display is "
    "needed. With --json, results and errors are JSON; the page json.md of the user guide "
    "documents the fields.",
    "Elevations are in meters, whatever the file's unit. Positions outside the map or on nodata "
    "print nan.",
    "Longitudes are degrees east. Latitudes are planetocentric, on the Earth planetographic; "
    "--latitude chooses the other kind.",
    "Numbers that belong together are separated by commas or blanks.",
};

} // namespace

std::span<const DocumentedFact> exitStatuses()
{
    return kExitStatuses;
}

std::span<const DocumentedFact> environmentVariables()
{
    return kVariables;
}

std::span<const DocumentedFact> usedFiles()
{
    return kFiles;
}

std::span<const std::string_view> commandConventions()
{
    return kConventions;
}

} // namespace marsview
