#include "core/raster/label_elevation.h"

#include "core/base/plain_number.h"
#include "core/files/gdal_file.h"
#include "core/files/gdal_runtime.h"
#include "core/files/raster_path.h"
#include "core/files/remote_raster.h"
#include "core/formats/odl_label.h"
#include "core/raster/nodata.h"

#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <memory>
#include <span>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kLabelBytesMax = std::size_t{1} << 20;

// A connection of a database or a service, which has no files next to it.
bool isConnection(const std::string& path)
{
    return !remoteNameFor(path) && path.find("://") != std::string::npos;
}

// 16#FF7FFFFB# are the bits of the sample, whatever its type.
std::optional<double> basedNumber(std::string_view text, SampleType type)
{
    const std::size_t first = text.find('#');
    if (first == std::string_view::npos || !text.ends_with('#') || first + 2 > text.size() - 1) {
        return std::nullopt;
    }
    const std::string_view base_text = text.substr(0, first);
    const std::string_view digits = text.substr(first + 1, text.size() - first - 2);
    int base = 0;
    std::uint64_t bits = 0;
    const auto base_read =
        std::from_chars(base_text.data(), base_text.data() + base_text.size(), base);
    if (base_read.ec != std::errc{} || base < 2 || base > 16) {
        return std::nullopt;
    }
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), bits, base);
    if (read.ec != std::errc{} || read.ptr != digits.data() + digits.size()) {
        return std::nullopt;
    }
    return dispatchSampleType(type, [bits](auto zero) {
        using T = decltype(zero);
        if constexpr (std::is_same_v<T, float>) {
            return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
        } else if constexpr (std::is_same_v<T, double>) {
            return std::bit_cast<double>(bits);
        } else {
            return static_cast<double>(static_cast<T>(bits));
        }
    });
}

