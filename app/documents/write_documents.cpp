#include "app/documents/write_documents.h"

#include "app/console/output_file.h"
#include "app/documents/completions.h"
#include "app/documents/manual_page.h"

#include <filesystem>
#include <fmt/format.h>
#include <system_error>
#include <utility>

namespace marsview {

Status writeDocuments(const DocumentedCommand& program,
                      const std::string& folder,
                      std::string_view version)
{
    const std::string& name = program.path.front();
    std::vector<std::pair<std::string, std::string>> files{
        {"bash/" + name, bashCompletion(program)},
        {"zsh/_" + name, zshCompletion(program)},
        {"fish/" + name + ".fish", fishCompletion(program)}};
    for (const DocumentedCommand* command : allCommands(program)) {
        files.emplace_back("man1/" + manualPageFile(*command),
                           manualPage(program, *command, version));
    }
    for (const auto& [file, text] : files) {
        const std::filesystem::path path = std::filesystem::path(folder) / file;
        std::error_code failure;
        std::filesystem::create_directories(path.parent_path(), failure);
        if (failure) {
            return Error{ErrorCode::Unreadable,
                         fmt::format("{}: {}", path.parent_path().string(), failure.message())};
        }
        if (Status status = writeOutputFile(path.string(), text); !status) {
            return status;
        }
    }
    return Done{};
}

} // namespace marsview
