// Simulated HID devices in place of hidapi: a test plugs them in, sets their reports, and unplugs
// them.
#pragma once

#include "haptics/drivers/hid/hid_api.h"

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace marsview::test {

struct FakeHidDevice {
    std::string path;
    std::uint16_t vendor_id = 0;
    std::uint16_t product_id = 0;
    std::uint16_t usage_page = 0;
    std::uint16_t usage = 0;
    int interface_number = 0;
    int access_error = 0;
    std::wstring serial{};
};

/// One instance at a time, because hidapi's functions take no object. All members may be called
/// from any thread.
class FakeHid {
public:
    using Report = std::vector<unsigned char>;

    FakeHid();
    ~FakeHid();
    FakeHid(const FakeHid&) = delete;
    FakeHid& operator=(const FakeHid&) = delete;

    const HidApi& api() const;
    void plugIn(const FakeHidDevice& device);

    /// The report that the open device returns at every read from now on; empty: none.
    void say(const Report& report);
    /// A report that it returns once, before that one.
    void sayOnce(const Report& report);
    /// The device is not listed any more, and reads fail.
    void unplug();
    void plugInAgain();
    /// The device at this path gets another path.
    void move(const std::string& from, const std::string& to);
    void refuseToOpen();
    /// Enumerating blocks until goOnEnumerating().
    void stallEnumerating();
    void goOnEnumerating();
    /// Writing blocks until goOnWriting().
    void stallWriting();
    void goOnWriting();

    std::size_t writes() const;
    std::size_t readings() const;
    std::size_t enumerations() const;
    std::size_t openDevices() const;
    /// For the last device that was opened.
    std::string openedPath() const;
    Report lastWritten() const;
    std::vector<Report> written() const;

    /// Waits until `is_so`, while the driver reads and writes reports. False if that does not
    /// happen within a hundred thousand of them.
    bool waitUntil(const std::function<bool()>& is_so);

    // Implementations for the function table.
    hid_device_info* enumerate();
    hid_device_* open(const std::string& path);
    void close();
    int read(unsigned char* data, std::size_t bytes, int ms);
    int write(const unsigned char* data, std::size_t bytes);
    int accessError(const std::string& path) const;

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<FakeHidDevice> devices_;
    std::deque<Report> once_;
    Report always_;
    std::vector<Report> written_;
    std::string opened_path_;
    std::uint64_t turns_ = 0;
    std::size_t open_ = 0;
    std::size_t enumerations_ = 0; // started
    std::size_t readings_ = 0;
    bool is_unplugged_ = false;
    bool does_not_open_ = false;
    bool is_stalled_ = false;
    bool is_enumerating_stalled_ = false;
};

/// Little-endian int16, as in the reports of all these devices; with `first` in front, if any.
FakeHid::Report
reportOf(const std::vector<int>& numbers, std::size_t bytes, const FakeHid::Report& first = {});

} // namespace marsview::test
