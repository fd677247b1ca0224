#include "ui/panels/attitudes_view.h"

#include "core/session/measurement_tables.h"
#include "ui/controllers/measure_controller.h"
#include "ui/panels/save_chart_dialog.h"
#include "ui/plots/stereonet_plot.h"
#include "ui/text/attitude_text.h"
#include "ui/text/measure_text.h"

#include <QComboBox>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSaveFile>
#include <QVBoxLayout>

#include <utility>

namespace marsview {

AttitudesView::AttitudesView(MeasureController& controller, QWidget* parent)
    : QWidget(parent)
    , controller_(controller)
    , plot_(new StereonetPlot(this))
    , statistics_(new QLabel(this))
{
    statistics_->setWordWrap(true);
    statistics_->setObjectName(QStringLiteral("orientationStatistics"));
    statistics_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* diagram = new QComboBox(this);
    diagram->setAccessibleName(tr("Diagram of attitudes"));
    diagram->addItems({tr("Stereonet"), tr("Rose Diagram")});
    connect(diagram, &QComboBox::activated, plot_, [this](int index) {
        plot_->setDiagram(index == 0 ? StereonetPlot::Diagram::Stereonet
                                     : StereonetPlot::Diagram::Rose);
    });
    auto* save = new QPushButton(tr("Save &Attitudes…"), this);
    save->setObjectName(QStringLiteral("saveAttitudes"));
    save->setToolTip(tr("Save all attitudes as CSV, or the diagram as PNG, SVG or PDF"));
    connect(save, &QPushButton::clicked, this, &AttitudesView::askFile);
    connect(plot_, &StereonetPlot::planeChosen, &controller_, &MeasureController::select);
    auto* side = new QVBoxLayout;
    side->addWidget(diagram, 0, Qt::AlignLeading);
    side->addWidget(statistics_);
    side->addStretch(1);
    side->addWidget(save, 0, Qt::AlignLeading);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(plot_, 1);
    layout->addLayout(side, 1);
}

void AttitudesView::showItems()
{
    std::vector<NetPlane> planes;
    const MeasureState& state = controller_.state();
    for (const MeasureItem& item : state.items) {
        if (const auto* attitude = controller_.outcome(item.id).as<Attitude>()) {
            planes.push_back({.id = item.id,
                              .name = item.name,
                              .plane = orientationOf(*attitude),
                              .ellipse = poleEllipse(*attitude)});
        }
    }
    plot_->setPlanes(std::move(planes), state.current);
    statistics_->setText(statisticsText());
}

QString AttitudesView::statisticsText() const
{
    const auto& known = plot_->statistics();
    if (!known) {
        return {};
    }
    if (known->count < 2) {
        return tr("Further attitudes are added to this diagram, with their mean.");
    }
    return orientationLines(*known).join(QLatin1Char('\n'));
}

void AttitudesView::askFile()
{
    askChartFile(*this, {.title = tr("Save Attitudes"), .name = tr("attitudes"), .folder = folder_},
                 [this](const QString& path) {
                     folder_ = QFileInfo(path).absolutePath();
                     if (save(path)) {
                         Q_EMIT saved(path);
                     } else {
                         Q_EMIT failed(tr("Cannot Save Attitudes"), notWrittenText(path));
                     }
                 });
}

bool AttitudesView::save(const QString& path) const
{
    if (QFileInfo(path).suffix().toLower() != QStringLiteral("csv")) {
        return plot_->savePicture(path);
    }
    QSaveFile file(path);
    const std::string text = attitudesCsv(controller_.named());
    return file.open(QIODevice::WriteOnly) &&
           file.write(text.data(), static_cast<qint64>(text.size())) >= 0 && file.commit();
}

} // namespace marsview
