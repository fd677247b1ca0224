#include "app/console/usage.h"

#include "core/base/nearest_word.h"
#include "core/base/plain_number.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace marsview {
namespace {

using Words = std::vector<std::string>;

constexpr std::string_view kSizeType = "WxH";

bool isNumber(std::string_view word)
{
    return parseNumber(word).has_value();
}

// Whether a word is an option rather than a value: "-5" and "-" are values.
bool looksLikeOption(const std::string& word)
{
    return word.size() > 1 && word.front() == '-' && !isNumber(word) &&
           (std::isdigit(static_cast<unsigned char>(word[1])) == 0 && word[1] != '.' &&
            word[1] != ',');
}

// The parts of "1,2 3"; an empty part between two adjacent commas. A comma at the end counts as one
// before the next word.
Words partsOf(const std::string& word)
{
    Words parts{""};
    for (const char c : word) {
        const bool is_blank = c == ' ' || c == '\t';
        if (c == ',' || c == ';') {
            parts.emplace_back();
        } else if (is_blank) {
            if (!parts.back().empty()) {
                parts.emplace_back();
            }
        } else {
            parts.back() += c;
        }
    }
    if (parts.size() > 1 && parts.back().empty()) {
        parts.pop_back();
    }
    return parts;
}

bool areNumbers(const Words& parts)
{
    return std::all_of(parts.begin(), parts.end(), isNumber);
}

bool isWholeNumber(const std::string& word)
{
    return !word.empty() && std::all_of(word.begin(), word.end(),
                                        [](unsigned char c) { return std::isdigit(c) != 0; });
}

class Normalizer {
public:
    Normalizer(const CLI::App& app, const Words& given)
        : command_(&app)
        , given_(given)
    {}

    Result<Words> normalized()
    {
        if (const auto unknown = findCommand()) {
            return *unknown;
        }
        if (const auto asked = helpOrVersion()) {
            words_.push_back(*asked);
            return words_;
        }
        while (at_ < given_.size()) {
            const std::string& word = given_[at_];
            if (word == "--") {
                words_.push_back(word);
                ++at_;
                while (at_ < given_.size()) {
                    if (auto error = takePositional()) {
                        return *error;
                    }
                }
                break;
            }
            if (looksLikeOption(word)) {
                if (auto error = takeOption()) {
                    return *error;
                }
            } else if (auto error = takePositional()) {
                return *error;
            }
        }
        return words_;
    }

    const CLI::App& command() const { return *command_; }

    std::optional<Error> findCommand()
    {
        while (!command_->get_subcommands({}).empty()) {
            Words names;
            for (const CLI::App* known : command_->get_subcommands({})) {
                names.push_back(known->get_name());
            }
            if (at_ == given_.size()) {
                const std::string problem =
                    fmt::format("a command is missing; known ones are {}", fmt::join(names, ", "));
                return command_->get_parent() != nullptr ? usage(command_->get_name(), problem)
                                                         : Error{ErrorCode::Invalid, problem};
            }
            const std::string& word = given_[at_];
            if (looksLikeOption(word)) {
                return isHelpOrVersion(word) ? std::nullopt
                                             : std::optional(optionBeforeCommand(word, names));
            }
            const CLI::App* next = nullptr;
            for (const CLI::App* known : command_->get_subcommands({})) {
                next = known->get_name() == word ? known : next;
            }
            if (next == nullptr) {
                return unknownCommand(word, names);
            }
            words_.push_back(word);
            command_ = next;
            ++at_;
        }
        return std::nullopt;
    }

