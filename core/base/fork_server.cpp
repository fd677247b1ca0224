#include "core/base/fork_server.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace marsview {
namespace {

constexpr std::size_t kRequestBytesMax = 65536;
constexpr int kFailed = 127; // as of a shell that cannot start a program

// Of a request: standard input, output, error, and where to report the end.
constexpr std::size_t kDescriptors = 4;

std::atomic<int> server_socket{-1};

struct Request {
    std::vector<std::string> words; // the working folder and the arguments
    std::array<int, kDescriptors> descriptors{-1, -1, -1, -1};
};

struct Control {
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int) * kDescriptors)> bytes{};
};

msghdr messageOf(iovec& text, Control& control)
{
    msghdr message{};
    message.msg_iov = &text;
    message.msg_iovlen = 1;
    message.msg_control = control.bytes.data();
    message.msg_controllen = control.bytes.size();
    return message;
}

bool send(int socket, const Request& request)
{
    std::string text;
    for (const std::string& word : request.words) {
        text += word;
        text += '\0';
    }
    if (text.size() > kRequestBytesMax) {
        return false;
    }
    iovec part{text.data(), text.size()};
    Control control;
    msghdr message = messageOf(part, control);
    cmsghdr* const header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof(int) * kDescriptors);
    std::memcpy(CMSG_DATA(header), request.descriptors.data(), sizeof(int) * kDescriptors);
    return sendmsg(socket, &message, MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
}

// Waits for a request. Empty when the other end is closed.
std::optional<Request> receive(int socket)
{
    std::string text(kRequestBytesMax, '\0');
    iovec part{text.data(), text.size()};
    Control control;
    msghdr message = messageOf(part, control);
    ssize_t bytes = 0;
    do {
        bytes = recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
    } while (bytes < 0 && errno == EINTR);
    const cmsghdr* const header = bytes > 0 ? CMSG_FIRSTHDR(&message) : nullptr;
    if (header == nullptr || header->cmsg_type != SCM_RIGHTS ||
        header->cmsg_len != CMSG_LEN(sizeof(int) * kDescriptors)) {
        return std::nullopt;
    }
    Request request;
    std::memcpy(request.descriptors.data(), CMSG_DATA(header), sizeof(int) * kDescriptors);
    text.resize(static_cast<std::size_t>(bytes));
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\0', begin);
        request.words.push_back(text.substr(begin, end - begin));
        begin = end == std::string::npos ? text.size() : end + 1;
    }
    return request;
}

void endWithParent(pid_t parent)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) {
        _exit(kFailed); // it ended before
    }
}

[[noreturn]] void becomeChild(const Request& request, ChildMain child_main)
{
    setpgid(0, 0);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGCHLD}) {
        std::signal(number, SIG_DFL);
    }
    for (int standard = STDIN_FILENO; standard <= STDERR_FILENO; ++standard) {
        dup2(request.descriptors[static_cast<std::size_t>(standard)], standard);
    }
    close_range(STDERR_FILENO + 1, ~0U, 0);
    if (request.words.empty() || chdir(request.words.front().c_str()) != 0) {
        _exit(kFailed);
    }
    int status = kFailed;
    try {
        status = child_main({request.words.begin() + 1, request.words.end()});
    } catch (const std::exception&) {
        std::abort();
    }
    _exit(status);
}

// Reports the child's number and its end, since the program is not the child's parent.
[[noreturn]] void keepChild(const Request& request, ChildMain child_main)
{
    std::signal(SIGCHLD, SIG_DFL);
    const pid_t keeper = getpid();
    const pid_t child = fork();
    if (child == 0) {
        endWithParent(keeper);
        becomeChild(request, child_main);
    }
    const int report = request.descriptors.back();
    if (child > 0) {
        setpgid(child, child);
        for (std::size_t i = 0; i + 1 < kDescriptors; ++i) {
            close(request.descriptors[i]);
        }
        int status = 0;
        if (write(report, &child, sizeof child) == sizeof child) {
            while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
            }
            _exit(write(report, &status, sizeof status) == sizeof status ? 0 : kFailed);
        }
    }
    _exit(kFailed);
}

[[noreturn]] void serve(int socket, ChildMain child_main)
{
    setpgid(0, 0);                 // so that Ctrl-C in a terminal does not reach it
    std::signal(SIGCHLD, SIG_IGN); // keepers need not be waited for
    const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
    for (int standard = STDIN_FILENO; standard <= STDERR_FILENO; ++standard) {
        dup2(nowhere, standard); // a reader of the program's output does not wait for the server
    }
    const int kept = fcntl(socket, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    close_range(STDERR_FILENO + 1, static_cast<unsigned>(kept) - 1, 0);
    close_range(static_cast<unsigned>(kept) + 1, ~0U, 0);
    const pid_t server = getpid();
    while (const std::optional<Request> request = receive(kept)) {
        if (fork() == 0) {
            endWithParent(server);
            keepChild(*request, child_main);
        }
        for (const int descriptor : request->descriptors) {
            close(descriptor);
        }
    }
    _exit(0);
}

} // namespace

void startForkServer(ChildMain child_main)
{
    std::array<int, 2> ends{-1, -1};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        return;
    }
    const pid_t program = getpid();
    const pid_t server = fork();
    if (server == 0) {
        endWithParent(program);
        serve(ends[1], child_main);
    }
    close(ends[1]);
    if (server < 0) {
        close(ends[0]);
        return;
    }
    server_socket = ends[0];
}

std::optional<ForkedChild>
forkChild(const std::vector<std::string>& arguments, int input, int out, int err)
{
    std::error_code failure;
    const std::string folder = std::filesystem::current_path(failure).string();
    std::array<int, 2> report{-1, -1};
    if (server_socket < 0 || failure || pipe2(report.data(), O_CLOEXEC) != 0) {
        return std::nullopt;
    }
    Request request{{folder}, {input, out, err, report[1]}};
    request.words.insert(request.words.end(), arguments.begin(), arguments.end());
    const bool is_sent = send(server_socket, request);
    close(report[1]);
    ForkedChild child{.status = report[0]};
    ssize_t bytes = -1;
    do {
        bytes = is_sent ? read(child.status, &child.pid, sizeof child.pid) : 0;
    } while (bytes < 0 && errno == EINTR);
    if (bytes != sizeof child.pid) {
        close(child.status);
        return std::nullopt;
    }
    return child;
}

} // namespace marsview
