#include "core/view/color_ramp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <set>
#include <string>

namespace marsview {
namespace {

using Triple = std::array<double, 3>;
using Matrix3 = std::array<Triple, 3>;

// Colors as seen without one type of cones.
//
// Viénot, Brettel & Mollon, "Digital video colourmaps for checking the legibility of displays by
// dichromats", 1999, for long and middle cones: colors collapse along the axis of the missing cone
// onto the plane of black, white and blue. Brettel, Viénot & Mollon, "Computerized simulation of
// color appearance for dichromats", 1997, for short cones: onto two half planes through white and
// the lights of 485 nm and of 660 nm. Cones are those of Smith & Pokorny, 1975, colors those of IEC
// 61966-2-1 (sRGB), the two lights those of the CIE 1931 observer.
class ColorVision {
public:
    enum Missing { Long = 0, Middle = 1, Short = 2 };

    explicit ColorVision(Missing missing)
        : missing_(missing)
    {
        const Triple white = conesFromXyz(xyzFromRgb({1.0, 1.0, 1.0}));
        const Triple blue = conesFromXyz(xyzFromRgb({0.0, 0.0, 1.0}));
        const Triple cyan_light = conesFromXyz({0.05795, 0.1693, 0.6162});
        const Triple red_light = conesFromXyz({0.1649, 0.0610, 0.0});
        plane_[0] = crossed(white, missing == Short ? cyan_light : blue);
        plane_[1] = crossed(white, missing == Short ? red_light : blue);
        side_ = crossed(white, {0.0, 0.0, 1.0});
        if (product(side_, red_light) < 0.0) {
            side_ = {-side_[0], -side_[1], -side_[2]};
        }
    }