std::optional<double> numberFrom(std::string text)
{
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    const std::size_t end = text.find_last_not_of(" \t\r\n");
    if (begin == std::string::npos) {
        return std::nullopt;
    }
    text = text.substr(begin, end - begin + 1);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    const std::optional<double> number = parseNumber(text);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

// The value for one band: the band's item of a list, or a single value.
std::optional<std::string> itemIn(const OdlStatement& group, std::string_view name, int band)
{
    const OdlStatement* const statement = statementIn(group, name);
    if (statement == nullptr) {
        return std::nullopt;
    }
    const std::vector<std::string> items = odlItems(statement->value);
    return items[std::min(static_cast<std::size_t>(band - 1), items.size() - 1)];
}

std::optional<double> numberIn(const OdlStatement& group, std::string_view name, int band)
{
    const std::optional<std::string> item = itemIn(group, name, band);
    return item ? numberFrom(*item) : std::nullopt;
}

// Labels say in these words that they have no value.
bool isNone(std::string_view text)
{
    constexpr std::array<std::string_view, 6> kNone{"", "N/A", "NULL", "UNK", "NONE", "UNKNOWN"};
    return std::any_of(kNone.begin(), kNone.end(), [text](std::string_view none) {
        return text.size() == none.size() && EQUALN(text.data(), none.data(), none.size());
    });
}

// The number of a statement that should have one.
std::optional<double> numberIn(const OdlStatement& group,
                               std::string_view name,
                               int band,
                               OverrideField field,
                               std::vector<UnreadNumber>& unread)
{
    const std::optional<std::string> item = itemIn(group, name, band);
    const std::optional<double> number = item ? numberFrom(*item) : std::nullopt;
    if (item && !number && !isNone(*item)) {
        unread.push_back({field, std::string(name), *item});
    }
    return number;
}

struct Names {
    std::string_view scale, offset, unit;
    std::span<const std::string_view> nodata; // the first one present is the nodata value
};
constexpr std::array<std::string_view, 15> kConstants{"MISSING_CONSTANT",
                                                      "MISSING",
                                                      "NULL_CONSTANT",
                                                      "CORE_NULL",
                                                      "INVALID_CONSTANT",
                                                      "UNKNOWN_CONSTANT",
                                                      "NOT_APPLICABLE_CONSTANT",
                                                      "CORE_LOW_REPR_SATURATION",
                                                      "CORE_LOW_INSTR_SATURATION",
                                                      "CORE_HIGH_INSTR_SATURATION",
                                                      "CORE_HIGH_REPR_SATURATION",
                                                      "LOW_REPR_SATURATION",
                                                      "LOW_INSTR_SATURATION",
                                                      "HIGH_INSTR_SATURATION",
                                                      "HIGH_REPR_SATURATION"};
constexpr Names kImageNames{"SCALING_FACTOR", "OFFSET", "UNIT", kConstants};
constexpr Names kQubeNames{"CORE_MULTIPLIER", "CORE_BASE", "CORE_UNIT", kConstants};
constexpr Names kIsis3Names{"MULTIPLIER", "BASE", "", {}}; // GDAL's mask has its special values

// Of several bands, a sequence in parentheses has an item each. Otherwise every item counts.
std::vector<std::string>
constantsIn(const OdlStatement& group, const OdlStatement& statement, int band)
{
    std::vector<std::string> items = odlItems(statement.value);
    const std::optional<std::string> bands = itemIn(group, "BANDS", 1);
    const bool is_per_band = statement.value.starts_with('(') && items.size() > 1 && bands &&
                             numberFrom(*bands) == static_cast<double>(items.size()) &&
                             static_cast<std::size_t>(band) <= items.size();
    return is_per_band ? std::vector{items[static_cast<std::size_t>(band - 1)]} : items;
}

std::vector<double> nodataIn(const OdlStatement& group,
                             std::span<const std::string_view> names,
                             int band,
                             SampleType type,
                             std::vector<UnreadNumber>& unread)
{
    std::vector<double> values;
    for (const std::string_view name : names) {
        for (const OdlStatement& statement : group.statements) {
            if (statement.is_group || statement.name != name) {
                continue;
            }
            for (const std::string& item : constantsIn(group, statement, band)) {
                std::optional<double> value = basedNumber(item, type);
                value = value ? value : numberFrom(item);
                if (!value && !isNone(item)) {
                    unread.push_back({OverrideField::Nodata, std::string(name), item});
                }
                if (value && std::find(values.begin(), values.end(), *value) == values.end()) {
                    values.push_back(*value);
                }
            }
        }
    }
    return values;
}

LabelElevation elevationIn(const OdlStatement& group, const Names& names, int band, SampleType type)
{
    LabelElevation label;
    label.scale = numberIn(group, names.scale, band, OverrideField::Scale, label.unread);
    label.offset = numberIn(group, names.offset, band, OverrideField::Offset, label.unread);
    const std::string unit = itemIn(group, names.unit, band).value_or("");
    label.unit = isNone(unit) ? "" : unit;
    label.nodata = nodataIn(group, names.nodata, band, type, label.unread);
    label.columns = numberIn(group, "LINE_SAMPLES", 1);
    label.rows = numberIn(group, "LINES", 1);
    const std::string samples = itemIn(group, "SAMPLE_TYPE", band).value_or("");
    if (samples.find("INTEGER") != std::string::npos) {
        label.is_signed = samples.find("UNSIGNED") == std::string::npos;
    }
    return label;
}

// The object with the samples: IMAGE at any depth, or one such as HEIGHT_IMAGE.
const OdlStatement* imageIn(const OdlStatement& group)
{
    if (const OdlStatement* const image = groupNamed(group, "IMAGE")) {
        return image;
    }
    for (const OdlStatement& statement : group.statements) {
        if (!statement.is_group) {
            continue;
        }
        if (statement.name.ends_with("_IMAGE") && statementIn(statement, "LINES") != nullptr) {
            return &statement;
        }
        if (const OdlStatement* const deeper = imageIn(statement)) {
            return deeper;
        }
    }
    return nullptr;
}

std::optional<LabelElevation> odlElevation(const OdlStatement& root, int band, SampleType type)
{
    if (const OdlStatement* const cube = groupNamed(root, "ISISCUBE")) {
        const OdlStatement* const pixels = groupNamed(*cube, "PIXELS");
        return pixels != nullptr ? std::optional(elevationIn(*pixels, kIsis3Names, band, type))
                                 : std::nullopt;
    }
    if (const OdlStatement* const image = imageIn(root)) {
        return elevationIn(*image, kImageNames, band, type);
    }
    for (const char* name : {"QUBE", "SPECTRAL_QUBE"}) {
        if (const OdlStatement* const qube = groupNamed(root, name)) {
            return elevationIn(*qube, kQubeNames, band, type);
        }
    }
    return std::nullopt;
}

struct XmlCloser {
    void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};

// The first element of that name, `node` included, at any depth.
const CPLXMLNode* elementNamed(const CPLXMLNode* node, std::string_view name, int depth = 0)
{
    constexpr int kDepthMax = 32;
    for (; node != nullptr && depth < kDepthMax; node = node->psNext) {
        if (node->eType == CXT_Element && name == node->pszValue) {
            return node;
        }
        if (const CPLXMLNode* const found = elementNamed(node->psChild, name, depth + 1)) {
            return found;
        }
    }
    return nullptr;
}

std::optional<LabelElevation> pds4Elevation(const std::string& text)
{
    const std::unique_ptr<CPLXMLNode, XmlCloser> xml(CPLParseXMLString(text.c_str()));
    if (!xml) {
        return std::nullopt;
    }
    CPLStripXMLNamespace(xml.get(), nullptr, TRUE);
    const CPLXMLNode* array = nullptr;
    for (const char* name : {"Array_2D_Map", "Array_2D_Image", "Array_2D", "Array_3D_Image",
                             "Array_3D", "Array_2D_Spectrum", "Array_3D_Spectrum"}) {
        array = array != nullptr ? array : elementNamed(xml.get(), name);
    }
    if (array == nullptr) {
        return std::nullopt;
    }
    const auto textAt = [array](const char* path) {
        const char* value = CPLGetXMLValue(array, path, nullptr);
        return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
    };
    LabelElevation label;
    const auto numberAt = [&textAt, &label](const char* path, OverrideField field) {
        const std::optional<std::string> value = textAt(path);
        const std::optional<double> number = value ? numberFrom(*value) : std::nullopt;
        if (value && !number && !isNone(*value)) {
            label.unread.push_back({field, CPLGetExtension(path), *value});
        }
        return number;
    };
    label.scale = numberAt("Element_Array.scaling_factor", OverrideField::Scale);
    label.offset = numberAt("Element_Array.value_offset", OverrideField::Offset);
    label.unit = textAt("Element_Array.unit").value_or("");
    for (const char* name : {"missing_constant", "invalid_constant", "unknown_constant",
                             "not_applicable_constant", "error_constant", "saturated_constant",
                             "high_instrument_saturation", "high_representation_saturation",
                             "low_instrument_saturation", "low_representation_saturation"}) {
        const auto value =
            numberAt((std::string("Special_Constants.") + name).c_str(), OverrideField::Nodata);
        if (value &&
            std::find(label.nodata.begin(), label.nodata.end(), *value) == label.nodata.end()) {
            label.nodata.push_back(*value);
        }
    }
    return label;
}

std::string textOf(const std::string& path)
{
    const GdalFile file = openGdalFile(path);
    std::string text(file ? kLabelBytesMax : 0, '\0');
    text.resize(file ? VSIFReadL(text.data(), 1, text.size(), file.get()) : 0);
    return text;
}

// Names of the files in the folder of `path`.
std::vector<std::string> namesNextTo(const std::string& path)
{
    const std::string folder = CPLGetPath(path.c_str());
    const CPLStringList entries(VSIReadDir(folder.empty() ? "." : folder.c_str()));
    return {entries.List(), entries.List() + entries.Count()};
}

std::string besideOf(const std::string& path, const std::string& name)
{
    const std::string folder = CPLGetPath(path.c_str());
    return folder.empty() ? name : folder + "/" + name;
}

bool isThere(const std::string& path)
{
    const GdalMessages ignored; // of a server that has no such file
    VSIStatBufL status{};
    return VSIStatExL(path.c_str(), &status, VSI_STAT_EXISTS_FLAG) == 0;
}

// Those of the names that exist, in the letter case of the data file's own extension: each costs a
// request.
std::vector<std::string> remoteLabelNamesOf(const std::string& path)
{
    const std::string stem = CPLGetBasename(path.c_str());
    const std::string extension = CPLGetExtension(path.c_str());
    const bool is_upper = !extension.empty() && extension != lowerCase(extension);
    std::vector<std::string> names{stem + (is_upper ? ".LBL" : ".lbl")};
    if (isJpeg2000Name(path)) {
        names.push_back(stem + (is_upper ? "_JP2.LBL" : "_jp2.lbl"));
    }
    names.push_back(stem + ".xml");
    std::erase_if(names,
                  [&path](const std::string& name) { return !isThere(besideOf(path, name)); });
    return names;
}

// Those of the names that exist: folders may hold thousands of TIFFs, so none is listed for each.
std::vector<std::string> usualLabelNamesOf(const std::string& path)
{
    const std::string file = CPLGetFilename(path.c_str());
    const std::string stem = CPLGetBasename(path.c_str());
    std::vector<std::string> names;
    for (const char* extension : {".lbl", ".LBL", ".Lbl", ".xml", ".XML"}) {
        for (const std::string& name : {stem + extension, file + extension}) {
            if (isThere(besideOf(path, name))) {
                names.push_back(name);
            }
        }
    }
    return names;
}

std::vector<std::string> labelNamesOf(const std::string& path)
{
    if (remoteNameFor(path)) {
        return remoteLabelNamesOf(path);
    }
    return isJpeg2000Name(path) ? namesNextTo(path) : usualLabelNamesOf(path);
}

bool isXml(const std::string& text)
{
    const std::size_t first = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
    return first != std::string::npos && text[first] == '<';
}

// JPEG2000 as a file or as a bare codestream, or TIFF of either kind and order.
bool isEncodedImage(const std::string& path)
{
    const GdalFile file = openGdalFile(path);
    std::string head(12, '\0');
    head.resize(file ? VSIFReadL(head.data(), 1, head.size(), file.get()) : 0);
    using namespace std::string_view_literals;
    constexpr std::array kSignatures{
        "\0\0\0\x0CjP  "sv, "\xFF\x4F\xFF\x51"sv, "II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv};
    return std::any_of(kSignatures.begin(), kSignatures.end(),
                       [&head](std::string_view signature) { return head.starts_with(signature); });
}

// Both in lower case; not as the end of another name.
bool hasFileName(const std::string& text, const std::string& name)
{
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        const char before = at == 0 ? ' ' : text[at - 1];
        const bool is_part = (before >= 'a' && before <= 'z') || (before >= '0' && before <= '9') ||
                             before == '_' || before == '-' || before == '.';
        if (!is_part) {
            return true;
        }
    }
    return false;
}

bool isSameNodata(SampleType type, const std::optional<double>& a, const std::optional<double>& b)
{
    return dispatchSampleType(type, [&a, &b](auto zero) {
        using T = decltype(zero);
        const Nodata<T> first(a);
        const Nodata<T> second(b);
        return first.exists == second.exists && (!first.exists || first.value == second.value);
    });
}

bool canBeSample(SampleType type, double value)
{
    return dispatchSampleType(type,
                              [value](auto zero) { return Nodata<decltype(zero)>(value).exists; });
}

// The value that GDAL reads stays the nodata value if the label has it, too.
void applyNodata(RasterInfo& info, const std::vector<double>& constants)
{
    const auto is_known = [&info](double value) {
        return isSameNodata(info.type, value, info.nodata);
    };
    if (!constants.empty() && std::none_of(constants.begin(), constants.end(), is_known)) {
        info.nodata = constants.front();
    }
    for (const double value : constants) {
        if (!is_known(value) && canBeSample(info.type, value)) {
            info.other_nodata.push_back(value);
        }
    }
}

std::string numbersAsText(const std::vector<double>& numbers)
{
    std::string text;
    for (const double number : numbers) {
        text += (text.empty() ? "" : " ") + fmt::format("{}", number);
    }
    return text;
}

// Where the samples are: ^IMAGE at any depth, or else a pointer such as ^HEIGHT_IMAGE.
const OdlStatement* pointerIn(const OdlStatement& group)
{
    const OdlStatement* other = statementIn(group, "^IMAGE");
    for (const OdlStatement& statement : group.statements) {
        const OdlStatement* const deeper = statement.is_group ? pointerIn(statement) : nullptr;
        if (deeper != nullptr && (other == nullptr || deeper->name == "^IMAGE")) {
            other = deeper;
        }
        if (other == nullptr && statement.name.starts_with("^") &&
            statement.name.ends_with("_IMAGE") &&
            statement.name.find("BROWSE") == std::string::npos) {
            other = &statement;
        }
    }
    return other;
}

// Values that cannot be read, and what is used in their place.
void noteUnreadNumbers(RasterInfo& info, const LabelElevation& label)
{
    const char* const name = CPLGetFilename(label.path.c_str());
    for (const UnreadNumber& number : label.unread) {
        const std::string gives =
            fmt::format("the label {} gives {} as \"{}\", which is not a number", name, number.name,
                        number.text);
        if (number.field == OverrideField::Nodata) {
            info.addNotice(gives + "; set the nodata value if its samples are not void (--nodata)",
                           {number.field});
            continue;
        }
        // GDAL takes "0,5" for 0.5 in one format and for none in another.
        const bool is_scale = number.field == OverrideField::Scale;
        (is_scale ? info.scale : info.offset) = is_scale ? 1.0 : 0.0;
        info.addNotice(fmt::format("{}; {} is used instead; set the {} that the product's "
                                   "documentation gives ({})",
                                   gives, is_scale ? info.scale : info.offset,
                                   is_scale ? "scale" : "offset",
                                   is_scale ? "--scale" : "--offset"),
                       {number.field});
    }
}

bool isSigned(SampleType type)
{
    return dispatchSampleType(type, [](auto zero) { return std::is_signed_v<decltype(zero)>; });
}

} // namespace