    // A message about "--output" as one about "-o" if that was typed.
    static std::string
    asTyped(const CLI::App& command, const Words& arguments, const std::string& message)
    {
        const auto is_typed = [&arguments](const std::string& name) {
            return std::any_of(arguments.begin(), arguments.end(), [&](const std::string& word) {
                return word == name || word.starts_with(name + "=") ||
                       (!name.starts_with("--") && word.starts_with(name));
            });
        };
        for (const CLI::Option* option : command.get_options()) {
            for (const std::string& long_name : option->get_lnames()) {
                const std::string name = "--" + long_name;
                if (!message.starts_with(name + ": ") || is_typed(name)) {
                    continue;
                }
                for (const std::string& short_name : option->get_snames()) {
                    if (is_typed("-" + short_name)) {
                        return "-" + short_name + message.substr(name.size());
                    }
                }
            }
        }
        return message;
    }

private:
    Error unknownCommand(const std::string& word, const Words& known) const
    {
        const std::string within = command_->get_parent() != nullptr
                                       ? fmt::format(" of {}", command_->get_name())
                                       : std::string();
        return usage(word,
                     fmt::format("unknown command{}{}", within, didYouMeanOrKnown(word, known)));
    }

    // Options belong behind their command. A wrong command after options without values is what to
    // mend first.
    Error optionBeforeCommand(const std::string& option, const Words& commands) const
    {
        const auto is_flag = [this](const std::string& name) {
            const std::vector<const CLI::App*> known = command_->get_subcommands({});
            return std::any_of(known.begin(), known.end(), [&name](const CLI::App* command) {
                const CLI::Option* of = command->get_option_no_throw(name);
                return of != nullptr && of->get_items_expected_max() == 0;
            });
        };
        std::size_t at = at_;
        while (at < given_.size() && looksLikeOption(given_[at]) && is_flag(given_[at])) {
            ++at;
        }
        if (at == given_.size() || looksLikeOption(given_[at])) {
            return unknownOption(option);
        }
        const std::string& word = given_[at];
        if (std::find(commands.begin(), commands.end(), word) == commands.end()) {
            return at > at_ ? unknownCommand(word, commands) : unknownOption(option);
        }
        return usage(option, fmt::format("belongs after the command: {} {}", word, option));
    }

    static Error usage(const std::string& what, const std::string& why)
    {
        return Error{ErrorCode::Invalid, fmt::format("{}: {}", what, why)};
    }

    static bool isHelpOrVersion(const std::string& word)
    {
        return word == "--help" || word == "-h" || word == "--version";
    }

    // Before "--", after which file names follow.
    std::optional<std::string> helpOrVersion() const
    {
        for (std::size_t i = at_; i < given_.size() && given_[i] != "--"; ++i) {
            if (isHelpOrVersion(given_[i])) {
                return given_[i];
            }
        }
        return std::nullopt;
    }

    Words optionNames() const
    {
        Words names;
        for (const CLI::Option* option : command_->get_options()) {
            for (const std::string& name : option->get_lnames()) {
                names.push_back("--" + name);
            }
            for (const std::string& name : option->get_snames()) {
                names.push_back("-" + name);
            }
        }
        return names;
    }

    const CLI::Option* optionNamed(const std::string& name) const
    {
        for (const CLI::Option* option : command_->get_options()) {
            if (!option->get_positional() && option->check_name(name)) {
                return option;
            }
        }
        return nullptr;
    }

    Error unknownOption(const std::string& name) const
    {
        const std::string of = command_->get_parent() != nullptr
                                   ? fmt::format(" of {}", command_->get_name())
                                   : std::string();
        return usage(name, fmt::format("unknown option{}{}", of, didYouMean(name, optionNames())));
    }

