#include "tests/haptics/drivers/fake_hid.h"

#include <hidapi.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <cwchar>
#include <memory>
#include <stdexcept>

namespace marsview::test {
namespace {

FakeHid* the_fake = nullptr;

} // namespace

FakeHid::FakeHid()
{
    if (the_fake != nullptr) {
        throw std::logic_error("there is a fake already");
    }
    the_fake = this;
}

FakeHid::~FakeHid()
{
    the_fake = nullptr;
}

const HidApi& FakeHid::api() const
{
    static const HidApi kApi{
        .enumerate = [](unsigned short, unsigned short) { return the_fake->enumerate(); },
        .free_enumeration =
            [](hid_device_info* first) {
                while (first != nullptr) {
                    const std::unique_ptr<hid_device_info> info(first);
                    free(info->path);
                    free(info->serial_number);
                    first = info->next;
                }
            },
        .open_path = [](const char* path) { return the_fake->open(path); },
        .close = [](hid_device_*) { the_fake->close(); },
        .read_timeout = [](hid_device_*, unsigned char* data, std::size_t bytes,
                           int ms) { return the_fake->read(data, bytes, ms); },
        .write = [](hid_device_*, const unsigned char* data,
                    std::size_t bytes) { return the_fake->write(data, bytes); },
        .access_error = [](const char* path) { return the_fake->accessError(path); },
    };
    return kApi;
}

void FakeHid::plugIn(const FakeHidDevice& device)
{
    const std::lock_guard lock(mutex_);
    devices_.push_back(device);
}

void FakeHid::say(const Report& report)
{
    const std::lock_guard lock(mutex_);
    always_ = report;
}

void FakeHid::sayOnce(const Report& report)
{
    const std::lock_guard lock(mutex_);
    once_.push_back(report);
}

void FakeHid::unplug()
{
    const std::lock_guard lock(mutex_);
    is_unplugged_ = true;
}

void FakeHid::plugInAgain()
{
    const std::lock_guard lock(mutex_);
    is_unplugged_ = false;
}

void FakeHid::move(const std::string& from, const std::string& to)
{
    const std::lock_guard lock(mutex_);
    for (FakeHidDevice& device : devices_) {
        device.path = device.path == from ? to : device.path;
    }
}

void FakeHid::refuseToOpen()
{
    const std::lock_guard lock(mutex_);
    does_not_open_ = true;
}

void FakeHid::stallEnumerating()
{
    const std::lock_guard lock(mutex_);
    is_enumerating_stalled_ = true;
}

void FakeHid::goOnEnumerating()
{
    const std::lock_guard lock(mutex_);
    is_enumerating_stalled_ = false;
    changed_.notify_all();
}

void FakeHid::stallWriting()
{
    const std::lock_guard lock(mutex_);
    is_stalled_ = true;
}

void FakeHid::goOnWriting()
{
    const std::lock_guard lock(mutex_);
    is_stalled_ = false;
    changed_.notify_all();
}

std::size_t FakeHid::writes() const
{
    const std::lock_guard lock(mutex_);
    return written_.size();
}

std::size_t FakeHid::readings() const
{
    const std::lock_guard lock(mutex_);
    return readings_;
}

std::size_t FakeHid::enumerations() const
{
    const std::lock_guard lock(mutex_);
    return enumerations_;
}

std::size_t FakeHid::openDevices() const
{
    const std::lock_guard lock(mutex_);
    return open_;
}

std::string FakeHid::openedPath() const
{
    const std::lock_guard lock(mutex_);
    return opened_path_;
}

FakeHid::Report FakeHid::lastWritten() const
{
    const std::lock_guard lock(mutex_);
    return written_.empty() ? Report() : written_.back();
}

std::vector<FakeHid::Report> FakeHid::written() const
{
    const std::lock_guard lock(mutex_);
    return written_;
}

bool FakeHid::waitUntil(const std::function<bool()>& is_so)
{
    for (int i = 0; i < 100'000; ++i) {
        std::uint64_t turns = 0;
        {
            const std::lock_guard lock(mutex_);
            turns = turns_;
        }
        if (is_so()) {
            return true;
        }
        std::unique_lock lock(mutex_);
        // A driver that has given up reads no more; then only a timed wait makes progress.
        changed_.wait_for(lock, std::chrono::milliseconds(1), [&] { return turns_ != turns; });
    }
    return false;
}

hid_device_info* FakeHid::enumerate()
{
    std::unique_lock lock(mutex_);
    enumerations_ += 1;
    changed_.wait(lock, [&] { return !is_enumerating_stalled_; });
    hid_device_info* first = nullptr;
    if (is_unplugged_) {
        return first;
    }
    for (auto device = devices_.rbegin(); device != devices_.rend(); ++device) {
        auto* info = new hid_device_info{};
        info->path = strdup(device->path.c_str());
        info->vendor_id = device->vendor_id;
        info->product_id = device->product_id;
        info->usage_page = device->usage_page;
        info->usage = device->usage;
        info->interface_number = device->interface_number;
        static wchar_t product[] = L"Fake";
        info->product_string = product;
        info->serial_number = device->serial.empty() ? nullptr : wcsdup(device->serial.c_str());
        info->next = first;
        first = info;
    }
    return first;
}

hid_device_* FakeHid::open(const std::string& path)
{
    const std::lock_guard lock(mutex_);
    if (does_not_open_ || is_unplugged_) {
        return nullptr;
    }
    opened_path_ = path;
    open_ += 1;
    return reinterpret_cast<hid_device_*>(this);
}

void FakeHid::close()
{
    const std::lock_guard lock(mutex_);
    open_ -= 1;
}

int FakeHid::read(unsigned char* data, std::size_t bytes, int ms)
{
    std::unique_lock lock(mutex_);
    turns_ += 1;
    readings_ += 1;
    changed_.notify_all();
    if (is_unplugged_) {
        return -1;
    }
    Report report;
    if (!once_.empty()) {
        report = once_.front();
        once_.pop_front();
    } else if (ms > 0) {
        // A board sends reports regularly; without any, the read waits for its full timeout.
        const auto wait =
            always_.empty() ? std::chrono::microseconds(1000 * ms) : std::chrono::microseconds(200);
        changed_.wait_for(lock, wait, [&] { return is_unplugged_; });
        if (is_unplugged_) {
            return -1;
        }
        report = always_;
    }
    const std::size_t size = std::min(bytes, report.size());
    std::copy_n(report.begin(), size, data);
    return static_cast<int>(size);
}

int FakeHid::write(const unsigned char* data, std::size_t bytes)
{
    std::unique_lock lock(mutex_);
    turns_ += 1;
    changed_.wait(lock, [&] { return !is_stalled_; });
    if (is_unplugged_) {
        return -1;
    }
    written_.emplace_back(data, data + bytes);
    changed_.notify_all();
    return static_cast<int>(bytes);
}

int FakeHid::accessError(const std::string& path) const
{
    const std::lock_guard lock(mutex_);
    const auto device = std::find_if(devices_.begin(), devices_.end(),
                                     [&](const FakeHidDevice& d) { return d.path == path; });
    return device != devices_.end() ? device->access_error : ENOENT;
}

FakeHid::Report
reportOf(const std::vector<int>& numbers, std::size_t bytes, const FakeHid::Report& first)
{
    FakeHid::Report report = first;
    for (const int number : numbers) {
        const auto bits = static_cast<std::uint16_t>(number);
        report.push_back(static_cast<unsigned char>(bits & 0xFF));
        report.push_back(static_cast<unsigned char>(bits >> 8));
    }
    report.resize(bytes);
    return report;
}

} // namespace marsview::test
