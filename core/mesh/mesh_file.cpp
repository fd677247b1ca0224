// Numbers are parsed with std::from_chars, which ignores the locale.

#include "core/mesh/mesh_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <utility>

namespace marsview {
namespace {

// Progress is reported, and cancellation checked, after this many lines or elements.
constexpr std::size_t kReportEvery = 1U << 14U;

bool isBlank(char c) noexcept
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

// A short, printable excerpt of a file for messages.
std::string shown(std::string_view text)
{
    constexpr std::size_t kMost = 40;
    std::string printable;
    for (const char c : text.substr(0, kMost)) {
        printable += c >= ' ' && c <= '~' ? c : '?';
    }
    return "\"" + printable + (text.size() > kMost ? "…\"" : "\"");
}

// Splits text into lines and words.
class Lines {
public:
    explicit Lines(std::string_view text)
        : text_(text)
    {}

    // Moves to the next line with words other than a comment; false at the end.
    bool next(char comment)
    {
        while (at_ < text_.size()) {
            const std::size_t end = std::min(text_.find('\n', at_), text_.size());
            line_ = text_.substr(at_, end - at_);
            at_ = std::min(end + 1, text_.size());
            ++number_;
            if (comment != '\0') {
                line_ = line_.substr(0, line_.find(comment));
            }
            rest_ = line_;
            skipBlanks();
            if (!rest_.empty()) {
                return true;
            }
        }
        line_ = {};
        rest_ = {};
        return false;
    }
    // The next word of the line; empty at its end.
    std::string_view word()
    {
        skipBlanks();
        const auto end = std::find_if(rest_.begin(), rest_.end(), isBlank);
        const auto size = static_cast<std::size_t>(end - rest_.begin());
        const std::string_view word = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return word;
    }
    std::string_view line() const { return line_; }
    std::size_t number() const { return number_; }
    std::size_t position() const { return at_; } // of the next line

private:
    void skipBlanks()
    {
        while (!rest_.empty() && isBlank(rest_.front())) {
            rest_.remove_prefix(1);
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t number_ = 0;
    std::string_view line_;
    std::string_view rest_;
};

template <typename T>
std::optional<T> parsed(std::string_view word)
{
    if (!word.empty() && word.front() == '+') {
        word.remove_prefix(1);
    }
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if constexpr (std::is_floating_point_v<T>) {
        // Overflow becomes infinite, underflow 0: the check of the mesh decides.
        if (error == std::errc::result_out_of_range && end == word.data() + word.size()) {
            return word.find("e-") != std::string_view::npos ||
                           word.find("E-") != std::string_view::npos
                       ? T{}
                       : std::numeric_limits<T>::infinity();
        }
    }
    return error == std::errc() && end == word.data() + word.size() && !word.empty()
               ? std::optional(value)
               : std::nullopt;
}

class Reader {
public:
    Reader(const std::string& path, std::string_view text, JobMonitor& monitor)
        : path_(path)
        , text_(text)
        , monitor_(monitor)
    {}
    virtual ~Reader() = default;
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    Result<TriangleSoup> read()
    {
        if (auto error = parse()) {
            return std::move(*error);
        }
        if (soup_.faces.empty()) {
            return Error{ErrorCode::Invalid, fmt::format("{}: holds no triangles", path_)};
        }
        return std::move(soup_);
    }

protected:
    // Empty on success.
    using Problem = std::optional<Error>;

    virtual Problem parse() = 0;

    Problem atLine(std::size_t line, const std::string& what) const
    {
        return Error{ErrorCode::Invalid, fmt::format("{}: line {}: {}", path_, line, what)};
    }
    Problem atByte(std::size_t byte, const std::string& what) const
    {
        return Error{ErrorCode::Invalid, fmt::format("{}: byte {}: {}", path_, byte, what)};
    }
    Problem inFile(const std::string& what) const
    {
        return Error{ErrorCode::Invalid, fmt::format("{}: {}", path_, what)};
    }
    // Call once for each line or element.
    Problem canceled(std::size_t position)
    {
        if (++asked_ % kReportEvery != 0) {
            return std::nullopt;
        }
        monitor_.report(static_cast<double>(position) / static_cast<double>(text_.size() + 1));
        return monitor_.isCanceled()
                   ? Problem(
                         Error{ErrorCode::Canceled, fmt::format("{}: reading was canceled", path_)})
                   : std::nullopt;
    }

    // Three numbers of a line, as a vertex.
    Problem point(Lines& lines, ScenePoint& p) const
    {
        for (double* value : {&p.x, &p.y, &p.z}) {
            const std::string_view word = lines.word();
            const auto number = parsed<double>(word);
            if (!number) {
                return atLine(lines.number(), word.empty()
                                                  ? "a coordinate is missing"
                                                  : fmt::format("{} is not a number", shown(word)));
            }
            *value = *number;
        }
        return std::nullopt;
    }

    void addPolygon()
    {
        for (std::size_t i = 2; i < polygon_.size(); ++i) {
            soup_.faces.push_back({polygon_[0], polygon_[i - 1], polygon_[i]});
        }
    }

    const std::string& path_;
    std::string_view text_;
    JobMonitor& monitor_;
    TriangleSoup soup_;
    std::vector<std::uint32_t> polygon_;

private:
    std::size_t asked_ = 0;
};

// Wavefront OBJ, "Advanced Visualizer Manual", appendix B1.
class ObjReader final : public Reader {
public:
    using Reader::Reader;

private:
    Problem parse() override
    {
        static constexpr std::array<std::string_view, 15> kSkipped{
            "vt",     "vn",     "o",      "g",     "s",   "l",        "p",       "usemtl",
            "mtllib", "usemap", "maplib", "bevel", "lod", "d_interp", "c_interp"};
        Lines lines(text_);
        // Faces may refer to later vertices only by absolute numbers; those are checked last.
        std::uint64_t highest = 0;
        std::size_t highest_line = 0;
        while (lines.next('#')) {
            if (auto stop = canceled(lines.position())) {
                return stop;
            }
            const std::string_view keyword = lines.word();
            if (keyword == "v") {
                ScenePoint p;
                if (auto problem = point(lines, p)) {
                    return problem;
                }
                soup_.vertices.push_back(p);
            } else if (keyword == "f") {
                if (auto problem = face(lines, highest, highest_line)) {
                    return problem;
                }
            } else if (std::find(kSkipped.begin(), kSkipped.end(), keyword) == kSkipped.end()) {
                return atLine(lines.number(), fmt::format("{} is not an OBJ statement of polygons",
                                                          shown(keyword)));
            }
        }
        if (highest > soup_.vertices.size()) {
            return atLine(highest_line, fmt::format("a face names vertex {}, there are {}", highest,
                                                    soup_.vertices.size()));
        }
        return std::nullopt;
    }

    Problem face(Lines& lines, std::uint64_t& highest, std::size_t& highest_line)
    {
        polygon_.clear();
        for (std::string_view word = lines.word(); !word.empty(); word = lines.word()) {
            const auto number = parsed<std::int64_t>(word.substr(0, word.find('/')));
            if (!number || *number == 0) {
                return atLine(lines.number(),
                              fmt::format("{} is not the number of a vertex", shown(word)));
            }
            const auto count = static_cast<std::int64_t>(soup_.vertices.size());
            const std::int64_t index = *number > 0 ? *number - 1 : count + *number;
            if (index < 0 || index >= std::int64_t{TriangleMesh::kNone}) {
                return atLine(lines.number(),
                              fmt::format("a face names vertex {}, there are {}", *number, count));
            }
            if (static_cast<std::uint64_t>(index) >= highest) {
                highest = static_cast<std::uint64_t>(index) + 1;
                highest_line = lines.number();
            }
            polygon_.push_back(static_cast<std::uint32_t>(index));
        }
        if (polygon_.size() < 3) {
            return atLine(lines.number(), fmt::format("a face has {} corners", polygon_.size()));
        }
        addPolygon();
        return std::nullopt;
    }
};

// G. Turk, "The PLY polygon file format", 1994.
class PlyReader final : public Reader {
public:
    using Reader::Reader;

private:
    enum class Encoding : std::uint8_t { Ascii, LittleEndian, BigEndian };
    enum class Type : std::uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };
    struct Property {
        std::string name;
        Type type = Type::Float;
        std::optional<Type> count_type; // a list
    };
    struct Element {
        std::string name;
        std::uint64_t count = 0;
        std::vector<Property> properties;
    };

    static std::optional<Type> typeOf(std::string_view name)
    {
        static constexpr std::array<std::pair<std::string_view, Type>, 16> kTypes{{
            {"char", Type::Int8},
            {"int8", Type::Int8},
            {"uchar", Type::Uint8},
            {"uint8", Type::Uint8},
            {"short", Type::Int16},
            {"int16", Type::Int16},
            {"ushort", Type::Uint16},
            {"uint16", Type::Uint16},
            {"int", Type::Int32},
            {"int32", Type::Int32},
            {"uint", Type::Uint32},
            {"uint32", Type::Uint32},
            {"float", Type::Float},
            {"float32", Type::Float},
            {"double", Type::Double},
            {"float64", Type::Double},
        }};
        const auto* const at = std::find_if(kTypes.begin(), kTypes.end(),
                                            [name](const auto& t) { return t.first == name; });
        return at == kTypes.end() ? std::nullopt : std::optional(at->second);
    }
    static std::size_t sizeOf(Type type)
    {
        static constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
        return kSizes[static_cast<std::size_t>(type)];
    }

    Problem parse() override
    {
        if (auto problem = header()) {
            return problem;
        }
        for (const Element& element : elements_) {
            if (element.name == "vertex") {
                vertex_count_ = element.count;
            }
        }
        for (const Element& element : elements_) {
            if (auto problem = body(element)) {
                return problem;
            }
        }
        return std::nullopt;
    }

    Problem header()
    {
        Lines lines(text_);
        bool has_format = false;
        while (lines.next('\0')) {
            const std::string_view keyword = lines.word();
            if (lines.number() == 1) {
                if (keyword != "ply") {
                    return atLine(1, fmt::format("a PLY file begins with \"ply\", this one with {}",
                                                 shown(lines.line())));
                }
            } else if (keyword == "format") {
                const std::string_view name = lines.word();
                has_format = true;
                if (name == "ascii") {
                    encoding_ = Encoding::Ascii;
                } else if (name == "binary_little_endian") {
                    encoding_ = Encoding::LittleEndian;
                } else if (name == "binary_big_endian") {
                    encoding_ = Encoding::BigEndian;
                } else {
                    return atLine(lines.number(),
                                  fmt::format("{} is not a PLY format", shown(name)));
                }
            } else if (keyword == "element") {
                Element element;
                element.name = lines.word();
                const std::string_view word = lines.word();
                const auto count = parsed<std::uint64_t>(word);
                if (!count) {
                    return atLine(lines.number(),
                                  fmt::format("{} is not a number of elements", shown(word)));
                }
                element.count = *count;
                elements_.push_back(std::move(element));
            } else if (keyword == "property") {
                if (auto problem = property(lines)) {
                    return problem;
                }
            } else if (keyword == "end_header") {
                if (!has_format) {
                    return atLine(lines.number(), "the header ends without a format");
                }
                at_ = lines.position();
                lines_ = lines;
                return std::nullopt;
            } else if (keyword != "comment" && keyword != "obj_info") {
                return atLine(lines.number(),
                              fmt::format("{} is not a line of a PLY header", shown(keyword)));
            }
        }
        return atLine(lines.number(), "the file ends within the header");
    }

    Problem property(Lines& lines)
    {
        if (elements_.empty()) {
            return atLine(lines.number(), "a property comes before the first element");
        }
        Property property;
        std::string_view type = lines.word();
        if (type == "list") {
            const std::string_view count_type = lines.word();
            property.count_type = typeOf(count_type);
            if (!property.count_type || *property.count_type == Type::Float ||
                *property.count_type == Type::Double) {
                return atLine(lines.number(),
                              fmt::format("{} is not a type that counts", shown(count_type)));
            }
            type = lines.word();
        }
        const auto known = typeOf(type);
        if (!known) {
            return atLine(lines.number(), fmt::format("{} is not a PLY type", shown(type)));
        }
        property.type = *known;
        property.name = lines.word();
        elements_.back().properties.push_back(std::move(property));
        return std::nullopt;
    }

    // One number; empty if missing. Integers of 32 bits are exact as doubles.
    std::optional<double> number(Type type)
    {
        if (encoding_ == Encoding::Ascii) {
            word_ = lines_.word();
            return parsed<double>(word_);
        }
        const std::size_t size = sizeOf(type);
        if (text_.size() - at_ < size) {
            return std::nullopt;
        }
        std::array<unsigned char, 8> bytes{};
        std::memcpy(bytes.data(), text_.data() + at_, size);
        at_ += size;
        if ((encoding_ == Encoding::BigEndian) != (std::endian::native == std::endian::big)) {
            std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        }
        switch (type) {
        case Type::Int8:
            return as<std::int8_t>(bytes);
        case Type::Uint8:
            return as<std::uint8_t>(bytes);
        case Type::Int16:
            return as<std::int16_t>(bytes);
        case Type::Uint16:
            return as<std::uint16_t>(bytes);
        case Type::Int32:
            return as<std::int32_t>(bytes);
        case Type::Uint32:
            return as<std::uint32_t>(bytes);
        case Type::Float:
            return as<float>(bytes);
        case Type::Double:
            return as<double>(bytes);
        }
        return std::nullopt;
    }
    template <typename T>
    static double as(const std::array<unsigned char, 8>& bytes)
    {
        T value{};
        std::memcpy(&value, bytes.data(), sizeof(T));
        return static_cast<double>(value);
    }
    Problem noNumber() const
    {
        if (encoding_ != Encoding::Ascii) {
            return atByte(text_.size(), "the file ends early");
        }
        return atLine(lines_.number(), word_.empty()
                                           ? "a number is missing"
                                           : fmt::format("{} is not a number", shown(word_)));
    }
    Problem here(const std::string& what) const
    {
        return encoding_ == Encoding::Ascii ? atLine(lines_.number(), what) : atByte(at_, what);
    }

    Problem body(const Element& element)
    {
        const auto find = [&element](std::string_view name) {
            const auto at = std::find_if(element.properties.begin(), element.properties.end(),
                                         [name](const Property& p) { return p.name == name; });
            return static_cast<std::size_t>(at - element.properties.begin());
        };
        const std::size_t none = element.properties.size();
        const bool is_vertex = element.name == "vertex";
        const bool is_face = element.name == "face";
        const std::array<std::size_t, 3> xyz{find("x"), find("y"), find("z")};
        const std::size_t list =
            find("vertex_indices") != none ? find("vertex_indices") : find("vertex_index");
        if (is_vertex && (xyz[0] == none || xyz[1] == none || xyz[2] == none)) {
            return inFile("its vertices have no x, y and z");
        }
        if (is_face && (list == none || !element.properties[list].count_type)) {
            return inFile("its faces have no list vertex_indices");
        }
        if (encoding_ != Encoding::Ascii && element.properties.empty()) {
            return std::nullopt;
        }
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (encoding_ == Encoding::Ascii && !lines_.next('\0')) {
                return atLine(lines_.number(),
                              fmt::format("the file ends after {} of {} elements \"{}\"", i,
                                          element.count, element.name));
            }
            if (auto stop = canceled(encoding_ == Encoding::Ascii ? lines_.position() : at_)) {
                return stop;
            }
            std::array<double, 3> point{};
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                const Property& property = element.properties[p];
                if (property.count_type) {
                    if (auto problem = readList(property, is_face && p == list)) {
                        return problem;
                    }
                    continue;
                }
                const auto value = number(property.type);
                if (!value) {
                    return noNumber();
                }
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    point[axis] = xyz[axis] == p ? *value : point[axis];
                }
            }
            if (is_vertex) {
                soup_.vertices.push_back({point[0], point[1], point[2]});
            }
        }
        return std::nullopt;
    }

