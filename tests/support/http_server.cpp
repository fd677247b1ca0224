// RFC 9110 (HTTP semantics) as far as files need it; the numbers in comments are its sections.

#include "tests/support/http_server.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cctype>
#include <cerrno>
#include <condition_variable>
#include <ctime>
#include <fcntl.h>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <optional>
#include <poll.h>
#include <string_view>
#include <sys/socket.h>
#include <sys/stat.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

namespace marsview::test {
namespace {

constexpr std::size_t kHeaderBytesMax = 64 * 1024;
constexpr std::size_t kPieceBytes = 64 * 1024;
constexpr std::string_view kBoundary = "a-piece-ends-here";

[[noreturn]] void fail(const char* what)
{
    throw std::system_error(errno, std::generic_category(), what);
}

class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int value) noexcept
        : value_(value)
    {}
    ~Descriptor()
    {
        if (value_ >= 0) {
            close(value_);
        }
    }
    Descriptor(Descriptor&& other) noexcept
        : value_(std::exchange(other.value_, -1))
    {}
    Descriptor& operator=(Descriptor&& other) noexcept
    {
        std::swap(value_, other.value_);
        return *this;
    }
    int get() const noexcept { return value_; }

private:
    int value_ = -1;
};

struct Listener {
    Descriptor socket;
    std::uint16_t port = 0;
};

Listener listenOn(std::uint16_t port)
{
    Listener listener{Descriptor(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)), 0};
    const int yes = 1;
    setsockopt(listener.socket.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    socklen_t length = sizeof address;
    if (bind(listener.socket.get(), reinterpret_cast<const sockaddr*>(&address), length) != 0 ||
        listen(listener.socket.get(), 64) != 0 ||
        getsockname(listener.socket.get(), reinterpret_cast<sockaddr*>(&address), &length) != 0) {
        fail("listening on 127.0.0.1");
    }
    listener.port = ntohs(address.sin_port);
    return listener;
}

struct Request {
    std::string method;
    std::string target;
    std::map<std::string, std::string> headers; // by name in lower case

    std::string header(const std::string& name) const
    {
        const auto found = headers.find(name);
        return found == headers.end() ? "" : found->second;
    }
};

std::optional<Request> parsed(std::string_view head)
{
    Request request;
    std::size_t begin = 0;
    for (std::size_t line = 0; begin < head.size(); ++line) {
        const std::size_t end = std::min(head.find("\r\n", begin), head.size());
        const std::string_view text = head.substr(begin, end - begin);
        begin = end + 2;
        if (line == 0) {
            const std::size_t first = text.find(' ');
            const std::size_t last = text.rfind(' ');
            if (first == std::string_view::npos || last <= first) {
                return std::nullopt;
            }
            request.method = text.substr(0, first);
            request.target = text.substr(first + 1, last - first - 1);
            continue;
        }
        const std::size_t colon = text.find(':');
        if (colon == std::string_view::npos) {
            return std::nullopt;
        }
        std::string name(text.substr(0, colon));
        std::transform(name.begin(), name.end(), name.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        std::string_view value = text.substr(colon + 1);
        value.remove_prefix(std::min(value.find_first_not_of(" \t"), value.size()));
        request.headers[name] = value;
    }
    return request;
}

struct Range {
    std::uint64_t begin = 0;
    std::uint64_t end = 0; // one past the last byte
};

std::optional<std::uint64_t> numberFrom(std::string_view text)
{
    if (text.empty() || text.size() > 18 ||
        !std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; })) {
        return std::nullopt;
    }
    std::uint64_t number = 0;
    for (const char c : text) {
        number = number * 10 + static_cast<std::uint64_t>(c - '0');
    }
    return number;
}

