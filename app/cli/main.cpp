// marsview-cli: the command line for scripts and benchmarks. No display and no Qt needed.

#include "app/cli/commands.h"
#include "app/cli/text_output.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>

namespace {

constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;

void addVersionTo(CLI::App& app)
{
    app.set_version_flag("--version", MARSVIEW_VERSION);
    for (CLI::App* command : app.get_subcommands({})) {
        addVersionTo(*command);
    }
}

int run(int argc, char** argv)
{
    CLI::App app("Explore very large topographic maps from scripts", "marsview-cli");
    app.require_subcommand(1);
    const bool has_stdin =
        std::any_of(argv, argv + argc, [](std::string_view word) { return word == "--stdin"; });
    marsview::CommandAction action;
    marsview::addInfoCommand(app, action);
    marsview::addSampleCommand(app, action, has_stdin);
    marsview::addTraceCommand(app, action);
    marsview::addLoopCommand(app, action);
    marsview::addPrepareCommand(app, action);
    marsview::addRenderCommand(app, action);
    marsview::addDevicesCommand(app, action);
    CLI::App* bench = app.add_subcommand("bench", "Measure how fast and how exact this program is");
    bench->require_subcommand(1);
    marsview::addBenchViewCommand(*bench, action);
    marsview::addBenchContactCommand(*bench, action);
    marsview::addBenchTerrainCommand(*bench, action);
    marsview::addBenchStabilityCommand(*bench, action);
    addVersionTo(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        app.exit(help);
        return EXIT_SUCCESS;
    } catch (const CLI::ParseError& error) {
        std::fprintf(stderr, "marsview-cli: %s\nRun marsview-cli --help for what it understands.\n",
                     error.what());
        return kExitUsage;
    }
    const marsview::Status status = action();
    if (!status) {
        std::fprintf(stderr, "marsview-cli: %s\n",
                     marsview::asOneLine(status.error().message).c_str());
        return kExitFailed;
    }
    if (std::fflush(stdout) != 0) {
        std::fprintf(stderr, "marsview-cli: stdout: writing the result failed\n");
        return kExitFailed;
    }
    return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char** argv)
{
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "marsview-cli: %s\n", error.what());
        return kExitFailed;
    }
}
