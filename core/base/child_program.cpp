#include "core/base/child_program.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
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

} // namespace

Result<ChildOutcome> runChild(const ChildProgram& program)
{
    const auto failed = [&program](int number) {
        return Error{ErrorCode::Unreadable, fmt::format("{}: cannot be run ({})", program.path,
                                                        std::strerror(number))}; // NOLINT
    };
    Pipe out = makePipe();
    Pipe err = makePipe();
    const Descriptor input = fileOf(program.input);
    if (out.read.number() < 0 || err.read.number() < 0 || input.number() < 0) {
        return failed(errno);
    }
    std::vector<std::string> words{program.path};
    words.insert(words.end(), program.arguments.begin(), program.arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    SpawnSettings settings;
    posix_spawn_file_actions_adddup2(&settings.actions, input.number(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&settings.actions, out.write.number(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&settings.actions, err.write.number(), STDERR_FILENO);
    pid_t child = 0;
    const int failure = posix_spawn(&child, program.path.c_str(), &settings.actions,
                                    &settings.attributes, argv.data(), environ);
    if (failure != 0) {
        return failed(failure);
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
            kill(-child, SIGKILL);
            kill(child, SIGKILL);
            break;
        }
    }
    // The child has closed its output: it exits now or, if it hangs on exit, when the time limit
    // ends.
    int status = 0;
    while (waitpid(child, &status, outcome.end == ChildEnd::Exited ? WNOHANG : 0) != child) {
        if (outcome.end == ChildEnd::Exited && Clock::now() > end) {
            outcome.end = ChildEnd::TimedOut;
            kill(child, SIGKILL);
        }
        poll(nullptr, 0, 1);
    }
    if (outcome.end == ChildEnd::Exited && WIFSIGNALED(status)) {
        outcome.end = ChildEnd::Killed;
        outcome.signal = WTERMSIG(status);
    } else if (outcome.end == ChildEnd::Exited) {
        outcome.exit_status = WEXITSTATUS(status);
    }
    return outcome;
}

} // namespace marsview
