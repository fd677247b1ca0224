// Maps of any shape and position, prepared as in the program.
#pragma once

#include "core/session/map.h"
#include "tests/support/make_raster.h"

#include <array>
#include <cstddef>
#include <functional>
#include <string>

namespace marsview::test {

/// Loads and prepares a file; on failure, fails the test and throws.
std::shared_ptr<const Map> loadedMap(const std::string& path);

/// withOverrides() without a monitor.
Result<std::shared_ptr<const Map>> overridden(const Map& map, const RasterOverrides& overrides);

/// Makes maps in a folder that is removed with the object.
class MapMaker {
public:
    using Height = std::function<double(std::size_t column, std::size_t row)>; // NaN for void

    struct Place {
        std::size_t columns = 20;
        std::size_t rows = 15;
        std::array<double, 6> transform{500000.0, 30.0, 0.0, 4000000.0, 0.0, -30.0}; // GDAL's order
        std::string srs{}; // anything that OGR accepts; empty for none
    };

    std::shared_ptr<const Map> make(const Place& place, const Height& height);

private:
    TempFolder folder_;
    int count_ = 0;
};

} // namespace marsview::test
