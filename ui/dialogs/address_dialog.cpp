#include "ui/dialogs/address_dialog.h"

#include "core/files/file_address.h"
#include "core/files/remote_raster.h"
#include "ui/text/sentence.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QUrl>
#include <QVBoxLayout>

namespace marsview {
namespace {

constexpr int kWidth = 520; // pixels: most of an address can be read

// "/vsizip/maps.zip/dem.tif", "NETCDF:maps.nc:z".
bool isNameForGdal(const QString& text)
{
    static const QRegularExpression name(
        QStringLiteral("^(/vsi(zip|tar|gzip)/|[A-Z][A-Z0-9_]+:)."));
    return name.match(text).hasMatch();
}

} // namespace

QString problemOfAddress(const QString& address)
{
    if (isNameForGdal(address)) {
        return {};
    }
    const QUrl url(address, QUrl::StrictMode);
    if (address.startsWith(QStringLiteral("file:/"), Qt::CaseInsensitive)) {
        const Result<std::string> path = localPathOf(address.toStdString());
        return path ? QString() : asSentence(path.error().message);
    }
    if (!remoteNameFor(address.toStdString()) || !address.contains(QStringLiteral("://"))) {
        return AddressDialog::tr(
            "An address begins with https://, http://, s3://, gs:// or file://. Names of GDAL, "
            "such as /vsizip/maps.zip/dem.tif, can be opened, too.");
    }
    if (!url.isValid() || url.host().isEmpty()) {
        return AddressDialog::tr(
            "Not an address: the name of the server is missing, or it contains a character that "
            "addresses cannot have.");
    }
    if (url.path().size() < 2 || url.path().endsWith(QLatin1Char('/'))) {
        return AddressDialog::tr("The address names a server or a folder; name a file there.");
    }
    return {};
}

AddressDialog::AddressDialog(const QStringList& history, QWidget* parent)
    : QDialog(parent)
    , field_(new QComboBox(this))
    , answer_(new QLabel(this))
{
    setWindowTitle(tr("Open Address"));
    field_->setEditable(true);
    field_->setInsertPolicy(QComboBox::NoInsert);
    field_->addItems(history);
    field_->setCurrentIndex(-1);
    field_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    field_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    field_->setAccessibleName(tr("Address"));
    field_->setObjectName(QStringLiteral("address"));
    // An example is the same in every language.
    field_->lineEdit()->setPlaceholderText(QStringLiteral("https://example.org/Mars_200m.tif"));
    field_->lineEdit()->setClearButtonEnabled(true);
    field_->lineEdit()->setAccessibleName(tr("Address"));
    auto* about = new QLabel(
        tr("A cloud-optimized GeoTIFF is read in pieces: only the tiles shown or touched are "
           "downloaded, and kept on disk for later."),
        this);
    about->setWordWrap(true);
    answer_->setAccessibleName(tr("Whether this address can be opened"));
    answer_->setObjectName(QStringLiteral("answer"));
    answer_->setWordWrap(true);
    answer_->setMinimumHeight(2 * fontMetrics().lineSpacing()); // no jumps while typing
    answer_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    auto* form = new QFormLayout;
    form->addRow(tr("&Address"), field_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    open_button_ = buttons->addButton(tr("&Open"), QDialogButtonBox::AcceptRole);
    open_button_->setDefault(true);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(about);
    layout->addLayout(form);
    layout->addWidget(answer_);
    layout->addStretch(1);
    layout->addWidget(buttons);
    resize(kWidth, sizeHint().height());
    connect(field_, &QComboBox::editTextChanged, this, &AddressDialog::check);
    connect(buttons, &QDialogButtonBox::accepted, this, &AddressDialog::choose);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    field_->setFocus();
    check();
}

void AddressDialog::check()
{
    const QString address = field_->currentText().trimmed();
    const QString problem = address.isEmpty() ? QString() : problemOfAddress(address);
    answer_->setText(problem);
    open_button_->setEnabled(!address.isEmpty() && problem.isEmpty());
}

void AddressDialog::choose()
{
    const QString address = field_->currentText().trimmed();
    if (!address.isEmpty() && problemOfAddress(address).isEmpty()) {
        const Result<std::string> path = localPathOf(address.toStdString());
        Q_EMIT addressChosen(path ? QString::fromStdString(*path) : address);
        accept();
    }
}

} // namespace marsview