    Problem readList(const Property& property, bool is_polygon)
    {
        const auto count = number(*property.count_type);
        if (!count) {
            return noNumber();
        }
        if (!(*count >= 0.0 && *count <= 4294967295.0) || *count != std::floor(*count)) {
            return here(fmt::format("a list has {} elements", *count));
        }
        const auto size = static_cast<std::uint64_t>(*count);
        polygon_.clear();
        for (std::uint64_t i = 0; i < size; ++i) {
            const auto value = number(property.type);
            if (!value) {
                return noNumber();
            }
            if (!is_polygon) {
                continue;
            }
            if (!(*value >= 0.0 && *value < static_cast<double>(vertex_count_)) ||
                *value != std::floor(*value)) {
                return here(fmt::format("a face names vertex {}, counted from 0, there are {}",
                                        *value, vertex_count_));
            }
            polygon_.push_back(static_cast<std::uint32_t>(*value));
        }
        if (is_polygon) {
            if (size < 3) {
                return here(fmt::format("a face has {} corners", size));
            }
            addPolygon();
        }
        return std::nullopt;
    }

    Encoding encoding_ = Encoding::Ascii;
    std::vector<Element> elements_;
    std::uint64_t vertex_count_ = 0;
    std::size_t at_ = 0;      // in binary data
    Lines lines_{text_};      // in ascii data
    std::string_view word_{}; // that is not a number
};

