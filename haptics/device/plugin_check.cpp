#include "haptics/device/plugin_check.h"

#include "haptics/device/plugin_library.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <optional>
#include <poll.h>
#include <set>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int kReads = 1000;
constexpr milliseconds kPeriod{1};
// Of a thousand calls all but ten: the scheduler may delay a few on a busy machine.
constexpr std::size_t kSlowMax = 10;
constexpr std::chrono::microseconds kCallMax{500};
constexpr milliseconds kAgeMax{15};
constexpr milliseconds kClockTime{500};
constexpr milliseconds kPatience{20'000}; // for the whole test

struct Finding {
    std::string fault;
    std::string remark;
};

// Writes to the parent: the name of a step when it begins, then its outcome.
class Writer {
public:
    explicit Writer(int pipe)
        : pipe_(pipe)
    {}
    void operator()(char kind, const std::string& text) const
    {
        std::string line = kind + text;
        std::replace(line.begin(), line.end(), '\n', ' ');
        line += '\n';
        for (std::size_t sent = 0; sent < line.size();) {
            const ssize_t written = write(pipe_, line.data() + sent, line.size() - sent);
            if (written < 0 && errno != EINTR) {
                _exit(EXIT_FAILURE);
            }
            sent += written > 0 ? static_cast<std::size_t>(written) : 0;
        }
    }

private:
    int pipe_;
};

double microseconds(Clock::duration time)
{
    return std::chrono::duration<double, std::micro>(time).count();
}

// In the child. Stops at the first fault after which nothing more can be tested.
class Check {
public:
    Check(const std::filesystem::path& plugin, std::string id, Writer writer)
        : plugin_(plugin)
        , id_(std::move(id))
        , writer_(writer)
    {}

    void run()
    {
        if (!step("loads, with a complete table of functions", [this] { return load(); }) ||
            !step("lists devices", [this] { return list(); }) ||
            !step("refuses an unknown device", [this] { return refuseUnknown(); })) {
            return;
        }
        if (!has_device_) {
            return;
        }
        if (!step("opens its device, which states plausible capabilities",
                  [this] { return open(); }) ||
            !step("delivers plausible samples, and accepts zero force",
                  [this] { return read(); })) {
            return;
        }
        step("answers within microseconds", [this] { return beFast(); });
        step("measures when it says", [this] { return beCurrent(); });
        if (device_->capabilities().owns_clock) {
            step("calls ticks at its rate, and none after its clock is stopped",
                 [this] { return keepTime(); });
        }
        step("can be closed and opened again", [this] {
            device_.reset();
            return open();
        });
        step("can be closed", [this] {
            device_.reset();
            return Finding{};
        });
    }

private:
    bool step(const char* what, const std::function<Finding()>& test)
    {
        writer_('?', what);
        const Finding finding = test();
        if (!finding.remark.empty()) {
            writer_('#', finding.remark);
        }
        writer_('=', finding.fault);
        return finding.fault.empty();
    }

    // Without the name of the file in front.
    static std::string reason(const Error& error, const std::string& subject)
    {
        const std::string start = subject + ": ";
        return error.message.starts_with(start) ? error.message.substr(start.size())
                                                : error.message;
    }

    Finding load()
    {
        Result<PluginLibrary> library = PluginLibrary::load(plugin_);
        if (!library) {
            return {.fault = reason(library.error(), plugin_.string()), .remark = {}};
        }
        library_.emplace(std::move(library).value());
        return {.fault = {}, .remark = library_->name()};
    }

    Finding list()
    {
        const std::vector<PluginEntry> entries = library_->enumerate();
        std::set<std::string> ids;
        for (const PluginEntry& entry : entries) {
            if (!ids.insert(entry.id).second) {
                return {.fault = fmt::format("two devices have the id \"{}\"", entry.id),
                        .remark = {}};
            }
        }
        for (const PluginEntry& entry : entries) {
            if (id_.empty() ? entry.reason.empty() : entry.id == id_) {
                id_ = entry.id;
                has_device_ = true;
                return {.fault = {},
                        .remark = entry.id.empty() ? entry.name
                                                   : fmt::format("{}: {}", entry.id, entry.name)};
            }
        }
        if (!id_.empty()) {
            return {.fault = fmt::format("there is no device \"{}\"", id_), .remark = {}};
        }
        return {.fault = {},
                .remark = entries.empty()
                              ? std::string("no device is connected: the rest is not tested")
                              : fmt::format("{}: {}; the rest is not tested", entries.front().name,
                                            entries.front().reason)};
    }

    Finding refuseUnknown()
    {
        const std::string unknown = "a device that does not exist";
        const Result<std::unique_ptr<HapticDevice>> opened = library_->open(unknown, "unknown");
        if (opened) {
            return {.fault = fmt::format("it opens \"{}\"", unknown), .remark = {}};
        }
        if (opened.error().message.ends_with("gave no reason")) {
            return {.fault = "it gives no reason", .remark = {}};
        }
        return {};
    }

    Finding open()
    {
        Result<std::unique_ptr<HapticDevice>> opened = library_->open(id_, id_);
        if (!opened) {
            return {.fault = reason(opened.error(), id_), .remark = {}};
        }
        device_ = std::move(opened).value();
        const DeviceCapabilities& c = device_->capabilities();
        return {.fault = {},
                .remark = fmt::format("{}: {:.0f} Hz, {} axes in, {} out, {} N", c.name, c.rate_hz,
                                      c.axes_in, c.axes_out, c.force_n_peak)};
    }

    Finding read()
    {
        std::size_t fine = 0;
        Clock::time_point deadline = Clock::now();
        for (int i = 0; i < kReads; ++i) {
            DeviceSample sample;
            const Clock::time_point begin = Clock::now();
            const DeviceStatus status = device_->read(sample);
            const Clock::time_point between = Clock::now();
            calls_.push_back(between - begin);
            if (status == DeviceStatus::Lost) {
                return {.fault = fmt::format("is lost at read {}: {}", i + 1, trouble()),
                        .remark = {}};
            }
            if (status == DeviceStatus::Fine) {
                ++fine;
                ages_.push_back(between - sample.time);
                const DeviceStatus written = device_->write(Vec3{});
                calls_.push_back(Clock::now() - between);
                if (written == DeviceStatus::Lost) {
                    return {.fault = fmt::format("is lost at a force of zero: {}", trouble()),
                            .remark = {}};
                }
            }
            deadline += kPeriod;
            std::this_thread::sleep_until(deadline);
        }
        if (fine == 0) {
            const std::string why = device_->trouble();
            return why.empty() ? Finding{.fault = "is not ready, and gives no reason", .remark = {}}
                               : Finding{.fault = {}, .remark = "not ready: " + why};
        }
        return {.fault = {}, .remark = fmt::format("{} of {} reads", fine, kReads)};
    }

    std::string trouble() const
    {
        std::string why = device_->trouble();
        return why.empty() ? "it gives no reason" : why;
    }

    Finding beFast()
    {
        std::sort(calls_.begin(), calls_.end());
        const Clock::duration middle = calls_[calls_.size() / 2];
        const auto slow = static_cast<std::size_t>(std::count_if(
            calls_.begin(), calls_.end(), [](Clock::duration time) { return time > kCallMax; }));
        Finding finding;
        finding.remark = fmt::format("median {:.1f} µs, longest {:.1f} µs", microseconds(middle),
                                     microseconds(calls_.back()));
        if (slow > kSlowMax) {
            finding.fault = fmt::format(
                "{} of {} calls take longer than {} µs; use a thread for "
                "a transport that blocks",
                slow, calls_.size(), kCallMax.count());
        }
        return finding;
    }

    Finding beCurrent()
    {
        if (ages_.empty()) {
            return {.fault = {}, .remark = "not tested: no sample"};
        }
        std::sort(ages_.begin(), ages_.end());
        const Clock::duration middle = ages_[ages_.size() / 2];
        if (middle > kAgeMax || middle < -kAgeMax) {
            return {.fault = fmt::format("samples are {:.1f} ms old, more than {} ms; time_ns "
                                         "counts CLOCK_MONOTONIC",
                                         microseconds(middle) / 1e3, kAgeMax.count()),
                    .remark = {}};
        }
        return {.fault = {}, .remark = fmt::format("{:.2f} ms ago", microseconds(middle) / 1e3)};
    }

    Finding keepTime()
    {
        struct Ticks {
            HapticDevice* device;
            std::atomic<int> count{0};
        };
        // Outlives ticks that come too late.
        static Ticks ticks{};
        ticks.device = device_.get();
        const auto tick = [](void* self, Clock::time_point) noexcept {
            auto* counted = static_cast<Ticks*>(self);
            DeviceSample sample;
            if (counted->device->read(sample) == DeviceStatus::Fine) {
                counted->device->write(Vec3{});
            }
            counted->count.fetch_add(1);
        };
        const Clock::time_point begin = Clock::now();
        if (!device_->startClock(tick, &ticks)) {
            return {.fault = fmt::format("its clock does not start: {}", trouble()), .remark = {}};
        }
        std::this_thread::sleep_for(kClockTime);
        device_->stopClock();
        const std::chrono::duration<double> elapsed = Clock::now() - begin;
        const int count = ticks.count.load();
        std::this_thread::sleep_for(milliseconds(50));
        if (ticks.count.load() != count) {
            return {.fault = "ticks arrive after stop_clock has returned", .remark = {}};
        }
        const double rate_hz = count / elapsed.count();
        const double stated_hz = device_->capabilities().rate_hz;
        // Half, since a busy machine delays ticks.
        if (rate_hz < 0.5 * stated_hz || rate_hz > 1.5 * stated_hz) {
            return {.fault = fmt::format("{:.0f} ticks a second arrive, {:.0f} are stated", rate_hz,
                                         stated_hz),
                    .remark = {}};
        }
        return {.fault = {}, .remark = fmt::format("{:.0f} Hz", rate_hz)};
    }

    std::filesystem::path plugin_;
    std::string id_;
    Writer writer_;
    std::optional<PluginLibrary> library_;
    std::unique_ptr<HapticDevice> device_;
    bool has_device_ = false;
    std::vector<Clock::duration> calls_;
    std::vector<Clock::duration> ages_;
};

// All that the child writes, until it ends or the time is over.
std::string readAll(int pipe, bool& is_late)
{
    std::string all;
    const Clock::time_point end = Clock::now() + kPatience;
    for (;;) {
        const auto left = std::chrono::duration_cast<milliseconds>(end - Clock::now()).count();
        pollfd wait{.fd = pipe, .events = POLLIN, .revents = 0};
        const int ready = left <= 0 ? 0 : poll(&wait, 1, static_cast<int>(left));
        if (ready == 0) {
            is_late = true;
            return all;
        }
        if (ready < 0) {
            continue; // a signal
        }
        std::array<char, 4096> buffer{};
        const ssize_t bytes = ::read(pipe, buffer.data(), buffer.size());
        if (bytes == 0 || (bytes < 0 && errno != EINTR)) {
            return all;
        }
        all.append(buffer.data(), bytes > 0 ? static_cast<std::size_t>(bytes) : 0);
    }
}

std::vector<PluginCheckStep> stepsIn(const std::string& lines, const std::string& how_it_ended)
{
    std::vector<PluginCheckStep> steps;
    bool is_open = false;
    for (std::size_t begin = 0; begin < lines.size();) {
        const std::size_t end = std::min(lines.find('\n', begin), lines.size());
        const std::string text = lines.substr(begin + 1, end - begin - 1);
        if (lines[begin] == '?') {
            steps.push_back({.what = text, .fault = {}, .remark = {}});
            is_open = true;
        } else if (!steps.empty() && lines[begin] == '#') {
            steps.back().remark = text;
        } else if (!steps.empty() && lines[begin] == '=') {
            steps.back().fault = text;
            is_open = false;
        }
        begin = end + 1;
    }
    if (is_open) {
        steps.back().fault = how_it_ended;
    }
    return steps;
}

} // namespace