std::optional<LabelElevation> labelElevationIn(const std::string& text, int band, SampleType type)
{
    if (isXml(text)) {
        return pds4Elevation(text);
    }
    const std::optional<OdlStatement> root = parseOdl(text);
    return root ? odlElevation(*root, band, type) : std::nullopt;
}

bool isJpeg2000Name(const std::string& path)
{
    const std::string lower = lowerCase(path);
    return lower.ends_with(".jp2") || lower.ends_with(".j2k") || lower.ends_with(".jpx") ||
           lower.ends_with(".j2c") || lower.ends_with(".jpc");
}

std::optional<LabelElevation>
labelElevationOf(GDALDataset& dataset, const RasterInfo& info, const std::string& label_path)
{
    std::string path;
    std::optional<LabelElevation> label;
    if (info.driver == "PDS" || info.driver == "ISIS2" || info.driver == "ISIS3") {
        const CPLStringList files(dataset.GetFileList());
        path = files.Count() > 0 ? files[0] : info.path;
        if (const std::optional<OdlStatement> root = readOdlLabel(path)) {
            label = odlElevation(*root, info.band, info.type);
        }
    } else if (info.driver == "PDS4") {
        path = info.path;
        char** const xml = dataset.GetMetadata("xml:PDS4");
        label = xml != nullptr && xml[0] != nullptr ? pds4Elevation(xml[0]) : std::nullopt;
    } else if (info.driver == "GTiff" || info.driver.starts_with("JP2")) {
        path = label_path;
        if (!path.empty()) {
            label = labelElevationIn(textOf(path), info.band, info.type);
            if (!label) {
                label.emplace().is_understood = false;
            }
        }
    }
    if (label) {
        label->path = std::move(path);
    }
    return label;
}

