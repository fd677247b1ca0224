#include "haptics/drivers/record_driver.h"

#include "core/base/plain_number.h"
#include "haptics/device/device_registry.h"
#include "haptics/drivers/built_in_drivers.h"
#include "haptics/sync/spsc_queue.h"
#include "haptics/trace/trace_file.h"

#include <fmt/format.h>
#include <mutex>
#include <thread>
#include <utility>

namespace marsview {
namespace {

constexpr std::string_view kColumns =
    "time_s,status,x,y,z,twist_rad,buttons,is_held,force_x_n,force_y_n,force_z_n,"
    "orientation_w,orientation_x,orientation_y,orientation_z";

struct Reading {
    DeviceSample sample;
    DeviceStatus status = DeviceStatus::Fine;
    Vec3 force_n{}; // last written
};

std::string_view nameOf(DeviceStatus status)
{
    switch (status) {
    case DeviceStatus::Fine:
        return "fine";
    case DeviceStatus::Unready:
        return "unready";
    case DeviceStatus::Lost:
        return "lost";
    case DeviceStatus::Finished:
        return "finished";
    }
    return "unknown";
}

class RecordDevice final : public HapticDevice {
public:
    RecordDevice(std::unique_ptr<HapticDevice> device, TraceFile file)
        : device_(std::move(device))
        , file_(std::move(file))
    {
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }
    ~RecordDevice() override
    {
        device_->stopClock();
        thread_.request_stop();
        thread_.join();
    }
    RecordDevice(const RecordDevice&) = delete;
    RecordDevice& operator=(const RecordDevice&) = delete;

    const DeviceCapabilities& capabilities() const noexcept override
    {
        return device_->capabilities();
    }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        reading_.status = device_->read(sample);
        reading_.sample = sample;
        queue_.put(reading_); // full if the disk is too slow: lines are dropped
        return reading_.status;
    }
    DeviceStatus write(const Vec3& force_n) noexcept override
    {
        reading_.force_n = force_n;
        return device_->write(force_n);
    }
    bool recordedTick(RecordedTick& tick) const noexcept override
    {
        return device_->recordedTick(tick);
    }
    double playedShare() const noexcept override { return device_->playedShare(); }
    void strokeWithin(const WorkspaceBox& box) noexcept override { device_->strokeWithin(box); }
    bool startClock(ClockTick tick, void* self) noexcept override
    {
        return device_->startClock(tick, self);
    }
    void stopClock() noexcept override { device_->stopClock(); }
    // The device's own problem, else why recording has stopped, which does not affect the force.
    std::string trouble() const override
    {
        std::string of_device = device_->trouble();
        if (!of_device.empty()) {
            return of_device;
        }
        const std::lock_guard lock(mutex_);
        drain();
        const Status status = file_.status();
        return status ? std::string() : "recording stopped: " + status.error().message;
    }

private:
    void run(const std::stop_token& stop)
    {
        constexpr std::chrono::milliseconds kLook{20};
        while (!stop.stop_requested()) {
            {
                const std::lock_guard lock(mutex_);
                drain();
            }
            std::this_thread::sleep_for(kLook);
        }
        const std::lock_guard lock(mutex_);
        drain();
    }
    // Requires mutex_, which makes the caller the queue's only reader.
    void drain() const
    {
        Reading r;
        while (queue_.take(r)) {
            if (begin_ == decltype(begin_){}) {
                begin_ = r.sample.time;
            }
            const double time_s = std::chrono::duration<double>(r.sample.time - begin_).count();
            const std::string line = fmt::format(
                "{:.6f},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", time_s, nameOf(r.status),
                asText(r.sample.position.x), asText(r.sample.position.y),
                asText(r.sample.position.z), asText(r.sample.twist_rad), r.sample.buttons,
                r.sample.is_held ? 1 : 0, asText(r.force_n.x), asText(r.force_n.y),
                asText(r.force_n.z), asText(r.sample.orientation.w), asText(r.sample.orientation.x),
                asText(r.sample.orientation.y), asText(r.sample.orientation.z));
            file_.write(line);
        }
        file_.flush();
    }

    std::unique_ptr<HapticDevice> device_;
    Reading reading_;
    mutable std::mutex mutex_; // guards the file; the servo thread does not lock it
    mutable TraceFile file_;
    mutable SpscQueue<Reading, 1U << 13> queue_;
    mutable std::chrono::steady_clock::time_point begin_{};
    std::jthread thread_;
};

class RecordDriver final : public DeviceDriver {
public:
    std::string_view scheme() const noexcept override { return "record"; }
    std::vector<FoundDevice> find() override { return {}; }
    Status checkAddress(std::string_view address) const override
    {
        const std::size_t comma = address.find(',');
        if (comma == 0 || comma == std::string_view::npos || comma + 1 == address.size()) {
            return Error{ErrorCode::Invalid,
                         fmt::format("record:{}: needs a file and the URI of a device, as in "
                                     "record:touch.csv,sim:",
                                     address)};
        }
        return DeviceRegistry(builtInDrivers()).check(address.substr(comma + 1));
    }
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override
    {
        if (const Status checked = checkAddress(address); !checked) {
            return checked.error();
        }
        const std::size_t comma = address.find(',');
        const std::string path(address.substr(0, comma));
        Result<std::unique_ptr<HapticDevice>> device =
            DeviceRegistry(builtInDrivers()).open(address.substr(comma + 1));
        if (!device) {
            return std::move(device).error();
        }
        Result<TraceFile> file = TraceFile::begin(path, kColumns);
        if (!file) {
            return Error{file.error().code, "record:" + file.error().message};
        }
        return std::unique_ptr<HapticDevice>(
            new RecordDevice(std::move(device).value(), std::move(*file)));
    }
};

} // namespace

std::string recordedFile(std::string_view uri)
{
    constexpr std::string_view kScheme = "record:";
    const std::size_t comma = uri.find(',');
    return uri.starts_with(kScheme) && comma != std::string_view::npos
               ? std::string(uri.substr(kScheme.size(), comma - kScheme.size()))
               : std::string();
}

std::unique_ptr<DeviceDriver> makeRecordDriver()
{
    return std::make_unique<RecordDriver>();
}

} // namespace marsview
