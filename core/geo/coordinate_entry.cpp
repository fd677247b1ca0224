#include "core/geo/coordinate_entry.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace marsview {
namespace {

enum class TokenKind { Number, Letter, Degrees, Minutes, Seconds, Colon, Comma, Semicolon };

struct Token {
    TokenKind kind;
    double value = 0.0; // of a number, without its sign
    bool is_negative = false;
    bool is_whole = true;
    char letter = 0; // N, S, E or W
};

constexpr const char* kExample = "write for example 18.65 N 226.2 E";

// Typographic characters that people and word processors use in place of ASCII.
constexpr std::array<std::pair<std::string_view, std::string_view>, 21> kSigns{{
    {"\u2212", "-"},  // minus
    {"\u2013", "-"},  // en dash
    {"\u00B0", "\1"}, // degree
    {"\u00BA", "\1"}, // masculine ordinal
    {"\u2032", "'"},  {"\u2019", "'"}, {"\u2033", "\""}, {"\u201D", "\""},
    {"''", "\""},     {"\u00A0", " "}, // no-break space
    {"\u2009", " "},                   // thin space
    {"\u202F", " "},                   // narrow no-break space
    {"\u200E", ""},                    // marks and isolates of the writing direction
    {"\u200F", ""},   {"\u061C", ""},  {"\u2066", ""},   {"\u2067", ""},
    {"\u2068", ""},   {"\u2069", ""},  {"\u066B", "."}, // Arabic decimal separator
    {"\u060C", ","},                                    // Arabic comma
}};

std::string inAscii(std::string_view text)
{
    std::string ascii(text);
    const auto replace = [&ascii](std::string_view sign, std::string_view replacement) {
        for (auto at = ascii.find(sign); at != std::string::npos; at = ascii.find(sign, at)) {
            ascii.replace(at, sign.size(), replacement);
            at += replacement.size();
        }
    };
    for (const auto& [sign, replacement] : kSigns) {
        replace(sign, replacement);
    }
    for (char digit = 0; digit < 10; ++digit) {
        const std::string plain(1, static_cast<char>('0' + digit));
        replace(std::string("\xD9") + static_cast<char>(0xA0 + digit), plain); // Arabic
        replace(std::string("\xDB") + static_cast<char>(0xB0 + digit), plain); // Persian
    }
    return ascii;
}

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

std::optional<TokenKind> markOf(char c)
{
    switch (c) {
    case '\1':
        return TokenKind::Degrees;
    case '\'':
        return TokenKind::Minutes;
    case '"':
        return TokenKind::Seconds;
    case ':':
        return TokenKind::Colon;
    case ',':
        return TokenKind::Comma;
    case ';':
        return TokenKind::Semicolon;
    default:
        return std::nullopt;
    }
}

// The number that begins at `text`, and how long it is. With `has_decimal_comma`, a comma between
// digits counts as a decimal point. A length of 0 means that no number was found.
std::pair<Token, std::size_t> numberAt(std::string_view text, bool has_decimal_commas)
{
    std::string plain;
    std::size_t length = 0;
    Token token{TokenKind::Number};
    if (!text.empty() && (text[0] == '-' || text[0] == '+')) {
        token.is_negative = text[0] == '-';
        length = 1;
    }
    bool has_digits = false;
    for (; length < text.size(); ++length) {
        const char c = text[length];
        const bool is_point = c == '.' || (has_decimal_commas && c == ',' && has_digits &&
                                           length + 1 < text.size() && isDigit(text[length + 1]));
        if (is_point && token.is_whole) {
            plain += '.';
            token.is_whole = false;
        } else if (isDigit(c)) {
            plain += c;
            has_digits = true;
        } else {
            break;
        }
    }
    const auto result = std::from_chars(plain.data(), plain.data() + plain.size(), token.value);
    const bool is_number = has_digits && result.ec == std::errc{};
    return {token, is_number ? length : 0};
}

Result<std::vector<Token>> tokensOf(std::string_view ascii, bool has_decimal_commas)
{
    constexpr std::string_view kLetters = "NSEW";
    std::vector<Token> tokens;
    for (std::size_t at = 0; at < ascii.size();) {
        const char c = ascii[at];
        const char upper = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        if (c == ' ' || c == '\t') {
            ++at;
        } else if (const auto mark = markOf(c)) {
            tokens.push_back({*mark});
            ++at;
        } else if (kLetters.find(upper) != std::string_view::npos) {
            tokens.push_back({.kind = TokenKind::Letter, .letter = upper});
            ++at;
        } else {
            const auto [number, length] = numberAt(ascii.substr(at), has_decimal_commas);
            if (length == 0) {
                return Error{ErrorCode::Invalid, fmt::format("\"{}\" is not understood; {}",
                                                             ascii.substr(at), kExample)};
            }
            tokens.push_back(number);
            at += length;
        }
    }
    return tokens;
}

// Whether commas between digits are decimal commas in a text without letters: a semicolon
// separates, or there are two such commas and something else separates. A single comma may be the
// separator, as in "18,226".
bool hasDecimalCommas(std::string_view ascii)
{
    std::size_t commas = 0;
    bool has_separator = false;
    for (std::size_t at = 0; at < ascii.size(); ++at) {
        const bool is_between_digits =
            at > 0 && at + 1 < ascii.size() && isDigit(ascii[at - 1]) && isDigit(ascii[at + 1]);
        commas += ascii[at] == ',' && is_between_digits ? 1U : 0U;
        has_separator = has_separator || ascii[at] == ' ' || ascii[at] == '\t' || ascii[at] == '\1';
    }
    return ascii.find(';') != std::string_view::npos ||
           (commas == 2 && has_separator && ascii.find('.') == std::string_view::npos);
}

bool has(std::span<const Token> tokens, TokenKind kind)
{
    return std::any_of(tokens.begin(), tokens.end(),
                       [kind](const Token& token) { return token.kind == kind; });
}

std::size_t countOf(std::span<const Token> tokens, TokenKind kind)
{
    return static_cast<std::size_t>(std::count_if(
        tokens.begin(), tokens.end(), [kind](const Token& token) { return token.kind == kind; }));
}

// The written angle on one side of the pair.
struct WrittenAngle {
    double degrees = 0.0;
    char letter = 0;
};

Result<WrittenAngle> angleFrom(std::span<const Token> tokens)
{
    const auto invalid = [](const std::string& what) {
        return Error{ErrorCode::Invalid, fmt::format("{}; {}", what, kExample)};
    };
    constexpr std::array kMarks{TokenKind::Degrees, TokenKind::Minutes, TokenKind::Seconds};
    constexpr std::array kParts{1.0, 60.0, 3600.0};
    WrittenAngle angle;
    std::size_t part = 0;
    bool is_negative = false;
    bool is_whole = true;
    bool may_be_marked = false;
    for (const Token& token : tokens) {
        switch (token.kind) {
        case TokenKind::Letter:
            angle.letter = token.letter;
            may_be_marked = false;
            break;
        case TokenKind::Number:
            if (part == kParts.size()) {
                return invalid("an angle has at most degrees, minutes and seconds");
            }
            if (part > 0 && token.is_negative) {
                return invalid("only degrees may have a sign");
            }
            if (part > 0 && !(token.value < 60.0)) {
                return Error{ErrorCode::OutOfRange,
                             fmt::format("{} is too large; minutes and seconds must be below 60",
                                         token.value)};
            }
            if (!is_whole) {
                return invalid("only the last part of an angle may have decimals");
            }
            is_whole = token.is_whole;
            angle.degrees += token.value / kParts[part];
            is_negative = is_negative || token.is_negative;
            ++part;
            may_be_marked = true;
            break;
        case TokenKind::Colon:
            if (!may_be_marked) {
                return invalid("a colon must follow the degrees or the minutes");
            }
            may_be_marked = false;
            break;
        case TokenKind::Degrees:
        case TokenKind::Minutes:
        case TokenKind::Seconds:
            if (!may_be_marked || kMarks[part - 1] != token.kind) {
                return invalid("the degree, minute and second marks are out of order");
            }
            may_be_marked = false;
            break;
        case TokenKind::Comma:
        case TokenKind::Semicolon:
            return invalid("there is more than one comma between latitude and longitude");
        }
    }
    if (part == 0) {
        return invalid("a number is missing");
    }
    if (is_negative && angle.letter != 0) {
        return invalid("a sign and a letter contradict each other");
    }
    if (is_negative) {
        angle.degrees = -angle.degrees;
    }
    return angle;
}

struct Halves {
    std::span<const Token> first;
    std::span<const Token> second;
};

std::span<const Token> withoutSeparators(std::span<const Token> tokens)
{
    const auto is_separator = [](const Token& token) {
        return token.kind == TokenKind::Comma || token.kind == TokenKind::Semicolon;
    };
    while (!tokens.empty() && is_separator(tokens.front())) {
        tokens = tokens.subspan(1);
    }
    while (!tokens.empty() && is_separator(tokens.back())) {
        tokens = tokens.first(tokens.size() - 1);
    }
    return tokens;
}

std::size_t positionOf(std::span<const Token> tokens, TokenKind kind, std::size_t from = 0)
{
    const auto hit = std::find_if(tokens.begin() + static_cast<std::ptrdiff_t>(from), tokens.end(),
                                  [kind](const Token& token) { return token.kind == kind; });
    return static_cast<std::size_t>(hit - tokens.begin());
}

// Where the second coordinate begins: by letters, by the separator, by the second degree mark, or
// in the middle of the numbers.
std::optional<Halves> halved(std::span<const Token> tokens)
{
    const auto at = [tokens](std::size_t index) {
        return Halves{tokens.first(index), withoutSeparators(tokens.subspan(index))};
    };
    if (has(tokens, TokenKind::Letter)) {
        if (countOf(tokens, TokenKind::Letter) != 2) {
            return std::nullopt;
        }
        const std::size_t first = positionOf(tokens, TokenKind::Letter);
        const std::size_t second = positionOf(tokens, TokenKind::Letter, first + 1);
        Halves halves = first == 0 ? at(second) : at(first + 1);
        halves.first = withoutSeparators(halves.first);
        return halves;
    }
    for (const TokenKind separator : {TokenKind::Semicolon, TokenKind::Comma}) {
        if (has(tokens, separator)) {
            return at(positionOf(tokens, separator));
        }
    }
    if (countOf(tokens, TokenKind::Degrees) == 2) {
        const std::size_t first = positionOf(tokens, TokenKind::Degrees);
        return at(positionOf(tokens, TokenKind::Degrees, first + 1) - 1);
    }
    const std::size_t count = countOf(tokens, TokenKind::Number);
    if (count == 0 || count % 2 != 0) {
        return std::nullopt;
    }
    std::size_t index = 0;
    for (std::size_t numbers = 0; numbers <= count / 2; ++index) {
        numbers += tokens[index].kind == TokenKind::Number ? 1U : 0U;
    }
    return at(index - 1);
}

bool isLatitude(char letter)
{
    return letter == 'N' || letter == 'S';
}

} // namespace

