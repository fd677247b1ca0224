#include "core/names/search_text.h"

#include "core/base/check.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <unicode/translit.h>
#include <unicode/unistr.h>

namespace marsview {
namespace {

// Other scripts in Latin letters, without marks; then letters such as "ø" and "ł", which are not
// made of a letter and a mark.
constexpr const char* kRules =
    "Any-Latin; NFD; [:Nonspacing Mark:] Remove; NFC; Latin-ASCII; Lower";

bool isAscii(std::string_view text)
{
    return std::all_of(text.begin(), text.end(),
                       [](char byte) { return static_cast<unsigned char>(byte) < 0x80; });
}

// ICU's transliterators are for one thread at a time, and slow to make.
std::string inLatinLetters(std::string_view text)
{
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    static const std::unique_ptr<icu::Transliterator> kTransliterator = [] {
        UErrorCode failure = U_ZERO_ERROR;
        std::unique_ptr<icu::Transliterator> made(
            icu::Transliterator::createInstance(kRules, UTRANS_FORWARD, failure));
        MARSVIEW_CHECK(U_SUCCESS(failure) && made);
        return made;
    }();
    auto letters = icu::UnicodeString::fromUTF8(
        icu::StringPiece(text.data(), static_cast<std::int32_t>(text.size())));
    kTransliterator->transliterate(letters);
    std::string result;
    letters.toUTF8String(result);
    return result;
}

char lower(char letter)
{
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

bool isGap(char letter)
{
    return letter == ' ' || letter == '\t' || letter == '-' || letter == '\'';
}

} // namespace

std::string searchText(std::string_view text)
{
    const std::string letters = isAscii(text) ? std::string(text) : inLatinLetters(text);
    std::string result;
    for (const char letter : letters) {
        if (!isGap(letter)) {
            result += lower(letter);
        } else if (!result.empty() && result.back() != ' ') {
            result += ' ';
        }
    }
    if (!result.empty() && result.back() == ' ') {
        result.pop_back();
    }
    return result;
}

} // namespace marsview