    std::optional<Error> takeOption()
    {
        std::string name = given_[at_++];
        std::optional<std::string> value;
        const bool is_long = name.starts_with("--");
        if (const std::size_t sign = name.find('='); is_long && sign != std::string::npos) {
            value = name.substr(sign + 1);
            name.resize(sign);
        }
        const CLI::Option* option = optionNamed(name);
        constexpr std::size_t kShortLength = 2;
        if (option == nullptr && !is_long && name.size() > kShortLength) {
            option = optionNamed(name.substr(0, kShortLength)); // -oFILE
            if (option != nullptr && option->get_items_expected_max() > 0) {
                value = name.substr(kShortLength);
                name.resize(kShortLength);
            } else {
                option = nullptr;
            }
        }
        if (option == nullptr) {
            return unknownOption(name);
        }
        if (option->get_items_expected_max() == 0) {
            if (value) {
                return usage(name, "takes no value");
            }
            words_.push_back(name);
            return std::nullopt;
        }
        if (option->get_items_expected_max() < kOpenListMin && !taken_.insert(option).second) {
            return usage(name, "given twice");
        }
        if (value) {
            pending_.push_back(*value);
        }
        return takeValues(name, *option);
    }

    // The next word that belongs to an option, or nothing.
    std::optional<std::string> nextValue()
    {
        if (!pending_.empty()) {
            std::string word = std::move(pending_.back());
            pending_.clear();
            return word;
        }
        if (at_ == given_.size() || given_[at_] == "--" || looksLikeOption(given_[at_])) {
            return std::nullopt;
        }
        return given_[at_++];
    }

    std::optional<Error> takeValues(const std::string& name, const CLI::Option& option)
    {
        const int items_min = option.get_items_expected_min();
        const int items_max = option.get_items_expected_max();
        const bool is_size = option.get_type_name() == kSizeType;
        Words values;
        while (true) {
            const bool is_first = values.empty();
            if (!is_first && static_cast<int>(values.size()) >= items_max) {
                break;
            }
            const bool is_needed = static_cast<int>(values.size()) < items_min;
            const std::size_t before = at_;
            const std::optional<std::string> word = nextValue();
            if (!word) {
                break;
            }
            const Words parts = items_max > 1 || is_size ? partsOf(*word) : Words{*word};
            const bool is_list = parts.size() > 1 || areNumbers(parts);
            if (is_size && is_first) {
                values.push_back(sizeFrom(*word, parts));
                break;
            }
            if (!is_needed && !(is_list && areNumbers(parts)) && !isAccepted(option, parts)) {
                at_ = before; // a file, not one more value
                break;
            }
            values.insert(values.end(), parts.begin(), parts.end());
        }
        if (std::any_of(values.begin(), values.end(),
                        [](const std::string& text) { return text.empty(); })) {
            return usage(name, "an empty value was given");
        }
        for (std::string& text : values) {
            if (items_max > 1 && isNumber(text) && !std::isfinite(*parseNumber(text))) {
                return usage(name, fmt::format("{} is not a finite number", text));
            }
            if (items_max > 1 && text.starts_with("-.")) {
                text.insert(1, "0"); // the parser would take -.5 for an option
            }
        }
        const int count = static_cast<int>(values.size());
        if (count < items_min || count > items_max) {
            return usage(name, countProblem(items_min, items_max, count));
        }
        emit(name, option, values);
        return std::nullopt;
    }

    // "640,480" and "640 480" as "640x480".
    std::string sizeFrom(const std::string& word, const Words& parts)
    {
        if (parts.size() == 2 && isWholeNumber(parts[0]) && isWholeNumber(parts[1])) {
            return parts[0] + "x" + parts[1];
        }
        if (isWholeNumber(word) && at_ < given_.size() && isWholeNumber(given_[at_])) {
            return word + "x" + given_[at_++];
        }
        return word;
    }

    static bool isAccepted(const CLI::Option& option, const Words& parts)
    {
        try {
            const CLI::Validator* const check =
                const_cast<CLI::Option&>(option).get_validator(0); // NOLINT: CLI11 has no other
            return std::all_of(parts.begin(), parts.end(),
                               [check](const std::string& text) { return (*check)(text).empty(); });
        } catch (const CLI::OptionNotFound&) {
            return false;
        }
    }

    static std::string countProblem(int items_min, int items_max, int count)
    {
        if (items_min == 1 && count == 0) {
            return "a value is missing";
        }
        return items_min == items_max
                   ? fmt::format("{} values are needed, {} given", items_min, count)
                   : fmt::format("{} to {} values are needed, {} given", items_min, items_max,
                                 count);
    }

