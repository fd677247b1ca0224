// Part of every test program: prepared files, also those of programs that a test runs, go to a
// folder that is removed at the end, never to the user's ~/.cache.

#include "tests/support/temp_folder.h"

#include <cstdlib>

namespace marsview::test {
namespace {

class PrivateCache {
public:
    PrivateCache() { setenv("MARSVIEW_CACHE_DIR", folder_.path().c_str(), 1); } // NOLINT

private:
    TempFolder folder_;
};

const PrivateCache kPrivateCache;

} // namespace
} // namespace marsview::test
