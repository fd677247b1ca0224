#include "ui/dialogs/about_dialog.h"

#include "core/files/gdal_drivers.h"
#include "ui/widgets/icons.h"

#include <QCoreApplication>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace marsview {
namespace {

constexpr int kAboutIconSide = 96; // points

} // namespace

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
    add(tr("License"),
        tr("MIT License; with QCustomPlot, which draws its diagrams, this program is "
           "distributed under the GNU General Public License, version 3"));
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* layout = new QVBoxLayout(this);
    layout->setSpacing(12);
    auto* icon = new QLabel(this);
    icon->setObjectName(QStringLiteral("programIcon"));
    icon->setPixmap(
        programIcon().pixmap(QSize(kAboutIconSide, kAboutIconSide), devicePixelRatioF()));
    icon->setAccessibleName(tr("Icon of the program"));
    auto* name = new QVBoxLayout;
    name->setSpacing(4);
    name->addStretch(1);
    name->addWidget(title);
    name->addWidget(text);
    name->addStretch(1);
    auto* head = new QHBoxLayout;
    head->setSpacing(16);
    head->addWidget(icon);
    head->addLayout(name, 1);
    layout->addLayout(head);
    layout->addLayout(facts);
    layout->addStretch(1);
    layout->addWidget(buttons);
    resize(420, sizeHint().height());
}

} // namespace marsview