// 14.1.2. Ranges that start beyond the end are omitted; nullopt if the header does not contain byte
// ranges, which means that it is ignored.
std::optional<std::vector<Range>> rangesFrom(std::string_view header, std::uint64_t file_bytes)
{
    constexpr std::string_view unit = "bytes=";
    if (!header.starts_with(unit)) {
        return std::nullopt;
    }
    header.remove_prefix(unit.size());
    std::vector<Range> ranges;
    while (!header.empty()) {
        const std::size_t comma = std::min(header.find(','), header.size());
        std::string_view text = header.substr(0, comma);
        header.remove_prefix(std::min(comma + 1, header.size()));
        text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
        const std::size_t dash = text.find('-');
        if (dash == std::string_view::npos) {
            return std::nullopt;
        }
        const std::optional<std::uint64_t> first = numberFrom(text.substr(0, dash));
        const std::optional<std::uint64_t> last = numberFrom(text.substr(dash + 1));
        if (!first && last) { // the last bytes of the file
            ranges.push_back({file_bytes - std::min(file_bytes, *last), file_bytes});
        } else if (first && (last || dash + 1 == text.size())) {
            const Range range{*first, last ? std::min(*last + 1, file_bytes) : file_bytes};
            if (range.begin < range.end) {
                ranges.push_back(range);
            }
        } else {
            return std::nullopt;
        }
    }
    return ranges;
}

std::string httpDate(std::time_t time)
{
    std::tm parts{};
    gmtime_r(&time, &parts);
    std::array<char, 64> text{};
    const std::size_t length =
        std::strftime(text.data(), text.size(), "%a, %d %b %Y %H:%M:%S GMT", &parts);
    return {text.data(), length};
}

const char* reasonOf(int status)
{
    switch (status) {
    case 200:
        return "OK";
    case 206:
        return "Partial Content";
    case 400:
        return "Bad Request";
    case 403:
        return "Forbidden";
    case 404:
        return "Not Found";
    case 405:
        return "Method Not Allowed";
    case 412:
        return "Precondition Failed";
    case 416:
        return "Range Not Satisfiable";
    case 500:
        return "Internal Server Error";
    case 503:
        return "Service Unavailable";
    default:
        return "Other";
    }
}

// A file in the state in which it was opened.
struct OpenFile {
    Descriptor descriptor;
    std::uint64_t bytes = 0;
    std::string etag;
    std::string modified;
};

