#include "app/python/map_contact.h"

#include "core/contact/contact_model.h"
#include "core/contact/goal_frame.h"
#include "core/contact/resident_heights.h"
#include "core/levels/waiting_terrain.h"

#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <pybind11/stl.h>
#include <utility>

namespace marsview::python {
namespace {

class ModelOverMap final : public DrivenModel {
public:
    ModelOverMap(std::shared_ptr<const Map> map,
                 std::unique_ptr<MapContactModel> model,
                 GoalFrame frame)
        : map_(std::move(map))
        , model_(std::move(model))
        , frame_(std::move(frame))
    {}
    Updated update(const std::array<double, 3>& goal) override
    {
        const ScenePoint scene = frame_.toScene({goal[0], goal[1], goal[2]});
        return updated(model_->update(scene), scene);
    }
    Updated place(const std::array<double, 3>& goal) override
    {
        const ScenePoint scene = frame_.toScene({goal[0], goal[1], goal[2]});
        return updated(model_->place(scene), scene);
    }

private:
    Updated updated(const ContactState& state, const ScenePoint& goal) const
    {
        const TracePoint proxy = frame_.fromScene(state.proxy);
        Updated result{.proxy = {proxy.x, proxy.y, proxy.z}, .state = state};
        const Vec3 apart = state.proxy - goal;
        const double distance_m = length(apart);
        if (std::isfinite(distance_m)) {
            result.distance_m = distance_m;
            if (distance_m > 0.0) {
                result.force_direction = {apart.x / distance_m, apart.y / distance_m,
                                          apart.z / distance_m};
            }
        }
        return result;
    }

    std::shared_ptr<const Map> map_; // which the model reads
    std::unique_ptr<MapContactModel> model_;
    GoalFrame frame_;
};

// The rows of the results of many updates.
struct Rows {
    explicit Rows(py::ssize_t count)
        : proxy({count, py::ssize_t{3}})
        , force_direction({count, py::ssize_t{3}})
        , distance_m(count)
        , contact(count)
        , feature(count)
    {
        for (auto& counter : counters) {
            counter = py::array_t<std::uint32_t>(count);
        }
    }
    py::dict asDict() const
    {
        py::dict named;
        for (std::size_t i = 0; i < counters.size(); ++i) {
            named[kCounterNames[i]] = counters[i];
        }
        py::dict rows;
        rows["proxy"] = proxy;
        rows["contact"] = contact;
        rows["feature"] = feature;
        rows["force_direction"] = force_direction;
        rows["distance_m"] = distance_m;
        rows["counters"] = named;
        return rows;
    }

