#include "core/formats/odl_label.h"

#include "core/files/gdal_file.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <memory>

namespace marsview {
namespace {

constexpr std::size_t kLabelBytesMax = std::size_t{1} << 20;
constexpr int kDepthMax = 32;

std::string upperCase(std::string_view text)
{
    std::string upper(text);
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return upper;
}

bool isSpace(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && isSpace(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && isSpace(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

std::string unquoted(std::string_view text)
{
    text = trimmed(text);
    if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'') &&
        text.back() == text.front()) {
        text = trimmed(text.substr(1, text.size() - 2));
    }
    return std::string(text);
}

class Parser {
public:
    explicit Parser(std::string_view text)
        : text_(text)
    {}

    OdlStatement parse()
    {
        OdlStatement root;
        root.is_group = true;
        readInto(root, 0);
        return root;
    }

private:
    bool atEnd() const { return at_ >= text_.size() || text_[at_] == '\0'; }
    char here() const { return text_[at_]; }
    bool follows(std::string_view word) const { return text_.substr(at_).starts_with(word); }

    void skipLine()
    {
        while (!atEnd() && here() != '\n') {
            ++at_;
        }
    }

    void skipSpace()
    {
        while (!atEnd()) {
            if (isSpace(here())) {
                ++at_;
            } else if (follows("/*")) {
                const std::size_t end = text_.find("*/", at_ + 2);
                at_ = end == std::string_view::npos ? text_.size() : end + 2;
            } else if (here() == '#') { // a comment of ISIS 3
                skipLine();
            } else {
                return;
            }
        }
    }

    std::string_view name()
    {
        const std::size_t begin = at_;
        while (!atEnd() && !isSpace(here()) && here() != '=' && here() != ';') {
            ++at_;
        }
        return text_.substr(begin, at_ - begin);
    }

    // From an opening bracket to the one that closes it, quoted parts skipped.
    void skipList()
    {
        int depth = 0;
        char quote = '\0';
        for (; !atEnd(); ++at_) {
            const char c = here();
            if (quote != '\0') {
                quote = c == quote ? '\0' : quote;
            } else if (c == '"' || c == '\'') {
                quote = c;
            } else if (c == '(' || c == '{') {
                ++depth;
            } else if ((c == ')' || c == '}') && --depth == 0) {
                ++at_;
                return;
            }
        }
    }

    std::string_view value()
    {
        const std::size_t begin = at_;
        if (here() == '(' || here() == '{') {
            skipList();
        } else if (here() == '"' || here() == '\'') {
            const std::size_t end = text_.find(here(), at_ + 1);
            at_ = end == std::string_view::npos ? text_.size() : end + 1;
        } else {
            while (!atEnd() && !isSpace(here()) && here() != '<' && !follows("/*")) {
                ++at_;
            }
        }
        return text_.substr(begin, at_ - begin);
    }

    std::string unit()
    {
        std::size_t next = at_;
        while (next < text_.size() && (text_[next] == ' ' || text_[next] == '\t')) {
            ++next;
        }
        if (next >= text_.size() || text_[next] != '<') {
            return {};
        }
        const std::size_t end = text_.find('>', next);
        if (end == std::string_view::npos) {
            return {};
        }
        at_ = end + 1;
        return std::string(trimmed(text_.substr(next + 1, end - next - 1)));
    }

    void readInto(OdlStatement& group, int depth)
    {
        for (;;) {
            skipSpace();
            if (atEnd()) {
                return;
            }
            const std::string key = upperCase(name());
            skipSpace();
            const bool has_value = !atEnd() && here() == '=';
            if (key == "END" && !has_value) {
                at_ = text_.size();
                return;
            }
            const bool ends_group = key == "END_OBJECT" || key == "END_GROUP";
            if (!has_value) {
                if (ends_group) {
                    return;
                }
                if (key.empty()) {
                    ++at_; // such as a stray semicolon
                }
                continue;
            }
            ++at_;
            skipSpace();
            if (atEnd()) {
                return;
            }
            OdlStatement statement;
            const std::string_view written = value();
            const bool is_list = written.starts_with('(') || written.starts_with('{');
            statement.value = is_list ? std::string(written) : unquoted(written);
            if (ends_group) {
                return;
            }
            statement.name = key;
            if (key == "OBJECT" || key == "GROUP") {
                statement.is_group = true;
                statement.name = upperCase(statement.value);
                if (depth >= kDepthMax) {
                    return;
                }
                readInto(statement, depth + 1);
            } else {
                statement.unit = unit();
            }
            group.statements.push_back(std::move(statement));
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

} // namespace

std::optional<OdlStatement> parseOdl(std::string_view text)
{
    OdlStatement root = Parser(text.substr(0, kLabelBytesMax)).parse();
    return root.statements.empty() ? std::nullopt : std::optional(std::move(root));
}

std::optional<OdlStatement> readOdlLabel(const std::string& path)
{
    const GdalFile file = openGdalFile(path);
    if (!file) {
        return std::nullopt;
    }
    // Files of samples are not parsed as text.
    constexpr std::size_t kHeadBytes = 4096;
    std::string text(kHeadBytes, '\0');
    text.resize(VSIFReadL(text.data(), 1, text.size(), file.get()));
    const std::string head = upperCase(text);
    const bool is_label =
        head.find("PDS_VERSION_ID") != std::string::npos ||
        head.find("ODL_VERSION_ID") != std::string::npos ||
        head.find("CCSD3ZF") != std::string::npos || head.find("ISISCUBE") != std::string::npos ||
        head.find("^QUBE") != std::string::npos || head.find("^IMAGE") != std::string::npos;
    if (!is_label) {
        return std::nullopt;
    }
    if (text.size() == kHeadBytes) {
        text.resize(kLabelBytesMax);
        text.resize(kHeadBytes + VSIFReadL(text.data() + kHeadBytes, 1, kLabelBytesMax - kHeadBytes,
                                           file.get()));
    }
    return parseOdl(text);
}

const OdlStatement* statementIn(const OdlStatement& group, std::string_view name)
{
    const auto found = std::find_if(group.statements.begin(), group.statements.end(),
                                    [name](const OdlStatement& statement) {
                                        return !statement.is_group && statement.name == name;
                                    });
    return found == group.statements.end() ? nullptr : &*found;
}

const OdlStatement* groupNamed(const OdlStatement& group, std::string_view name)
{
    if (group.is_group && group.name == name) {
        return &group;
    }
    for (const OdlStatement& statement : group.statements) {
        const OdlStatement* const found =
            statement.is_group ? groupNamed(statement, name) : nullptr;
        if (found != nullptr) {
            return found;
        }
    }
    return nullptr;
}

std::vector<std::string> odlItems(const std::string& value)
{
    std::string_view text = trimmed(value);
    if (text.size() < 2 || (text.front() != '(' && text.front() != '{')) {
        return {unquoted(text)};
    }
    text = text.substr(1, text.size() - 2);
    std::vector<std::string> items;
    char quote = '\0';
    std::size_t begin = 0;
    for (std::size_t at = 0; at <= text.size(); ++at) {
        const char c = at < text.size() ? text[at] : ',';
        if (quote != '\0' && at < text.size()) {
            quote = c == quote ? '\0' : quote;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == ',') {
            std::string_view item = text.substr(begin, at - begin);
            item = item.substr(0, item.find('<'));
            items.push_back(unquoted(item));
            begin = at + 1;
        }
    }
    return items;
}

} // namespace marsview
