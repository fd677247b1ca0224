// Finding and opening haptic devices away from the GUI thread.
#pragma once

#include "haptics/device/device_driver.h"
#include "ui/controllers/detached_jobs.h"

#include <QObject>
#include <QString>

#include <functional>
#include <memory>
#include <vector>

namespace marsview {

/// Makes the drivers that devices are looked for with. Called once, on another thread.
using DriverMaker = std::function<std::vector<std::unique_ptr<DeviceDriver>>()>;

/// Searching buses and opening devices may take seconds, or never end, so both run on separate
/// threads, one after the other. Lives in the GUI thread, which never waits for them; a job that
/// hangs while the finder is destroyed keeps running.
class DeviceFinder final : public QObject {
    Q_OBJECT

public:
    explicit DeviceFinder(DriverMaker make_drivers, QObject* parent = nullptr);
    ~DeviceFinder() override;

    /// found() follows. Does nothing if a search is in progress.
    void find();
    bool isFinding() const noexcept { return is_finding_; }
    /// opened() or refused() follows, unless canceled, or another one is opened first.
    void open(const QString& uri);
    /// A device that is being opened is closed as soon as it is open.
    void cancelOpening() { ++opening_; }

    /// The device that opened() announced; null if it was taken.
    std::unique_ptr<HapticDevice> takeOpened() { return std::move(opened_); }

Q_SIGNALS:
    void found(const std::vector<FoundDevice>& devices);
    void opened();
    /// "URI: WHY", and whether the reason is that the device is not connected.
    void refused(const QString& problem, bool is_absent);

private:
    struct Drivers;

    std::shared_ptr<Drivers> drivers_;
    std::unique_ptr<HapticDevice> opened_;
    bool is_finding_ = false;
    int opening_ = 0; // which of the openings counts
    DetachedJobs jobs_;
};

} // namespace marsview
