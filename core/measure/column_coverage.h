// How often a polygon covers a column of grid cells at one row.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace marsview {

/// A step function of the share u across the column, as the sum of weighted pieces. At most a few
/// pieces.
class ColumnCoverage {
public:
    void reset(double weight)
    {
        steps_.clear();
        add(0.0, 1.0, weight);
        normalize();
    }
    void add(double from, double to, double weight)
    {
        if (from < to && weight != 0.0) {
            steps_.push_back({from, weight});
            steps_.push_back({to, -weight});
        }
    }
    /// After additions.
    void normalize()
    {
        std::sort(steps_.begin(), steps_.end(),
                  [](const Step& a, const Step& b) { return a.u < b.u; });
        std::size_t kept = 0;
        for (const Step& step : steps_) {
            constexpr double kSame = 1e-12; // ends of edges, computed from both sides
            if (kept > 0 && step.u - steps_[kept - 1].u <= kSame) {
                steps_[kept - 1].change += step.change;
            } else {
                steps_[kept++] = step;
            }
        }
        steps_.resize(kept);
        std::erase_if(steps_, [](const Step& step) { return step.change == 0.0; });
    }

    bool isEmpty() const { return steps_.empty(); }
    /// The weight, if it is the same everywhere.
    std::optional<double> whole() const
    {
        if (steps_.empty()) {
            return 0.0;
        }
        return steps_.size() == 2 && steps_[0].u <= kEdge && steps_[1].u >= 1.0 - kEdge
                   ? std::optional(steps_[0].change)
                   : std::nullopt;
    }
    double at(double u) const
    {
        double weight = 0.0;
        for (const Step& step : steps_) {
            weight += step.u <= u ? step.change : 0.0;
        }
        return weight;
    }
    template <typename F>
    void forEach(const F& function) const
    {
        double weight = 0.0;
        for (std::size_t i = 0; i + 1 < steps_.size(); ++i) {
            weight += steps_[i].change;
            if (weight != 0.0) {
                function(steps_[i].u, steps_[i + 1].u, weight);
            }
        }
    }

private:
    static constexpr double kEdge = 1e-12;
    struct Step {
        double u;
        double change;
    };
    std::vector<Step> steps_;
};

} // namespace marsview