    static constexpr std::array<const char*, 8> kCounterNames{
        "vertices", "faces", "casts", "cells", "far_edges", "far_loops", "cut_short", "refused"};
    py::array_t<double> proxy;
    py::array_t<double> force_direction;
    py::array_t<double> distance_m;
    py::array_t<bool> contact;
    py::array_t<std::uint8_t> feature;
    std::array<py::array_t<std::uint32_t>, 8> counters;
};

py::dict updates(DrivenModel& model, const Doubles& goals)
{
    checkRows(goals, 3, "goals");
    const py::ssize_t count = goals.shape(0);
    Rows rows(count);
    const double* goal = goals.data();
    double* proxy = rows.proxy.mutable_data();
    double* force = rows.force_direction.mutable_data();
    double* distance_m = rows.distance_m.mutable_data();
    bool* contact = rows.contact.mutable_data();
    std::uint8_t* feature = rows.feature.mutable_data();
    std::array<std::uint32_t*, 8> counter{};
    for (std::size_t i = 0; i < counter.size(); ++i) {
        counter[i] = rows.counters[i].mutable_data();
    }
    {
        const py::gil_scoped_release released;
        for (py::ssize_t i = 0; i < count; ++i) {
            const Updated step = model.update({goal[3 * i], goal[3 * i + 1], goal[3 * i + 2]});
            for (std::size_t k = 0; k < 3; ++k) {
                proxy[3 * i + static_cast<py::ssize_t>(k)] = step.proxy[k];
                force[3 * i + static_cast<py::ssize_t>(k)] = step.force_direction[k];
            }
            distance_m[i] = step.distance_m;
            contact[i] = step.state.is_in_contact;
            feature[i] = static_cast<std::uint8_t>(step.state.feature);
            const ContactCounters& c = step.state.counters;
            const std::array<std::uint32_t, 8> counts{c.vertices,  c.faces,     c.casts,
                                                      c.cells,     c.far_edges, c.far_loops,
                                                      c.cut_short, c.refused};
            for (std::size_t k = 0; k < counts.size(); ++k) {
                counter[k][i] = counts[k];
            }
        }
    }
    return rows.asDict();
}

std::unique_ptr<DrivenModel> makeDriven(const py::object& surface,
                                        const std::string& model,
                                        double exaggeration,
                                        const std::optional<double>& radius_m,
                                        const std::optional<double>& cell_size_m)
{
    if (!contactModelKind(model)) {
        throw py::value_error(fmt::format("unknown contact model \"{}\"", model));
    }
    const auto is_positive = [](double value) { return std::isfinite(value) && value > 0.0; };
    if (!is_positive(exaggeration) || !is_positive(radius_m.value_or(1.0)) ||
        !is_positive(cell_size_m.value_or(1.0))) {
        throw py::value_error("exaggeration, radius_m and cell_size_m must be positive");
    }
    const DriveOptions options{
        .model = model, .exaggeration = exaggeration, .radius_m = radius_m.value_or(0.0)};
    if (py::isinstance<PythonMap>(surface)) {
        if (cell_size_m) {
            throw py::value_error("cell_size_m is for arrays; a map has its own");
        }
        return modelOverMap(surface.cast<const PythonMap&>(), options);
    }
    const py::array heights = py::array::ensure(surface);
    if (!heights) {
        throw py::error_already_set();
    }
    return modelOverArray(heights, cell_size_m.value_or(1.0), options);
}

} // namespace

std::unique_ptr<DrivenModel> modelOverMap(const PythonMap& opened, const DriveOptions& options)
{
    const std::shared_ptr<const Map>& map = opened.map;
    const Georeference& georeference = map->georeference();
    const ContactModelOptions model_options{
        .radius_m =
            options.radius_m > 0.0
                ? options.radius_m
                : (georeference.pixelWidthMeters() + georeference.pixelHeightMeters()) / 4.0};
    const GoalFrame frame(std::shared_ptr<const Georeference>(map, &georeference),
                          options.exaggeration);
    const ContactModelKind kind = *contactModelKind(options.model);
    std::unique_ptr<MapContactModel> model;
    if (map->filled()) {
        model = makeContactModel(
            kind, HeightfieldSurface(map->filled(), frame.frame(), options.exaggeration),
            model_options);
    } else {
        const Heightfield& heightfield = map->heightfield();
        const auto heights =
            std::make_shared<const TileHeights>(map->levels(), heightfield.scale());
        const std::shared_ptr<const TiledTerrain> terrain =
            std::make_shared<const WaitingTerrain>(heightfield.tiles()->raster(), heights);
        model = makeContactModel(
            kind, TiledHeightfieldSurface(terrain, frame.frame(), options.exaggeration),
            model_options);
    }
    return std::make_unique<ModelOverMap>(map, std::move(model), frame);
}

void addContact(py::module_& module)
{
    py::class_<DrivenModel>(module, "ContactModel")
        .def(py::init(&makeDriven), py::arg("surface"), py::arg("model") = "continuous-walk",
             py::kw_only(), py::arg("exaggeration") = 1.0, py::arg("radius_m") = py::none(),
             py::arg("cell_size_m") = py::none())
        .def("update", &updates, py::arg("goals"))
        .def(
            "place",
            [](DrivenModel& self, std::array<double, 3> goal) {
                const Updated placed = self.place(goal);
                return py::make_tuple(placed.proxy[0], placed.proxy[1], placed.proxy[2]);
            },
            py::arg("goal"));
    py::list names;
    for (const ContactModelKind kind : kContactModelKinds) {
        names.append(std::string(contactModelName(kind)));
    }
    module.attr("contact_models") = py::tuple(names);
}

} // namespace marsview::python
