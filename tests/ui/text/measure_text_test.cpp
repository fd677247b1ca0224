// Results of measurements as people read them.

#include "ui/text/measure_text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace marsview {
namespace {

QString valueOf(const std::vector<MeasureRow>& rows, const char* label)
{
    const auto row = std::find_if(rows.begin(), rows.end(), [label](const MeasureRow& one) {
        return one.label == QLatin1String(label);
    });
    return row == rows.end() ? QString() : row->value;
}

// A plane that may be level has no strike that could be copied into a report.
TEST(MeasureText, HasNoStrikeWhereAnyIsPossible)
{
    Attitude attitude;
    attitude.strike_deg = 330.0;
    attitude.dip_direction_deg = 60.0;
    attitude.dip_deg = 0.25;
    attitude.points = 4;
    attitude.uncertainty.dip_error_deg = 4.0;
    attitude.uncertainty.strike_error_deg = 180.0;
    const MeasurementResult level{.map = {}, .values = MeasuredValues(attitude)};
    EXPECT_TRUE(measureSummary(level, HeightUnit::Meters).contains(QStringLiteral("–/")))
        << measureSummary(level, HeightUnit::Meters).toStdString();
    for (const char* label : {"Strike (right-hand rule)", "Dip direction"}) {
        EXPECT_EQ(valueOf(measureRows(level, HeightUnit::Meters), label),
                  QStringLiteral("undetermined"));
    }

    attitude.dip_deg = 20.0;
    attitude.uncertainty.strike_error_deg = 12.0;
    EXPECT_TRUE(measureSummary({.map = {}, .values = MeasuredValues(attitude)}, HeightUnit::Meters)
                    .contains(QStringLiteral("330/")));
}

} // namespace
} // namespace marsview
