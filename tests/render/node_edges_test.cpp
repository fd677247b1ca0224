// Neighboring nodes have the same vertices on their common edge, to the last bit: otherwise there
// are cracks. Checks the output of the vertex shader through transform feedback.

#include "core/terrain/drawn_surface.h"
#include "tests/render/render_fixture.h"
#include "ui/render/node_instance.h"
#include "ui/render/opengl/gl_objects.h"
#include "ui/render/terrain_shaders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

constexpr std::size_t kCells = DetailErrors::kNodeCells;
constexpr std::size_t kSide = kCells + 1;
constexpr std::size_t kVertices = kSide * kSide;
constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

// gl_Position and v_sample, unchanged.
using Bits = std::array<std::uint32_t, 6>;

// A program with the renderer's vertex stage alone.
class FeedbackProgram {
public:
    FeedbackProgram()
        : id_(glCreateProgram())
    {
        const GLuint vertex = shader(GL_VERTEX_SHADER, TerrainShaders::vertexSource());
        const GLuint fragment = shader(GL_FRAGMENT_SHADER,
                                       "#version 330 core\nout vec4 color;\n"
                                       "void main() { color = vec4(0.0); }\n");
        glAttachShader(id_, vertex);
        glAttachShader(id_, fragment);
        const std::array<const char*, 2> outputs{"gl_Position", "v_sample"};
        glTransformFeedbackVaryings(id_, 2, outputs.data(), GL_INTERLEAVED_ATTRIBS);
        glLinkProgram(id_);
        glDeleteShader(vertex);
        glDeleteShader(fragment);
        GLint is_linked = GL_FALSE;
        glGetProgramiv(id_, GL_LINK_STATUS, &is_linked);
        EXPECT_EQ(is_linked, GL_TRUE);
    }
    ~FeedbackProgram() { glDeleteProgram(id_); }
    FeedbackProgram(const FeedbackProgram&) = delete;
    FeedbackProgram& operator=(const FeedbackProgram&) = delete;

    GLuint id() const { return id_; }
    GLint uniform(const char* name) const { return glGetUniformLocation(id_, name); }

private:
    static GLuint shader(GLenum stage, const std::string& source)
    {
        const GLuint id = glCreateShader(stage);
        const char* text = source.c_str();
        glShaderSource(id, 1, &text, nullptr);
        glCompileShader(id);
        return id;
    }

    GLuint id_;
};

