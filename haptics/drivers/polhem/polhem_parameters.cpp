#include "haptics/drivers/polhem/polhem_parameters.h"

#include "core/base/bounded_text.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace marsview {
namespace {

using Json = nlohmann::json;

struct Range {
    double low;
    double high;
};

constexpr Range kLengthM{1e-4, 2.0};
constexpr Range kSomewhereM{-2.0, 2.0};
constexpr Range kCounts{1.0, 1e7};
constexpr Range kTorqueConstant{1e-4, 10.0};
constexpr Range kCurrentA{0.01, 20.0};
constexpr Range kForceN{0.0, 100.0};
constexpr Range kStiffness{0.0, 1e5};
constexpr Range kInt16{std::numeric_limits<std::int16_t>::min(),
                       std::numeric_limits<std::int16_t>::max()};
constexpr Range kSignedCounts{-1e7, 1e7};

// Reads numbers from the file and keeps the first error.
class Reader {
public:
    explicit Reader(const Json& json)
        : json_(json)
    {}

    double number(const char* name, Range range)
    {
        const auto found = json_.find(name);
        return found == json_.end() ? complain(name, "is missing") : checked(name, *found, range);
    }

    template <typename T, std::size_t N>
    void numbers(const char* name, Range range, std::array<T, N>& values)
    {
        const auto found = json_.find(name);
        if (found == json_.end() || !found->is_array() || found->size() != N) {
            complain(name, fmt::format("is not an array of {} numbers", N));
            return;
        }
        for (std::size_t i = 0; i < N; ++i) {
            values[i] = static_cast<T>(checked(name, (*found)[i], range));
        }
    }

    double complain(const char* name, const std::string& what)
    {
        if (!complaint_) {
            complaint_ = fmt::format("\"{}\" {}", name, what);
        }
        return 0.0;
    }

    const std::optional<std::string>& complaint() const { return complaint_; }

private:
    double checked(const char* name, const Json& value, Range range)
    {
        if (!value.is_number()) {
            return complain(name, "holds " + value.dump() + ", which is not a number");
        }
        const auto number = value.get<double>();
        if (!(number >= range.low && number <= range.high)) {
            return complain(name, fmt::format("holds {}, which is outside [{}, {}]", number,
                                              range.low, range.high));
        }
        return number;
    }

    const Json& json_;
    std::optional<std::string> complaint_;
};

} // namespace

Result<PolhemParameters> readPolhemParameters(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    if (!stream) {
        return Error{ErrorCode::NotFound,
                     fmt::format("{}: the device's parameters cannot be read; copy and edit "
                                 "polhem-v1.json, which comes with the program",
                                 file.string())};
    }
    const Result<std::string> text = readBoundedText(
        stream, file.string(), {.bytes_max = 1U << 20U, .line_bytes_max = 1U << 20U});
    if (!text) {
        return text.error();
    }
    const Json json = Json::parse(*text, nullptr, false, true);
    if (!json.is_object()) {
        return Error{ErrorCode::Invalid, fmt::format("{}: is not a JSON object", file.string())};
    }
    Reader read(json);
    PolhemParameters p;
    p.name = json.value("name", "WoodenHaptics arm");
    read.numbers("capstan_diameter_m", kLengthM, p.capstan_diameter_m);
    read.numbers("body_diameter_m", kLengthM, p.body_diameter_m);
    read.numbers("body_length_m", kLengthM, p.body_length_m);
    read.numbers("encoder_counts_per_turn", kCounts, p.encoder_counts_per_turn);
    read.numbers("angle_sign", {-1.0, 1.0}, p.angle_sign);
    for (const double sign : p.angle_sign) {
        if (std::abs(sign) != 1.0) {
            read.complain("angle_sign", "holds values other than 1 and −1");
        }
    }
    read.numbers("torque_constant_nm_per_a", kTorqueConstant, p.torque_constant_nm_per_a);
    p.current_a_max = read.number("current_a_max", kCurrentA);
    read.numbers("origin_m", kSomewhereM, p.origin_m);
    p.workspace_radius_m = read.number("workspace_radius_m", {0.01, 2.0});
    p.force_n_peak = read.number("force_n_peak", kForceN);
    p.force_n_continuous = read.number("force_n_continuous", {0.0, p.force_n_peak});
    p.stiffness_n_per_m_max = read.number("stiffness_n_per_m_max", kStiffness);
    read.numbers("home_encoders", kInt16, p.home_encoders);
    p.twist_counts_per_turn = read.number("twist_counts_per_turn", kSignedCounts);
    if (read.complaint()) {
        return Error{ErrorCode::Invalid, fmt::format("{}: {}", file.string(), *read.complaint())};
    }
    return p;
}

} // namespace marsview
