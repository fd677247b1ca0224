// The compiled part of the Python package marsview. The documentation of its functions is in
// marsview/__init__.pyi.
#include "app/python/python_map.h"

PYBIND11_MODULE(_marsview, module)
{
    using namespace marsview::python; // NOLINT(google-build-using-namespace)
    module.attr("__version__") = MARSVIEW_VERSION;
    addError(module);
    addMap(module);
    addContact(module);
    pybind11::module_ measure = module.def_submodule("measure");
    addMeasure(measure);
}
