// A real HTTP server for tests of maps by address.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace marsview::test {

/// What a server was asked, and answered, since it started or resetCounts.
struct HttpCounts {
    std::uint64_t connections = 0;
    std::uint64_t requests = 0; // of any method
    std::uint64_t heads = 0;
    std::uint64_t ranges = 0;     // asked for; a request may ask for several
    std::uint64_t body_bytes = 0; // sent
    std::uint64_t failures = 0;   // answers with a status of 400 or more, and bodies cut short
};

struct HttpRequest {
    std::string method;
    std::string target;
    std::string range; // of the header; empty for none
    int status = 0;    // of the answer
};

enum class HttpRanges : std::uint8_t {
    Served,
    Ignored, // every GET is answered with the whole file
};

/// What a server says by which a client can tell that a file has changed.
enum class HttpValidators : std::uint8_t {
    EtagAndTime,
    TimeOnly,
    None,
};

/// Serves the files of a folder over HTTP/1.1 on 127.0.0.1, at a port of the system's choice: HEAD
/// and GET with single and multiple ranges, kept-alive connections, ETag and Last-Modified with
/// their conditions. A file that is replaced is another from the next request on. Members are for
/// any thread at any time; what is set holds for requests that arrive afterwards.
class HttpServer {
public:
    explicit HttpServer(std::filesystem::path folder);
    /// Breaks off what is being sent.
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    std::uint16_t port() const noexcept;
    /// "http://127.0.0.1:PORT/FILE".
    std::string url(const std::string& file) const;

    HttpCounts counts() const;
    std::vector<HttpRequest> requests() const;
    void resetCounts();

    /// Before each answer.
    void setLatency(std::chrono::milliseconds latency);
    /// Of each connection; 0 for as fast as it goes.
    void setBandwidth(std::size_t bytes_per_s);
    void setRanges(HttpRanges ranges);
    void setValidators(HttpValidators validators);
    /// The next `count` requests are answered with `status` and nothing else.
    void failNext(std::size_t count, int status);
    /// The next `count` bodies end, and with them the connection, after `body_bytes`.
    void cutNext(std::size_t count, std::size_t body_bytes);
    /// Connections are refused, and those that are open are closed, until accept.
    void refuse();
    void accept();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace marsview::test
