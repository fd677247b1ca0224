#include "ui/controllers/device_finder.h"

#include "haptics/device/device_registry.h"

#include <exception>
#include <optional>
#include <utility>

namespace marsview {

// Only jobs touch it, one after the other.
struct DeviceFinder::Drivers {
    DriverMaker make_drivers;
    std::optional<DeviceRegistry> made;

    DeviceRegistry& registry()
    {
        if (!made) {
            made.emplace(make_drivers());
        }
        return *made;
    }
};

DeviceFinder::DeviceFinder(DriverMaker make_drivers, QObject* parent)
    : QObject(parent)
    , drivers_(std::make_shared<Drivers>())
    , jobs_(*this)
{
    drivers_->make_drivers = std::move(make_drivers);
}

DeviceFinder::~DeviceFinder() = default;

void DeviceFinder::find()
{
    if (std::exchange(is_finding_, true)) {
        return;
    }
    jobs_.run([this, drivers = drivers_](const auto& outlet) {
        std::vector<FoundDevice> devices;
        try {
            devices = drivers->registry().find();
        } catch (const std::exception& e) {
            devices.push_back({.uri = "", .name = "", .reason = e.what()});
        }
        outlet->post([this, devices = std::move(devices)] {
            is_finding_ = false;
            Q_EMIT found(devices);
        });
    });
}

void DeviceFinder::open(const QString& uri)
{
    jobs_.run([this, drivers = drivers_, uri = uri.toStdString(),
               number = ++opening_](const auto& outlet) {
        // Shared because posted functors are copied; a device that is not taken is closed with it.
        auto device = std::make_shared<std::unique_ptr<HapticDevice>>();
        QString problem;
        bool is_absent = false;
        try {
            Result<std::unique_ptr<HapticDevice>> result = drivers->registry().open(uri);
            if (result) {
                *device = std::move(result).value();
            } else {
                problem = QString::fromStdString(result.error().message);
                is_absent = result.error().code == ErrorCode::NotFound;
            }
        } catch (const std::exception& e) {
            problem = QString::fromStdString(uri + ": " + e.what());
        }
        outlet->post([this, device, problem, is_absent, number] {
            if (number != opening_) {
                return;
            }
            if (*device) {
                opened_ = std::move(*device);
                Q_EMIT opened();
                opened_.reset();
            } else {
                Q_EMIT refused(problem, is_absent);
            }
        });
    });
}

} // namespace marsview