bool LabelElevation::hasScale() const
{
    return scale || std::any_of(unread.begin(), unread.end(), [](const UnreadNumber& number) {
               return number.field == OverrideField::Scale;
           });
}

void applyLabel(RasterInfo& info, const LabelElevation& label)
{
    const char* const name = CPLGetFilename(label.path.c_str());
    if (!label.is_understood) {
        info.addNotice(
            fmt::format("the label {} is damaged or describes no samples, so the samples are taken "
                        "as elevations in {}; fetch it again, or set scale and offset",
                        name, info.unit.name),
            {OverrideField::Scale, OverrideField::Offset});
        return;
    }
    info.label_name = name;
    const auto note = [&info](OverrideField field, const char* what, const std::string& label_says,
                              const std::string& gdal_says) {
        info.label_corrections.push_back(
            {field, fmt::format("{} {}", what, label_says), fmt::format("{} {}", what, gdal_says)});
    };
    // Both read the same digits.
    const auto isOther = [](const std::optional<double>& declared, double applied) {
        return declared && std::abs(*declared - applied) > 1e-12 * std::abs(applied);
    };
    if (label.scale == 0.0) {
        info.addNotice(
            fmt::format("the label {} gives the scale 0, which would make all elevations equal; {} "
                        "is used instead; set the scale that the product's documentation gives "
                        "(--scale)",
                        name, info.scale),
            {OverrideField::Scale});
    } else if (isOther(label.scale, info.scale)) {
        note(OverrideField::Scale, "scale", fmt::format("{}", *label.scale),
             fmt::format("{}", info.scale));
        info.scale = *label.scale;
    }
    if (isOther(label.offset, info.offset)) {
        note(OverrideField::Offset, "offset", fmt::format("{}", *label.offset),
             fmt::format("{}", info.offset));
        info.offset = *label.offset;
    }
    noteUnreadNumbers(info, label);
    if (const auto unit = verticalUnitFrom(label.unit);
        unit && (*unit != info.unit || !info.is_unit_declared)) {
        if (*unit != info.unit) {
            note(OverrideField::VerticalUnit, "unit", label.unit,
                 info.is_unit_declared ? info.unit.name : "none");
        }
        info.unit = *unit;
        info.is_unit_declared = true;
    }
    const std::optional<double> nodata_before = info.nodata;
    applyNodata(info, label.nodata);
    if (!isSameNodata(info.type, nodata_before, info.nodata) || !info.other_nodata.empty()) {
        note(OverrideField::Nodata, "nodata", numbersAsText(label.nodata),
             nodata_before ? fmt::format("{}", *nodata_before) : std::string("none"));
    }
    // The void value that GDAL uses for such samples in an .IMG without a MISSING_CONSTANT.
    constexpr double kNull = -32768.0;
    if (label.nodata.empty() && info.driver.starts_with("JP2") && info.type == SampleType::Int16 &&
        !info.nodata) {
        info.nodata = kNull;
    }
    if (label.nodata.empty() && info.driver == "PDS" && info.nodata == 0.0 &&
        !isSigned(info.type)) {
        note(OverrideField::Nodata, "nodata", "none", "0"); // for every product of unsigned samples
        info.nodata.reset();
    }
    if (std::string notice = info.labelNotice(); !notice.empty()) {
        info.notices.push_back(std::move(notice));
    }
    if (label.columns && label.rows &&
        (*label.columns != static_cast<double>(info.columns) ||
         *label.rows != static_cast<double>(info.rows))) {
        info.notices.push_back(
            fmt::format("the label {} describes {} × {} samples, but the file holds {} × {}; check "
                        "that they belong together",
                        name, *label.columns, *label.rows, info.columns, info.rows));
    }
    const bool is_integer =
        dispatchSampleType(info.type, [](auto zero) { return std::is_integral_v<decltype(zero)>; });
    if (label.is_signed && is_integer && *label.is_signed != isSigned(info.type)) {
        info.notices.push_back(fmt::format(
            "the label {} declares {} samples, but the file holds {} ones; check the elevations",
            name, *label.is_signed ? "signed" : "unsigned",
            *label.is_signed ? "unsigned" : "signed"));
    }
}

