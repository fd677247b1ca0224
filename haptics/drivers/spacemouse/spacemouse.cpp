#include "haptics/drivers/spacemouse/spacemouse.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <utility>

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint16_t kLogitech = 0x046D; // the former maker
constexpr std::uint16_t kThreeDconnexion = 0x256F;
constexpr std::uint16_t kGenericDesktop = 0x01;
constexpr std::uint16_t kMultiAxisController = 0x08;

struct Model {
    std::uint16_t vendor_id;
    std::uint16_t product_id;
    const char* name;
};

// Not here: CadMouse (0x256F, 0xC650, 0xC651, 0xC654 to 0xC658) and keyboards (from 0xC664).
constexpr std::array kModels{
    Model{kLogitech, 0xC603, "SpaceMouse Plus XT"},
    Model{kLogitech, 0xC605, "CADman"},
    Model{kLogitech, 0xC606, "SpaceMouse Classic"},
    Model{kLogitech, 0xC621, "SpaceBall 5000"},
    Model{kLogitech, 0xC623, "SpaceTraveler"},
    Model{kLogitech, 0xC625, "SpacePilot"},
    Model{kLogitech, 0xC626, "SpaceNavigator"},
    Model{kLogitech, 0xC627, "SpaceExplorer"},
    Model{kLogitech, 0xC628, "SpaceNavigator for Notebooks"},
    Model{kLogitech, 0xC629, "SpacePilot Pro"},
    Model{kLogitech, 0xC62B, "SpaceMouse Pro"},
    Model{kThreeDconnexion, 0xC62E, "SpaceMouse Wireless (cabled)"},
    Model{kThreeDconnexion, 0xC62F, "SpaceMouse Wireless"},
    Model{kThreeDconnexion, 0xC631, "SpaceMouse Pro Wireless (cabled)"},
    Model{kThreeDconnexion, 0xC632, "SpaceMouse Pro Wireless"},
    Model{kThreeDconnexion, 0xC633, "SpaceMouse Enterprise"},
    Model{kThreeDconnexion, 0xC635, "SpaceMouse Compact"},
    Model{kThreeDconnexion, 0xC636, "SpaceMouse Module"},
    Model{kThreeDconnexion, 0xC638, "SpaceMouse Pro Wireless (Bluetooth)"},
    Model{kThreeDconnexion, 0xC63A, "SpaceMouse Wireless (Bluetooth)"},
    Model{kThreeDconnexion, 0xC652, "Universal Receiver"},
};

constexpr int kReadPatienceMs = 50;
constexpr std::chrono::milliseconds kSilence{150}; // ten reports
constexpr std::size_t kReportBytesMax = 64;

const Model* modelOf(const HidEntry& entry)
{
    const auto model = std::find_if(kModels.begin(), kModels.end(), [&](const Model& m) {
        return m.vendor_id == entry.vendor_id && m.product_id == entry.product_id;
    });
    return model != kModels.end() ? &*model : nullptr;
}

// A receiver has one path for the cap and other paths for mice and keyboards.
bool isSpaceMouse(const HidEntry& entry)
{
    const bool may_have_axes = entry.usage_page == 0 || (entry.usage_page == kGenericDesktop &&
                                                         entry.usage == kMultiAxisController);
    return modelOf(entry) != nullptr && may_have_axes;
}

std::string uriOf(std::string_view address)
{
    return fmt::format("spacemouse:{}", address);
}

} // namespace

std::vector<FoundDevice> SpaceMouse::find(const HidApi& api)
{
    std::vector<FoundDevice> found;
    for (const HidEntry& entry : hidDevices(api, isSpaceMouse)) {
        found.push_back({uriOf(entry.path), modelOf(entry)->name, refusalToOpen(api, entry.path)});
    }
    return found;
}

Result<std::unique_ptr<SpaceMouse>>
SpaceMouse::open(std::string_view address, const HidApi& api, std::function<void()> notify)
{
    const std::string uri = uriOf(address);
    const std::vector<HidEntry> entries = hidDevices(api, [&](const HidEntry& entry) {
        return isSpaceMouse(entry) && (address.empty() || entry.path == address);
    });
    if (entries.empty()) {
        return Error{ErrorCode::NotFound,
                     fmt::format("{}: no SpaceMouse is connected there; plug it in, and see "
                                 "marsview-cli devices",
                                 uri)};
    }
    Result<HidHandle> handle = openHid(api, entries.front().path, uri);
    if (!handle) {
        return std::move(handle).error();
    }
    return std::unique_ptr<SpaceMouse>(
        new SpaceMouse(api, std::move(*handle), modelOf(entries.front())->name, std::move(notify)));
}

SpaceMouse::SpaceMouse(const HidApi& api,
                       HidHandle handle,
                       std::string name,
                       std::function<void()> notify)
    : api_(api)
    , handle_(std::move(handle))
    , name_(std::move(name))
    , notify_(notify ? std::move(notify) : [] {})
{
    thread_ = std::thread([this] { run(); });
}

SpaceMouse::~SpaceMouse()
{
    is_stopping_.store(true);
    thread_.join();
}

SpaceMouseRates SpaceMouse::rates() const noexcept
{
    return rates_.read();
}

void SpaceMouse::run() noexcept
{
    SpaceMouseRates rates;
    Clock::time_point heard = Clock::now();
    while (!is_stopping_.load(std::memory_order_relaxed)) {
        std::array<unsigned char, kReportBytesMax> bytes{};
        const int read =
            api_.read_timeout(handle_.get(), bytes.data(), bytes.size(), kReadPatienceMs);
        if (read < 0) {
            break;
        }
        const auto size = std::min(static_cast<std::size_t>(read), bytes.size());
        const SpaceMouseRates before = rates;
        if (takeSpaceMouseReport({bytes.data(), size}, rates)) {
            heard = Clock::now();
        } else if (!rates.isAtRest() && Clock::now() - heard > kSilence) {
            rates.push = rates.turn = {}; // otherwise the last rates would move the camera forever
        } else {
            continue;
        }
        rates_.write(rates);
        const std::uint32_t pressed = rates.buttons & ~before.buttons;
        pressed_.fetch_or(pressed);
        if (pressed != 0 || (before.isAtRest() && !rates.isAtRest())) {
            notify_();
        }
    }
    handle_.reset();
    if (!is_stopping_.load(std::memory_order_relaxed)) {
        rates_.write({});
        is_lost_.store(true, std::memory_order_release);
        notify_();
    }
}

std::vector<FoundDevice> SpaceMouseDriver::find()
{
    std::vector<FoundDevice> found = SpaceMouse::find(api_);
    for (FoundDevice& device : found) {
        if (device.isUsable()) {
            device.reason = "moves the camera in the window; it is not a haptic device";
        }
    }
    return found;
}

Result<std::unique_ptr<HapticDevice>> SpaceMouseDriver::open(std::string_view address)
{
    return Error{ErrorCode::Unsupported,
                 fmt::format("{}: a SpaceMouse moves the camera and is not a haptic device; "
                             "name another device",
                             uriOf(address))};
}

} // namespace marsview
