#include "core/mesh/mesh_file.h"
#include "tests/core/mesh/mesh_shapes.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>

#include <bit>
#include <clocale>
#include <cstring>
#include <fmt/format.h>

namespace marsview {
namespace {

class MeshFile : public testing::Test {
protected:
    std::string write(const std::string& name, const std::string& content)
    {
        return folder_.write(name, content);
    }
    Result<TriangleSoup> read(const std::string& name, const std::string& content)
    {
        JobMonitor monitor;
        return readTriangles(write(name, content), monitor);
    }
    // The error message without the path.
    std::string refusal(const std::string& name, const std::string& content)
    {
        const auto soup = read(name, content);
        if (soup) {
            return "was read";
        }
        const std::string& message = soup.error().message;
        const std::size_t at = message.find(name);
        EXPECT_NE(at, std::string::npos) << message;
        return at == std::string::npos ? message : message.substr(at);
    }

    test::TempFolder folder_;
};

std::string objOf(const TriangleSoup& soup)
{
    std::string text;
    for (const ScenePoint& v : soup.vertices) {
        text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    }
    for (const auto& [a, b, c] : soup.faces) {
        text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    }
    return text;
}

template <typename T>
void append(std::string& bytes, T value, std::endian order)
{
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    if (order != std::endian::native) {
        std::reverse(raw.begin(), raw.end());
    }
    bytes.append(raw.data(), raw.size());
}

std::string plyOf(const TriangleSoup& soup, const std::string& format)
{
    std::string text = fmt::format(
        "ply\nformat {} 1.0\ncomment made by a test\nelement vertex {}\n"
        "property double x\nproperty double y\nproperty uchar red\n"
        "property double z\nelement face {}\n"
        "property list uchar int vertex_indices\nproperty float area\n"
        "end_header\n",
        format, soup.vertices.size(), soup.faces.size());
    if (format == "ascii") {
        for (const ScenePoint& v : soup.vertices) {
            text += fmt::format("{} {} 255 {}\n", v.x, v.y, v.z);
        }
        for (const auto& [a, b, c] : soup.faces) {
            text += fmt::format("3 {} {} {} 0.5\n", a, b, c);
        }
        return text;
    }
    const std::endian order =
        format == "binary_big_endian" ? std::endian::big : std::endian::little;
    for (const ScenePoint& v : soup.vertices) {
        append(text, v.x, order);
        append(text, v.y, order);
        append(text, std::uint8_t{255}, order);
        append(text, v.z, order);
    }
    for (const auto& face : soup.faces) {
        append(text, std::uint8_t{3}, order);
        for (const std::uint32_t v : face) {
            append(text, static_cast<std::int32_t>(v), order);
        }
        append(text, 0.5F, order);
    }
    return text;
}

std::string binaryStlOf(const TriangleSoup& soup)
{
    std::string bytes = "solid although binary";
    bytes.resize(80, ' ');
    append(bytes, static_cast<std::uint32_t>(soup.faces.size()), std::endian::little);
    for (const auto& face : soup.faces) {
        bytes.append(12, '\0');
        for (const std::uint32_t v : face) {
            for (const double x : {soup.vertices[v].x, soup.vertices[v].y, soup.vertices[v].z}) {
                append(bytes, static_cast<float>(x), std::endian::little);
            }
        }
        bytes.append(2, '\0');
    }
    return bytes;
}

std::string asciiStlOf(const TriangleSoup& soup)
{
    std::string text = "solid made by a test\n";
    for (const auto& face : soup.faces) {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for (const std::uint32_t v : face) {
            text += fmt::format("      vertex {:e} {:e} {:e}\n", soup.vertices[v].x,
                                soup.vertices[v].y, soup.vertices[v].z);
        }
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid made by a test\n";
}

// The same triangles in the same order, whatever the vertex indices.
void expectSame(const TriangleSoup& soup, const TriangleSoup& truth, double tolerance)
{
    ASSERT_EQ(soup.faces.size(), truth.faces.size());
    EXPECT_EQ(soup.vertices.size(), truth.vertices.size());
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 difference =
                soup.vertices[soup.faces[f][i]] - truth.vertices[truth.faces[f][i]];
            EXPECT_LE(length(difference), tolerance) << f << ", " << i;
        }
    }
}

TEST_F(MeshFile, EveryFormatGivesTheTriangles)
{
    const TriangleSoup truth = test::placed(test::icosphere(1), 1.0, {}, test::Turned::Yes);
    struct Case {
        std::string name;
        std::string content;
        double tolerance;
    };
    for (const auto& [name, content, tolerance] : std::vector<Case>{
             {"a.obj", objOf(truth), 0.0},
             {"a.OBJ", objOf(truth), 0.0},
             {"b.ply", plyOf(truth, "ascii"), 0.0},
             {"c.ply", plyOf(truth, "binary_little_endian"), 0.0},
             {"d.ply", plyOf(truth, "binary_big_endian"), 0.0},
             {"e.stl", asciiStlOf(truth), 1e-6},
             {"f.stl", binaryStlOf(truth), 1e-6},
         }) {
        SCOPED_TRACE(name);
        const auto soup = read(name, content);
        ASSERT_TRUE(soup) << soup.error().message;
        expectSame(*soup, truth, tolerance);
        JobMonitor monitor;
        const auto mesh = loadMesh(write(name, content), 1.0, monitor);
        ASSERT_TRUE(mesh) << mesh.error().message;
        EXPECT_EQ((*mesh)->faceCount(), truth.faces.size());
        EXPECT_EQ(monitor.fraction(), 1.0);
    }
}

TEST_F(MeshFile, ObjMayHaveNegativeIndicesAndOtherStatements)
{
    const auto soup = read("a.obj",
                           "# a comment\r\nmtllib some.mtl\r\no thing\r\n"
                           "v 0 0 0\r\nv 1.5e0 0 0 1.0\r\nv +1 1E0 0 # here\r\n"
                           "vn 0 0 1\r\nvt 0 0\r\ng group\r\ns off\r\nusemtl red\r\n"
                           "\tf -3/1/1 -2//1 -1/1\r\nv 0 1 -2.5e-1\r\n\r\n"
                           "f 1 2 3 4\r\nl 1 2\r\n");
    ASSERT_TRUE(soup) << soup.error().message;
    EXPECT_THAT(soup->faces,
                testing::ElementsAre(MeshFace{0, 1, 2}, MeshFace{0, 1, 2}, MeshFace{0, 2, 3}));
    EXPECT_EQ(soup->vertices[1], (ScenePoint{1.5, 0, 0}));
    EXPECT_EQ(soup->vertices[3], (ScenePoint{0, 1, -0.25}));
}

TEST_F(MeshFile, NumbersDoNotDependOnTheLocale)
{
    const char* const changed = std::setlocale(LC_ALL, "de_DE.UTF-8"); // NOLINT
    const auto soup = read("a.obj", "v 0.5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::setlocale(LC_ALL, "C"); // NOLINT
    ASSERT_TRUE(soup) << soup.error().message;
    EXPECT_EQ(soup->vertices[0].x, 0.5);
    if (changed == nullptr) {
        std::printf("this machine has no locale with a decimal comma\n");
    }
}

TEST_F(MeshFile, StlIsWeldedWhereCoordinatesAreEqual)
{
    const auto soup = read("a.stl", binaryStlOf(test::cube()));
    ASSERT_TRUE(soup);
    EXPECT_EQ(soup->vertices.size(), 8U);
    // 0 and -0 are the same coordinate.
    const auto zeros = read("b.stl",
                            "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                            "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
                            "facet normal 0 0 1\nouter loop\nvertex -0.0 0 0\n"
                            "vertex 0 1 0\nvertex -1 0 0\nendloop\nendfacet\nendsolid\n");
    ASSERT_TRUE(zeros) << zeros.error().message;
    EXPECT_EQ(zeros->vertices.size(), 4U);
}

TEST_F(MeshFile, ReportsErrorsWithTheirPositionInOneSentence)
{
    EXPECT_EQ(refusal("a.xyz", "1 2 3"),
              "a.xyz: is not a mesh by its name; .obj, .ply and .stl are read");
    EXPECT_EQ(refusal("a.obj", ""), "a.obj: holds no triangles");
    EXPECT_EQ(refusal("a.obj", "v 1 2 3\nv 1 2\n"), "a.obj: line 2: a coordinate is missing");
    EXPECT_EQ(refusal("a.obj", "v 1 2,5 3\n"), "a.obj: line 1: \"2,5\" is not a number");
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\nf 1 2 3\n"),
              "a.obj: line 4: a face names vertex 4, there are 3");
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nf -1 -2 -3\n"),
              "a.obj: line 2: a face names vertex -2, there are 1");
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nf 1 0 1\n"),
              "a.obj: line 2: \"0\" is not the number of a vertex");
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nf 1 1\n"), "a.obj: line 2: a face has 2 corners");
    EXPECT_EQ(refusal("a.obj",
                      "\x7f"
                      "ELF\x01\x02\n"),
              "a.obj: line 1: \"?ELF??\" is not an OBJ statement of polygons");
    EXPECT_EQ(refusal("a.ply", "solid x\n"),
              "a.ply: line 1: a PLY file begins with \"ply\", this one with \"solid x\"");
    EXPECT_EQ(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n"),
              "a.ply: line 3: the file ends within the header");
    EXPECT_EQ(refusal("a.ply", "ply\nformat pdp_endian 1.0\n"),
              "a.ply: line 2: \"pdp_endian\" is not a PLY format");
    EXPECT_EQ(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex -1\n"),
              "a.ply: line 3: \"-1\" is not a number of elements");
    EXPECT_EQ(refusal("a.ply",
                      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                      "property float y\nproperty float z\nend_header\n1 2 3\n"),
              "a.ply: line 8: the file ends after 1 of 2 elements \"vertex\"");
    EXPECT_EQ(refusal("a.ply",
                      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                      "property float y\nend_header\n1 2\n"),
              "a.ply: its vertices have no x, y and z");
    EXPECT_EQ(refusal("a.ply",
                      "ply\nformat ascii 1.0\nelement face 1\n"
                      "property list uchar int vertex_indices\nend_header\n3 0 1 2\n"),
              "a.ply: line 6: a face names vertex 0, counted from 0, there are 0");
    const std::string ply = plyOf(test::cube(), "binary_little_endian");
    EXPECT_EQ(refusal("a.ply", ply.substr(0, ply.size() - 3)),
              fmt::format("a.ply: byte {}: the file ends early", ply.size() - 3));
    const std::string stl = binaryStlOf(test::cube());
    EXPECT_EQ(refusal("a.stl", "\1" + stl.substr(1, stl.size() - 10)),
              "a.stl: byte 80: 12 triangles are announced, which is a file of 684 bytes, this one "
              "has 675");
    EXPECT_EQ(refusal("a.stl", "short"),
              "a.stl: an STL file has 84 bytes or more, or begins with "
              "\"solid\"; this one has 5");
    EXPECT_EQ(refusal("a.stl",
                      "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                      "endloop\nendfacet\nendsolid\n"),
              "a.stl: line 6: a facet has 1 vertices");
    EXPECT_EQ(refusal("a.stl", "solid x\nfacet normal 0 0 1\n"),
              "a.stl: line 2: the file ends before \"endsolid\"");
    JobMonitor monitor;
    const auto missing = readTriangles("/nowhere/a.stl", monitor);
    EXPECT_EQ(missing.error().message, "/nowhere/a.stl: cannot be opened");
    EXPECT_EQ(missing.error().code, ErrorCode::NotFound);
}