// 3D Systems, "StereoLithography interface specification", 1989.
class StlReader final : public Reader {
public:
    using Reader::Reader;

private:
    static constexpr std::size_t kHeader = 84; // ends with the number of triangles
    static constexpr std::size_t kTriangle = 50;

    Problem parse() override
    {
        // Binary files may begin with "solid" too, but only they have exactly this size.
        const bool has_count = text_.size() >= kHeader;
        const std::uint64_t count = has_count ? littleEndian(kHeader - 4) : 0;
        if (has_count && text_.size() == kHeader + kTriangle * count) {
            return binary(count);
        }
        if (isAscii()) {
            return ascii();
        }
        return has_count
                   ? atByte(kHeader - 4,
                            fmt::format("{} triangles are announced, which is a file of {} bytes, "
                                        "this one has {}",
                                        count, kHeader + kTriangle * count, text_.size()))
                   : inFile(fmt::format("an STL file has {} bytes or more, or begins with "
                                        "\"solid\"; this one has {}",
                                        kHeader, text_.size()));
    }

    bool isAscii() const
    {
        Lines lines(text_.substr(0, 4096));
        return lines.next('\0') && lines.word() == "solid" &&
               (!lines.next('\0') || isAsciiKeyword(lines.word()));
    }
    static bool isAsciiKeyword(std::string_view word)
    {
        return word == "facet" || word == "endsolid" ||
               std::all_of(word.begin(), word.end(), [](char c) { return c >= ' ' && c <= '~'; });
    }

