#include "core/files/open_probe.h"

#include "core/base/child_program.h"
#include "core/base/environment.h"
#include "core/base/fork_server.h"
#include "core/base/plain_number.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <sstream>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr char kProgram[] = "marsview-probe";

// The folders of the program and of the file with this code, a module that another program loaded.
std::array<fs::path, 2> ownFolders()
{
    std::error_code none;
    Dl_info code{};
    const bool is_found = dladdr(kProgram, &code) != 0 && code.dli_fname != nullptr;
    return {fs::read_symlink("/proc/self/exe", none).parent_path(),
            is_found ? fs::absolute(code.dli_fname, none).parent_path() : fs::path()};
}

// Next to the program, in libexec of its prefix, or in a build tree's bin; empty if it is missing.
fs::path findProbe()
{
    std::error_code none;
    const auto found = [&none](const fs::path& file) { return fs::is_regular_file(file, none); };
    for (const fs::path& folder : ownFolders()) {
        for (const fs::path& file :
             {folder / kProgram, folder / MARSVIEW_LIBEXEC_FROM_BIN / kProgram}) {
            if (found(file)) {
                return file;
            }
        }
        for (fs::path above = folder; above.has_relative_path(); above = above.parent_path()) {
            for (const char* below : {"bin", "libexec/marsview"}) {
                if (found(above / below / kProgram)) {
                    return above / below / kProgram;
                }
            }
        }
    }
    return {};
}

double numberFrom(const char* variable, double otherwise)
{
    const std::optional<double> number = parseNumber(environmentVariable(variable));
    return number && *number > 0.0 && *number < 1e9 ? *number : otherwise;
}

// The child's last output and its last known state.
struct Report {
    std::optional<Json> answer;
    std::size_t name = 0;
    std::string driver;
    bool is_out_of_memory = false;
};

// Signals that other processes send, and the kernel when memory runs out; not those of a fault.
bool isFromOutside(int signal)
{
    return signal == SIGKILL || signal == SIGTERM || signal == SIGINT || signal == SIGHUP;
}

Report reportIn(const std::string& out)
{
    Report report;
    std::istringstream lines(out);
    for (std::string line; std::getline(lines, line);) {
        Json json = Json::parse(line, nullptr, false);
        if (!json.is_object()) {
            continue;
        }
        if (json.contains("opening")) {
            report.driver = json.value("opening", std::string());
            report.name = json.value("name", std::size_t{0});
        } else if (json.contains("memory")) {
            report.is_out_of_memory = true;
        } else if (json.contains("kind")) {
            report.answer = std::move(json);
        }
    }
    return report;
}

} // namespace

void prestartProbes()
{
    setenv("PROJ_DEBUG", "0", 0); // NOLINT(concurrency-mt-unsafe): there are no other threads
    startForkServer(&probeMain);
}

std::size_t probeMemoryBytes()
{
    return static_cast<std::size_t>(numberFrom("MARSVIEW_OPEN_MB", 1024.0) * 0x1p20);
}

double probeSeconds(std::size_t bytes)
{
    constexpr double kSeconds = 10.0;
    constexpr double kBytesPerSecond = 10e6; // the slowest text formats
    return numberFrom("MARSVIEW_OPEN_SECONDS",
                      kSeconds + static_cast<double>(bytes) / kBytesPerSecond);
}

namespace {

enum class Names { FirstThatOpens, Each };

Result<ChildOutcome>
runProbe(std::span<const std::string> names, double seconds, Names which, const JobMonitor* job)
{
    static const fs::path program = findProbe();
    if (program.empty()) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("the program {} that opens it safely is missing; install MarsView "
                                 "again",
                                 kProgram)};
    }
    ChildProgram child;
    child.path = program.string();
    child.may_be_forked = true;
    child.arguments = {fmt::format("{}", probeMemoryBytes()), fmt::format("{:.0f}", seconds)};
    if (which == Names::Each) {
        child.arguments.emplace_back("each");
    }
    for (const std::string& name : names) {
        child.input += name;
        child.input += '\0';
    }
    child.time_max = std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1e3));
    child.job = job;
    Result<ChildOutcome> outcome = runChild(child);
    if (outcome && outcome->end == ChildEnd::Canceled) {
        return Error{ErrorCode::Canceled, "opening was canceled"};
    }
    return outcome;
}

