#include "ui/text/place_name_text.h"

#include <QLocale>

#include <gtest/gtest.h>

namespace marsview {
namespace {

QString sizeAt(double diameter_m)
{
    return placeDetailText({.name = "Somewhere", .diameter_m = diameter_m});
}

TEST(PlaceNameText, SizesAreMetersTenthsOrWholeKilometersNeverPowersOfTen)
{
    QLocale::setDefault(QLocale(QLocale::English));
    EXPECT_EQ(sizeAt(840.0), QStringLiteral("840 m"));
    EXPECT_EQ(sizeAt(4260.0), QStringLiteral("4.3 km"));
    EXPECT_EQ(sizeAt(610130.0), QStringLiteral("610 km"));
    EXPECT_EQ(sizeAt(1911330.0), QStringLiteral("1,911 km"));
    EXPECT_EQ(sizeAt(0.0), QString());
    QLocale::setDefault(QLocale::c());
}

} // namespace
} // namespace marsview
