// A language for tests: readable English, but longer and with letters that English lacks.
#pragma once

#include <QString>
#include <QTranslator>

#include <cstddef>
#include <string_view>

namespace marsview {

/// "&Open…" becomes "[&Öþéñ… ~~]": accented, in brackets that show where a text is cut off, and a
/// third longer, as texts in other languages often are. Arguments, mnemonics and the patterns of
/// file dialogs are kept.
class PseudoTranslator final : public QTranslator {
public:
    bool isEmpty() const override { return false; }
    QString translate(const char*, const char* text, const char*, int) const override
    {
        const QString plain = QString::fromUtf8(text);
        QString longer = QStringLiteral("[");
        for (qsizetype i = 0; i < plain.size(); ++i) {
            const bool is_argument = i > 0 && plain[i - 1] == QLatin1Char('%');
            const std::size_t at = is_argument ? kPlain.npos : kPlain.find(plain[i].toLatin1());
            longer += at == kPlain.npos ? plain[i] : kAccented[static_cast<qsizetype>(at)];
        }
        longer += QLatin1Char(' ');
        longer += QString(plain.size() / 3, QLatin1Char('~'));
        return plain.contains(QStringLiteral("(*")) ? plain : longer + QLatin1Char(']');
    }

private:
    static constexpr std::string_view kPlain = "aeiouncsyzAEIOUNCSYZ";
    const QString kAccented = QStringLiteral("áéíöüñçšýžÁÉÍÖÜÑÇŠÝŽ");
};

} // namespace marsview
