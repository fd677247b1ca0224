#include "ui/dialogs/save_picture_dialog.h"

#include "ui/text/number_text.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>

namespace marsview {
namespace {

constexpr int kSideMin = 16;
constexpr int kCustom = 0; // in place of a factor

} // namespace

SavePictureDialog::SavePictureDialog(QSize view_size, const PictureLimits& limits, QWidget* parent)
    : QDialog(parent)
    , view_size_(view_size)
    , limits_(limits)
    , sizes_(new QComboBox(this))
    , width_(new QSpinBox(this))
    , height_(new QSpinBox(this))
    //: In a picture that is saved
    , legend_(new QCheckBox(tr("&Legend"), this))
    //: In a picture that is saved
    , scale_(new QCheckBox(tr("&Compass and scale bar"), this))
    //: In a picture that is saved: names of places, graticule, measurements
    , labels_(new QCheckBox(tr("L&abels and lines on the map"), this))
    , note_(new QLabel(this))
{
    setWindowTitle(tr("Save Picture"));
    for (const int factor : {1, 2, 4}) {
        const QSize size = view_size * factor;
        const QString pixels = leftToRight(
            //: Size of a picture: width and height in pixels
            tr("%1 × %2").arg(numberText(size.width(), 0), numberText(size.height(), 0)));
        sizes_->addItem(factor == 1
                            //: Size of a picture; %1 are its pixels, such as 1,280 × 800
                            ? tr("As in the window (%1)").arg(pixels)
                            //: Size of a picture; %1 are its pixels, %2 is 2 or 4
                            : tr("%2 times the window (%1)").arg(pixels).arg(factor),
                        factor);
    }
    //: Size of a picture: it is typed
    sizes_->addItem(tr("Custom"), kCustom);
    sizes_->setAccessibleName(tr("Picture size"));
    for (QSpinBox* box : {width_, height_}) {
        box->setRange(kSideMin, limits_.side_max);
        //: Pixels, after a number
        box->setSuffix(tr(" px"));
        box->setGroupSeparatorShown(true);
    }
    width_->setObjectName(QStringLiteral("width"));
    width_->setAccessibleName(tr("Width in pixels"));
    height_->setObjectName(QStringLiteral("height"));
    height_->setAccessibleName(tr("Height in pixels"));
    legend_->setObjectName(QStringLiteral("legend"));
    legend_->setChecked(true);
    scale_->setObjectName(QStringLiteral("scale"));
    scale_->setChecked(true);
    labels_->setObjectName(QStringLiteral("labels"));
    labels_->setChecked(true);
    note_->setWordWrap(true);

    auto* form = new QFormLayout;
    form->addRow(tr("&Size"), sizes_);
    form->addRow(tr("&Width"), width_);
    form->addRow(tr("&Height"), height_);
    form->addRow(tr("Include"), legend_);
    form->addRow(QString(), scale_);
    form->addRow(QString(), labels_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    //: On a button: choose a file for the picture
    save_ = buttons->addButton(tr("Sa&ve As…"), QDialogButtonBox::AcceptRole);
    save_->setDefault(true);
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(form);
    layout->addWidget(note_);
    layout->addWidget(buttons);
    layout->setSizeConstraint(QLayout::SetFixedSize);

    connect(buttons, &QDialogButtonBox::accepted, this, &SavePictureDialog::fileRequested);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(sizes_, &QComboBox::currentIndexChanged, this, &SavePictureDialog::showSize);
    for (QSpinBox* box : {width_, height_}) {
        connect(box, &QSpinBox::valueChanged, this, [this] {
            const QSignalBlocker blocker(sizes_);
            const int known = sizes_->findData(width_->value() == view_size_.width() &&
                                                       height_->value() == view_size_.height()
                                                   ? 1
                                                   : kCustom);
            sizes_->setCurrentIndex(known);
            note_->setText(problem());
            save_->setEnabled(problem().isEmpty());
        });
    }
    showSize();
}

void SavePictureDialog::showSize()
{
    const int factor = sizes_->currentData().toInt();
    if (factor != kCustom) {
        const QSignalBlocker width_blocker(width_);
        const QSignalBlocker height_blocker(height_);
        width_->setValue(view_size_.width() * factor);
        height_->setValue(view_size_.height() * factor);
    }
    note_->setText(problem());
    save_->setEnabled(problem().isEmpty());
}

QString SavePictureDialog::problem() const
{
    const int factor = sizes_->currentData().toInt();
    const QSize size = factor != kCustom ? view_size_ * factor : choice().size;
    if (std::max(size.width(), size.height()) > limits_.side_max) {
        return tr("The graphics driver draws at most %1 pixels per side.")
            .arg(countText(static_cast<std::size_t>(limits_.side_max)));
    }
    if (static_cast<qint64>(size.width()) * size.height() > limits_.pixel_count_max) {
        return tr("Choose at most %1 million pixels.")
            .arg(countText(static_cast<std::size_t>(limits_.pixel_count_max / 1'000'000)));
    }
    return {};
}

PictureChoice SavePictureDialog::choice() const
{
    return {.size = {width_->value(), height_->value()},
            .has_legend = legend_->isChecked(),
            .has_scale = scale_->isChecked(),
            .has_labels = labels_->isChecked()};
}

} // namespace marsview