std::optional<OpenFile> openFile(const std::filesystem::path& path)
{
    OpenFile file{Descriptor(open(path.c_str(), O_RDONLY | O_CLOEXEC)), 0, "", ""};
    struct stat status {};
    if (file.descriptor.get() < 0 || fstat(file.descriptor.get(), &status) != 0 ||
        !S_ISREG(status.st_mode)) {
        return std::nullopt;
    }
    file.bytes = static_cast<std::uint64_t>(status.st_size);
    file.etag = fmt::format("\"{:x}-{:x}-{:x}.{:x}\"", status.st_ino, status.st_size,
                            status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
    file.modified = httpDate(status.st_mtim.tv_sec);
    return file;
}

struct Settings {
    std::chrono::milliseconds latency{0};
    std::size_t bytes_per_s = 0;
    HttpRanges ranges = HttpRanges::Served;
    HttpValidators validators = HttpValidators::EtagAndTime;
    std::size_t fail_count = 0;
    int fail_status = 0;
    std::size_t cut_count = 0;
    std::size_t cut_bytes = 0;
};

// The body: parts of the file, each with some text in front.
struct Part {
    std::string text;
    Range range;
};

struct Answer {
    int status = 200;
    std::string headers; // whole lines, without those about the length and the connection
    std::vector<Part> body;

    std::uint64_t bodyBytes() const
    {
        std::uint64_t bytes = 0;
        for (const Part& part : body) {
            bytes += part.text.size() + (part.range.end - part.range.begin);
        }
        return bytes;
    }
};

Answer refusal(int status)
{
    Answer answer{status, "Content-Type: text/plain\r\n", {}};
    answer.body.push_back({fmt::format("{} {}\n", status, reasonOf(status)), {}});
    return answer;
}

// 13.1: whether the file is still the version that the client has.
bool meetsConditions(const Request& request, const OpenFile& file, HttpValidators validators)
{
    if (const std::string wanted = request.header("if-match"); !wanted.empty()) {
        return wanted == "*" || (validators == HttpValidators::EtagAndTime &&
                                 wanted.find(file.etag) != std::string::npos);
    }
    if (const std::string time = request.header("if-unmodified-since");
        !time.empty() && validators != HttpValidators::None) {
        return time == file.modified;
    }
    return true;
}

Answer answerFor(const Request& request, const OpenFile& file, const Settings& settings)
{
    if (!meetsConditions(request, file, settings.validators)) {
        return refusal(412);
    }
    Answer answer;
    if (settings.validators == HttpValidators::EtagAndTime) {
        answer.headers += fmt::format("ETag: {}\r\n", file.etag);
    }
    if (settings.validators != HttpValidators::None) {
        answer.headers += fmt::format("Last-Modified: {}\r\n", file.modified);
    }
    if (settings.ranges == HttpRanges::Served) {
        answer.headers += "Accept-Ranges: bytes\r\n";
    }
    const std::optional<std::vector<Range>> ranges =
        request.method == "GET" && settings.ranges == HttpRanges::Served
            ? rangesFrom(request.header("range"), file.bytes)
            : std::nullopt;
    constexpr const char* type = "Content-Type: application/octet-stream\r\n";
    const auto content_range = [&file](const Range& range) {
        return fmt::format("Content-Range: bytes {}-{}/{}\r\n", range.begin, range.end - 1,
                           file.bytes);
    };
    if (!ranges) {
        answer.headers += type;
        answer.body.push_back({"", {0, file.bytes}});
    } else if (ranges->empty()) {
        answer.status = 416;
        answer.headers += fmt::format("Content-Range: bytes */{}\r\n", file.bytes);
    } else if (ranges->size() == 1) {
        answer.status = 206;
        answer.headers += type + content_range(ranges->front());
        answer.body.push_back({"", ranges->front()});
    } else {
        answer.status = 206;
        answer.headers +=
            fmt::format("Content-Type: multipart/byteranges; boundary={}\r\n", kBoundary);
        for (const Range& range : *ranges) {
            answer.body.push_back(
                {fmt::format("\r\n--{}\r\n{}{}\r\n", kBoundary, type, content_range(range)),
                 range});
        }
        answer.body.push_back({fmt::format("\r\n--{}--\r\n", kBoundary), {}});
    }
    return answer;
}

bool sendAll(int socket, std::string_view data)
{
    while (!data.empty()) {
        const ssize_t sent = send(socket, data.data(), data.size(), MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) {
            continue;
        }
        if (sent <= 0) {
            return false;
        }
        data.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

} // namespace

struct HttpServer::Impl {
    struct Connection {
        Descriptor socket;
        std::thread thread;
        bool is_over = false;
    };

    std::filesystem::path folder;
    std::array<Descriptor, 2> wake; // a pipe that ends the wait for connections

    mutable std::mutex mutex; // for all members below
    std::condition_variable stopped;
    bool is_stopping = false;
    Listener listener;
    std::uint16_t port = 0;
    Settings settings;
    HttpCounts counts;
    std::vector<HttpRequest> log;
    std::vector<std::unique_ptr<Connection>> connections;
    std::thread acceptor;

    void acceptLoop();
    void reap(bool is_all);
    void serve(Connection& connection);
    bool respond(int socket, const Request& request);
    Settings takeSettings(const Request& request);
    bool sendBody(int socket, int file, const Answer& answer, const Settings& now);
    bool sendPaced(int socket, std::string_view data, const Settings& now);
    void pause(std::chrono::nanoseconds time);
    void startAccepting();
    void stopAccepting();
};

// Waits, unless the server is stopping.
void HttpServer::Impl::pause(std::chrono::nanoseconds time)
{
    if (time.count() > 0) {
        std::unique_lock lock(mutex);
        stopped.wait_for(lock, time, [this] { return is_stopping; });
    }
}

// Call without holding a lock: joins threads.
void HttpServer::Impl::reap(bool is_all)
{
    std::vector<std::unique_ptr<Connection>> finished;
    {
        const std::lock_guard lock(mutex);
        for (auto& connection : connections) {
            if (is_all) {
                shutdown(connection->socket.get(), SHUT_RDWR);
            }
            if (is_all || connection->is_over) {
                finished.push_back(std::move(connection));
            }
        }
        std::erase(connections, nullptr);
    }
    for (auto& connection : finished) {
        connection->thread.join();
    }
}

void HttpServer::Impl::acceptLoop()
{
    while (true) {
        std::array<pollfd, 2> waiting{pollfd{listener.socket.get(), POLLIN, 0},
                                      pollfd{wake[0].get(), POLLIN, 0}};
        if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) {
            return;
        }
        if (waiting[1].revents != 0) {
            return;
        }
        reap(false);
        Descriptor socket(accept4(listener.socket.get(), nullptr, nullptr, SOCK_CLOEXEC));
        if (socket.get() < 0) {
            continue;
        }
        const int yes = 1;
        setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
        auto connection = std::make_unique<Connection>();
        connection->socket = std::move(socket);
        Connection& served = *connection;
        const std::lock_guard lock(mutex);
        ++counts.connections;
        served.thread = std::thread([this, &served] { serve(served); });
        connections.push_back(std::move(connection));
    }
}

void HttpServer::Impl::serve(Connection& connection)
{
    const int socket = connection.socket.get();
    std::string received;
    std::array<char, 4096> piece{};
    while (true) {
        const std::size_t end = received.find("\r\n\r\n");
        if (end != std::string::npos) {
            const std::optional<Request> request =
                parsed(std::string_view(received).substr(0, end));
            received.erase(0, end + 4);
            if (!request || !respond(socket, *request)) {
                break;
            }
            continue;
        }
        const ssize_t count = recv(socket, piece.data(), piece.size(), 0);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0 || received.size() > kHeaderBytesMax) {
            break;
        }
        received.append(piece.data(), static_cast<std::size_t>(count));
    }
    shutdown(socket, SHUT_RDWR);
    const std::lock_guard lock(mutex);
    connection.is_over = true;
}

