// A slider whose upper part has no effect at present.
#pragma once

#include <QSlider>

#include <optional>

namespace marsview {

/// Horizontal. A mark shows the value above which others have no more effect; they can be chosen
/// all the same.
class LimitSlider final : public QSlider {
    Q_OBJECT

public:
    explicit LimitSlider(QWidget* parent = nullptr);

    /// Nothing, or a value at or above the maximum, for no mark.
    void setLimit(std::optional<int> value);
    std::optional<int> limit() const noexcept { return limit_; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    std::optional<int> limit_;
};

} // namespace marsview
