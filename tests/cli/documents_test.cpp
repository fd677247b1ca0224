// Manual pages and completions cover all that the help lists.
#include "app/gui/window_arguments.h"
#include "tests/cli/run_cli.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace marsview::test {
namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

std::string joined(const Words& words, const std::string& separator)
{
    std::string text;
    for (const std::string& word : words) {
        text += (text.empty() ? "" : separator) + word;
    }
    return text;
}

struct CommandHelp {
    Words path; // without the program
    Words options;
};

// What people read: the help of `path` and of all commands below it.
void collectHelp(const Words& path, std::vector<CommandHelp>& all)
{
    Words arguments = path;
    arguments.emplace_back("--help");
    const ProgramOutput output = runCli(arguments);
    if (output.exit_status != 0) {
        throw std::runtime_error(output.err);
    }
    CommandHelp help{.path = path, .options = {}};
    const std::regex option("^  (-[a-z],)?(--[a-z-]+)");
    const std::regex command("^  ([a-z]+) ");
    bool are_commands = false;
    std::vector<Words> below;
    std::istringstream lines(output.out);
    std::smatch match;
    for (std::string line; std::getline(lines, line);) {
        are_commands = are_commands || line == "Subcommands:";
        if (are_commands && std::regex_search(line, match, command)) {
            below.push_back(path);
            below.back().push_back(match[1]);
        } else if (std::regex_search(line, match, option)) {
            help.options.push_back(match[2]);
        }
    }
    all.push_back(help);
    for (const Words& next : below) {
        collectHelp(next, all);
    }
}

// Documents of marsview-cli, once for all tests.
class Documents : public ::testing::Test {
protected:
    static void SetUpTestSuite()
    {
        folder_ = new TempFolder;
        ASSERT_EQ(runCli({"--write-documents", folder_->path().string()}).exit_status, 0);
        help_ = new std::vector<CommandHelp>;
        collectHelp({}, *help_);
    }
    static void TearDownTestSuite()
    {
        delete help_;
        delete folder_;
    }

    static std::string document(const std::string& name)
    {
        return readFile(folder_->path() / name);
    }

    // What the bash function offers for these words, the last of which is being typed.
    static std::set<std::string> offeredByBash(const Words& words)
    {
        std::string script = "source '" + folder_->file("bash/marsview-cli") + "'; COMP_WORDS=(";
        for (const std::string& word : words) {
            script += "'" + word + "' ";
        }
        script += "); COMP_CWORD=" + std::to_string(words.size() - 1) +
                  "; _marsview_cli; printf '%s\\n' \"${COMPREPLY[@]}\"";
        std::istringstream lines(runTool({"bash", "-c", script}));
        std::set<std::string> offered;
        for (std::string line; std::getline(lines, line);) {
            offered.insert(line);
        }
        return offered;
    }

    static Words typed(const CommandHelp& command, const std::string& last)
    {
        Words words{"marsview-cli"};
        words.insert(words.end(), command.path.begin(), command.path.end());
        words.push_back(last);
        return words;
    }

    static TempFolder* folder_;
    static std::vector<CommandHelp>* help_;
};

TempFolder* Documents::folder_ = nullptr;
std::vector<CommandHelp>* Documents::help_ = nullptr;

std::string pageOf(const CommandHelp& command)
{
    return "man1/marsview-cli" + (command.path.empty() ? "" : "-" + joined(command.path, "-")) +
           ".1";
}

TEST_F(Documents, EveryCommandHasAPageWithEveryOption)
{
    EXPECT_GE(help_->size(), 13U);
    for (const CommandHelp& command : *help_) {
        const std::string page =
            std::regex_replace(document(pageOf(command)), std::regex("\\\\-"), "-");
        EXPECT_GE(command.options.size(), 2U) << pageOf(command);
        for (const std::string& option : command.options) {
            EXPECT_NE(page.find("\\fB" + option + "\\fR"), std::string::npos)
                << option << " in " << pageOf(command);
        }
    }
}

TEST_F(Documents, EveryPageBelongsToACommand)
{
    const fs::directory_iterator pages(folder_->path() / "man1");
    EXPECT_EQ(static_cast<std::size_t>(std::distance(begin(pages), end(pages))), help_->size());
}

TEST_F(Documents, BashOffersEveryCommandAndOption)
{
    for (const CommandHelp& command : *help_) {
        const std::set<std::string> options = offeredByBash(typed(command, "--"));
        for (const std::string& option : command.options) {
            EXPECT_TRUE(options.contains(option)) << joined(command.path, " ") << " " << option;
        }
        if (!command.path.empty()) {
            CommandHelp above = command;
            above.path.pop_back();
            EXPECT_TRUE(offeredByBash(typed(above, "")).contains(command.path.back()));
        }
    }
}

TEST_F(Documents, BashOffersChoicesAndFiles)
{
    EXPECT_EQ(offeredByBash({"marsview-cli", "loop", "x.tif", "--model", "god"}),
              (std::set<std::string>{"god-object", "god-object-release"}));
    EXPECT_EQ(offeredByBash({"marsview-cli", "render", "--shading", "=", "s"}),
              std::set<std::string>{"slope"});
    const std::string map = folder_->write("a map.tif", "");
    const std::string start = folder_->file("a");
    EXPECT_EQ(offeredByBash({"marsview-cli", "info", start}), std::set<std::string>{map});
    EXPECT_EQ(offeredByBash({"marsview-cli", "bench", "contact", "--plot", start}),
              std::set<std::string>{map});
    EXPECT_EQ(offeredByBash({"marsview-cli", "loop", "--radius", start}),
              std::set<std::string>{""}); // a number
}