TEST_F(MeshFile, DoesNotTrustDeclaredSizes)
{
    // Memory for the announced counts would not be available.
    for (const std::string format : {"ascii", "binary_little_endian"}) {
        EXPECT_NE(refusal("a.ply", "ply\nformat " + format +
                                       " 1.0\nelement vertex 18446744073709551615\n"
                                       "property float x\nproperty float y\nproperty float z\n"
                                       "end_header\n0 0 0\n"),
                  "was read");
        EXPECT_NE(refusal("a.ply", "ply\nformat " + format +
                                       " 1.0\nelement face 1\n"
                                       "property list uint int vertex_indices\nend_header\n"
                                       "\xff\xff\xff\xff 0 0\n"),
                  "was read");
    }
}

TEST_F(MeshFile, FaultsOfTheMeshNameTheFile)
{
    JobMonitor monitor;
    const std::string path = write("a.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto mesh = loadMesh(path, 1.0, monitor);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().message, path +
                                        ": the mesh cannot be touched: 1 coordinate that is not "
                                        "a number within 1e12 m (vertex 1, 0, 0, nan)");
}

TEST_F(MeshFile, IsExaggeratedInZOnly)
{
    JobMonitor monitor;
    const std::string path = write("a.obj", "v 0 0 1\nv 1 0 -2\nv 0 1 0\nf 1 2 3\n");
    const auto mesh = loadMesh(path, 2.5, monitor);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ((*mesh)->vertex(0).z, 2.5);
    EXPECT_EQ((*mesh)->vertex(1).x, 1.0);
    EXPECT_EQ((*mesh)->vertex(1).z, -5.0);
}