// The settings for this request; uses up one ordered failure or cut.
Settings HttpServer::Impl::takeSettings(const Request& request)
{
    const std::lock_guard lock(mutex);
    Settings now = settings;
    if (settings.fail_count > 0) {
        --settings.fail_count;
    } else {
        now.fail_count = 0;
        if (request.method == "GET" && settings.cut_count > 0) {
            --settings.cut_count;
        } else {
            now.cut_count = 0;
        }
    }
    return now;
}

bool HttpServer::Impl::respond(int socket, const Request& request)
{
    const Settings now = takeSettings(request);
    pause(now.latency);
    const bool is_head = request.method == "HEAD";
    Answer answer;
    std::optional<OpenFile> file;
    const std::string path = request.target.substr(0, request.target.find('?'));
    if (!is_head && request.method != "GET") {
        answer = refusal(405);
    } else if (now.fail_count > 0) {
        answer = refusal(now.fail_status);
    } else if (!path.starts_with('/') || path.find("..") != std::string::npos) {
        answer = refusal(400);
    } else {
        file = openFile(folder / path.substr(1));
        answer = file ? answerFor(request, *file, now) : refusal(404);
    }
    const std::string range = request.header("range");
    {
        const std::lock_guard lock(mutex);
        ++counts.requests;
        counts.heads += is_head ? 1 : 0;
        counts.failures += answer.status >= 400 ? 1 : 0;
        counts.ranges +=
            range.empty()
                ? 0
                : 1 + static_cast<std::uint64_t>(std::count(range.begin(), range.end(), ','));
        log.push_back({request.method, request.target, range, answer.status});
    }
    const std::string head =
        fmt::format("HTTP/1.1 {} {}\r\n{}Content-Length: {}\r\nConnection: keep-alive\r\n\r\n",
                    answer.status, reasonOf(answer.status), answer.headers, answer.bodyBytes());
    if (!sendAll(socket, head)) {
        return false;
    }
    if (is_head) {
        return true;
    }
    return sendBody(socket, file ? file->descriptor.get() : -1, answer, now);
}