    // Writes the first value with an equals sign, so that a minus sign is not parsed as an option.
    // The parser consumes the end of an open list.
    void emit(const std::string& name, const CLI::Option& option, const Words& values)
    {
        const bool has_list = option.get_items_expected_max() > 1;
        if (!name.starts_with("--")) {
            words_.push_back(name);
            words_.insert(words_.end(), values.begin(), values.end());
        } else {
            const bool is_open = option.get_items_expected_max() >= kOpenListMin;
            for (std::size_t i = 0; i < values.size(); ++i) {
                if (i == 0 || is_open) {
                    words_.push_back(name + "=" + values[i]);
                } else {
                    words_.push_back(values[i]);
                }
                if (is_open && option.get_allow_extra_args()) {
                    words_.emplace_back("--");
                }
            }
            if (has_list && !is_open &&
                (static_cast<int>(values.size()) < option.get_items_expected_max() ||
                 option.get_allow_extra_args())) {
                words_.emplace_back("--");
            }
        }
    }

    std::optional<Error> takePositional()
    {
        const std::string& word = given_[at_++];
        int expected = 0;
        std::string names;
        for (const CLI::Option* option : command_->get_options()) {
            if (option->get_positional()) {
                expected = std::min(expected + option->get_items_expected_max(), kOpenListMin);
                names += (names.empty() ? "" : ", ") + option->get_name(true);
            }
        }
        if (word.empty()) {
            return usage(names.empty() ? "\"\"" : names, "an empty name was given");
        }
        if (static_cast<int>(++positional_count_) > expected) {
            return usage(word, fmt::format("unexpected argument of {}", command_->get_name()));
        }
        words_.push_back(word);
        return std::nullopt;
    }

    static constexpr int kOpenListMin = 1 << 20;

    const CLI::App* command_;
    const Words& given_;
    std::size_t at_ = 0;
    std::size_t positional_count_ = 0;
    std::set<const CLI::Option*> taken_; // those with a value
    Words pending_;                      // the value after an equals sign
    Words words_;
};

std::string plainMessage(const CLI::ParseError& error)
{
    const std::string text = error.what();
    const auto ended = [&text](std::string_view end) { return text.ends_with(end); };
    constexpr std::string_view kRequired = " is required";
    constexpr std::string_view kExcludes = " excludes ";
    constexpr std::string_view kRequires = " requires ";
    if (ended("exactly one is required")) {
        return text;
    }
    if (ended(kRequired)) {
        return text.substr(0, text.size() - kRequired.size()) + ": missing";
    }
    if (const std::size_t at = text.find(kExcludes); at != std::string::npos) {
        return fmt::format("{}: cannot be combined with {}", text.substr(0, at),
                           text.substr(at + kExcludes.size()));
    }
    if (const std::size_t at = text.find(kRequires); at != std::string::npos) {
        return fmt::format("{}: needs {}", text.substr(0, at), text.substr(at + kRequires.size()));
    }
    return text;
}

} // namespace

Result<Words> normalizedArguments(const CLI::App& app, const Words& arguments)
{
    return Normalizer(app, arguments).normalized();
}

std::string usageMessage(const CLI::App& app, const Words& arguments, const CLI::ParseError& error)
{
    const std::string message = plainMessage(error);
    Normalizer normalizer(app, arguments);
    (void)normalizer.findCommand();
    return Normalizer::asTyped(normalizer.command(), arguments, message);
}

std::string commandName(const CLI::App& app, const Words& arguments)
{
    Normalizer normalizer(app, arguments);
    (void)normalizer.findCommand();
    std::string name;
    for (const CLI::App* part = &normalizer.command(); part != nullptr; part = part->get_parent()) {
        name = part->get_name() + (name.empty() ? "" : " ") + name;
    }
    return name;
}

} // namespace marsview