std::optional<std::string> noticeOfUnusedScale(GDALDataset& dataset, const RasterInfo& info)
{
    const CPLStringList files(info.driver == "ISIS3" ? dataset.GetFileList() : nullptr);
    for (int i = 1; i < files.Count(); ++i) {
        const GdalMessages ignored;
        const std::array<const char*, 2> tiff{"GTiff", nullptr};
        const GDALDatasetUniquePtr image(GDALDataset::Open(files[i], GDAL_OF_RASTER, tiff.data()));
        GDALRasterBand* const band = image ? image->GetRasterBand(info.band) : nullptr;
        if (band == nullptr) {
            continue;
        }
        int has_scale = 0;
        int has_offset = 0;
        const double scale = band->GetScale(&has_scale);
        const double offset = band->GetOffset(&has_offset);
        if ((has_scale != 0 && scale != info.scale) || (has_offset != 0 && offset != info.offset)) {
            return fmt::format(
                "the label {} gives scale {}, offset {}, but {} has scale {}, offset "
                "{} of its own; those of the label are used; set scale and offset "
                "if they are wrong",
                CPLGetFilename(files[0]), info.scale, info.offset, CPLGetFilename(files[i]),
                has_scale != 0 ? scale : 1.0, has_offset != 0 ? offset : 0.0);
        }
    }
    return std::nullopt;
}

