// Part of test programs that open many rasters: the children that open them first are forked, as
// those of the window and of the command line are, and not loaded anew each.

#include "core/files/open_probe.h"
#include "tests/support/scoped_variable.h"

#include <gtest/gtest.h>

namespace marsview::test {
namespace {

class ForkedProbes final : public testing::Environment {
public:
    void SetUp() override // before any thread of a test
    {
#ifdef MARSVIEW_TEST_GDAL_DRIVERS
        // Children have the environment of now.
        const ScopedVariable drivers("GDAL_DRIVER_PATH", MARSVIEW_TEST_GDAL_DRIVERS);
#endif
        prestartProbes();
    }
};

const testing::Environment* const kForkedProbes =
    testing::AddGlobalTestEnvironment(new ForkedProbes);

} // namespace
} // namespace marsview::test