Result<std::vector<PluginCheckStep>> checkPlugin(const std::filesystem::path& plugin,
                                                 const std::string& id)
{
    std::error_code none;
    if (!std::filesystem::is_regular_file(plugin, none)) {
        return Error{ErrorCode::NotFound,
                     fmt::format("{}: there is no such file", plugin.string())};
    }
    std::array<int, 2> pipes{};
    const auto cannot_start = [&] {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: cannot be tested in a process of its own: {}",
                                 plugin.string(),
                                 std::strerror(errno))}; // NOLINT(concurrency-mt-unsafe)
    };
    if (pipe(pipes.data()) != 0) {
        return cannot_start();
    }
    const pid_t child = fork();
    if (child < 0) {
        const Error error = cannot_start();
        close(pipes[0]);
        close(pipes[1]);
        return error;
    }
    if (child == 0) {
        close(pipes[0]);
        Check(plugin, id, Writer(pipes[1])).run();
        _exit(EXIT_SUCCESS); // without the destructors of the parent's objects
    }
    close(pipes[1]);
    bool is_late = false;
    const std::string lines = readAll(pipes[0], is_late);
    close(pipes[0]);
    if (is_late) {
        kill(child, SIGKILL);
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const std::string ending =
        is_late ? "does not answer"
        : WIFSIGNALED(status)
            ? fmt::format("crashes: {}",
                          strsignal(WTERMSIG(status))) // NOLINT(concurrency-mt-unsafe)
            : std::string("ends the program");
    return stepsIn(lines, ending);
}

} // namespace marsview
