// The project file (.mvproj): the document as versioned JSON. The guide's page "Projects" describes
// the format.
#pragma once

#include "core/annotations/annotation.h"
#include "core/base/angle.h"
#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/session/measurement.h"
#include "core/session/session.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// The version that this program writes. Versions up to it are read. It grows when an older program
/// would misread a file.
inline constexpr int kProjectVersion = 1;

/// A camera in the map coordinates of the topmost layer in the picture.
struct ProjectCamera {
    double x = 0.0; // of the target, in the units of the CRS
    double y = 0.0;
    double elevation_m = 0.0; // of the target, without exaggeration
    double distance_m = 1.0;  // > 0
    Angle azimuth{};
    Angle tilt{};
    Angle field_of_view = Angle::degrees(40.0);

    bool operator==(const ProjectCamera&) const = default;
};

/// How the layers are laid out.
enum class SceneChoice { Automatic, Flat, Globe };

/// A measurement by its geometry. The results follow from it and from the layer.
struct ProjectMeasurement {
    MeasurementKind kind = MeasurementKind::Distance;
    std::string name{};
    std::optional<std::size_t> layer{};     // an index of Project::layers; empty: it was removed
    std::vector<MeasuredVertex> vertices{}; // all of one type
    DrawnTime time{};                       // at which it was begun
    std::string note{};
    std::optional<Rgb8> color{}; // empty: the usual one

    bool operator==(const ProjectMeasurement&) const = default;
};

/// An annotation, and the layer that it was drawn on.
struct ProjectAnnotation {
    Annotation annotation{};
    std::optional<std::size_t> layer{}; // an index of Project::layers; empty: it was removed

    bool operator==(const ProjectAnnotation&) const = default;
};

/// A saved view; see SavedView.
struct ProjectView {
    std::string name{};
    ViewCamera camera{};
    double exaggeration = 1.0;
    std::optional<std::size_t> layer{}; // an index of Project::layers; empty: it was removed
    std::string body{};
    bool is_on_globe = false;

    bool operator==(const ProjectView&) const = default;
};

/// What a project file states.
struct Project {
    std::vector<LayerRecord> layers;       // top first
    std::optional<std::size_t> active{};   // an index of `layers`
    std::vector<VectorOverlay> overlays{}; // in the order of Session::overlays
    TerrainLook look{};
    LayerOrder order = LayerOrder::Listed;
    std::optional<ProjectCamera> camera{}; // of the flat map
    SceneChoice scene = SceneChoice::Automatic;
    std::optional<ViewCamera> globe_camera{}; // its target is on the body
    std::vector<ProjectView> views{};
    std::vector<ProjectMeasurement> measurements{};
    std::vector<ProjectAnnotation> annotations{};
    /// Members that this version does not define, as JSON. They are kept when the project is saved.
    std::map<std::string, std::string> others{};

    bool operator==(const Project&) const = default;
};

/// Folders that paths in a project refer to.
struct ProjectFolders {
    std::filesystem::path project; // where the project file is; absolute
    std::filesystem::path bundled; // the maps that come with the program; empty if unknown
};

/// The layers of a session, with the missing ones in their places, from the top.
std::vector<LayerId> projectOrder(const Session& session);

/// The project of a session: its layers in projectOrder(), its overlays, its views and its look.
/// Without cameras, scene, measurements and annotations.
Project projectOf(const Session& session);

/// Views by the places of their layers in `layers`, and back. The ids that they get are counted
/// from `first_id`.
std::vector<ProjectView> projectViews(const std::vector<SavedView>& views,
                                      const std::vector<LayerId>& layers);
std::vector<SavedView> savedViews(const std::vector<ProjectView>& views,
                                  const std::vector<LayerId>& layers,
                                  std::uint32_t first_id);

/// The JSON text: members in a fixed order, one value a line, every number exact; only an angle
/// that no decimal number of degrees gives may be off by one unit in its last place. Files below
/// the project's folder or below its parent folder get relative paths, bundled maps their name,
/// other files absolute paths; addresses and GDAL names stay as they are. Invalid if a name or path
/// is not UTF-8.
Result<std::string> projectText(const Project& project, const ProjectFolders& folders);

/// The project that `text` describes. `name` is the path of its file, which errors begin with.
/// Unsupported for versions after kProjectVersion; Damaged with the place of the first fault;
/// Invalid for files that are not projects. Paths in the result are absolute.
Result<Project>
projectFrom(std::string_view text, const ProjectFolders& folders, const std::string& name);

/// Reads a project file of at most 1 GB: seconds for a million annotations. Blocks on the disk.
/// Canceled if the monitor says so.
Result<Project> readProject(const std::filesystem::path& path,
                            const std::filesystem::path& bundled,
                            JobMonitor& monitor);
inline Result<Project> readProject(const std::filesystem::path& path,
                                   const std::filesystem::path& bundled)
{
    JobMonitor monitor;
    return readProject(path, bundled, monitor);
}

/// Replaces the project file as a whole (replaceFile): seconds for a million annotations. Blocks on
/// the disk. Canceled if the monitor says so: the file stays as it was.
Status writeProject(const Project& project,
                    const std::filesystem::path& path,
                    const std::filesystem::path& bundled,
                    JobMonitor& monitor);
inline Status writeProject(const Project& project,
                           const std::filesystem::path& path,
                           const std::filesystem::path& bundled)
{
    JobMonitor monitor;
    return writeProject(project, path, bundled, monitor);
}

/// Whether a path has the extension of project files, in either case.
bool isProjectPath(const std::string& path);

} // namespace marsview
