#include "ui/device_finder.h"

#include "haptics/device/device_registry.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace marsview {
namespace {

// For jobs that are about to end anyway.
constexpr std::chrono::milliseconds kEndPatience{300};

} // namespace

struct DeviceFinder::Shared {
    std::mutex registry_mutex; // held by the job that runs
    DriverMaker make_drivers;
    std::optional<DeviceRegistry> registry;

    std::mutex mutex; // of the following
    std::condition_variable ended;
    DeviceFinder* owner = nullptr; // null once it is gone
    int jobs = 0;

    DeviceRegistry& drivers()
    {
        if (!registry) {
            registry.emplace(make_drivers());
        }
        return *registry;
    }
    template <typename F>
    void post(F result)
    {
        const std::lock_guard lock(mutex);
        if (owner != nullptr) {
            QMetaObject::invokeMethod(owner, std::move(result), Qt::QueuedConnection);
        }
    }
};

DeviceFinder::DeviceFinder(DriverMaker make_drivers, QObject* parent)
    : QObject(parent)
    , shared_(std::make_shared<Shared>())
{
    shared_->make_drivers = std::move(make_drivers);
    shared_->owner = this;
}

DeviceFinder::~DeviceFinder()
{
    std::unique_lock lock(shared_->mutex);
    shared_->owner = nullptr;
    shared_->ended.wait_for(lock, kEndPatience, [this] { return shared_->jobs == 0; });
}

void DeviceFinder::run(const std::function<void(Shared&)>& job)
{
    {
        const std::lock_guard lock(shared_->mutex);
        ++shared_->jobs;
    }
    std::thread([shared = shared_, job] {
        {
            const std::lock_guard one_at_a_time(shared->registry_mutex);
            job(*shared);
        }
        const std::lock_guard lock(shared->mutex);
        --shared->jobs;
        shared->ended.notify_all();
    }).detach();
}

void DeviceFinder::find()
{
    if (std::exchange(is_finding_, true)) {
        return;
    }
    run([this](Shared& shared) {
        std::vector<FoundDevice> devices;
        try {
            devices = shared.drivers().find();
        } catch (const std::exception& e) {
            devices.push_back({.uri = "", .name = "", .reason = e.what()});
        }
        shared.post([this, devices = std::move(devices)] {
            is_finding_ = false;
            Q_EMIT found(devices);
        });
    });
}

void DeviceFinder::open(const QString& uri)
{
    run([this, uri = uri.toStdString(), number = ++opening_](Shared& shared) {
        // Shared, as what is posted is copied; a device that nobody takes is closed with it.
        auto device = std::make_shared<std::unique_ptr<HapticDevice>>();
        QString problem;
        try {
            Result<std::unique_ptr<HapticDevice>> result = shared.drivers().open(uri);
            if (result) {
                *device = std::move(result).value();
            } else {
                problem = QString::fromStdString(result.error().message);
            }
        } catch (const std::exception& e) {
            problem = QString::fromStdString(uri + ": " + e.what());
        }
        shared.post([this, device, problem, number] {
            if (number != opening_) {
                return;
            }
            if (*device) {
                opened_ = std::move(*device);
                Q_EMIT opened();
                opened_.reset();
            } else {
                Q_EMIT refused(problem);
            }
        });
    });
}

} // namespace marsview
