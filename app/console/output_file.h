// Files that a command writes as its result.
#pragma once

#include "core/base/result.h"

#include <string>
#include <string_view>

namespace marsview {

/// Ignores Ctrl-C during its lifetime: for the moment in which a file is written.
class InterruptIgnored {
public:
    InterruptIgnored();
    ~InterruptIgnored();
    InterruptIgnored(const InterruptIgnored&) = delete;
    InterruptIgnored& operator=(const InterruptIgnored&) = delete;

private:
    void (*before_)(int);
};

/// Writes `text` to `path`, completely or not at all; "-" is standard output. A regular file is
/// written under another name in the same folder and then renamed; pipes and devices are written
/// directly. Ctrl-C is ignored during the call. Unreadable, with the system's reason, on failure.
Status writeOutputFile(const std::string& path, std::string_view text);

} // namespace marsview
