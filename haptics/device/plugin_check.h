// The conformance test of device plugins, for their authors.
#pragma once

#include "core/base/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace marsview {

struct PluginCheckStep {
    std::string what;   // "samples are plausible"
    std::string fault;  // one sentence; empty if the plugin passes
    std::string remark; // what was found or why a step was left out
};

/// Loads the plugin, lists its devices, opens the one with this id (empty: the first), reads it for
/// a second while its force is kept at zero, lets its clock run if it owns one, and opens it again.
/// Everything runs in a child process, which a crash or a hang of the plugin ends, and with it the
/// test. The steps that were begun, in order. NotFound if there is no such file; Unreadable if the
/// child cannot be started. Takes a few seconds; call it before the program starts threads.
Result<std::vector<PluginCheckStep>> checkPlugin(const std::filesystem::path& plugin,
                                                 const std::string& id);

} // namespace marsview
