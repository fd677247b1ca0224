// Part of test programs that open many rasters. The child processes that open them first are
// forked, as in the window and the command line, because loading a program each time takes longer.

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
