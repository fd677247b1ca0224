// Starts children of this program without loading it again.
//
// Loading this program takes tens of milliseconds, most of them to relocate a hundred libraries. A
// process that is forked while the program has a single thread is loaded already, and can fork
// children at any later time: it holds no lock of another thread.
#pragma once

#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace marsview {

/// What a child does. It has the requested standard input and outputs, and ends with the returned
/// status, without exit handlers.
using ChildMain = int (*)(const std::vector<std::string>& arguments);

/// Call it once, before the program has other threads. The server ends with the program. If it
/// cannot be started, forkChild() returns nothing.
void startForkServer(ChildMain child_main);

struct ForkedChild {
    pid_t pid = -1;  // in its own process group
    int status = -1; // descriptor, to be closed: an int as from waitpid() once the child has ended
};

/// Starts a child in the current folder with these descriptors as its standard ones. Empty without
/// a server. Any thread.
std::optional<ForkedChild>
forkChild(const std::vector<std::string>& arguments, int input, int out, int err);

} // namespace marsview