// Draws nodes and returns kVertices entries per node, row by row.
class NodeVertices {
public:
    NodeVertices()
        : atlas_(32, 32)
    {
        // Drawing needs a frame buffer, even if no pixels are written.
        glBindRenderbuffer(GL_RENDERBUFFER, color_.id());
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 1, 1);
        glBindFramebuffer(GL_FRAMEBUFFER, frame_.id());
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                  color_.id());
        std::vector<std::uint8_t> cells;
        for (std::size_t row = 0; row < kSide; ++row) {
            for (std::size_t column = 0; column < kSide; ++column) {
                cells.push_back(static_cast<std::uint8_t>(column));
                cells.push_back(static_cast<std::uint8_t>(row));
            }
        }
        glBindVertexArray(array_.id());
        glBindBuffer(GL_ARRAY_BUFFER, cells_.id());
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(cells.size()), cells.data(),
                     GL_STATIC_DRAW);
        glEnableVertexAttribArray(kCellAttribute);
        glVertexAttribPointer(kCellAttribute, 2, GL_UNSIGNED_BYTE, GL_FALSE, 2, nullptr);
        glBindBuffer(GL_ARRAY_BUFFER, instances_.id());
        describeNodeInstances();
    }

    std::vector<Bits>
    of(const DrawnMap& map, const DetailView& view, const DetailSelection& selection)
    {
        const DrawnSurface surface(*map.field, map.analysis->means);
        const std::size_t columns = map.field->columns();
        const std::size_t rows = map.field->rows();
        const ScenePoint eye = eyeOf(view.camera);
        const GridPoint anchor = nodeAnchor(map.frame.toGrid(eye), columns, rows);
        glUseProgram(program_.id());
        glUniform1i(program_.uniform("u_heights"), 0);
        glUniform2f(program_.uniform("u_last_sample"),
                    static_cast<GLfloat>(static_cast<double>(columns - 1) - anchor.column),
                    static_cast<GLfloat>(static_cast<double>(rows - 1) - anchor.row));
        const Vec3 from_eye =
            map.frame.toScene(anchor, surface.baseMeters() * view.exaggeration) - eye;
        glUniform3f(program_.uniform("u_anchor_from_eye"), static_cast<GLfloat>(from_eye.x),
                    static_cast<GLfloat>(from_eye.y), static_cast<GLfloat>(from_eye.z));
        glUniform4f(program_.uniform("u_frame"), static_cast<GLfloat>(map.frame.east_per_column),
                    static_cast<GLfloat>(map.frame.east_per_row),
                    static_cast<GLfloat>(map.frame.north_per_column),
                    static_cast<GLfloat>(map.frame.north_per_row));
        glUniform1f(program_.uniform("u_exaggeration"), static_cast<GLfloat>(view.exaggeration));
        const Matrix4 clip = projection(view.camera, view.viewport,
                                        clipRange(view.camera, map.box(view.exaggeration))) *
                             viewRotation(view.camera);
        std::array<GLfloat, 16> matrix{};
        std::transform(clip.values.begin(), clip.values.end(), matrix.begin(),
                       [](double v) { return static_cast<GLfloat>(v); });
        glUniformMatrix4fv(program_.uniform("u_clip_from_eye"), 1, GL_FALSE, matrix.data());

        std::vector<Bits> vertices;
        std::vector<NodeInstance> batch;
        atlas_.beginRound();
        const std::uint32_t number = next_map_++;
        std::vector<TileId> missing; // none: the samples are in memory
        const auto flush = [&] {
            draw(batch, vertices);
            batch.clear();
            atlas_.beginRound();
        };
        for (const SelectedNode& selected : selection.nodes) {
            const LayerNode key{.layer = number, .node = selected.node};
            auto place = atlas_.place(key, surface, 0, missing);
            if (!place) {
                flush();
                place = atlas_.place(key, surface, 0, missing);
            }
            batch.push_back(nodeInstance(selected, anchor, surface.baseMeters(), *place,
                                         {.page = 0, .layer = 0, .node = selected.relief}));
        }
        flush();
        return vertices;
    }

private:
    void draw(const std::vector<NodeInstance>& batch, std::vector<Bits>& vertices)
    {
        if (batch.empty()) {
            return;
        }
        atlas_.bind(GL_TEXTURE0);
        glBindVertexArray(array_.id());
        glBindBuffer(GL_ARRAY_BUFFER, instances_.id());
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(batch.size() * sizeof(NodeInstance)),
                     batch.data(), GL_STREAM_DRAW);
        const std::size_t count = batch.size() * kVertices;
        const auto bytes = static_cast<GLsizeiptr>(count * sizeof(Bits));
        glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, results_.id());
        glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, bytes, nullptr, GL_STREAM_READ);
        glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, results_.id());
        glEnable(GL_RASTERIZER_DISCARD);
        glBeginTransformFeedback(GL_POINTS);
        glDrawArraysInstanced(GL_POINTS, 0, static_cast<GLsizei>(kVertices),
                              static_cast<GLsizei>(batch.size()));
        glEndTransformFeedback();
        glDisable(GL_RASTERIZER_DISCARD);
        const std::size_t before = vertices.size();
        vertices.resize(before + count);
        glGetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, bytes, &vertices[before]);
        ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }

    FeedbackProgram program_;
    HeightAtlas atlas_;
    GlVertexArray array_;
    GlBuffer cells_;
    GlBuffer instances_;
    GlBuffer results_;
    GlFramebuffer frame_;
    GlRenderbuffer color_;
    std::uint32_t next_map_ = 0;
};

// One side of a node on the grid: its position, and the indices of its vertices in the node.
struct Side {
    std::size_t begin = 0; // along the side, samples
    std::size_t end = 0;
};

struct Tally {
    std::array<std::size_t, 4> edges_by_difference{};
    std::size_t odd = 0;
    std::size_t morphing = 0; // edges with vertices between two levels
};