// Adds what the child found, with names counted from `first`. Returns the number of the name that
// it began last.
std::size_t
appendRasters(const std::string& out, std::size_t first, std::vector<ProbedRaster>& rasters)
{
    std::size_t at = 0;
    std::istringstream lines(out);
    for (std::string line; std::getline(lines, line);) {
        const Json json = Json::parse(line, nullptr, false);
        if (!json.is_object()) {
            continue;
        }
        at = json.value("name", at);
        if (json.value("kind", std::string()) == "raster") {
            rasters.push_back({.name = first + at,
                               .driver = json.value("driver", std::string()),
                               .columns = json.value("columns", std::size_t{0}),
                               .rows = json.value("rows", std::size_t{0}),
                               .has_bytes = json.value("has_bytes", false),
                               .has_colors = json.value("has_colors", false),
                               .files = json.value("files", std::vector<std::string>())});
        }
    }
    return first + at;
}

} // namespace

Result<std::vector<ProbedRaster>>
probeEach(const std::vector<std::string>& names, std::size_t bytes, const JobMonitor* job)
{
    using Clock = std::chrono::steady_clock;
    const double seconds = probeSeconds(bytes);
    const Clock::time_point begin = Clock::now();
    std::vector<ProbedRaster> rasters;
    for (std::size_t first = 0; first < names.size();) {
        const double spent = std::chrono::duration<double>(Clock::now() - begin).count();
        if (spent >= seconds) {
            break;
        }
        const Result<ChildOutcome> outcome =
            runProbe(std::span(names).subspan(first), seconds - spent, Names::Each, job);
        if (!outcome) {
            return outcome.error();
        }
        first = appendRasters(outcome->out, first, rasters) + 1;
    }
    return rasters;
}

Result<ProbeAnswer>
probeNames(const std::vector<std::string>& names, std::size_t bytes, const JobMonitor* job)
{
    const double limit_s = probeSeconds(bytes);
    const Result<ChildOutcome> outcome = runProbe(names, limit_s, Names::FirstThatOpens, job);
    if (!outcome) {
        return outcome.error();
    }
    Report report = reportIn(outcome->out);
    if (outcome->end == ChildEnd::Killed && isFromOutside(outcome->signal) &&
        !report.is_out_of_memory) {
        return Error{
            ErrorCode::Unreadable,
            "the process that opens it was ended from outside, perhaps because the machine "
            "has too little memory; try again"};
    }
    ProbeAnswer answer;
    answer.prints = !outcome->err.empty();
    answer.name = std::min(report.name, names.size() - 1);
    answer.driver = report.driver;
    if (outcome->end == ChildEnd::TimedOut || outcome->signal == SIGXCPU) {
        answer.kind = ProbeAnswer::Kind::TimedOut;
        answer.limit_s = limit_s;
    } else if (report.is_out_of_memory) {
        answer.kind = ProbeAnswer::Kind::OutOfMemory;
    } else if (outcome->end == ChildEnd::Killed || !report.answer) {
        answer.kind = ProbeAnswer::Kind::Crashed;
    } else if (report.answer->value("kind", std::string()) == "opened") {
        answer.kind = ProbeAnswer::Kind::Opened;
        answer.files = report.answer->value("files", std::vector<std::string>());
    } else {
        answer.kind = ProbeAnswer::Kind::NotOpened;
        answer.message = report.answer->value("message", std::string());
    }
    return answer;
}

} // namespace marsview
