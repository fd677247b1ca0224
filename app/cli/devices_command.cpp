// marsview-cli devices: lists haptic devices, with the reason if one cannot be used.

#include "app/cli/devices_command.h"

#include "app/cli/commands.h"
#include "app/console/number_checks.h"
#include "app/console/text_output.h"
#include "haptics/device/device_registry.h"
#include "haptics/device/plugin_call.h"
#include "haptics/device/plugin_check.h"
#include "haptics/drivers/built_in_drivers.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

struct DevicesOptions {
    bool is_json = false;
    bool tries_again = false;
    std::string plugin; // to check
    std::string device; // of it
};

// Names come from devices and files, and may not be valid UTF-8.
std::string shown(const std::string& text)
{
    const std::string valid = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
    return asOneLine(Json::parse(valid).get<std::string>());
}

// As counted by fmt for column widths.
std::size_t characters(const std::string& utf8)
{
    return static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    }));
}

std::string stateOf(const FoundDevice& device)
{
    if (device.reason.empty()) {
        return "ready";
    }
    return (device.isUsable() ? "ready; " : "") + shown(device.reason);
}

Status runDevices(const DevicesOptions& options)
{
    if (options.tries_again) {
        CrashMarker::forget(CrashMarker::defaultFolder());
    }
    DeviceRegistry registry(builtInDrivers());
    const std::vector<FoundDevice> devices = registry.find();
    if (options.is_json) {
        printJson(withSchema(devicesAsJson(devices, registry.schemes())), JsonLayout::OneLine);
    } else {
        printLine(devicesAsTable(devices));
    }
    return Done{};
}

Status runCheck(const DevicesOptions& options)
{
    const Result<std::vector<PluginCheckStep>> steps = checkPlugin(options.plugin, options.device);
    if (!steps) {
        return steps.error();
    }
    Json list = Json::array();
    std::size_t faults = 0;
    for (const PluginCheckStep& step : *steps) {
        const bool has_passed = step.fault.empty();
        faults += has_passed ? 0 : 1;
        const std::string& text = has_passed ? step.remark : step.fault;
        if (!options.is_json) {
            printLine(fmt::format("{}  {}{}", has_passed ? "passed" : "FAILED", step.what,
                                  text.empty() ? "" : ": " + shown(text)));
        }
        list.push_back(
            {{"check", step.what},
             {"passed", has_passed},
             {"reason", has_passed ? Json(nullptr) : Json(shown(step.fault))},
             {"remark", step.remark.empty() ? Json(nullptr) : Json(shown(step.remark))}});
    }
    if (options.is_json) {
        printJson(withSchema({{"plugin", options.plugin}, {"checks", list}}));
    }
    if (faults > 0) {
        return Error{ErrorCode::Invalid, fmt::format("{}: {} of {} checks failed", options.plugin,
                                                     faults, steps->size())};
    }
    return Done{};
}

} // namespace

std::string devicesAsTable(const std::vector<FoundDevice>& devices)
{
    struct Row {
        std::string uri;
        std::string name;
        std::string state;
    };
    std::vector<Row> rows{{"URI", "name", "state"}};
    for (const FoundDevice& device : devices) {
        rows.push_back({shown(device.uri), shown(device.name), stateOf(device)});
    }
    std::size_t uri_width = 0;
    std::size_t name_width = 0;
    for (const Row& row : rows) {
        uri_width = std::max(uri_width, characters(row.uri));
        name_width = std::max(name_width, characters(row.name));
    }
    std::string table;
    for (const Row& row : rows) {
        table += fmt::format("{}{:<{}}  {:<{}}  {}", table.empty() ? "" : "\n", row.uri, uri_width,
                             row.name, name_width, row.state);
    }
    return table;
}

Json devicesAsJson(const std::vector<FoundDevice>& devices, const std::vector<std::string>& schemes)
{
    Json list = Json::array();
    for (const FoundDevice& device : devices) {
        list.push_back(
            {{"uri", device.uri},
             {"name", device.name},
             {"usable", device.isUsable()},
             {"reason", device.reason.empty() ? Json(nullptr) : Json(device.reason)},
             {"details", device.details.empty() ? Json(nullptr) : Json(device.details)}});
    }
    return {{"devices", list}, {"schemes", schemes}};
}

void addDevicesCommand(CLI::App& app, CommandAction& run)
{
    const auto options = std::make_shared<DevicesOptions>();
    CLI::App* command =
        app.add_subcommand("devices", "List haptic devices and plugins, and why one is not usable");
    command->add_flag("--json", options->is_json, "print JSON");
    command->add_flag("--retry", options->tries_again,
                      "try plugins again that are skipped because the program ended during one of "
                      "their calls");
    auto* check = command
                      ->add_option("--check", options->plugin,
                                   "test whether a device plugin conforms to the interface, on its "
                                   "device, without force")
                      ->type_name("FILE")
                      ->transform(fileName());
    command
        ->add_option("--device", options->device,
                     "id of the device to test; by default the first one that is ready")
        ->type_name("ID")
        ->needs(check);
    command->callback([options, &run] {
        run = [options] {
            return options->plugin.empty() ? runDevices(*options) : runCheck(*options);
        };
    });
}

} // namespace marsview