std::string labelNextTo(const std::string& data_path)
{
    if (isConnection(data_path) || data_path.empty()) {
        return {};
    }
    const std::string data_name = lowerCase(CPLGetFilename(data_path.c_str()));
    const std::string stem = lowerCase(CPLGetBasename(data_path.c_str()));
    std::string of_same_name;
    for (const std::string& name : labelNamesOf(data_path)) {
        const std::string lower = lowerCase(name);
        const bool is_candidate = lower == stem + ".lbl" || lower == stem + ".xml" ||
                                  lower == stem + "_jp2.lbl" || lower == data_name + ".lbl" ||
                                  lower == data_name + ".xml";
        if (!is_candidate || lower == data_name) {
            continue;
        }
        const std::string path = besideOf(data_path, name);
        const std::string text = lowerCase(textOf(path));
        const bool is_label = isXml(text) ? text.find("<product_observational") != std::string::npos
                                          : text.find("pds_version_id") != std::string::npos ||
                                                text.find("isiscube") != std::string::npos;
        if (is_label && hasFileName(text, data_name)) {
            return path;
        }
        if (is_label && !isXml(text)) {
            of_same_name = path;
        }
    }
    // A TIFF of the same name may be derived from the product, with elevations in meters. JPEG2000
    // holds integers.
    return isJpeg2000Name(data_name) ? of_same_name : std::string();
}

std::string encodedImageOf(const std::string& label_path)
{
    const std::optional<OdlStatement> root =
        isConnection(label_path) ? std::nullopt : readOdlLabel(label_path);
    if (!root) {
        return {};
    }
    const OdlStatement* const compressed = groupNamed(*root, "COMPRESSED_FILE");
    const OdlStatement* const file =
        compressed != nullptr ? statementIn(*compressed, "FILE_NAME") : pointerIn(*root);
    const std::string wanted =
        file != nullptr ? lowerCase(odlItems(file->value).front()) : std::string();
    for (const std::string& name : namesNextTo(label_path)) {
        const std::string path = besideOf(label_path, name);
        if (lowerCase(name) == wanted && isEncodedImage(path)) {
            return path;
        }
    }
    return {};
}

} // namespace marsview
