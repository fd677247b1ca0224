#include "ui/text/number_text.h"

#include <QGuiApplication>
#include <QLocale>

#include <gtest/gtest.h>

#include <limits>

namespace marsview {
namespace {

TEST(NumberText, HasTrueMinusSignsAndNoMinusZero)
{
    EXPECT_EQ(numberText(-12.5, 1), QStringLiteral("−12.5"));
    EXPECT_EQ(numberText(-0.04, 1), QStringLiteral("0.0"));
    EXPECT_EQ(numberText(-0.06, 1), QStringLiteral("−0.1"));
    EXPECT_EQ(shortNumberText(-32768.0, 9), QStringLiteral("−32768"));
    EXPECT_EQ(shortNumberText(-1e-12, 3), QStringLiteral("−1e−12"));
    EXPECT_EQ(withMinusSigns(QStringLiteral("a-b -5")), QStringLiteral("a-b −5"));
}

TEST(NumberText, GroupsAsTheLocaleDoes)
{
    QLocale::setDefault(QLocale(QLocale::English));
    EXPECT_EQ(significantNumberText(342'711.0, 3), QStringLiteral("343,000"));
    EXPECT_EQ(significantNumberText(-99'960.0, 3), QStringLiteral("−100,000"));
    EXPECT_EQ(significantNumberText(58.127, 3), QStringLiteral("58.1"));
    EXPECT_EQ(significantNumberText(0.01234, 3), QStringLiteral("0.0123"));
    EXPECT_EQ(countText(8192), QStringLiteral("8,192"));
    EXPECT_EQ(heightRangeText({.minimum_m = -8201.4, .maximum_m = 21241.3}, HeightUnit::Meters),
              QStringLiteral("−8,201 … 21,241 m"));
    QLocale::setDefault(QLocale::c());
}

TEST(NumberText, StaysInItsOrderInLayoutsFromRightToLeft)
{
    QGuiApplication::setLayoutDirection(Qt::RightToLeft);
    EXPECT_EQ(numberText(-12.5, 1), QStringLiteral("\u2066−12.5\u2069"));
    EXPECT_EQ(withUnit(QStringLiteral("12"), QStringLiteral("m")),
              QStringLiteral("\u206612 m\u2069"));
    EXPECT_TRUE(heightRangeText({.minimum_m = -1.0, .maximum_m = 1.0}, HeightUnit::Meters)
                    .startsWith(QChar(0x2066)));
    EXPECT_EQ(isolated(QStringLiteral("mars.tif")), QStringLiteral("\u2068mars.tif\u2069"));
    QLocale::setDefault(QLocale(QLocale::Hebrew));
    EXPECT_TRUE(numberText(-5.0, 0).contains(QChar(0x2212)));
    EXPECT_FALSE(numberText(-5.0, 0).contains(QLatin1Char('-')));
    QLocale::setDefault(QLocale::c());
    QGuiApplication::setLayoutDirection(Qt::LeftToRight);
    EXPECT_EQ(isolated(QStringLiteral("mars.tif")), QStringLiteral("mars.tif"));
    // A name in Arabic letters would reverse the English sentence around it.
    EXPECT_EQ(isolated(QStringLiteral("\u0645\u0631.tif")),
              QStringLiteral("\u2068\u0645\u0631.tif\u2069"));
}

TEST(NumberText, WritesHeightsInFeet)
{
    EXPECT_EQ(heightRangeText({.minimum_m = 0.0, .maximum_m = 304.8}, HeightUnit::Feet),
              QStringLiteral("0 … 1000 ft"));
    EXPECT_EQ(heightRangeText({.minimum_m = 0.25, .maximum_m = 0.75}, HeightUnit::Meters),
              QStringLiteral("0.250 … 0.750 m"));
}

TEST(SampleText, WritesIntegersInFullAndFloatsAsTheyAreMeant)
{
    const auto lowest = static_cast<double>(std::numeric_limits<float>::lowest());
    EXPECT_EQ(sampleText(-32767.0), QStringLiteral("−32767"));
    EXPECT_EQ(sampleText(static_cast<double>(-1e34F)), QStringLiteral("−1e+34"));
    EXPECT_EQ(sampleText(lowest), QStringLiteral("−3.4028235e+38"));
    EXPECT_EQ(sampleText(0.1), QStringLiteral("0.1"));
    EXPECT_EQ(sampleText(static_cast<double>(0.1F)), QStringLiteral("0.1"));
}

} // namespace
} // namespace marsview
