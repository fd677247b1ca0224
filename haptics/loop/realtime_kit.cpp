#include "haptics/loop/realtime_kit.h"

#if defined(MARSVIEW_HAS_DBUS)

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <dbus/dbus.h>
#include <memory>
#include <optional>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

namespace marsview {
namespace {

constexpr const char* kService = "org.freedesktop.RealtimeKit1";
constexpr const char* kPath = "/org/freedesktop/RealtimeKit1";
constexpr const char* kInterface = "org.freedesktop.RealtimeKit1";
constexpr int kTimeoutMs = 500;

struct CloseConnection {
    void operator()(DBusConnection* connection) const
    {
        dbus_connection_close(connection);
        dbus_connection_unref(connection);
    }
};
using Connection = std::unique_ptr<DBusConnection, CloseConnection>;

struct Unref {
    void operator()(DBusMessage* message) const { dbus_message_unref(message); }
};
using Message = std::unique_ptr<DBusMessage, Unref>;

// The error of a call.
class CallError {
public:
    CallError() { dbus_error_init(&error_); }
    ~CallError() { dbus_error_free(&error_); }
    CallError(const CallError&) = delete;
    CallError& operator=(const CallError&) = delete;

    DBusError* get() { return &error_; }
    std::string text() const
    {
        return dbus_error_is_set(&error_) != 0 ? error_.message : "no answer";
    }

private:
    DBusError error_;
};

// A numeric property of the service.
std::optional<std::int64_t> property(DBusConnection* connection, const char* name)
{
    const Message call(
        dbus_message_new_method_call(kService, kPath, "org.freedesktop.DBus.Properties", "Get"));
    if (!call || dbus_message_append_args(call.get(), DBUS_TYPE_STRING, &kInterface,
                                          DBUS_TYPE_STRING, &name, DBUS_TYPE_INVALID) == 0) {
        return std::nullopt;
    }
    CallError error;
    const Message reply(
        dbus_connection_send_with_reply_and_block(connection, call.get(), kTimeoutMs, error.get()));
    DBusMessageIter outer;
    if (!reply || dbus_message_iter_init(reply.get(), &outer) == 0 ||
        dbus_message_iter_get_arg_type(&outer) != DBUS_TYPE_VARIANT) {
        return std::nullopt;
    }
    DBusMessageIter inner;
    dbus_message_iter_recurse(&outer, &inner);
    if (dbus_message_iter_get_arg_type(&inner) == DBUS_TYPE_INT32) {
        dbus_int32_t value = 0;
        dbus_message_iter_get_basic(&inner, &value);
        return value;
    }
    if (dbus_message_iter_get_arg_type(&inner) == DBUS_TYPE_INT64) {
        dbus_int64_t value = 0;
        dbus_message_iter_get_basic(&inner, &value);
        return value;
    }
    return std::nullopt;
}

// The service refuses processes whose real-time threads have no run-time limit.
std::string boundedRunTime(std::int64_t microseconds)
{
    rlimit limit{};
    if (getrlimit(RLIMIT_RTTIME, &limit) != 0) {
        return std::strerror(errno); // NOLINT(concurrency-mt-unsafe): glibc's is
    }
    const auto most = static_cast<rlim_t>(microseconds);
    limit.rlim_max = std::min(limit.rlim_max, most);
    limit.rlim_cur = std::min(limit.rlim_cur, most);
    return setrlimit(RLIMIT_RTTIME, &limit) == 0
               ? std::string()
               : std::string(std::strerror(errno)); // NOLINT(concurrency-mt-unsafe)
}

} // namespace

std::string askRealtimeKit(int priority)
{
    CallError error;
    const Connection connection(dbus_bus_get_private(DBUS_BUS_SYSTEM, error.get()));
    if (!connection) {
        return "RealtimeKit cannot be used: " + error.text();
    }
    dbus_connection_set_exit_on_disconnect(connection.get(), 0);
    const auto highest = property(connection.get(), "MaxRealtimePriority");
    const auto longest = property(connection.get(), "RTTimeUSecMax");
    if (!highest || !longest) {
        return "RealtimeKit is not available";
    }
    if (const std::string refusal = boundedRunTime(*longest); !refusal.empty()) {
        return "RealtimeKit requires a run-time limit, which was refused: " + refusal;
    }
    const dbus_uint64_t thread = static_cast<dbus_uint64_t>(gettid());
    const dbus_uint32_t granted =
        static_cast<dbus_uint32_t>(std::min<std::int64_t>(priority, *highest));
    const Message call(
        dbus_message_new_method_call(kService, kPath, kInterface, "MakeThreadRealtime"));
    if (!call || dbus_message_append_args(call.get(), DBUS_TYPE_UINT64, &thread, DBUS_TYPE_UINT32,
                                          &granted, DBUS_TYPE_INVALID) == 0) {
        return "RealtimeKit cannot be used: out of memory";
    }
    const Message reply(dbus_connection_send_with_reply_and_block(connection.get(), call.get(),
                                                                  kTimeoutMs, error.get()));
    if (!reply) {
        return "RealtimeKit refused: " + error.text();
    }
    const int policy = sched_getscheduler(0);
    const bool is_real_time = policy >= 0 && (policy & ~SCHED_RESET_ON_FORK) != SCHED_OTHER;
    return is_real_time ? std::string() : "RealtimeKit agreed, but the scheduling is unchanged";
}

} // namespace marsview

#else

namespace marsview {

std::string askRealtimeKit(int /*priority*/)
{
    return "RealtimeKit cannot be used: built without D-Bus";
}

} // namespace marsview

#endif