    std::uint32_t littleEndian(std::size_t at) const
    {
        std::uint32_t value = 0;
        for (std::size_t i = 4; i > 0; --i) {
            value = value << 8U | static_cast<unsigned char>(text_[at + i - 1]);
        }
        return value;
    }

    Problem binary(std::uint64_t count)
    {
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::size_t begin = kHeader + kTriangle * static_cast<std::size_t>(i);
            if (auto stop = canceled(begin)) {
                return stop;
            }
            MeshFace face{};
            for (std::size_t corner = 0; corner < 3; ++corner) {
                std::array<double, 3> xyz{};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const std::uint32_t bits = littleEndian(begin + 12 + 12 * corner + 4 * axis);
                    xyz[axis] = static_cast<double>(std::bit_cast<float>(bits));
                }
                face[corner] = welded({xyz[0], xyz[1], xyz[2]});
            }
            soup_.faces.push_back(face);
        }
        return std::nullopt;
    }

    Problem ascii()
    {
        Lines lines(text_);
        bool is_closed = true;
        bool is_in_facet = false;
        while (lines.next('\0')) {
            if (auto stop = canceled(lines.position())) {
                return stop;
            }
            const std::string_view keyword = lines.word();
            if (keyword == "solid") {
                is_closed = false;
            } else if (keyword == "endsolid") {
                is_closed = true;
            } else if (keyword == "facet") {
                is_in_facet = true;
                polygon_.clear();
            } else if (keyword == "vertex" && is_in_facet) {
                ScenePoint p;
                if (auto problem = point(lines, p)) {
                    return problem;
                }
                polygon_.push_back(welded(p));
            } else if (keyword == "endfacet" && is_in_facet) {
                is_in_facet = false;
                if (polygon_.size() != 3) {
                    return atLine(lines.number(),
                                  fmt::format("a facet has {} vertices", polygon_.size()));
                }
                addPolygon();
            } else if (!is_in_facet || (keyword != "outer" && keyword != "endloop")) {
                return atLine(lines.number(),
                              fmt::format("{} is not an STL statement here", shown(keyword)));
            }
        }
        return is_closed && !is_in_facet
                   ? std::nullopt
                   : atLine(lines.number(), "the file ends before \"endsolid\"");
    }

    // Equal coordinates mean the same vertex; -0 equals 0.
    std::uint32_t welded(const ScenePoint& p)
    {
        const std::array<std::uint64_t, 3> key{std::bit_cast<std::uint64_t>(p.x + 0.0),
                                               std::bit_cast<std::uint64_t>(p.y + 0.0),
                                               std::bit_cast<std::uint64_t>(p.z + 0.0)};
        const auto [at, is_new] =
            known_.try_emplace(key, static_cast<std::uint32_t>(soup_.vertices.size()));
        if (is_new) {
            soup_.vertices.push_back(p);
        }
        return at->second;
    }

    struct Hash {
        std::size_t operator()(const std::array<std::uint64_t, 3>& key) const noexcept
        {
            std::uint64_t hash = 0;
            for (const std::uint64_t part : key) {
                hash = (hash ^ part) * 0x9e3779b97f4a7c15U;
                hash ^= hash >> 32U;
            }
            return static_cast<std::size_t>(hash);
        }
    };
    std::unordered_map<std::array<std::uint64_t, 3>, std::uint32_t, Hash> known_;
};

