// Round numbers for scales: 1, 2 and 5 times a power of ten.
#pragma once

#include <vector>

namespace marsview {

/// The largest of the numbers 1, 2, 5 × 10^n that is at most `value`, and the smallest that is at
/// least `value`; a value within a billionth of a round number counts as that number. `value` is
/// positive and finite.
double roundNumberBelow(double value);
double roundNumberAbove(double value);

/// The decimals that show a multiple of a round number: 0 for 20, 1 for 0.5, 2 for 0.01.
int decimalsOf(double round_number);

struct RoundTicks {
    double step = 0.0;          // a round number; 0 without ticks
    std::vector<double> values; // ascending multiples of the step; zero is +0
};

/// All multiples of a round step that lie in [low, high], with the smallest step that gives at most
/// `count_max`. Empty if high exceeds low by less than a trillionth of their size, if they are not
/// finite, and for count_max < 1.
RoundTicks roundTicks(double low, double high, int count_max);

} // namespace marsview
