#include "core/base/child_program.h"

#include "core/base/fork_server.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <optional>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

extern char** environ; // NOLINT: as POSIX has it

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;

// How often the cancel flag is polled.
constexpr std::chrono::milliseconds kPollInterval{50};

class Descriptor {
public:
    Descriptor() noexcept = default;
    explicit Descriptor(int number) noexcept
        : number_(number)
    {}
    ~Descriptor() { reset(); }
    Descriptor(Descriptor&& other) noexcept
        : number_(std::exchange(other.number_, -1))
    {}
    Descriptor& operator=(Descriptor&& other) noexcept
    {
        reset();
        number_ = std::exchange(other.number_, -1);
        return *this;
    }
    int number() const noexcept { return number_; }
    void reset() noexcept
    {
        if (number_ >= 0) {
            close(number_);
        }
        number_ = -1;
    }

private:
    int number_ = -1;
};

struct Pipe {
    Descriptor read;
    Descriptor write;
};

Pipe makePipe()
{
    std::array<int, 2> ends{-1, -1};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        return {};
    }
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

// An in-memory file that holds `text`, positioned at its beginning.
Descriptor fileOf(const std::string& text)
{
    Descriptor file(memfd_create("marsview-input", MFD_CLOEXEC));
    std::size_t written = 0;
    while (file.number() >= 0 && written < text.size()) {
        const ssize_t count = write(file.number(), text.data() + written, text.size() - written);
        if (count < 0 && errno != EINTR) {
            return Descriptor();
        }
        written += count > 0 ? static_cast<std::size_t>(count) : 0;
    }
    if (file.number() >= 0 && lseek(file.number(), 0, SEEK_SET) != 0) {
        return Descriptor();
    }
    return file;
}

class SpawnSettings {
public:
    SpawnSettings()
    {
        posix_spawn_file_actions_init(&actions);
        posix_spawnattr_init(&attributes);
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setpgroup(&attributes, 0);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    }
    ~SpawnSettings()
    {
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    posix_spawn_file_actions_t actions{};
    posix_spawnattr_t attributes{};
};

// A child that has been started.
class Running {
public:
    explicit Running(pid_t number) noexcept
        : number_(number)
    {}
    explicit Running(const ForkedChild& child) noexcept
        : number_(child.pid)
        , status_(child.status)
    {}

    enum class Wait { No, Yes };

    // As from waitpid(), once it has ended.
    std::optional<int> ended(Wait wait)
    {
        int status = 0;
        if (status_.number() < 0) {
            const int options = wait == Wait::Yes ? 0 : WNOHANG;
            return waitpid(number_, &status, options) == number_ ? std::optional(status)
                                                                 : std::nullopt;
        }
        pollfd ready{status_.number(), POLLIN, 0};
        if (poll(&ready, 1, wait == Wait::Yes ? -1 : 0) <= 0) {
            return std::nullopt;
        }
        const ssize_t bytes = read(status_.number(), &status, sizeof status);
        if (bytes < 0) {
            return std::nullopt;
        }
        return bytes == sizeof status ? status
                                      : SIGKILL; // the server was killed, with all children
    }

    void killAll() const
    {
        kill(-number_, SIGKILL);
        kill(number_, SIGKILL);
    }

private:
    pid_t number_;
    Descriptor status_; // of a forked one
};

// Reads what is available; closes the descriptor at end of file.
void drain(Descriptor& from, std::string& to, std::size_t bytes_max)
{
    std::array<char, 16384> buffer{};
    const ssize_t count = read(from.number(), buffer.data(), buffer.size());
    if (count > 0) {
        to.append(buffer.data(), std::min(static_cast<std::size_t>(count), bytes_max - to.size()));
    } else if (count == 0 || errno != EINTR) {
        from.reset();
    }
}

Error cannotRun(const ChildProgram& program, int number)
{
    return Error{ErrorCode::Unreadable, fmt::format("{}: cannot be run ({})", program.path,
                                                    std::strerror(number))}; // NOLINT
}

Result<pid_t> spawn(const ChildProgram& program,
                    const Descriptor& input,
                    const Descriptor& out,
                    const Descriptor& err)
{
    std::vector<std::string> words{program.path};
    words.insert(words.end(), program.arguments.begin(), program.arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    SpawnSettings settings;
    posix_spawn_file_actions_adddup2(&settings.actions, input.number(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&settings.actions, out.number(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&settings.actions, err.number(), STDERR_FILENO);
    pid_t child = -1;
    const int failure = posix_spawn(&child, program.path.c_str(), &settings.actions,
                                    &settings.attributes, argv.data(), environ);
    if (failure != 0) {
        return cannotRun(program, failure);
    }
    return child;
}

} // namespace

Result<ChildOutcome> runChild(const ChildProgram& program)
{
    Pipe out = makePipe();
    Pipe err = makePipe();
    const Descriptor input = fileOf(program.input);
    if (out.read.number() < 0 || err.read.number() < 0 || input.number() < 0) {
        return cannotRun(program, errno);
    }
    std::optional<Running> child;
    if (program.may_be_forked) {
        if (const auto forked = forkChild(program.arguments, input.number(), out.write.number(),
                                          err.write.number())) {
            child.emplace(*forked);
        }
    }
    if (!child) {
        const Result<pid_t> spawned = spawn(program, input, out.write, err.write);
        if (!spawned) {
            return spawned.error();
        }
        child.emplace(*spawned);
    }
    out.write.reset();
    err.write.reset();
    ChildOutcome outcome;
    const Clock::time_point end = Clock::now() + program.time_max;
    while (out.read.number() >= 0 || err.read.number() >= 0) {
        std::array<pollfd, 2> ready{
            {{out.read.number(), POLLIN, 0}, {err.read.number(), POLLIN, 0}}};
        poll(ready.data(), ready.size(), static_cast<int>(kPollInterval.count()));
        if (ready[0].revents != 0) {
            drain(out.read, outcome.out, program.output_bytes_max);
        }
        if (ready[1].revents != 0) {
            drain(err.read, outcome.err, program.output_bytes_max);
        }
        if (program.job != nullptr && program.job->isCanceled()) {
            outcome.end = ChildEnd::Canceled;
        } else if (Clock::now() > end) {
            outcome.end = ChildEnd::TimedOut;
        }
        if (outcome.end != ChildEnd::Exited) {
            child->killAll();
            break;
        }
    }
    // The child has closed its output: it exits now or, if it hangs on exit, when the time limit
    // ends.
    std::optional<int> ended;
    while (!(ended = child->ended(outcome.end == ChildEnd::Exited ? Running::Wait::No
                                                                  : Running::Wait::Yes))) {
        if (outcome.end == ChildEnd::Exited && Clock::now() > end) {
            outcome.end = ChildEnd::TimedOut;
            child->killAll();
        }
        poll(nullptr, 0, 1);
    }
    const int status = *ended;
    if (outcome.end == ChildEnd::Exited && WIFSIGNALED(status)) {
        outcome.end = ChildEnd::Killed;
        outcome.signal = WTERMSIG(status);
    } else if (outcome.end == ChildEnd::Exited) {
        outcome.exit_status = WEXITSTATUS(status);
    }
    return outcome;
}

} // namespace marsview
