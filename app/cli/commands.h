// The commands of marsview-cli. Each registers itself with the parser and sets `run` when chosen.
#pragma once

#include "app/console/command_action.h"

namespace CLI {
class App;
}

namespace marsview {

void addDevicesCommand(CLI::App& app, CommandAction& run);
void addInfoCommand(CLI::App& app, CommandAction& run);
void addLoopCommand(CLI::App& app, CommandAction& run);
/// `measure` with its commands.
void addMeasureCommand(CLI::App& app, CommandAction& run);
void addPrepareCommand(CLI::App& app, CommandAction& run);
void addRenderCommand(CLI::App& app, CommandAction& run);
/// `has_stdin` is true if `--stdin` is among the arguments: the position options then take no
/// numbers.
void addSampleCommand(CLI::App& app, CommandAction& run, bool has_stdin);
void addThumbnailCommand(CLI::App& app, CommandAction& run);
void addTraceCommand(CLI::App& app, CommandAction& run);

} // namespace marsview