void compareEdge(const std::vector<Bits>& vertices,
                 std::size_t a,
                 std::size_t b,
                 bool is_vertical,
                 const DetailSelection& selection,
                 const DrawnMap& map,
                 Tally& tally)
{
    const auto& nodes = selection.nodes;
    const std::size_t last = (is_vertical ? map.field->rows() : map.field->columns()) - 1;
    const auto side = [&](std::size_t n) {
        const DetailNode& node = nodes[n].node;
        const std::size_t first = (is_vertical ? node.row : node.column) * kCells << node.level;
        return Side{first, std::min(first + (kCells << node.level), last)};
    };
    const Side common{std::max(side(a).begin, side(b).begin), std::min(side(a).end, side(b).end)};
    // `a` lies left of or above `b`.
    const auto onEdge = [&](std::size_t n, std::size_t fixed) {
        std::set<Bits> set;
        const DetailNode& node = nodes[n].node;
        for (std::size_t k = 0; k < kSide; ++k) {
            const std::size_t place =
                std::min(((is_vertical ? node.row : node.column) * kCells + k) << node.level, last);
            if (place >= common.begin && place <= common.end) {
                const std::size_t at = is_vertical ? k * kSide + fixed : fixed * kSide + k;
                set.insert(vertices[n * kVertices + at]);
            }
        }
        return set;
    };
    const std::set<Bits> of_a = onEdge(a, kCells);
    const std::set<Bits> of_b = onEdge(b, 0);
    const std::size_t low = std::min(nodes[a].node.level, nodes[b].node.level);
    const std::size_t high = std::max(nodes[a].node.level, nodes[b].node.level);
    ++tally.edges_by_difference.at(std::min<std::size_t>(high - low, 3));
    tally.odd += of_a == of_b ? 0U : 1U;
    tally.morphing += std::any_of(of_a.begin(), of_a.end(),
                                  [](const Bits& bits) {
                                      const float column = std::bit_cast<float>(bits[4]);
                                      const float row = std::bit_cast<float>(bits[5]);
                                      return column != std::floor(column) || row != std::floor(row);
                                  })
                          ? 1U
                          : 0U;
}

void compareEdges(const std::vector<Bits>& vertices,
                  const DetailSelection& selection,
                  const DrawnMap& map,
                  Tally& tally)
{
    const std::size_t columns = map.analysis->errors.columns(0);
    const std::size_t rows = map.analysis->errors.rows(0);
    std::vector<std::size_t> owner(columns * rows, kNobody);
    for (std::size_t n = 0; n < selection.nodes.size(); ++n) {
        const DetailNode& node = selection.nodes[n].node;
        for (std::size_t row = node.row << node.level;
             row < std::min((node.row + 1) << node.level, rows); ++row) {
            for (std::size_t column = node.column << node.level;
                 column < std::min((node.column + 1) << node.level, columns); ++column) {
                owner[row * columns + column] = n;
            }
        }
    }
    std::set<std::array<std::size_t, 2>> right;
    std::set<std::array<std::size_t, 2>> below;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t n = owner[row * columns + column];
            const std::size_t r = column + 1 < columns ? owner[row * columns + column + 1] : n;
            const std::size_t d = row + 1 < rows ? owner[(row + 1) * columns + column] : n;
            if (n != kNobody && r != kNobody && r != n) {
                right.insert({n, r});
            }
            if (n != kNobody && d != kNobody && d != n) {
                below.insert({n, d});
            }
        }
    }
    for (const auto& [a, b] : right) {
        compareEdge(vertices, a, b, true, selection, map, tally);
    }
    for (const auto& [a, b] : below) {
        compareEdge(vertices, a, b, false, selection, map, tally);
    }
}

SceneFrame askew(std::size_t columns, std::size_t rows)
{
    SceneFrame frame = northUpFrame(columns, rows, 1.0);
    frame.east_per_column = 24.0;
    frame.north_per_column = 18.0;
    frame.east_per_row = -15.0;
    frame.north_per_row = 22.0;
    return frame;
}

