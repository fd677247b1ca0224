#include "ui/panels/loop_times.h"

#include "ui/panels/time_plot.h"
#include "ui/text/haptics_text.h"
#include "ui/text/number_text.h"
#include "ui/widgets/caption.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace marsview {
namespace {

constexpr int kIntervalMs = 250; // what an eye follows

QString timesText(const TimeHistogram& times)
{
    //: Durations: the median, the 99.9th percentile, the longest
    QString text = LoopTimes::tr("median %1 · 99.9 % %2 · longest %3")
                       .arg(spanText(times.quantile(0.5)), spanText(times.quantile(0.999)),
                            spanText(times.maximum()));
    // Lines break between the three, not before a unit.
    return text.replace(QLatin1Char(' '), QChar(QChar::Nbsp))
        .replace(QStringLiteral("\u00a0·\u00a0"), QStringLiteral(" · "));
}

} // namespace

LoopTimes::LoopTimes(QWidget* parent)
    : QWidget(parent)
{
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    update_ = makeLine(*layout, tr("Update time"));
    lateness_ = makeLine(*layout, tr("Late wake-up"));
    missed_ = new QLabel(this);
    missed_->setAccessibleName(tr("Missed deadlines"));
    real_time_ = new QLabel(this);
    real_time_->setAccessibleName(tr("Real-time scheduling"));
    real_time_->setObjectName(QStringLiteral("realTime"));
    for (QLabel* label : {missed_, real_time_}) {
        label->setWordWrap(true);
        layout->addWidget(label);
    }
}

LoopTimes::Line LoopTimes::makeLine(QBoxLayout& layout, const QString& name)
{
    const QString tip = tr(
        "Since the connection: the median, the 99.9th percentile and the longest. The plot shows "
        "the last half minute from 1 µs to 10 ms: the median, and paler the longest.");
    const Line line{.text = new QLabel(this), .plot = new TimePlot(this)};
    line.text->setWordWrap(true);
    line.text->setFont(captionFont(line.text->font()));
    line.text->setToolTip(tip);
    line.text->setObjectName(QStringLiteral("times"));
    line.plot->setAccessibleName(name);
    line.plot->setToolTip(tip);
    layout.addWidget(makeCaption(name, this));
    layout.addWidget(line.text);
    layout.addWidget(line.plot);
    return line;
}

bool LoopTimes::isDue() const
{
    return !since_shown_.isValid() || since_shown_.hasExpired(kIntervalMs);
}

void LoopTimes::showLoop(const LoopStatistics& now, const RealTimeGrants& grants)
{
    since_shown_.start();
    if (now.tick.count() == 0) {
        return;
    }
    const bool is_same_run = now.tick.count() >= last_.tick.count();
    const LoopStatistics last = is_same_run ? last_ : LoopStatistics{};
    const TimeHistogram ticks = now.tick.since(last.tick);
    const TimeHistogram late = now.lateness.since(last.lateness);
    if (ticks.count() > 0) {
        update_.plot->add({.usual = ticks.quantile(0.5), .longest = ticks.maximum()});
        lateness_.plot->add({.usual = late.quantile(0.5), .longest = late.maximum()});
    }
    last_ = now;
    update_.text->setText(timesText(now.tick));
    lateness_.text->setText(timesText(now.lateness));
    const auto missed = static_cast<std::size_t>(now.missed_by_tick + now.missed_by_waking);
    //: %1 and %2 are numbers
    missed_->setText(
        tr("%1 of %2 deadlines missed")
            .arg(countText(missed), countText(static_cast<std::size_t>(now.tick.count()))));
    missed_->show();
    real_time_->setText(realTimeText(grants));
    real_time_->show();
}

void LoopTimes::clear()
{
    update_.text->clear();
    lateness_.text->clear();
    update_.plot->clear();
    lateness_.plot->clear();
    missed_->hide();
    real_time_->hide();
    last_ = {};
}

} // namespace marsview