TEST_F(Documents, ZshAndFishNameEveryCommandAndOption)
{
    const std::string zsh = document("zsh/_marsview-cli");
    const std::string fish = document("fish/marsview-cli.fish");
    for (const CommandHelp& command : *help_) {
        Words path{"marsview-cli"};
        path.insert(path.end(), command.path.begin(), command.path.end());
        const std::size_t start = zsh.find("\n_" + joined(path, "-") + "() {");
        ASSERT_NE(start, std::string::npos) << joined(path, " ");
        const std::string function = zsh.substr(start, zsh.find("\n}\n", start) - start);
        for (const std::string& option : command.options) {
            EXPECT_TRUE(std::regex_search(function, std::regex("\\)" + option + "[=\\[]")))
                << joined(path, " ") << " " << option;
            EXPECT_TRUE(std::regex_search(
                fish,
                std::regex("= '" + joined(path, " ") + "'\"( -s .)? -l " + option.substr(2) + " ")))
                << joined(path, " ") << " " << option;
        }
    }
}

TEST_F(Documents, ShellsReadTheirCompletions)
{
    int count = 0;
    for (const auto& [shell, file] :
         std::map<std::string, std::string>{{"bash", "bash/marsview-cli"},
                                            {"zsh", "zsh/_marsview-cli"},
                                            {"fish", "fish/marsview-cli.fish"}}) {
        const ProgramOutput output = runProgram({shell, "-n", folder_->file(file)});
        if (output.exit_status != 127) { // installed
            EXPECT_EQ(output.exit_status, 0) << shell << ": " << output.err;
            ++count;
        }
    }
    EXPECT_GE(count, 1);
}

TEST_F(Documents, FishOffersChoices)
{
    const ProgramOutput output =
        runProgram({"fish", "-c",
                    "source '" + folder_->file("fish/marsview-cli.fish") +
                        "'; complete -C 'marsview-cli loop x.tif --model god'"});
    if (output.exit_status == 127) {
        GTEST_SKIP() << "fish is not installed";
    }
    EXPECT_EQ(output.out, "god-object\tcontact model\ngod-object-release\tcontact model\n");
}

TEST_F(Documents, PagesRenderWithoutWarnings)
{
    for (const auto& page : fs::directory_iterator(folder_->path() / "man1")) {
        const ProgramOutput output =
            runProgram({"groff", "-man", "-ww", "-Kutf8", "-Tutf8", "-z", page.path().string()});
        if (output.exit_status == 127) {
            GTEST_SKIP() << "groff is not installed";
        }
        EXPECT_EQ(output.exit_status, 0) << page.path();
        EXPECT_EQ(output.err, "") << page.path();
    }
}

// Variables are read by these literals alone.
TEST_F(Documents, PagesListEveryEnvironmentVariable)
{
    const std::string page = document("man1/marsview-cli.1");
    const std::regex name("\"(MARSVIEW_[A-Z_]+)\"");
    std::set<std::string> names;
    for (const char* folder : {"app", "core", "haptics", "ui"}) {
        for (const auto& file : fs::recursive_directory_iterator(sourceRoot() / folder)) {
            if (file.path().extension() != ".cpp") {
                continue;
            }
            const std::string source = readFile(file.path());
            for (auto match = std::sregex_iterator(source.begin(), source.end(), name);
                 match != std::sregex_iterator(); ++match) {
                names.insert((*match)[1]);
            }
        }
    }
    EXPECT_GE(names.size(), 7U);
    for (const std::string& variable : names) {
        EXPECT_NE(page.find("\\fB" + variable + "\\fR"), std::string::npos) << variable;
    }
}

TEST_F(Documents, WindowHasAPageAndCompletions)
{
    const auto arguments = parseWindowArguments({"--help"}, "");
    ASSERT_TRUE(arguments && arguments->answer);
    const TempFolder folder;
    const std::string help = folder.write("help.txt", *arguments->answer);
    ASSERT_EQ(runCli({"--write-documents", folder.path().string(), help}).exit_status, 0);
    const std::string page = readFile(folder.path() / "man1/marsview.1");
    const std::string bash = readFile(folder.path() / "bash/marsview");
    const std::string zsh = readFile(folder.path() / "zsh/_marsview");
    const std::string fish = readFile(folder.path() / "fish/marsview.fish");
    const std::regex option("--([a-z]+)");
    std::set<std::string> options;
    for (auto match =
             std::sregex_iterator(arguments->answer->begin(), arguments->answer->end(), option);
         match != std::sregex_iterator(); ++match) {
        options.insert((*match)[1]);
    }
    EXPECT_GE(options.size(), 5U);
    for (const std::string& name : options) {
        EXPECT_NE(page.find("\\fB\\-\\-" + name + "\\fR"), std::string::npos) << name;
        EXPECT_NE(bash.find("--" + name), std::string::npos) << name;
        EXPECT_NE(zsh.find(")--" + name), std::string::npos) << name;
        EXPECT_NE(fish.find("-l " + name + " "), std::string::npos) << name;
    }
    EXPECT_NE(page.find("\\fIDEM\\fR"), std::string::npos);
}

} // namespace
} // namespace marsview::test
