#include "ui/dialogs/guide_window.h"

#include "core/base/bundled_file.h"

#include <QDesktopServices>
#include <QDialogButtonBox>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QRegularExpression>
#include <QScreen>
#include <QShortcut>
#include <QSplitter>
#include <QTextBrowser>
#include <QTextDocument>
#include <QTextFrame>
#include <QTextTable>
#include <QUrl>
#include <QVBoxLayout>

#include <algorithm>
#include <optional>
#include <utility>

namespace marsview {
namespace {

std::optional<QString> textOf(const QString& path)
{
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) {
        return std::nullopt;
    }
    return QString::fromUtf8(file.readAll());
}

// What people read of Markdown, so that a search does not find addresses and marks.
QString plainText(const QString& markdown)
{
    QTextDocument document;
    document.setMarkdown(markdown);
    return document.toPlainText();
}

// Qt draws the tables of Markdown with double lines and no room around their text.
void drawTablesPlainly(QTextDocument& document, const QPalette& palette)
{
    for (QTextFrame* frame : document.rootFrame()->childFrames()) {
        if (auto* table = qobject_cast<QTextTable*>(frame)) {
            QTextTableFormat format = table->format();
            format.setBorderCollapse(true);
            format.setBorder(1.0);
            format.setBorderBrush(palette.mid());
            format.setCellSpacing(0.0);
            format.setCellPadding(5.0);
            table->setFormat(format);
        }
    }
}

} // namespace

QVector<GuidePage> guidePagesIn(const QString& folder)
{
    const QDir directory(folder);
    const std::optional<QString> contents = textOf(directory.filePath(QStringLiteral("README.md")));
    QVector<GuidePage> pages;
    if (!contents) {
        return pages;
    }
    static const QRegularExpression link(QStringLiteral(R"(\]\(([a-z0-9-]+\.md)\))"));
    static const QRegularExpression heading(QStringLiteral("^# (.+)$"),
                                            QRegularExpression::MultilineOption);
    for (auto matches = link.globalMatch(*contents); matches.hasNext();) {
        const QString name = matches.next().captured(1);
        const std::optional<QString> text = textOf(directory.filePath(name));
        if (text) {
            pages.append({name, heading.match(*text).captured(1), *text});
        }
    }
    return pages;
}

QString guideFolder()
{
    const std::filesystem::path contents = bundledFile("guide/README.md");
    return contents.empty() ? QString() : QString::fromStdString(contents.parent_path().string());
}

GuideWindow::GuideWindow(QVector<GuidePage> pages, QWidget* parent)
    : QDialog(parent)
    , pages_(std::move(pages))
    , search_(new QLineEdit(this))
    , outcome_(new QLabel(this))
    , list_(new QListWidget(this))
    , text_(new QTextBrowser(this))
{
    setWindowTitle(tr("User Guide"));
    setModal(false);
    constexpr QSize kSize{900, 640};
    constexpr double kShareMost = 0.9; // of the screen
    resize(kSize.boundedTo(screen()->availableSize() * kShareMost));
    search_->setPlaceholderText(tr("Search the guide"));
    search_->setAccessibleName(tr("Search the guide"));
    search_->setClearButtonEnabled(true);
    list_->setAccessibleName(tr("Pages"));
    text_->setAccessibleName(tr("Page"));
    text_->setOpenLinks(false);
    text_->document()->setDocumentMargin(16);
    for (const GuidePage& page : std::as_const(pages_)) {
        list_->addItem(page.title);
    }
    auto* split = new QSplitter(this);
    split->addWidget(list_);
    split->addWidget(text_);
    split->setStretchFactor(1, 1);
    split->setSizes({240, 660});
    split->setChildrenCollapsible(false);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    buttons->button(QDialogButtonBox::Close)->setAutoDefault(false);
    auto* line = new QHBoxLayout;
    line->addWidget(search_, 1);
    line->addWidget(outcome_);
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(line);
    layout->addWidget(split, 1);
    layout->addWidget(buttons);

    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(list_, &QListWidget::currentRowChanged, this, &GuideWindow::showPage);
    connect(search_, &QLineEdit::textChanged, this, &GuideWindow::search);
    connect(search_, &QLineEdit::returnPressed, this, &GuideWindow::findNext);
    connect(text_, &QTextBrowser::anchorClicked, this,
            [this](const QUrl& address) { open(address.toString()); });
    auto* find = new QShortcut(QKeySequence::Find, this);
    connect(find, &QShortcut::activated, search_, qOverload<>(&QWidget::setFocus));
    list_->setCurrentRow(0);
}

void GuideWindow::open(const QString& file)
{
    const QUrl address(file);
    const auto page = std::find_if(pages_.cbegin(), pages_.cend(), [&](const GuidePage& candidate) {
        return candidate.file == address.path();
    });
    if (page == pages_.cend()) {
        if (!address.isRelative()) {
            QDesktopServices::openUrl(address);
        }
        return;
    }
    list_->setCurrentRow(static_cast<int>(page - pages_.cbegin()));
    if (address.hasFragment()) {
        text_->scrollToAnchor(address.fragment());
    }
}

void GuideWindow::showPage(int row)
{
    if (row < 0 || row >= pages_.size()) {
        return;
    }
    text_->setMarkdown(pages_[row].text);
    drawTablesPlainly(*text_->document(), palette());
    if (!search_->text().isEmpty()) {
        text_->find(search_->text());
    }
}

// Pages without the text are grayed out; the first one with it is shown.
void GuideWindow::search()
{
    const QString wanted = search_->text();
    int found = 0;
    int first = -1;
    for (int row = 0; row < pages_.size(); ++row) {
        const auto count = static_cast<int>(
            wanted.isEmpty() ? 0 : plainText(pages_[row].text).count(wanted, Qt::CaseInsensitive));
        QListWidgetItem* item = list_->item(row);
        item->setFlags(wanted.isEmpty() || count > 0 ? Qt::ItemIsEnabled | Qt::ItemIsSelectable
                                                     : Qt::NoItemFlags);
        found += count;
        if (count > 0 && (first < 0 || row == list_->currentRow())) {
            first = row;
        }
    }
    if (wanted.isEmpty()) {
        outcome_->clear();
        return;
    }
    //: How often the text that is searched for stands in the guide
    outcome_->setText(found > 0 ? tr("%Ln match(es)", nullptr, found) : tr("Not found"));
    if (first >= 0) {
        list_->setCurrentRow(first);
        showPage(first);
    }
}

void GuideWindow::findNext()
{
    const QString wanted = search_->text();
    if (wanted.isEmpty() || text_->find(wanted)) {
        return;
    }
    for (int step = 1; step <= pages_.size(); ++step) {
        const int row = static_cast<int>((list_->currentRow() + step) % pages_.size());
        if (list_->item(row)->flags() != Qt::NoItemFlags) {
            list_->setCurrentRow(row);
            showPage(row); // from its beginning, even if it is the only page
            return;
        }
    }
}

} // namespace marsview