Result<WrittenPlace> placeFrom(std::string_view text, BareLongitude bare)
{
    const std::string ascii = inAscii(text);
    const bool has_letters = ascii.find_first_of("NSEWnsew") != std::string::npos;
    const bool has_decimal_commas = has_letters || hasDecimalCommas(ascii);
    Result<std::vector<Token>> tokens = tokensOf(ascii, has_decimal_commas);
    if (!tokens) {
        return std::move(tokens).error();
    }
    const auto halves = halved(*tokens);
    if (!halves) {
        return Error{ErrorCode::Invalid,
                     fmt::format("a latitude and a longitude are needed; {}", kExample)};
    }
    Result<WrittenAngle> first = angleFrom(halves->first);
    if (!first) {
        return std::move(first).error();
    }
    Result<WrittenAngle> second = angleFrom(halves->second);
    if (!second) {
        return std::move(second).error();
    }
    if (first->letter != 0 && isLatitude(first->letter) == isLatitude(second->letter)) {
        return Error{ErrorCode::Invalid, fmt::format("{} and {} are the same direction; {}",
                                                     first->letter, second->letter, kExample)};
    }
    const bool is_longitude_first = first->letter != 0 && !isLatitude(first->letter);
    const WrittenAngle& latitude = is_longitude_first ? *second : *first;
    const WrittenAngle& longitude = is_longitude_first ? *first : *second;
    if (!(std::abs(latitude.degrees) <= 90.0)) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("latitude {} is beyond 90 degrees", latitude.degrees)};
    }
    if (!(std::abs(longitude.degrees) <= 360.0)) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("longitude {} is beyond 360 degrees", longitude.degrees)};
    }
    const bool is_west =
        longitude.letter == 'W' || (longitude.letter == 0 && bare == BareLongitude::West);
    return WrittenPlace{
        .latitude = Angle::degrees(latitude.letter == 'S' ? -latitude.degrees : latitude.degrees),
        .longitude = Angle::degrees(is_west ? -longitude.degrees : longitude.degrees)};
}

Result<MapPoint> mapPointFrom(std::string_view text)
{
    const std::string ascii = inAscii(text);
    Result<std::vector<Token>> tokens = tokensOf(ascii, hasDecimalCommas(ascii));
    if (!tokens) {
        return Error{ErrorCode::Invalid, "enter two numbers, x and then y"};
    }
    std::vector<double> numbers;
    std::size_t separators = 0;
    for (const Token& token : *tokens) {
        if (token.kind == TokenKind::Number) {
            numbers.push_back(token.is_negative ? -token.value : token.value);
        } else if ((token.kind == TokenKind::Comma || token.kind == TokenKind::Semicolon) &&
                   numbers.size() == 1 && separators == 0) {
            ++separators;
        } else {
            return Error{ErrorCode::Invalid, "enter two plain numbers, x and then y"};
        }
    }
    if (numbers.size() != 2) {
        return Error{ErrorCode::Invalid,
                     fmt::format("enter two numbers, x and then y; there "
                                 "{} {}",
                                 numbers.size() == 1 ? "is" : "are", numbers.size())};
    }
    return MapPoint{numbers[0], numbers[1]};
}

} // namespace marsview