bool HttpServer::Impl::sendPaced(int socket, std::string_view data, const Settings& now)
{
    { // before sending: a client that has received an answer finds it counted
        const std::lock_guard lock(mutex);
        counts.body_bytes += data.size();
    }
    if (!sendAll(socket, data)) {
        return false;
    }
    if (now.bytes_per_s > 0) {
        pause(std::chrono::nanoseconds(data.size() * 1'000'000'000ULL / now.bytes_per_s));
    }
    return true;
}

// False if the connection is to be closed.
bool HttpServer::Impl::sendBody(int socket, int file, const Answer& answer, const Settings& now)
{
    std::uint64_t left = now.cut_count > 0 ? now.cut_bytes : ~std::uint64_t{0};
    std::string piece;
    const auto send_piece = [&] {
        piece.resize(std::min<std::uint64_t>(piece.size(), left));
        left -= piece.size();
        return sendPaced(socket, piece, now);
    };
    bool is_open = true;
    for (const Part& part : answer.body) {
        piece = part.text;
        is_open = is_open && send_piece();
        for (std::uint64_t at = part.range.begin; is_open && left > 0 && at < part.range.end;) {
            piece.resize(std::min<std::uint64_t>(kPieceBytes, part.range.end - at));
            const ssize_t count = pread(file, piece.data(), piece.size(), static_cast<off_t>(at));
            if (count <= 0) {
                return false; // the file was truncated while it was being sent
            }
            piece.resize(static_cast<std::size_t>(count));
            at += static_cast<std::uint64_t>(count);
            is_open = send_piece();
        }
    }
    if (now.cut_count > 0) {
        const std::lock_guard lock(mutex);
        ++counts.failures;
        return false;
    }
    return is_open;
}

void HttpServer::Impl::startAccepting()
{
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        fail("making a pipe");
    }
    wake = {Descriptor(ends[0]), Descriptor(ends[1])};
    listener = listenOn(port);
    port = listener.port;
    acceptor = std::thread([this] { acceptLoop(); });
}

void HttpServer::Impl::stopAccepting()
{
    if (!acceptor.joinable()) {
        return;
    }
    wake[1] = Descriptor(); // the peer then reads the end of the pipe
    acceptor.join();
    listener = {};
    reap(true);
}

HttpServer::HttpServer(std::filesystem::path folder)
    : impl_(std::make_unique<Impl>())
{
    impl_->folder = std::move(folder);
    impl_->startAccepting();
}

HttpServer::~HttpServer()
{
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->is_stopping = true;
    }
    impl_->stopped.notify_all();
    impl_->stopAccepting();
}

std::uint16_t HttpServer::port() const noexcept
{
    return impl_->port;
}

std::string HttpServer::url(const std::string& file) const
{
    return fmt::format("http://127.0.0.1:{}/{}", impl_->port, file);
}

HttpCounts HttpServer::counts() const
{
    const std::lock_guard lock(impl_->mutex);
    return impl_->counts;
}

std::vector<HttpRequest> HttpServer::requests() const
{
    const std::lock_guard lock(impl_->mutex);
    return impl_->log;
}

void HttpServer::resetCounts()
{
    const std::lock_guard lock(impl_->mutex);
    impl_->counts = {};
    impl_->log.clear();
}

void HttpServer::setLatency(std::chrono::milliseconds latency)
{
    const std::lock_guard lock(impl_->mutex);
    impl_->settings.latency = latency;
}

void HttpServer::setBandwidth(std::size_t bytes_per_s)
{
    const std::lock_guard lock(impl_->mutex);
    impl_->settings.bytes_per_s = bytes_per_s;
}

void HttpServer::setRanges(HttpRanges ranges)
{
    const std::lock_guard lock(impl_->mutex);
    impl_->settings.ranges = ranges;
}

void HttpServer::setValidators(HttpValidators validators)
{
    const std::lock_guard lock(impl_->mutex);
    impl_->settings.validators = validators;
}

void HttpServer::failNext(std::size_t count, int status)
{
    const std::lock_guard lock(impl_->mutex);
    impl_->settings.fail_count = count;
    impl_->settings.fail_status = status;
}

void HttpServer::cutNext(std::size_t count, std::size_t body_bytes)
{
    const std::lock_guard lock(impl_->mutex);
    impl_->settings.cut_count = count;
    impl_->settings.cut_bytes = body_bytes;
}

void HttpServer::refuse()
{
    impl_->stopAccepting();
}

void HttpServer::accept()
{
    if (!impl_->acceptor.joinable()) {
        impl_->startAccepting();
    }
}

} // namespace marsview::test
