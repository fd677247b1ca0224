// Reading the members of JSON objects, with the place of the first fault.
#pragma once

#include "core/base/angle.h"
#include "core/geo/geotransform.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

namespace marsview {

using Json = nlohmann::ordered_json;

/// A value and its name in a file. Lists of them are arrays.
template <typename Value>
struct Named {
    Value value;
    const char* name;
};

/// `value` is in the list.
template <typename Names, typename Value>
const char* nameIn(const Names& names, Value value)
{
    return std::find_if(names.begin(), names.end(),
                        [value](const auto& entry) { return entry.value == value; })
        ->name;
}

/// The shortest decimal number of degrees that gives the angle, if there is one: 15.3, where the
/// division gives 15.300000000000001.
double degreesOf(Angle angle);

/// Reads the members of one object and notes the first fault. Members that are absent leave their
/// variable as it is. The object outlives it.
class Members {
public:
    Members(const Json& json, std::string place, std::string& fault)
        : json_(json)
        , place_(std::move(place))
        , fault_(fault)
    {
        if (!json_.is_object()) {
            refuse("", "an object");
        }
    }

    bool has(const char* key) const { return json_.is_object() && json_.contains(key); }

    void text(const char* key, std::string& value)
    {
        if (has(key)) {
            if (const Json& member = json_[key]; member.is_string()) {
                value = member.get<std::string>();
            } else {
                refuse(key, "a text");
            }
        }
    }

    void text(const char* key, std::optional<std::string>& value)
    {
        if (has(key)) {
            value.emplace();
            text(key, *value);
        }
    }

    void flag(const char* key, bool& value)
    {
        if (has(key)) {
            if (const Json& member = json_[key]; member.is_boolean()) {
                value = member.get<bool>();
            } else {
                refuse(key, "true or false");
            }
        }
    }

    // Any number, also "nan", "inf" and "-inf".
    void anyNumber(const char* key, std::optional<double>& value)
    {
        if (has(key)) {
            value = numberIn(json_[key]);
            if (!value) {
                refuse(key, "a number");
            }
        }
    }

    template <typename Accepts>
    void number(const char* key, double& value, Accepts accepts, const char* what)
    {
        if (has(key)) {
            const Json& member = json_[key];
            const double given = member.is_number() ? member.get<double>()
                                                    : std::numeric_limits<double>::quiet_NaN();
            if (std::isfinite(given) && accepts(given)) {
                value = given;
            } else {
                refuse(key, what);
            }
        }
    }

    void number(const char* key, double& value)
    {
        number(
            key, value, [](double) { return true; }, "a number");
    }

    template <typename Accepts>
    void angle(const char* key, Angle& value, Accepts accepts, const char* what)
    {
        double degrees = 0.0;
        if (has(key)) {
            number(key, degrees, accepts, what);
            value = Angle::degrees(degrees);
        }
    }

    void index(const char* key, std::optional<std::size_t>& value, std::size_t count)
    {
        if (has(key)) {
            const Json& member = json_[key];
            if (member.is_number_unsigned() && member.get<std::size_t>() < count) {
                value = member.get<std::size_t>();
            } else {
                refuse(key, "the index of a layer");
            }
        }
    }

    void count(const char* key, int& value)
    {
        if (has(key)) {
            const Json& member = json_[key];
            constexpr int kMost = std::numeric_limits<int>::max();
            if (member.is_number_unsigned() && member.get<std::uint64_t>() >= 1 &&
                member.get<std::uint64_t>() <= std::uint64_t{kMost}) {
                value = member.get<int>();
            } else {
                refuse(key, "a whole number from 1 up");
            }
        }
    }

    template <typename Names, typename Value>
    void choice(const char* key, const Names& names, Value& value)
    {
        std::string name = nameIn(names, value);
        text(key, name);
        const auto* const found = std::find_if(
            names.begin(), names.end(), [&name](const auto& entry) { return name == entry.name; });
        if (found == names.end()) {
            refuse(key, "a known choice");
        } else {
            value = found->value;
        }
    }

    void terms(const char* key, std::optional<GeoTransform::Terms>& value)
    {
        if (!has(key)) {
            return;
        }
        const Json& member = json_[key];
        GeoTransform::Terms terms{};
        if (!member.is_array() || member.size() != terms.size()) {
            refuse(key, "a list of six numbers");
            return;
        }
        for (std::size_t i = 0; i < terms.size(); ++i) {
            const auto term = numberIn(member[i]);
            if (!term) {
                refuse(key, "a list of six numbers");
                return;
            }
            terms[i] = *term;
        }
        value = terms;
    }

    /// Calls `read(element, place)` for each element of a list of at most `count_max`.
    template <typename Read>
    void list(const char* key, std::size_t count_max, const char* what, Read read)
    {
        if (!has(key)) {
            return;
        }
        const Json& member = json_[key];
        if (!member.is_array() || member.size() > count_max) {
            refuse(key, what);
            return;
        }
        for (std::size_t i = 0; i < member.size(); ++i) {
            read(member[i], fmt::format("{}[{}]", placeOf(key), i));
        }
    }

    template <typename Read>
    void object(const char* key, Read read)
    {
        if (has(key)) {
            Members members(json_[key], placeOf(key), fault_);
            read(members);
        }
    }

    void refuse(const char* key, const char* what)
    {
        if (fault_.empty()) {
            fault_ = fmt::format("{} is not {}", placeOf(key), what);
        }
    }

private:
    static std::optional<double> numberIn(const Json& json)
    {
        if (json.is_number()) {
            return json.get<double>();
        }
        if (json == "nan") {
            return std::numeric_limits<double>::quiet_NaN();
        }
        if (json == "inf" || json == "-inf") {
            const double infinity = std::numeric_limits<double>::infinity();
            return json == "inf" ? infinity : -infinity;
        }
        return std::nullopt;
    }

    std::string placeOf(const char* key) const
    {
        return *key == '\0' ? place_ : place_.empty() ? key : place_ + "." + key;
    }

    const Json& json_;
    std::string place_;
    std::string& fault_;
};

} // namespace marsview
