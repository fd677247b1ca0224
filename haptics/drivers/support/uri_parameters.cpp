#include "haptics/drivers/support/uri_parameters.h"

#include "core/base/plain_number.h"

#include <algorithm>
#include <fmt/format.h>

namespace marsview {

Status readUriParameters(std::string_view uri,
                         std::string_view address,
                         const std::vector<UriParameter>& parameters)
{
    while (!address.empty()) {
        const std::size_t comma = std::min(address.find(','), address.size());
        const std::string_view word = address.substr(0, comma);
        address.remove_prefix(std::min(comma + 1, address.size()));
        const std::size_t equals = word.find('=');
        const std::string_view name = word.substr(0, equals);
        const auto parameter =
            std::find_if(parameters.begin(), parameters.end(),
                         [name](const UriParameter& p) { return p.name == name; });
        if (parameter == parameters.end() && parameters.empty()) {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: this device takes no address; write {}", uri,
                                     uri.substr(0, uri.find(':') + 1))};
        }
        if (parameter == parameters.end()) {
            std::string known;
            for (const UriParameter& p : parameters) {
                known += known.empty() ? "" : ", ";
                known += p.name;
            }
            return Error{
                ErrorCode::Invalid,
                fmt::format("{}: unknown parameter \"{}\"; known ones are {}", uri, name, known)};
        }
        const auto value =
            equals == std::string_view::npos ? std::nullopt : parseNumber(word.substr(equals + 1));
        if (!value || !(*value >= parameter->minimum && *value <= parameter->maximum)) {
            return Error{ErrorCode::OutOfRange,
                         fmt::format("{}: {} must be a number from {} to {}", uri, name,
                                     parameter->minimum, parameter->maximum)};
        }
        *parameter->value = *value;
    }
    return Done{};
}

} // namespace marsview
