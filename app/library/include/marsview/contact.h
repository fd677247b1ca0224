// Contact models for haptic rendering of elevation grids and triangle meshes, as a library.
//
//     #include <marsview/contact.h>
//     using namespace marsview::contact;
//
//     const Surface surface = Surface::fromGrid({.samples = heights.data(), .columns = 512, …});
//     ContactModel model(surface);
//     // once per millisecond, on the servo thread:
//     const Contact contact = model.update({x, y, z});
//     const double force_n = stiffness_n_per_m * contact.distance_m; // along
//     contact.force_direction
//
// Lengths are meters, in a right-handed frame with z up. Needs C++17, and neither Qt nor GDAL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#if defined(MARSVIEW_CONTACT_STATIC)
#define MARSVIEW_CONTACT_API
#else
#define MARSVIEW_CONTACT_API __attribute__((visibility("default")))
#endif

namespace marsview::contact {

struct Vector {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

enum class SampleType : std::uint8_t {
    UInt8,
    Int8,
    UInt16,
    Int16,
    UInt32,
    Int32,
    UInt64,
    Int64,
    Float32,
    Float64,
};

/// A grid of elevations, which is copied: the samples may be freed afterwards. Sample (column c,
/// row r) is at samples + c × column_stride_bytes + r × row_stride_bytes, in the byte order of the
/// machine. It lies at x = origin_x + c × cell_x_m, y = origin_y + r × cell_y_m and has the
/// elevation sample × gain + offset_m. Cells are cut by the diagonal from (c, r) to (c+1, r+1).
struct Grid {
    const void* samples = nullptr;
    SampleType type = SampleType::Float32;
    std::size_t columns = 0; // 2 to 2^30 - 1
    std::size_t rows = 0;    // 2 to 2^30 - 1
    /// 0: samples without gaps, row by row.
    std::ptrdiff_t column_stride_bytes = 0;
    std::ptrdiff_t row_stride_bytes = 0;
    /// Of either sign, not 0. The default is for rasters whose first row is the northernmost.
    double cell_x_m = 1.0;
    double cell_y_m = -1.0;
    double origin_x_m = 0.0; // of sample (0, 0)
    double origin_y_m = 0.0;
    double gain = 1.0;
    double offset_m = 0.0;
    /// If has_nodata, samples of this value are voids, as NaN and infinities always are. Voids are
    /// filled smoothly from their neighborhood.
    bool has_nodata = false;
    double nodata = 0.0;
};

/// What a model touches. Immutable; copies share the data. Any thread.
class MARSVIEW_CONTACT_API Surface {
public:
    /// Reads every sample a few times, on all cores. Throws std::invalid_argument if the grid is
    /// not usable, and std::bad_alloc.
    static Surface fromGrid(const Grid& grid);
    /// A sound triangle mesh: vertices, and three indices per face, counter-clockwise seen from
    /// free space. Throws std::invalid_argument with the faults and their places (holes between
    /// faces, intersections, faces without area, …). Takes about 3 µs per face, on all cores.
    static Surface fromMesh(const std::vector<Vector>& vertices,
                            const std::vector<std::uint32_t>& corners);

    /// True for grids: only these can be exaggerated.
    bool isGrid() const noexcept;
    /// Elevation of a grid's triangulated surface at a position, which is clamped to the grid. NaN
    /// for meshes. Allocates nothing.
    double height(double x, double y) const noexcept;

    /// @cond
    struct Data;
    /// @endcond

private:
    explicit Surface(std::shared_ptr<const Data> data);
    friend class ContactModel;
    std::shared_ptr<const Data> data_;
};

enum class Model : std::uint8_t {
    ProxyGraph,       // Walker and Salisbury 2003: from vertex to vertex along edges
    SurfaceWalk,      // exact steepest descent, once per update
    ContinuousWalk,   // follows the goal's motion event by event; independent of the update rate
    GodObject,        // Zilles and Salisbury 1995, constraints kept within an update
    GodObjectRelease, // constraints released
    VirtualProxy,     // a sphere swept over the surface (Ruspini, Kolarov and Khatib 1997)
    ProxyGraph2003,   // as Walker and Salisbury published it, to the letter
};

/// "continuous-walk" and so on, as the command line has them.
MARSVIEW_CONTACT_API const char* modelName(Model model) noexcept;
/// Throws std::invalid_argument if there is no model of that name.
MARSVIEW_CONTACT_API Model modelOfName(const std::string& name);

enum class Feature : std::uint8_t { Free, Vertex, Edge, Face };

/// The cost of one update.
struct Counters {
    std::uint32_t vertices = 0;  // visited
    std::uint32_t faces = 0;     // walked
    std::uint32_t casts = 0;     // segments cast through free space
    std::uint32_t cells = 0;     // grid cells visited by casts
    std::uint32_t far_edges = 0; // far-edge crossings of the proxy graph
    std::uint32_t far_loops = 0; // those that its list ended as loops
    std::uint32_t cut_short = 0; // 1: the step limit ended the update; the next one continues
    std::uint32_t refused = 0;   // 1: the goal is not usable (not finite); the proxy stays
};

/// The state after an update.
struct Contact {
    Vector proxy;
    bool is_in_contact = false;
    Feature feature = Feature::Free;
    /// From the goal to the proxy, of length 1; zero if these coincide. A spring's force acts on
    /// the user's hand in this direction.
    Vector force_direction;
    double distance_m = 0.0; // between goal and proxy
    Counters counters;
};

struct ModelOptions {
    Model model = Model::ContinuousWalk;
    double radius_m = 1.0; // > 0; of VirtualProxy's sphere
    /// > 0; elevations of a grid are multiplied by it, so z of goals and proxies is exaggerated.
    double exaggeration = 1.0;
};

/// A running contact model. update() and place() are for a servo thread: they allocate, lock and
/// throw nothing, and take a bounded time, 0.1 to 10 µs for most motions. One thread at a time.
class MARSVIEW_CONTACT_API ContactModel {
public:
    /// Throws std::invalid_argument if an option is outside its range.
    explicit ContactModel(const Surface& surface, const ModelOptions& options = {});
    ~ContactModel();
    ContactModel(ContactModel&&) noexcept;
    ContactModel& operator=(ContactModel&&) noexcept;

    /// Puts the proxy at the goal if that is above the surface, else on the surface straight above
    /// it (on a mesh: on the nearest part of the surface), and minimizes the distance from there.
    Contact place(const Vector& goal) noexcept;
    /// Moves the proxy towards the goal. The first update places it. Goals beyond the sides of a
    /// grid are clamped to it.
    Contact update(const Vector& goal) noexcept;
    /// Another exaggeration, > 0. In contact, the proxy keeps its place on the grid and moves with
    /// it. False, without an effect, for meshes and for values outside the range.
    bool setExaggeration(double exaggeration) noexcept;

private:
    struct Running;
    std::unique_ptr<Running> running_;
};

/// The version of the library that runs, "0.1.0".
MARSVIEW_CONTACT_API const char* version() noexcept;

} // namespace marsview::contact