Result<std::string> contentOf(const std::string& path)
{
    std::error_code failure;
    if (!std::filesystem::is_regular_file(path, failure) &&
        std::filesystem::exists(path, failure)) {
        return Error{ErrorCode::Unsupported, fmt::format("{}: is not a regular file", path)};
    }
    // Reading and checking a mesh takes several times its size.
    constexpr std::uintmax_t kBytesMax = std::uintmax_t{8} << 30U;
    const std::uintmax_t bytes = std::filesystem::file_size(path, failure);
    if (!failure && bytes > kBytesMax) {
        return Error{
            ErrorCode::TooLarge,
            fmt::format("{}: has {} bytes; meshes of up to {} are read", path, bytes, kBytesMax)};
    }
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) {
        return Error{ErrorCode::NotFound, fmt::format("{}: cannot be opened", path)};
    }
    const std::streamoff size = file.tellg();
    std::string content;
    if (size > 0) {
        content.resize(static_cast<std::size_t>(size));
        file.seekg(0);
        file.read(content.data(), size);
    }
    if (!file || size < 0) {
        return Error{ErrorCode::Unreadable, fmt::format("{}: cannot be read", path)};
    }
    return content;
}

std::string endingOf(const std::string& path)
{
    const std::size_t dot = path.find_last_of("./\\");
    if (dot == std::string::npos || path[dot] != '.') {
        return {};
    }
    std::string ending = path.substr(dot + 1);
    std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return ending;
}

} // namespace

