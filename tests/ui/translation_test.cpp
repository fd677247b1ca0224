// Every text that users read must pass through translation: a test translator marks the texts that
// it receives, and unmarked texts were not passed to it.

#include "tests/support/shared_data.h"
#include "tests/ui/pseudo_translator.h"
#include "tests/ui/test_map.h"
#include "tests/ui/widget_walk.h"
#include "ui/canvas/terrain_view.h"
#include "ui/commands/stretch_control.h"
#include "ui/dialogs/about_dialog.h"
#include "ui/dialogs/address_dialog.h"
#include "ui/dialogs/go_to_dialog.h"
#include "ui/dialogs/light_popup.h"
#include "ui/dialogs/preferences_dialog.h"
#include "ui/dialogs/save_picture_dialog.h"
#include "ui/dialogs/stretch_dialog.h"
#include "ui/panels/georeferencing_panel.h"
#include "ui/panels/haptics_panel.h"
#include "ui/panels/layer_model.h"
#include "ui/panels/layers_panel.h"
#include "ui/text/language.h"
#include "ui/window/keys_dialog.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"

#include <QApplication>
#include <QDialogButtonBox>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QMap>
#include <QMenuBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollArea>
#include <QSet>
#include <QTest>
#include <QTranslator>
#include <QXmlStreamReader>

#include <gtest/gtest.h>

namespace marsview {
namespace {

class MarkingTranslator final : public QTranslator {
public:
    struct Lookup {
        QByteArray context;
        QByteArray text;
        QByteArray comment;
        int number = -1;
    };

    bool isEmpty() const override { return false; }
    QString
    translate(const char* context, const char* text, const char* comment, int number) const override
    {
        if (!QByteArrayView(context).startsWith('Q')) { // Qt's own come with their translations
            lookups_.insert(
                QByteArray(context) + '\n' + text,
                {.context = context, .text = text, .comment = comment, .number = number});
        }
        return QStringLiteral("⟦%1⟧").arg(QString::fromUtf8(text));
    }
    /// What was asked for in the program's own contexts.
    QList<Lookup> lookups() const { return lookups_.values(); }

private:
    mutable QMap<QByteArray, Lookup> lookups_;
};

// The text outside all marks.
QString unmarked(const QString& text)
{
    QString rest;
    int depth = 0;
    for (const QChar c : text) {
        if (c == QChar(0x27E6)) {
            ++depth;
        } else if (c == QChar(0x27E7)) {
            --depth;
        } else if (depth == 0) {
            rest += c;
        }
    }
    return rest;
}

// Texts that are the same in every language: numbers and units, names of files, systems, bodies and
// formats, versions and drivers, examples of coordinates and addresses, the core's sentences about
// a map.
bool isUniversal(const QString& text, const QStringList& names)
{
    static const QRegularExpression kNumbers(
        QStringLiteral("^[^\\p{L}]*(?:(?:m|km|ft|US survey ft|px|e)[^\\p{L}]*)*$"));
    static const QRegularExpression kExample(QStringLiteral("^[0-9.,°′″ NE W]+$"));
    static const QRegularExpression kAddress(QStringLiteral("^https://example\\.org/\\S+$"));
    return kNumbers.match(text).hasMatch() || kExample.match(text).hasMatch() ||
           kAddress.match(text).hasMatch() || names.contains(text);
}

class TranslationTest : public testing::Test {
protected:
    void SetUp() override
    {
        ASSERT_TRUE(QCoreApplication::installTranslator(&translator_));
        window_ = std::make_unique<MainWindow>(testWindowOptions());
        window_->resize(1280, 800);
        window_->show();
        mars_ = maps_.mars();
        moon_ = maps_.moon();
        hill_ = maps_.hill();
        // What a layer is called if its file is open twice.
        const QFileInfo hill(hill_);
        names_ = {QStringLiteral("%1 (%2)").arg(hill.fileName(), hill.dir().dirName()),
                  mars_,
                  moon_,
                  hill_,
                  QStringLiteral("mars.vrt"),
                  QStringLiteral("moon.vrt"),
                  QStringLiteral("hill.asc"),
                  QStringLiteral("VRT"),
                  QStringLiteral("AAIGrid")};
        for (const Language& language : languages()) {
            names_.append(language.name); // in that language
        }
        for (const Body& body : knownBodies()) {
            names_.append(
                QString::fromUtf8(body.name.data(), static_cast<qsizetype>(body.name.size())));
        }
        window_->controller().open({hill_, moon_, mars_});
        EXPECT_TRUE(waitUntilSettled(*window_));
        for (const Layer& layer : window_->session().layers) {
            const RasterInfo& info = layer.map->info();
            if (info.crs) {
                names_.append(QString::fromStdString(info.crs->name()));
                names_.append(QString::fromStdString(info.crs->wkt()));
            }
            names_.append(QString::fromStdString(info.vertical_datum));
            for (const std::string& notice : info.notices) {
                QString sentence = QString::fromStdString(notice);
                names_.append(QStringLiteral("• ") + sentence);
                sentence[0] = sentence[0].toUpper();
                names_.append(sentence);
                names_.append(QStringLiteral("• ") + sentence);
            }
        }
    }
    void TearDown() override
    {
        window_.reset();
        QCoreApplication::removeTranslator(&translator_);
        expectInGerman();
    }

