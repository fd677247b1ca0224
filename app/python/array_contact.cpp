// Contact models over NumPy arrays: the installed library, as any other program uses it.
#include "app/python/map_contact.h"

#include <cstdint>
#include <fmt/format.h>
#include <marsview/contact.h>
#include <stdexcept>
#include <utility>

namespace marsview::python {
namespace {

contact::SampleType typeOf(const py::array& heights)
{
    const py::dtype type = heights.dtype();
    const char kind = type.kind();
    const py::ssize_t bytes = type.itemsize();
    using contact::SampleType;
    if (type.attr("isnative").cast<bool>()) {
        if (kind == 'f' && (bytes == 4 || bytes == 8)) {
            return bytes == 4 ? SampleType::Float32 : SampleType::Float64;
        }
        const bool is_signed = kind == 'i';
        if (is_signed || kind == 'u') {
            switch (bytes) {
            case 1:
                return is_signed ? SampleType::Int8 : SampleType::UInt8;
            case 2:
                return is_signed ? SampleType::Int16 : SampleType::UInt16;
            case 4:
                return is_signed ? SampleType::Int32 : SampleType::UInt32;
            case 8:
                return is_signed ? SampleType::Int64 : SampleType::UInt64;
            default:
                break;
            }
        }
    }
    throw py::value_error(
        fmt::format("heights of the type {} are not supported; use integers, "
                    "float32 or float64 in the machine's byte order",
                    py::str(static_cast<py::handle>(type)).cast<std::string>()));
}

class ModelOverArray final : public DrivenModel {
public:
    explicit ModelOverArray(contact::ContactModel model)
        : model_(std::move(model))
    {}
    Updated update(const std::array<double, 3>& goal) override
    {
        return updated(model_.update({goal[0], goal[1], goal[2]}));
    }
    Updated place(const std::array<double, 3>& goal) override
    {
        return updated(model_.place({goal[0], goal[1], goal[2]}));
    }

private:
    static Updated updated(const contact::Contact& step)
    {
        Updated result;
        result.proxy = {step.proxy.x, step.proxy.y, step.proxy.z};
        result.force_direction = {step.force_direction.x, step.force_direction.y,
                                  step.force_direction.z};
        result.distance_m = step.distance_m;
        result.state.is_in_contact = step.is_in_contact;
        result.state.feature = static_cast<ContactFeature>(step.feature);
        result.state.counters = {.vertices = step.counters.vertices,
                                 .faces = step.counters.faces,
                                 .casts = step.counters.casts,
                                 .cells = step.counters.cells,
                                 .far_edges = step.counters.far_edges,
                                 .far_loops = step.counters.far_loops,
                                 .cut_short = step.counters.cut_short,
                                 .refused = step.counters.refused};
        return result;
    }

    contact::ContactModel model_;
};

} // namespace

std::unique_ptr<DrivenModel>
modelOverArray(const py::array& heights, double cell_size_m, const DriveOptions& options)
{
    if (heights.ndim() != 2) {
        throw py::value_error("heights must be a map or a two-dimensional array");
    }
    contact::Grid grid;
    grid.samples = heights.data();
    grid.type = typeOf(heights);
    grid.columns = static_cast<std::size_t>(heights.shape(1));
    grid.rows = static_cast<std::size_t>(heights.shape(0));
    grid.column_stride_bytes = heights.strides(1);
    grid.row_stride_bytes = heights.strides(0);
    grid.cell_x_m = cell_size_m;
    grid.cell_y_m = -cell_size_m;
    grid.origin_y_m = cell_size_m * static_cast<double>(grid.rows - 1);
    try {
        const py::gil_scoped_release released;
        return std::make_unique<ModelOverArray>(contact::ContactModel(
            contact::Surface::fromGrid(grid),
            {.model = contact::modelOfName(options.model),
             .radius_m = options.radius_m > 0.0 ? options.radius_m : 0.5 * cell_size_m,
             .exaggeration = options.exaggeration}));
    } catch (const std::invalid_argument& refused) {
        throw py::value_error(refused.what());
    }
}

} // namespace marsview::python
