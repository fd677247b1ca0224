// The commands of marsview-cli. Each adds itself to the parser and sets `run` when it is chosen.
#pragma once

#include "app/console/command_action.h"

namespace CLI {
class App;
}

namespace marsview {

void addDevicesCommand(CLI::App& app, CommandAction& run);
void addInfoCommand(CLI::App& app, CommandAction& run);
void addLoopCommand(CLI::App& app, CommandAction& run);
void addPrepareCommand(CLI::App& app, CommandAction& run);
void addRenderCommand(CLI::App& app, CommandAction& run);
/// `has_stdin` tells beforehand whether `--stdin` is among the arguments: the position options then
/// stand without numbers.
void addSampleCommand(CLI::App& app, CommandAction& run, bool has_stdin);
void addTraceCommand(CLI::App& app, CommandAction& run);

} // namespace marsview
