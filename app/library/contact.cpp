#include "app/library/include/marsview/contact.h"

#include "core/contact/contact_model.h"
#include "core/contact/heightfield_surface.h"
#include "core/contact/mesh_surface.h"
#include "core/mesh/triangle_mesh.h"
#include "core/terrain/filled_heightfield.h"
#include "core/terrain/surface_analysis.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

namespace marsview::contact {
namespace {

constexpr Model kLastModel = Model::ProxyGraph2003;
static_assert(static_cast<std::size_t>(kLastModel) + 1 == kContactModelKinds.size());
static_assert(static_cast<int>(Model::VirtualProxy) ==
              static_cast<int>(ContactModelKind::VirtualProxy));
static_assert(static_cast<int>(Model::ProxyGraph2003) ==
              static_cast<int>(ContactModelKind::ProxyGraph2003));
static_assert(static_cast<int>(Model::GodObjectRelease) ==
              static_cast<int>(ContactModelKind::GodObjectRelease));
static_assert(static_cast<int>(SampleType::Float64) ==
              static_cast<int>(marsview::SampleType::Float64));
static_assert(static_cast<int>(SampleType::Int16) == static_cast<int>(marsview::SampleType::Int16));
static_assert(static_cast<int>(Feature::Face) == static_cast<int>(ContactFeature::Face));

[[noreturn]] void refuse(const std::string& why)
{
    throw std::invalid_argument(why);
}

template <typename T>
T valueOf(Result<T> result)
{
    if (!result) {
        if (result.error().code == ErrorCode::TooLarge) {
            throw std::bad_alloc();
        }
        refuse(result.error().message);
    }
    return std::move(result).value();
}

bool isUsable(double value)
{
    return std::isfinite(value) && value != 0.0;
}

void check(const Grid& grid)
{
    constexpr std::size_t kSideMax = std::size_t{1} << 30U;
    if (grid.samples == nullptr) {
        refuse("the grid has no samples");
    }
    if (grid.type > SampleType::Float64) {
        refuse("the type of the samples is unknown");
    }
    if (grid.columns < 2 || grid.rows < 2 || grid.columns >= kSideMax || grid.rows >= kSideMax) {
        refuse("the grid has " + std::to_string(grid.columns) + " × " + std::to_string(grid.rows) +
               " samples; each side needs at least 2 and less than 2^30");
    }
    if (!isUsable(grid.cell_x_m) || !isUsable(grid.cell_y_m) || !isUsable(grid.gain) ||
        !std::isfinite(grid.offset_m)) {
        refuse("cell size and gain must be finite and not 0, and the offset finite");
    }
}

Heightfield heightfieldOf(const Grid& grid)
{
    const auto type = static_cast<marsview::SampleType>(grid.type);
    const std::size_t bytes = sampleBytes(type);
    const std::ptrdiff_t column_stride = grid.column_stride_bytes == 0
                                             ? static_cast<std::ptrdiff_t>(bytes)
                                             : grid.column_stride_bytes;
    const std::ptrdiff_t row_stride =
        grid.row_stride_bytes == 0 ? column_stride * static_cast<std::ptrdiff_t>(grid.columns)
                                   : grid.row_stride_bytes;
    SampleGrid samples = valueOf(SampleGrid::create(type, grid.columns, grid.rows));
    const auto* first = static_cast<const std::byte*>(grid.samples);
    for (std::size_t row = 0; row < grid.rows; ++row) {
        const std::byte* from = first + static_cast<std::ptrdiff_t>(row) * row_stride;
        std::byte* to = samples.rowData(row);
        if (column_stride == static_cast<std::ptrdiff_t>(bytes)) {
            std::memcpy(to, from, bytes * grid.columns);
            continue;
        }
        for (std::size_t column = 0; column < grid.columns; ++column) {
            std::memcpy(to + column * bytes,
                        from + static_cast<std::ptrdiff_t>(column) * column_stride, bytes);
        }
    }
    const SampleStatistics statistics = samples.applyRule(
        {.nodata = grid.has_nodata ? std::optional(grid.nodata) : std::nullopt}, 0, grid.rows);
    return {std::make_shared<const SampleGrid>(std::move(samples)), statistics,
            ElevationScale{.gain = grid.gain, .offset_m = grid.offset_m}};
}

// Without the errors of detail, which only drawing uses.
std::shared_ptr<const FilledHeightfield> filled(const Heightfield& heightfield)
{
    JobMonitor monitor;
    MinMaxPyramid bounds = valueOf(MinMaxPyramid::build(heightfield, monitor));
    BlockMeans means = valueOf(BlockMeans::build(heightfield, monitor));
    auto analysis = std::make_shared<const SurfaceAnalysis>(SurfaceAnalysis{
        .bounds = std::move(bounds), .means = std::move(means), .errors = DetailErrors::from({})});
    return std::make_shared<const FilledHeightfield>(
        valueOf(FilledHeightfield::build(heightfield, std::move(analysis), monitor)));
}

Contact contactOf(const ContactState& state, const Vector& goal) noexcept
{
    Contact contact;
    contact.proxy = {state.proxy.x, state.proxy.y, state.proxy.z};
    contact.is_in_contact = state.is_in_contact;
    contact.feature = static_cast<Feature>(state.feature);
    contact.counters = {state.counters.vertices,  state.counters.faces,
                        state.counters.casts,     state.counters.cells,
                        state.counters.far_edges, state.counters.far_loops,
                        state.counters.cut_short, state.counters.refused};
    const double x = state.proxy.x - goal.x;
    const double y = state.proxy.y - goal.y;
    const double z = state.proxy.z - goal.z;
    const double distance = std::hypot(x, y, z);
    if (std::isfinite(distance)) {
        contact.distance_m = distance;
        if (distance > 0.0) {
            contact.force_direction = {x / distance, y / distance, z / distance};
        }
    }
    return contact;
}

} // namespace

struct Surface::Data {
    std::shared_ptr<const FilledHeightfield> terrain; // one of these two
    std::shared_ptr<const TriangleMesh> mesh;
    SceneFrame frame;
};

Surface::Surface(std::shared_ptr<const Data> data)
    : data_(std::move(data))
{}

Surface Surface::fromGrid(const Grid& grid)
{
    check(grid);
    auto data = std::make_shared<Data>();
    // Where x = y = 0 lies on the grid.
    data->frame = {.origin = {-grid.origin_x_m / grid.cell_x_m, -grid.origin_y_m / grid.cell_y_m},
                   .east_per_column = grid.cell_x_m,
                   .north_per_row = grid.cell_y_m};
    if (!data->frame.isSound()) {
        refuse("cell size or origin of the grid is outside the range of 1e-9 to 1e9 m for cells");
    }
    const Heightfield heightfield = heightfieldOf(grid);
    if (!heightfield.range()) {
        refuse("the grid has no valid sample");
    }
    data->terrain = filled(heightfield);
    return Surface(std::move(data));
}

Surface Surface::fromMesh(const std::vector<Vector>& vertices,
                          const std::vector<std::uint32_t>& corners)
{
    if (corners.empty() || corners.size() % 3 != 0) {
        refuse("a mesh needs three corners for each face; it has " +
               std::to_string(corners.size()) + " corners");
    }
    TriangleSoup soup;
    soup.vertices.reserve(vertices.size());
    for (const Vector& vertex : vertices) {
        soup.vertices.push_back({vertex.x, vertex.y, vertex.z});
    }
    soup.faces.reserve(corners.size() / 3);
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        soup.faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    JobMonitor monitor;
    auto data = std::make_shared<Data>();
    data->mesh = valueOf(TriangleMesh::build(std::move(soup), monitor));
    return Surface(std::move(data));
}

bool Surface::isGrid() const noexcept
{
    return data_->terrain != nullptr;
}

double Surface::height(double x, double y) const noexcept
{
    if (!isGrid() || !std::isfinite(x) || !std::isfinite(y)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const HeightfieldSurface surface(data_->terrain, data_->frame, 1.0);
    const auto goal = surface.goal({x, y, 0.0});
    return goal ? surface.height(goal->grid) : std::numeric_limits<double>::quiet_NaN();
}

const char* modelName(Model model) noexcept
{
    return model <= kLastModel
               ? contactModelName(static_cast<ContactModelKind>(model)).data() // of literals
               : "";
}

Model modelOfName(const std::string& name)
{
    const auto kind = contactModelKind(name);
    if (!kind) {
        refuse("unknown contact model \"" + name + "\"");
    }
    return static_cast<Model>(*kind);
}

struct ContactModel::Running {
    std::unique_ptr<MapContactModel> on_grid; // one of these two
    std::unique_ptr<marsview::ContactModel> on_mesh;
};

ContactModel::ContactModel(const Surface& surface, const ModelOptions& options)
    : running_(std::make_unique<Running>())
{
    if (options.model > kLastModel) {
        refuse("unknown contact model");
    }
    if (!(options.radius_m > 0.0) || !std::isfinite(options.radius_m) ||
        !(options.exaggeration > 0.0) || !std::isfinite(options.exaggeration)) {
        refuse("radius and exaggeration must be positive and finite");
    }
    const auto kind = static_cast<ContactModelKind>(options.model);
    const ContactModelOptions model_options{.radius_m = options.radius_m};
    const Surface::Data& data = *surface.data_;
    if (data.mesh) {
        running_->on_mesh = makeContactModel(kind, MeshSurface(data.mesh), model_options);
    } else {
        running_->on_grid = makeContactModel(
            kind, HeightfieldSurface(data.terrain, data.frame, options.exaggeration),
            model_options);
    }
}

ContactModel::~ContactModel() = default;
ContactModel::ContactModel(ContactModel&&) noexcept = default;
ContactModel& ContactModel::operator=(ContactModel&&) noexcept = default;

Contact ContactModel::place(const Vector& goal) noexcept
{
    const ScenePoint point{goal.x, goal.y, goal.z};
    return contactOf(running_->on_grid ? running_->on_grid->place(point)
                                       : running_->on_mesh->place(point),
                     goal);
}

Contact ContactModel::update(const Vector& goal) noexcept
{
    const ScenePoint point{goal.x, goal.y, goal.z};
    return contactOf(running_->on_grid ? running_->on_grid->update(point)
                                       : running_->on_mesh->update(point),
                     goal);
}

bool ContactModel::setExaggeration(double exaggeration) noexcept
{
    if (!running_->on_grid || !(exaggeration > 0.0) || !std::isfinite(exaggeration)) {
        return false;
    }
    running_->on_grid->setExaggeration(exaggeration);
    return true;
}

const char* version() noexcept
{
    return MARSVIEW_VERSION;
}

} // namespace marsview::contact