    // Everything that the test looked up.
    void expectInGerman() const
    {
        QTranslator german;
        if (!german.load(QStringLiteral(":/translations/marsview_de.qm"))) {
            return; // built without Qt's LinguistTools
        }
        for (const MarkingTranslator::Lookup& lookup : translator_.lookups()) {
            EXPECT_FALSE(german
                             .translate(lookup.context.constData(), lookup.text.constData(),
                                        lookup.comment.constData(), lookup.number)
                             .isEmpty())
                << lookup.context.toStdString() << ": " << lookup.text.toStdString();
        }
        EXPECT_GT(translator_.lookups().size(), 100);
    }

    void expectMarked(const QWidget& root)
    {
        int count = 0;
        for (const FoundText& found : textsOf(root)) {
            for (const QString& line : unmarked(found.text).split(QLatin1Char('\n'))) {
                EXPECT_TRUE(isUniversal(line.trimmed(), names_))
                    << describe(root).toStdString() << ", " << found.place.toStdString() << ": "
                    << found.text.toStdString();
            }
            count += unmarked(found.text) != found.text ? 1 : 0;
        }
        EXPECT_GT(count, 3) << describe(root).toStdString(); // the walk found any texts at all
    }

    MarkingTranslator translator_;
    TestMaps maps_;
    QString mars_;
    QString moon_;
    QString hill_;
    QStringList names_;
    std::unique_ptr<MainWindow> window_;
};

TEST_F(TranslationTest, ReachesEveryTextOfTheWindow)
{
    expectMarked(*window_);
    // The other states of the panels.
    for (std::size_t i = 0; i < window_->session().layers.size(); ++i) {
        window_->controller().activate(window_->session().layers[i].id);
        expectMarked(*window_);
    }
    window_->georeferencingPanel()->edit();
    expectMarked(*window_);
    const LayerModel& model = *window_->datasetPanel()->model();
    int reasons = 0;
    for (int row = 0; row < model.rowCount(); ++row) {
        reasons += model.index(row).data(LayerModel::ReasonRole).toString().isEmpty() ? 0 : 1;
        const QString reason = model.index(row).data(LayerModel::ReasonRole).toString();
        EXPECT_EQ(unmarked(reason), QString()) << reason.toStdString();
    }
    EXPECT_EQ(reasons, 2);
    EXPECT_TRUE(window_->undoStack().undoText().startsWith(QChar(0x27E6)));
}

TEST_F(TranslationTest, ReachesTheStatusBarWhilePointingAndLoading)
{
    QTest::mouseMove(window_->view(), window_->view()->rect().center());
    window_->open(hill_);
    QTest::qWait(50);
    expectMarked(*window_);
    ASSERT_TRUE(waitUntilSettled(*window_));
}

TEST_F(TranslationTest, ReachesEveryDialog)
{
    AboutDialog about(QString(), window_.get());
    names_ += {QCoreApplication::applicationVersion(), QString::fromLatin1(qVersion())};
    expectMarked(about);
    const KeysDialog keys(*window_->menuBar(), window_.get());
    for (const QLabel* label : keys.findChildren<QLabel*>()) {
        if (label->font().bold()) {
            names_.append(unmarked(label->text())); // the keys, as Qt names them
        }
    }
    expectMarked(keys);
    expectMarked(AddressDialog({}, window_.get()));
    expectMarked(PreferencesDialog({}, {}, window_.get()));
    expectMarked(LightPopup(window_.get()));
    expectMarked(SavePictureDialog({800, 600}, {}, window_.get()));
    window_->actionSet().edit_stretch->trigger();
    expectMarked(*window_->stretch().dialog());
    window_->stretch().dialog()->close();
    GoToDialog go_to({window_->view()->map()}, {}, {}, {}, window_.get());
    expectMarked(go_to);
    go_to.findChild<QLineEdit*>(QStringLiteral("coordinate"))->setText(QStringLiteral("15, 15"));
    expectMarked(go_to);
    go_to.findChild<QLineEdit*>(QStringLiteral("coordinate"))->setText(QStringLiteral("-50, 15"));
    expectMarked(go_to);
}

// The English texts that have another wording in German.
QSet<QString> translatedTexts()
{
    QFile file(QString::fromStdString(
        (test::sourceRoot() / "resources/translations/marsview_de.ts").string()));
    EXPECT_TRUE(file.open(QIODevice::ReadOnly));
    QXmlStreamReader xml(&file);
    QSet<QString> texts;
    QString source;
    while (!xml.atEnd()) {
        if (xml.readNext() != QXmlStreamReader::StartElement) {
            continue;
        }
        if (xml.name() == QLatin1String("source")) {
            source = xml.readElementText();
        } else if (xml.name() == QLatin1String("translation")) {
            const bool is_finished = !xml.attributes().hasAttribute(QLatin1String("type"));
            const QString text = xml.readElementText(QXmlStreamReader::IncludeChildElements);
            // Letters may be keys as well as directions.
            const bool is_letter = source.trimmed().size() == 1;
            if (is_finished && !is_letter && text.trimmed() != source.trimmed()) {
                texts.insert(source);
            }
        }
    }
    return texts;
}

class GermanTest : public testing::Test {
protected:
    void SetUp() override
    {
        if (languages().size() == 1) {
            GTEST_SKIP() << "built without Qt's LinguistTools";
        }
        translators_ = translateTo(QStringLiteral("de"));
        english_ = translatedTexts();
        ASSERT_GT(english_.size(), 500);
    }

