// The commands of `marsview-cli bench`. Each adds itself to the parser and sets `run` when it is
// chosen.
#pragma once

#include "app/console/command_action.h"

namespace CLI {
class App;
}

namespace marsview {

/// `bench` is the group of commands that measure.
void addBenchContactCommand(CLI::App& bench, CommandAction& run);
void addBenchStabilityCommand(CLI::App& bench, CommandAction& run);
void addBenchTerrainCommand(CLI::App& bench, CommandAction& run);
void addBenchViewCommand(CLI::App& bench, CommandAction& run);

} // namespace marsview
