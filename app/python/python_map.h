// marsview.Map: an open map.
#pragma once

#include "app/console/map_options.h"
#include "app/python/conversion.h"
#include "core/session/map.h"
#include "core/session/map_resources.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace marsview::python {

/// What the maps of this process share: made at the first use.
const MapResources& sharedResources();

/// The options of open() and prepare() in the form of the command line's.
MapOptions mapOptionsFrom(const std::string& path, const py::kwargs& overrides);

/// A map, shared with the contact models over it.
struct PythonMap {
    MapOptions options;
    std::shared_ptr<const Map> map;

    LatitudeKind latitudeKind() const { return options.latitudeKind(map->info().body); }
    /// Throws Failure on a map without a CRS.
    void needsLonLat() const;
};

void addMap(py::module_& module);
void addContact(py::module_& module);
void addMeasure(py::module_& module);

} // namespace marsview::python
