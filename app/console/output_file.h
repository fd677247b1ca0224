// Files that a command writes as its result.
#pragma once

#include "core/base/result.h"

#include <string>
#include <string_view>

namespace marsview {

/// While it lives, Ctrl-C is ignored: for the moment in which a file is written.
class InterruptIgnored {
public:
    InterruptIgnored();
    ~InterruptIgnored();
    InterruptIgnored(const InterruptIgnored&) = delete;
    InterruptIgnored& operator=(const InterruptIgnored&) = delete;

private:
    void (*before_)(int);
};

/// Writes `text` to `path`: whole or not at all. A regular file is written under another name in
/// the same folder and then renamed; pipes and devices are written directly. Ctrl-C is ignored for
/// that time. Unreadable with the system's reason where it fails.
Status writeOutputFile(const std::string& path, std::string_view text);

} // namespace marsview
