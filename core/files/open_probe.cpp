#include "core/files/open_probe.h"

#include "core/base/child_program.h"
#include "core/base/environment.h"
#include "core/base/plain_number.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <dlfcn.h>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <system_error>

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

Result<ProbeAnswer>
probeNames(const std::vector<std::string>& names, std::size_t bytes, const JobMonitor* job)
{
    static const fs::path program = findProbe();
    if (program.empty()) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("the program {} that opens it safely is missing; install MarsView "
                                 "again",
                                 kProgram)};
    }
    const double seconds = probeSeconds(bytes);
    ChildProgram child;
    child.path = program.string();
    child.arguments = {fmt::format("{}", probeMemoryBytes()), fmt::format("{:.0f}", seconds)};
    for (const std::string& name : names) {
        child.input += name;
        child.input += '\0';
    }
    child.time_max = std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1e3));
    child.job = job;
    const Result<ChildOutcome> outcome = runChild(child);
    if (!outcome) {
        return outcome.error();
    }
    if (outcome->end == ChildEnd::Canceled) {
        return Error{ErrorCode::Canceled, "opening was canceled"};
    }
    Report report = reportIn(outcome->out);
    ProbeAnswer answer;
    answer.prints = !outcome->err.empty();
    answer.name = std::min(report.name, names.size() - 1);
    answer.driver = report.driver;
    if (outcome->end == ChildEnd::TimedOut || outcome->signal == SIGXCPU) {
        answer.kind = ProbeAnswer::Kind::TimedOut;
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