Result<TriangleSoup> readTriangles(const std::string& path, JobMonitor& monitor)
{
    const std::string ending = endingOf(path);
    if (ending != "obj" && ending != "ply" && ending != "stl") {
        return Error{
            ErrorCode::Unsupported,
            fmt::format("{}: is not a mesh by its name; .obj, .ply and .stl are read", path)};
    }
    const auto content = contentOf(path);
    if (!content) {
        return content.error();
    }
    return ending == "obj"   ? ObjReader(path, *content, monitor).read()
           : ending == "ply" ? PlyReader(path, *content, monitor).read()
                             : StlReader(path, *content, monitor).read();
}

Result<std::shared_ptr<const TriangleMesh>>
loadMesh(const std::string& path, double exaggeration, JobMonitor& monitor)
{
    monitor.beginStage(0.0, 0.3);
    auto soup = readTriangles(path, monitor);
    if (!soup) {
        return std::move(soup).error();
    }
    for (ScenePoint& vertex : soup->vertices) {
        vertex.z *= exaggeration;
    }
    monitor.beginStage(0.3, 1.0);
    auto mesh = TriangleMesh::build(std::move(*soup), monitor);
    if (!mesh) {
        return Error{mesh.error().code, fmt::format("{}: {}", path, mesh.error().message)};
    }
    return mesh;
}

} // namespace marsview
