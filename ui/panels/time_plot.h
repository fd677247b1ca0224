// How long something took of late, as a line.
#pragma once

#include <QWidget>

#include <chrono>
#include <deque>
#include <optional>

namespace marsview {

/// Spans of some moments, the latest at the trailing end: for each the usual and the longest one,
/// between 1 µs and 10 ms on a logarithmic scale with a line for each factor of ten.
class TimePlot final : public QWidget {
    Q_OBJECT

public:
    struct Moment {
        std::chrono::nanoseconds usual{0};
        std::chrono::nanoseconds longest{0};
    };
    static constexpr std::size_t kMomentsMax = 120;

    explicit TimePlot(QWidget* parent = nullptr);

    void add(const Moment& moment);
    void clear();
    const std::deque<Moment>& moments() const noexcept { return moments_; }

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return {60, sizeHint().height()}; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    std::deque<Moment> moments_;
};

} // namespace marsview