class NodeEdges : public RenderTest {
protected:
    DetailView randomView(const DrawnMap& map, double exaggeration)
    {
        const SceneBox box = map.box(exaggeration);
        const double x = random_.uniform(box.minimum.x, box.maximum.x);
        const double y = random_.uniform(box.minimum.y, box.maximum.y);
        const double ground = map.ground(x, y, exaggeration);
        const double size =
            std::hypot(box.maximum.x - box.minimum.x, box.maximum.y - box.minimum.y);
        return {.camera = {.target = {x, y, std::isnan(ground) ? 0.0 : ground},
                           .distance_m = size * std::pow(10.0, random_.uniform(-2.5, 0.3)),
                           .azimuth = Angle::degrees(random_.uniform(0.0, 360.0)),
                           .tilt = Angle::degrees(random_.uniform(0.0, 80.0))},
                .viewport = {.width = 1000, .height = 700},
                .exaggeration = exaggeration};
    }

    void compare(const DrawnMap& map, const std::vector<double>& exaggerations, int shots)
    {
        NodeVertices node_vertices;
        DetailSelector selector(map.analysis, map.field->columns(), map.field->rows(), map.frame);
        for (int i = 0; i < shots; ++i) {
            const DetailView view =
                randomView(map, exaggerations[random_.below(exaggerations.size())]);
            constexpr std::array<double, 3> kErrors{1.0, 2.0, 8.0};
            const DetailSelection selection =
                selector.select(view, {.error_px = kErrors.at(random_.below(3))});
            const std::vector<Bits> vertices = node_vertices.of(map, view, selection);
            ASSERT_EQ(vertices.size(), selection.nodes.size() * kVertices);
            const std::size_t odd = tally_.odd;
            compareEdges(vertices, selection, map, tally_);
            EXPECT_EQ(tally_.odd, odd) << "shot " << i << ", exaggeration " << view.exaggeration;
        }
    }

    Random random_;
    Tally tally_;
};

TEST_F(NodeEdges, HaveTheSameBitsOnBothSides)
{
    const auto heights = fractalHeights(random_, 1500, 1300, 3000.0, 0.5);
    const auto fractal = heightsFrom(heights, 1500);
    compare({floatTerrain(1500, 1300, fractal), northUpFrame(1500, 1300, 30.0)},
            {0.1, 1.0, 1.0, 3.0, 20.0}, 12);
    compare({int16Terrain(1411, 1027, {}, fractal), askew(1411, 1027)}, {1.0, 2.0, 10.0}, 12);
    compare({floatTerrain(1300, 1300,
                          [&](std::size_t c, std::size_t r) {
                              return c + 2 * r > 1600 ? 0.0 : fractal(c, r);
                          }),
             northUpFrame(1300, 1300, 200.0)},
            {1.0, 5.0}, 12);
    compare(
        {floatTerrain(1025, 900, [](std::size_t c, std::size_t) { return c < 600 ? 0.0 : 4000.0; }),
         northUpFrame(1025, 900, 30.0)},
        {1.0, 4.0}, 10);
    EXPECT_EQ(tally_.odd, 0U);
    EXPECT_GT(tally_.edges_by_difference[0], 1000U);
    EXPECT_GT(tally_.edges_by_difference[1], 200U);
    EXPECT_EQ(tally_.edges_by_difference[3], 0U);
    EXPECT_GT(tally_.morphing, 100U) << "some edges must be seen half-way through a morph";
    std::printf("edges by difference of level: %zu, %zu, %zu; %zu half-way\n",
                tally_.edges_by_difference[0], tally_.edges_by_difference[1],
                tally_.edges_by_difference[2], tally_.morphing);
}

TEST_F(NodeEdges, HaveTheSameBitsAtVoids)
{
    const auto fractal = heightsFrom(fractalHeights(random_, 1200, 1200, 3000.0, 0.5), 1200);
    compare({floatTerrain(1200, 1200,
                          [&](std::size_t c, std::size_t r) {
                              const bool is_hole = c > 300 && c < 520 && r > 100 && r < 433;
                              return is_hole || c + r < 400 || random_.chance(0.02) ? std::nan("")
                                                                                    : fractal(c, r);
                          }),
             northUpFrame(1200, 1200, 30.0)},
            {1.0, 3.0, 10.0}, 25);
    EXPECT_EQ(tally_.odd, 0U);
    EXPECT_GT(tally_.edges_by_difference[1], 100U);
}

} // namespace
} // namespace marsview::test
