// A real HTTP server for tests of maps opened by address. Own code because cpp-httplib 0.11, which
// Debian 12 has, neither limits ranges to the end of the file nor places several of them correctly,
// and cannot close idle connections.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace marsview::test {

/// The requests and responses of a server since it started, or since resetCounts.
struct HttpCounts {
    std::uint64_t connections = 0;
    std::uint64_t requests = 0; // of any method
    std::uint64_t heads = 0;
    std::uint64_t ranges = 0;     // requested; a request may ask for several
    std::uint64_t body_bytes = 0; // sent
    std::uint64_t failures = 0;   // responses with a status of 400 or more, and truncated bodies
};

struct HttpRequest {
    std::string method;
    std::string target;
    std::string range; // of the header; empty for none
    int status = 0;    // of the response
};

enum class HttpRanges : std::uint8_t {
    Served,
    Ignored, // every GET is answered with the whole file
};

/// The headers from which a client can detect that a file has changed.
enum class HttpValidators : std::uint8_t {
    EtagAndTime,
    TimeOnly,
    None,
};

/// Serves the files of a folder over HTTP/1.1 on 127.0.0.1, at a port chosen by the system: HEAD
/// and GET with single and multiple ranges, keep-alive connections, ETag and Last-Modified with
/// their conditions. A replaced file is served from the next request on. Members may be called on
/// any thread at any time; settings apply to requests that arrive afterwards.
class HttpServer {
public:
    explicit HttpServer(std::filesystem::path folder);
    /// Aborts responses in progress.
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    std::uint16_t port() const noexcept;
    /// "http://127.0.0.1:PORT/FILE".
    std::string url(const std::string& file) const;

    HttpCounts counts() const;
    std::vector<HttpRequest> requests() const;
    void resetCounts();

    /// The delay before each response.
    void setLatency(std::chrono::milliseconds latency);
    /// Per connection; 0 for unlimited.
    void setBandwidth(std::size_t bytes_per_s);
    void setRanges(HttpRanges ranges);
    void setValidators(HttpValidators validators);
    /// The next `count` requests are answered with `status` only.
    void failNext(std::size_t count, int status);
    /// The next `count` bodies, and their connections, end after `body_bytes`.
    void cutNext(std::size_t count, std::size_t body_bytes);
    /// Closes all connections and rejects new ones until accept().
    void refuse();
    void accept();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace marsview::test