TEST_F(MeshFile, CanBeCanceled)
{
    JobMonitor monitor;
    monitor.cancel();
    const std::string path = write("a.obj", objOf(test::icosphere(5)));
    EXPECT_EQ(readTriangles(path, monitor).error().code, ErrorCode::Canceled);
}

TEST_F(MeshFile, DamageIsReportedOrReadButNeverCrashes)
{
    test::Random random;
    const TriangleSoup truth = test::icosphere(1);
    const std::vector<std::pair<std::string, std::string>> files{
        {"a.obj", objOf(truth)},
        {"b.ply", plyOf(truth, "ascii")},
        {"c.ply", plyOf(truth, "binary_little_endian")},
        {"d.ply", plyOf(truth, "binary_big_endian")},
        {"e.stl", asciiStlOf(truth)},
        {"f.stl", binaryStlOf(truth)},
    };
    int refused = 0;
    int read_well = 0;
    for (const auto& [name, content] : files) {
        for (int i = 0; i < 400; ++i) {
            std::string damaged = content;
            if (random.chance(0.4)) {
                damaged.resize(random.below(damaged.size()));
            }
            for (std::size_t flips = random.below(6); flips > 0 && !damaged.empty(); --flips) {
                const std::size_t at =
                    random.chance(0.5) ? random.below(std::min(damaged.size(), std::size_t{300}))
                                       : random.below(damaged.size());
                damaged[at] = static_cast<char>(random.bits());
            }
            JobMonitor monitor;
            const auto mesh = loadMesh(write(name, damaged), 1.0, monitor);
            if (mesh) {
                ++read_well;
            } else {
                ++refused;
                EXPECT_THAT(mesh.error().message, testing::HasSubstr(name));
                EXPECT_EQ(mesh.error().message.find('\n'), std::string::npos);
            }
        }
    }
    std::printf("%d refused, %d read\n", refused, read_well);
    EXPECT_GT(refused, 500);
    EXPECT_GT(read_well, 50);
}

} // namespace
} // namespace marsview