    Rgb8 seen(Rgb8 color) const
    {
        Triple cones =
            conesFromXyz(xyzFromRgb({linear(color.red), linear(color.green), linear(color.blue)}));
        const Triple& plane = plane_[product(side_, cones) >= 0.0 ? 1 : 0];
        double others = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            others += i != missing_ ? plane[i] * cones[i] : 0.0;
        }
        cones[missing_] = -others / plane[missing_];
        const Triple rgb = solved(kXyzFromRgb, solved(kConesFromXyz, cones));
        return {component(rgb[0]), component(rgb[1]), component(rgb[2])};
    }

private:
    static constexpr Matrix3 kXyzFromRgb{
        {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};
    static constexpr Matrix3 kConesFromXyz{
        {{0.15514, 0.54312, -0.03286}, {-0.15514, 0.45684, 0.03286}, {0.0, 0.0, 0.01608}}};

    static double product(const Triple& a, const Triple& b)
    {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    static Triple crossed(const Triple& a, const Triple& b)
    {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    static Triple times(const Matrix3& m, const Triple& v)
    {
        return {product(m[0], v), product(m[1], v), product(m[2], v)};
    }
    static Triple xyzFromRgb(const Triple& rgb) { return times(kXyzFromRgb, rgb); }
    static Triple conesFromXyz(const Triple& xyz) { return times(kConesFromXyz, xyz); }
    // Cramer's rule.
    static Triple solved(const Matrix3& m, const Triple& v)
    {
        const double determinant = product(m[0], crossed(m[1], m[2]));
        Triple x{};
        for (std::size_t i = 0; i < 3; ++i) {
            Matrix3 replaced = m;
            for (std::size_t row = 0; row < 3; ++row) {
                replaced[row][i] = v[row];
            }
            x[i] = product(replaced[0], crossed(replaced[1], replaced[2])) / determinant;
        }
        return x;
    }
    static double linear(std::uint8_t byte)
    {
        const double c = byte / 255.0;
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    }
    static std::uint8_t component(double value)
    {
        const double v = std::clamp(value, 0.0, 1.0);
        const double c = v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
        return static_cast<std::uint8_t>(std::lround(c * 255.0));
    }

    std::size_t missing_;
    std::array<Triple, 2> plane_{};
    Triple side_{};
};

double difference(Rgb8 a, Rgb8 b)
{
    const Oklab x = oklabFrom(a);
    const Oklab y = oklabFrom(b);
    return std::hypot(x.l - y.l, x.a - y.a, x.b - y.b);
}

// The smallest color differences on a ramp, for one type of color vision.
struct Distinctness {
    double neighbors = 1e9; // a twelfth of the ramp apart
    double others = 1e9;    // an eighth or more apart
};

template <typename See>
Distinctness distinctness(const ColorRamp& ramp, const See& see)
{
    auto colors = sampledRamp(ramp);
    std::transform(colors.begin(), colors.end(), colors.begin(), see);
    Distinctness least;
    for (std::size_t i = 0; i < 256; ++i) {
        if (i + 21 < 256) {
            least.neighbors = std::min(least.neighbors, difference(colors[i], colors[i + 21]));
        }
        for (std::size_t k = i + 32; k < 256; ++k) {
            least.others = std::min(least.others, difference(colors[i], colors[k]));
        }
    }
    return least;
}

constexpr std::array<const char*, 3> kMissing{"protanopia", "deuteranopia", "tritanopia"};

// The largest deviation of lightness from a straight line between two positions of the ramp.
double unevenness(const std::array<Rgb8, 256>& colors, std::size_t first, std::size_t last)
{
    const double low = lightness(colors[first]);
    const double high = lightness(colors[last]);
    double worst = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
        const double even =
            low + (high - low) * static_cast<double>(i - first) / static_cast<double>(last - first);
        worst = std::max(worst, std::abs(lightness(colors[i]) - even));
    }
    return worst;
}

TEST(ColorRamp, LightnessRisesEvenlyIfDeclaredEven)
{
    constexpr double kBound = 0.01;
    for (const ColorRamp& ramp : colorRamps()) {
        const auto colors = sampledRamp(ramp);
        const double whole = unevenness(colors, 0, 255);
        const double halves = std::max(unevenness(colors, 0, 127), unevenness(colors, 128, 255));
        std::cout << ramp.name << ": deviates by " << whole << ", halves by " << halves << '\n';
        switch (ramp.evenness) {
        case RampEvenness::Even:
            EXPECT_LT(whole, kBound) << ramp.name;
            EXPECT_GT(lightness(colors.back()) - lightness(colors.front()), 0.4) << ramp.name;
            break;
        case RampEvenness::EvenToSides:
            EXPECT_LT(halves, kBound) << ramp.name;
            EXPECT_GT(lightness(colors[127]) - lightness(colors.front()), 0.4) << ramp.name;
            EXPECT_NEAR(lightness(colors.front()), lightness(colors.back()), kBound) << ramp.name;
            break;
        case RampEvenness::Uneven:
            EXPECT_GT(whole, kBound) << ramp.name << " is better than declared";
            break;
        }
    }
}

// Lightness increases steadily, except for rounding to bytes.
TEST(ColorRamp, LightnessNeverFallsIfEven)
{
    for (const ColorRamp& ramp : colorRamps()) {
        if (ramp.evenness == RampEvenness::Even) {
            const auto colors = sampledRamp(ramp);
            for (std::size_t i = 3; i < colors.size(); ++i) {
                EXPECT_GT(lightness(colors[i]), lightness(colors[i - 3])) << ramp.name << i;
            }
        }
    }
}

// For even ramps, steps of a seventeenth are between 0.8 and 1.25 times their mean in Oklab.
TEST(ColorRamp, StepsLookEquallyLargeIfEven)
{
    for (const ColorRamp& ramp : colorRamps()) {
        if (ramp.evenness != RampEvenness::Even) {
            continue;
        }
        const auto colors = sampledRamp(ramp);
        double sum = 0.0;
        double least = 1e9;
        double most = 0.0;
        for (std::size_t i = 0; i < 255; i += 15) {
            const double step = difference(colors[i], colors[i + 15]);
            sum += step;
            least = std::min(least, step);
            most = std::max(most, step);
        }
        EXPECT_GT(least, 0.8 * sum / 17.0) << ramp.name;
        EXPECT_LT(most, 1.25 * sum / 17.0) << ramp.name;
    }
}

TEST(ColorRamp, IsDistinctForColorBlindPeopleIfDeclaredSo)
{
    constexpr double kNeighbors = 0.02;
    constexpr double kOthers = 0.035;
    for (const ColorRamp& ramp : colorRamps()) {
        bool is_distinct = true;
        for (const auto missing : {ColorVision::Long, ColorVision::Middle, ColorVision::Short}) {
            const ColorVision vision(missing);
            const Distinctness least =
                distinctness(ramp, [&](Rgb8 color) { return vision.seen(color); });
            std::cout << ramp.name << ", " << kMissing[missing] << ": neighbours "
                      << least.neighbors << ", others " << least.others << '\n';
            is_distinct = is_distinct && least.neighbors > kNeighbors && least.others > kOthers;
        }
        EXPECT_EQ(is_distinct, ramp.is_color_blind_safe) << ramp.name;
    }
}

TEST(ColorVision, KeepsGraysAndConfusesRedWithGreen)
{
    for (const auto missing : {ColorVision::Long, ColorVision::Middle, ColorVision::Short}) {
        const ColorVision vision(missing);
        EXPECT_LT(difference(vision.seen({128, 128, 128}), {128, 128, 128}), 0.005);
    }
    const Rgb8 red{170, 90, 60};
    const Rgb8 green{115, 115, 60};
    EXPECT_GT(difference(red, green), 0.1);
    EXPECT_LT(difference(ColorVision(ColorVision::Middle).seen(red),
                         ColorVision(ColorVision::Middle).seen(green)),
              0.05);
}

TEST(ColorRamp, StartsAndEndsWithItsStops)
{
    for (const ColorRamp& ramp : colorRamps()) {
        const auto colors = sampledRamp(ramp);
        EXPECT_EQ(colors.front(), ramp.stops.front().color) << ramp.name;
        EXPECT_EQ(colors.back(), ramp.stops.back().color) << ramp.name;
        EXPECT_TRUE(std::is_sorted(
            ramp.stops.begin(), ramp.stops.end(),
            [](const ColorStop& a, const ColorStop& b) { return a.position < b.position; }));
    }
}

TEST(ColorRamp, IsFoundByName)
{
    std::set<std::string_view> names;
    for (const ColorRamp& ramp : colorRamps()) {
        EXPECT_EQ(colorRampNamed(ramp.name), &ramp);
        names.insert(ramp.name);
    }
    EXPECT_EQ(names.size(), colorRamps().size());
    EXPECT_EQ(colorRampNamed("none such"), nullptr);
    EXPECT_EQ(defaultColorRamp("Mars").name, "rust");
    EXPECT_EQ(defaultColorRamp("Moon").name, "grey");
    EXPECT_EQ(defaultColorRamp("").name, "dawn");
}

TEST(ColorRamp, IsEvenAndSafeByDefault)
{
    for (const std::string_view body : {"Mars", "Moon", "Earth", ""}) {
        const ColorRamp& ramp = defaultColorRamp(body);
        EXPECT_EQ(ramp.evenness, RampEvenness::Even);
        EXPECT_TRUE(ramp.is_color_blind_safe);
    }
}

TEST(TintedRange, PutsTheDatumInTheMiddleOfACenteredRamp)
{
    const HeightRange mars{.minimum_m = -8068.0, .maximum_m = 21171.0};
    const HeightRange centered = tintedRange(*colorRampNamed("datum"), mars);
    EXPECT_EQ(centered.minimum_m, -21171.0);
    EXPECT_EQ(centered.maximum_m, 21171.0);
    const HeightRange plain = tintedRange(*colorRampNamed("dawn"), mars);
    EXPECT_EQ(plain.minimum_m, mars.minimum_m);
    EXPECT_EQ(plain.maximum_m, mars.maximum_m);
}

} // namespace
} // namespace marsview
