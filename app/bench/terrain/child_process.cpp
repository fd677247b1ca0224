#include "app/bench/terrain/child_process.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

extern char** environ; // NOLINT: as in POSIX

namespace marsview {
namespace {

constexpr const char* kSelf = "/proc/self/exe";

class Pipe {
public:
    Pipe() { is_open_ = pipe(ends_.data()) == 0; }
    ~Pipe()
    {
        closeEnd(0);
        closeEnd(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    bool isOpen() const { return is_open_; }
    int end(std::size_t i) const { return ends_[i]; }
    void closeEnd(std::size_t i)
    {
        if (is_open_ && ends_[i] >= 0) {
            close(ends_[i]);
            ends_[i] = -1;
        }
    }

private:
    std::array<int, 2> ends_{-1, -1};
    bool is_open_ = false;
};

// Reads from both until both are closed.
void readBoth(int out, int err, std::string& out_text, std::string& err_text)
{
    std::array<pollfd, 2> ends{pollfd{out, POLLIN, 0}, pollfd{err, POLLIN, 0}};
    const std::array<std::string*, 2> texts{&out_text, &err_text};
    int open_count = 2;
    while (open_count > 0) {
        if (poll(ends.data(), ends.size(), -1) < 0 && errno != EINTR) {
            return;
        }
        for (std::size_t i = 0; i < ends.size(); ++i) {
            if (ends[i].fd < 0 || ends[i].revents == 0) {
                continue;
            }
            std::array<char, 4096> buffer{};
            const ssize_t count = read(ends[i].fd, buffer.data(), buffer.size());
            if (count > 0) {
                texts[i]->append(buffer.data(), static_cast<std::size_t>(count));
            } else if (count == 0 || errno != EINTR) {
                ends[i].fd = -1;
                --open_count;
            }
        }
    }
}

// The last line, without the program's name, or the error that it describes in JSON.
std::string reasonIn(std::string text)
{
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    text = text.substr(text.rfind('\n') + 1); // npos + 1 is 0
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_object() && json.contains("error")) {
        const nlohmann::json& error = json["error"];
        const std::string message = error.value("message", std::string());
        return error["what"].is_string() ? error["what"].get<std::string>() + ": " + message
                                         : message;
    }
    constexpr std::string_view kName = "marsview-cli: ";
    return text.starts_with(kName) ? text.substr(kName.size()) : text;
}

} // namespace

Result<ChildOutput> runSelf(const std::vector<std::string>& arguments)
{
    Pipe out;
    Pipe err;
    if (!out.isOpen() || !err.isOpen()) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("cannot create a pipe ({})", std::strerror(errno))}; // NOLINT
    }
    std::vector<std::string> words{"marsview-cli"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions{};
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, out.end(1), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err.end(1), STDERR_FILENO);
    for (const Pipe* pipe : {&out, &err}) {
        posix_spawn_file_actions_addclose(&actions, pipe->end(0));
        posix_spawn_file_actions_addclose(&actions, pipe->end(1));
    }
    const auto begin = std::chrono::steady_clock::now();
    pid_t child = 0;
    const int failure = posix_spawn(&child, kSelf, &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) {
        return Error{ErrorCode::Unreadable, fmt::format("{}: cannot be run ({})", kSelf,
                                                        std::strerror(failure))}; // NOLINT
    }
    out.closeEnd(1);
    err.closeEnd(1);
    ChildOutput output;
    std::string said;
    readBoth(out.end(0), err.end(0), output.out, said);
    int status = 0;
    rusage usage{};
    while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    output.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    output.peak_memory_bytes = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        return Error{signal == SIGINT ? ErrorCode::Canceled : ErrorCode::Unreadable,
                     fmt::format("terminated by signal {}", signal)};
    }
    if (WEXITSTATUS(status) != 0) {
        const std::string reason = reasonIn(std::move(said));
        return Error{ErrorCode::Unreadable,
                     reason.empty() ? fmt::format("it failed with status {}", WEXITSTATUS(status))
                                    : reason};
    }
    return output;
}

} // namespace marsview
