#include "ui/panels/save_chart_dialog.h"

#include "ui/text/number_text.h"

#include <QCoreApplication>
#include <QFileDialog>

namespace marsview {
namespace {

struct SaveChart {
    Q_DECLARE_TR_FUNCTIONS(SaveChart)
};

} // namespace

void askChartFile(QWidget& parent,
                  const ChartFile& file,
                  const std::function<void(const QString& path)>& save)
{
    auto* dialog = new QFileDialog(&parent, file.title, file.folder);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setNameFilters(
        {SaveChart::tr("CSV table (*.csv)"), SaveChart::tr("PNG picture (*.png)"),
         SaveChart::tr("SVG drawing (*.svg)"), SaveChart::tr("PDF document (*.pdf)")});
    dialog->setDefaultSuffix(QStringLiteral("csv"));
    QObject::connect(dialog, &QFileDialog::filterSelected, dialog, [dialog](const QString& filter) {
        const qsizetype dot = filter.lastIndexOf(QLatin1Char('.'));
        dialog->setDefaultSuffix(filter.mid(dot + 1, 3));
    });
    dialog->selectFile(file.name + QStringLiteral(".csv"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    QObject::connect(dialog, &QFileDialog::fileSelected, &parent, save);
    dialog->open();
}

QString notWrittenText(const QString& path)
{
    return SaveChart::tr("%1 cannot be written; choose another folder").arg(isolated(path));
}

} // namespace marsview
