#include "app/console/text_output.h"

#include <cctype>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

} // namespace

Json asJson(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json withSchema(const Json& fields)
{
    Json json = {{"schema", kJsonSchema}};
    json.update(fields);
    return json;
}

void printJson(const Json& json, JsonLayout layout)
{
    constexpr int kIndent = 2;
    printLine(json.dump(layout == JsonLayout::Indented ? kIndent : -1, ' ', false,
                        Json::error_handler_t::replace));
}

std::string asOneLine(std::string text)
{
    for (char& c : text) {
        if (std::iscntrl(static_cast<unsigned char>(c)) != 0) {
            c = ' ';
        }
    }
    return text;
}

void printLine(const std::string& text)
{
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fputc('\n', stdout);
}

void printError(const std::string& message, int exit_status, ErrorForm form)
{
    const std::string line = asOneLine(message);
    if (form == ErrorForm::Line) {
        std::fprintf(stderr, "marsview-cli: %s\n", line.c_str());
        return;
    }
    const std::size_t colon = line.find(": ");
    const bool has_subject = colon != std::string::npos;
    const Json json =
        withSchema({{"error",
                     {{"what", has_subject ? Json(line.substr(0, colon)) : Json(nullptr)},
                      {"message", has_subject ? line.substr(colon + 2) : line},
                      {"exit_status", exit_status}}}});
    std::fprintf(stderr, "%s\n", json.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
}

} // namespace marsview
