#include "ui/dialogs/about_dialog.h"

#include "core/raster/raster_file.h"

#include <QCoreApplication>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace marsview {

AboutDialog::AboutDialog(const QString& graphics, QWidget* parent)
    : QDialog(parent)
{
    setWindowTitle(tr("About MarsView"));
    auto* title = new QLabel(tr("MarsView"), this);
    QFont font = title->font();
    font.setPointSizeF(font.pointSizeF() * 1.6);
    title->setFont(font);
    auto* text = new QLabel(tr("Explore very large topographic maps by sight and by touch."), this);
    text->setWordWrap(true);
    auto* facts = new QFormLayout;
    facts->setHorizontalSpacing(16);
    const auto add = [this, facts](const QString& name, const QString& value) {
        auto* label = new QLabel(value, this);
        label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
        label->setAccessibleName(name);
        label->setWordWrap(true);
        facts->addRow(name, label);
    };
    add(tr("Version"), QCoreApplication::applicationVersion());
    add(tr("GDAL"), QString::fromStdString(gdalVersion()));
    add(tr("Qt"), QString::fromLatin1(qVersion()));
    add(tr("OpenGL"), graphics.isEmpty() ? tr("none") : graphics);
    add(tr("Licence"), tr("MIT; the file LICENSE tells its terms"));
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* layout = new QVBoxLayout(this);
    layout->setSpacing(12);
    layout->addWidget(title);
    layout->addWidget(text);
    layout->addLayout(facts);
    layout->addStretch(1);
    layout->addWidget(buttons);
    resize(420, sizeHint().height());
}

} // namespace marsview