    // A text that is found in English was looked up in a context that has no translation of it.
    void expectGerman(const QWidget& root) const
    {
        for (const FoundText& found : textsOf(root)) {
            EXPECT_FALSE(english_.contains(found.text))
                << describe(root).toStdString() << ", " << found.place.toStdString() << ": "
                << found.text.toStdString();
        }
    }

    std::vector<std::unique_ptr<QTranslator>> translators_;
    QSet<QString> english_;
};

TEST_F(GermanTest, ReachesTheWindowAndItsDialogs)
{
    const TestMaps maps;
    MainWindow window(testWindowOptions());
    window.resize(1280, 800);
    window.show();
    window.controller().open({maps.hill(), maps.mars()});
    ASSERT_TRUE(waitUntilSettled(window));
    EXPECT_EQ(window.menuBar()->actions().front()->text(), QStringLiteral("&Datei"));
    expectGerman(window);
    EXPECT_EQ(sharedLetters(*window.menuBar()).join(QStringLiteral(", ")).toStdString(), "");
    for (const auto* area : window.georeferencingPanel()->findChildren<QScrollArea*>()) {
        if (area->isVisible()) {
            EXPECT_LE(area->widget()->minimumSizeHint().width(), area->viewport()->width());
        }
    }
    window.docks()->reveal(*window.docks()->haptics());
    QScrollArea* haptics = window.hapticsPanel()->findChild<QScrollArea*>();
    ASSERT_TRUE(QTest::qWaitFor([haptics] { return haptics->isVisible(); }));
    EXPECT_LE(haptics->widget()->minimumSizeHint().width(), haptics->viewport()->width());
    window.georeferencingPanel()->edit();
    expectGerman(window);
    expectGerman(AboutDialog(QString(), &window));
    expectGerman(AddressDialog({}, &window));
    expectGerman(KeysDialog(*window.menuBar(), &window));
    expectGerman(PreferencesDialog({}, {}, &window));
    expectGerman(SavePictureDialog({800, 600}, {}, &window));
    expectGerman(GoToDialog({window.view()->map()}, {}, {}, {}, &window));
}

// 2026-11: the hint told users to choose keys.
TEST_F(GermanTest, NamesToolsAsTheirButtonsDoAndDefaultsAsDefaults)
{
    const QString touch = QCoreApplication::translate("Tool", "&Touch").remove(QLatin1Char('&'));
    const QString hint = QCoreApplication::translate(
        "marsview::GestureHint", "Choose Touch (T) and drag to feel the terrain");
    EXPECT_TRUE(hint.contains(QStringLiteral("„%1“").arg(touch))) << qPrintable(hint);
    const PreferencesDialog preferences({}, {}, nullptr);
    const auto* buttons = preferences.findChild<QDialogButtonBox*>();
    EXPECT_EQ(buttons->button(QDialogButtonBox::RestoreDefaults)->text(),
              QStringLiteral("Stan&dardwerte wiederherstellen"));
}

// In a language with longer words and in one that is read from right to left.
TEST(PseudoTranslation, KeepsTheWindowAndItsDialogsOnASmallScreen)
{
    PseudoTranslator translator;
    ASSERT_TRUE(QCoreApplication::installTranslator(&translator));
    for (const Qt::LayoutDirection direction : {Qt::LeftToRight, Qt::RightToLeft}) {
        QGuiApplication::setLayoutDirection(direction);
        const TestMaps maps;
        MainWindow window(testWindowOptions());
        window.resize(1280, 800);
        window.show();
        window.controller().open({maps.hill(), maps.mars()});
        ASSERT_TRUE(waitUntilSettled(window));
        EXPECT_LE(window.width(), 1280);
        EXPECT_LE(window.height(), 800);
        const auto expect_small = [](QWidget&& dialog) {
            dialog.ensurePolished();
            EXPECT_LE(dialog.sizeHint().width(), 1280) << describe(dialog).toStdString();
            EXPECT_LE(dialog.sizeHint().height(), 760) << describe(dialog).toStdString();
        };
        expect_small(AboutDialog(QString(), &window));
        expect_small(AddressDialog({}, &window));
        expect_small(PreferencesDialog({}, {}, &window));
        expect_small(SavePictureDialog({800, 600}, {}, &window));
        expect_small(GoToDialog({window.view()->map()}, {}, {}, {}, &window));
    }
    QGuiApplication::setLayoutDirection(Qt::LeftToRight);
    QCoreApplication::removeTranslator(&translator);
}

} // namespace
} // namespace marsview
