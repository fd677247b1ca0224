// marsview-cli: the command line for scripts and benchmarks. Uses neither a display nor Qt.

#include "app/bench/bench_commands.h"
#include "app/cli/commands.h"
#include "app/console/text_output.h"
#include "app/console/usage.h"
#include "app/documents/write_documents.h"
#include "core/files/open_probe.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <fstream>
#include <iostream>
#include <iterator>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace {

constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;
constexpr std::string_view kOutOfMemory =
    "out of memory: close other programs, or work on a smaller part of the data";

void addVersionTo(CLI::App& app)
{
    app.set_version_flag("--version", MARSVIEW_VERSION);
    for (CLI::App* command : app.get_subcommands({})) {
        addVersionTo(*command);
    }
}

// A file or socket that is opened later would take the number of a closed stream: results would be
// written into it, and reading from it would not end. Input is then empty, and output fails.
void replaceClosedStreams()
{
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) < 0) {
            const int replaced = open("/dev/null", O_RDONLY); // the lowest free number
            (void)replaced;
        }
    }
}

// For exceptions that main() cannot catch, because they leave another thread.
[[noreturn]] void endWithOneLine()
{
    std::string line = "marsview-cli: internal error: terminated; please report this\n";
    try {
        if (const std::exception_ptr thrown = std::current_exception()) {
            std::rethrow_exception(thrown);
        }
    } catch (const std::bad_alloc&) {
        line = std::string("marsview-cli: ") + std::string(kOutOfMemory) + "\n";
    } catch (const std::exception& error) {
        line = std::string("marsview-cli: internal error: ") + error.what() + "\n";
    } catch (...) { // NOLINT(bugprone-empty-catch): the line has all known details
    }
    const ssize_t ignored = write(STDERR_FILENO, line.data(), line.size());
    (void)ignored;
    std::_Exit(kExitFailed);
}

int refuseUsage(const CLI::App& app,
                const std::vector<std::string>& arguments,
                const std::string& message,
                marsview::ErrorForm form)
{
    marsview::printError(message, kExitUsage, form);
    if (form == marsview::ErrorForm::Line) {
        std::fprintf(stderr, "Run %s --help for usage.\n",
                     marsview::commandName(app, arguments).c_str());
    }
    return kExitUsage;
}

int refuseOutput(marsview::ErrorForm form)
{
    marsview::printError("stdout: writing the result failed", kExitFailed, form);
    return kExitFailed;
}

// "FOLDER [HELP]": manual pages and completions of this program, or of the one whose help is in the
// file HELP. For the build, hence not in the help.
int writeDocuments(const CLI::App& app, const std::vector<std::string>& arguments)
{
    if (arguments.size() != 2 && arguments.size() != 3) {
        marsview::printError("--write-documents: write FOLDER, or FOLDER and HELP", kExitUsage,
                             marsview::ErrorForm::Line);
        return kExitUsage;
    }
    marsview::DocumentedCommand program = marsview::documentOf(app);
    if (arguments.size() == 3) {
        std::ifstream file(arguments[2]);
        const std::string help(std::istreambuf_iterator<char>(file), {});
        if (help.empty()) {
            marsview::printError(arguments[2] + ": no help can be read from it", kExitFailed,
                                 marsview::ErrorForm::Line);
            return kExitFailed;
        }
        program = marsview::documentOfHelp("marsview", help);
    }
    const marsview::Status status =
        marsview::writeDocuments(program, arguments[1], MARSVIEW_VERSION);
    if (!status) {
        marsview::printError(status.error().message, kExitFailed, marsview::ErrorForm::Line);
        return kExitFailed;
    }
    return EXIT_SUCCESS;
}

int run(const std::vector<std::string>& arguments, marsview::ErrorForm form)
{
    CLI::App app("Explore very large topographic maps from scripts", "marsview-cli");
    app.require_subcommand(1);
    const bool has_stdin =
        std::find(arguments.begin(), arguments.end(), "--stdin") != arguments.end();
    marsview::CommandAction action;
    marsview::addInfoCommand(app, action);
    marsview::addSampleCommand(app, action, has_stdin);
    marsview::addMeasureCommand(app, action);
    marsview::addTraceCommand(app, action);
    marsview::addLoopCommand(app, action);
    marsview::addPrepareCommand(app, action);
    marsview::addRenderCommand(app, action);
    marsview::addThumbnailCommand(app, action);
    marsview::addDevicesCommand(app, action);
    CLI::App* bench = app.add_subcommand("bench", "Measure the speed and accuracy of this program");
    bench->require_subcommand(1);
    marsview::addBenchViewCommand(*bench, action);
    marsview::addBenchContactCommand(*bench, action);
    marsview::addBenchTerrainCommand(*bench, action);
    marsview::addBenchStabilityCommand(*bench, action);
    addVersionTo(app);
    if (!arguments.empty() && arguments.front() == "--write-documents") {
        return writeDocuments(app, arguments);
    }
    marsview::Result<std::vector<std::string>> words =
        marsview::normalizedArguments(app, arguments);
    if (!words) {
        return refuseUsage(app, arguments, words.error().message, form);
    }
    try {
        std::reverse(words->begin(), words->end()); // as CLI11 reads them
        app.parse(*words);
    } catch (const CLI::Success& help) {
        app.exit(help);
        if (!std::cout.flush()) {
            return refuseOutput(form);
        }
        return EXIT_SUCCESS;
    } catch (const CLI::ParseError& error) {
        return refuseUsage(app, arguments, marsview::usageMessage(app, arguments, error), form);
    }
    marsview::prestartProbes();
    const marsview::Status status = action();
    if (!status) {
        std::fflush(stdout);
        marsview::printError(status.error().message, kExitFailed, form);
        return kExitFailed;
    }
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) { // or an earlier part of it
        return refuseOutput(form);
    }
    return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char** argv)
{
    replaceClosedStreams();
    std::set_terminate(endWithOneLine);
    marsview::ErrorForm form = marsview::ErrorForm::Line;
    try {
        const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
        if (std::find(arguments.begin(), arguments.end(), "--json") != arguments.end()) {
            form = marsview::ErrorForm::Json;
        }
        return run(arguments, form);
    } catch (const std::bad_alloc&) {
        marsview::printError(std::string(kOutOfMemory), kExitFailed, form);
    } catch (const std::length_error&) {
        marsview::printError(std::string(kOutOfMemory), kExitFailed, form);
    } catch (const std::exception& error) {
        marsview::printError(std::string("internal error: ") + error.what(), kExitFailed, form);
    }
    return kExitFailed;
}
