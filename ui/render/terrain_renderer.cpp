// Nodes (core/view/detail_selection.h) are drawn as instances of one square of 32 × 32 cells, whose
// heights come from the height atlas and whose shading comes from the relief cache. Positions are
// relative to a sample near the eye, so that floats suffice.

#include "ui/render/terrain_renderer.h"

#include "core/base/check.h"
#include "core/body/body_locator.h"
#include "core/globe/body_camera.h"
#include "core/globe/body_nodes.h"
#include "core/globe/map_walls.h"
#include "core/globe/sunlight.h"
#include "core/view/scene_box.h"
#include "ui/render/body_atlas.h"
#include "ui/render/cover_texture.h"
#include "ui/render/frame_target.h"
#include "ui/render/height_atlas.h"
#include "ui/render/node_instance.h"
#include "ui/render/opengl/gl_objects.h"
#include "ui/render/opengl/unfinished_draws.h"
#include "ui/render/relief_cache.h"
#include "ui/render/terrain_shaders.h"
#include "ui/render/wall_drawing.h"
#include "ui/render/warm_up.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <unordered_set>
#include <utility>

namespace marsview {
namespace {

constexpr int kCells = static_cast<int>(DetailErrors::kNodeCells);
constexpr int kSide = kCells + 1;
constexpr int kHalf = kCells / 2;
constexpr GLsizei kQuadrantIndices = 6 * kHalf * kHalf;
constexpr GLsizei kPoleIndices = 3 * kCells;

// How many tiles are sent to the driver for a picture in motion: a millisecond each in software.
constexpr std::size_t kHastyUploads = 8;

// Sizes of the stores in graphics memory. A software driver keeps them in main memory: a window of
// 1280 × 800 shows some 60 tiles of 0.8 MB and some 500 nodes of 4 kB; a GPU has more pixels to
// fill.
struct StoreSizes {
    std::size_t relief_tiles;
    std::size_t atlas_columns;
    std::size_t atlas_rows;
};
constexpr StoreSizes kStoresInSoftware{128, 32, 32};
constexpr StoreSizes kStoresOnGpu{512, 64, 64};

// Relief tiles in a picture, of those in store, so that the next picture's find room.
constexpr double kReliefShareMax = 0.75;

// Of the size that is asked for: half the bytes from a server, for texels of 1.06 pixels on
// average.
constexpr double kRemoteTexel = 1.5;

// Around an eye inside a map's box texels stay large however coarse they may be.
constexpr int kCoarserMax = 12;

// Wider than any pixel: where every sample is asked for, colors are those of the mesh everywhere.
constexpr double kLargeSample = 1e20;

// How far walls reach below both surfaces, which hide that, besides the error of the lower one.
constexpr double kWallBelowPx = 4.0;

constexpr double kDirectLight = 0.84;

// The fill light: from the side, so that ribs of a slope in shadow differ, and low.
constexpr Angle kFillAzimuth = Angle::degrees(110.0); // from that of the main light
constexpr Angle kFillAltitude = Angle::degrees(20.0);
constexpr double kFillLight = 0.168;

// Of the node mesh.
struct IndexRange {
    std::size_t first;
    GLsizei count;
};

constexpr std::size_t kNodesPerDraw = 32;

// Texture units.
enum Unit : GLint { Heights, Ramp, Relief, FirstCover, FirstOnBody = FirstCover + kCoversMax };

struct Color3 {
    float red;
    float green;
    float blue;
};

Color3 asFloats(Rgb8 color)
{
    return {static_cast<float>(color.red) / 255.0F, static_cast<float>(color.green) / 255.0F,
            static_cast<float>(color.blue) / 255.0F};
}

// The ramp so fine that a pixel needs no more than the nearest texel: between two of them colors
// differ by less than what a screen shows. Mixing two takes a fifth of a pixel's time in software.
std::vector<Rgb8> rampTexels(const ColorRamp& ramp)
{
    const auto colors = sampledRamp(ramp);
    std::vector<Rgb8> texels;
    texels.reserve(kRampTexels);
    for (std::size_t i = 0; i < kRampTexels; ++i) {
        const double place =
            static_cast<double>(i * (colors.size() - 1)) / static_cast<double>(kRampTexels - 1);
        const std::size_t below = std::min(static_cast<std::size_t>(place), colors.size() - 2);
        const double share = place - static_cast<double>(below);
        const auto mixed = [share](std::uint8_t a, std::uint8_t b) {
            return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
        };
        const Rgb8& a = colors[below];
        const Rgb8& b = colors[below + 1];
        texels.push_back({mixed(a.red, b.red), mixed(a.green, b.green), mixed(a.blue, b.blue)});
    }
    return texels;
}

// A map with what drawing it needs.
struct Layer {
    TerrainLayer source;
    std::uint32_t number = 0; // never used twice
    // For what vertices on a body depend on: the layers above, and the lowest terrain of all.
    std::uint32_t body_number = 0;
    std::vector<std::uint32_t> covered_by;      // numbers of layers
    std::vector<std::uint32_t> lies_on;         // likewise
    std::optional<MapWalls> walls;              // to those
    std::optional<std::array<double, 3>> reach; // of setReach()
    std::shared_ptr<const BodyLocator> locator;
    DrawnSurface surface;
    std::array<float, 2> pole_heights_m{};
    DetailSelector selector;
    GlTexture ramp;
    std::optional<CoverTexture> cover;    // once it lies on another layer
    std::optional<TileRequests> requests; // of a tiled map
    std::vector<TileId> missing;          // of this picture
    double texel_px = 1.0;                // likewise: of the relief, at most
    std::function<void()> notify;

    Layer(const TerrainLayer& layer,
          std::uint32_t layer_number,
          const std::function<void()>& notify_when_drawable)
        : source(layer)
        , number(layer_number)
        , body_number(layer_number)
        , surface(*source.heightfield, source.analysis->means)
        , selector(selectorOf(source))
        , notify(notify_when_drawable)
    {
        sendRamp();
        if (source.body) {
            pole_heights_m = poleHeights(surface, source.analysis->errors.levelCount() - 1);
        }
        if (source.heightfield->isTiled()) {
            requests.emplace(source.heightfield->tiles()->raster(), TileUrgency::View, notify);
        }
    }

    // Changes when tiles have arrived.
    std::uint64_t generation() const
    {
        return requests ? source.heightfield->tiles()->raster().generation() : 0;
    }
    // Requests the tiles missing from this picture: the coarser ones first, so that the whole
    // picture sharpens evenly. Adds the pending ones to `report`.
    void askForMissing(DrawReport& report)
    {
        if (!requests) {
            return;
        }
        std::stable_sort(missing.begin(), missing.end(),
                         [](const TileId& a, const TileId& b) { return a.level > b.level; });
        std::vector<TileId> wanted;
        std::unordered_set<TileId, TileIdHash> seen;
        std::copy_if(missing.begin(), missing.end(), std::back_inserter(wanted),
                     [&seen](const TileId& id) { return seen.insert(id).second; });
        requests->request(wanted);
        const TiledRaster& raster = source.heightfield->tiles()->raster();
        // A tile that arrived between the reading and the request causes no other notification.
        if (notify && std::any_of(wanted.begin(), wanted.end(), [&raster](const TileId& id) {
                return raster.find(id) != nullptr;
            })) {
            notify();
        }
        for (const TileId& id : wanted) {
            std::optional<Error> failure = raster.failure(id);
            report.is_complete = report.is_complete && failure;
            if (failure && !report.problem) {
                report.problem = std::move(failure);
            }
        }
    }

    static DetailSelector selectorOf(const TerrainLayer& layer)
    {
        return layer.body ? DetailSelector(layer.analysis,
                                           std::make_unique<BodyNodes>(layer.analysis, layer.body))
                          : DetailSelector(layer.analysis, layer.heightfield->columns(),
                                           layer.heightfield->rows(), layer.frame);
    }

    // The horizon hides nothing that rises over the lowest terrain of the scene. Walls reach the
    // terrain of the maps below, if there are any.
    void setReach(double scene_lowest_m, const std::optional<HeightRange>& below)
    {
        const std::array<double, 3> to{scene_lowest_m, below ? below->minimum_m : HUGE_VAL,
                                       below ? below->maximum_m : -HUGE_VAL};
        if (source.body && std::exchange(reach, to) != to) {
            auto nodes = std::make_unique<BodyNodes>(source.analysis, source.body);
            nodes->setLowest(scene_lowest_m);
            if (below) {
                nodes->setWalls(*below);
            }
            selector = DetailSelector(source.analysis, std::move(nodes));
        }
    }
    const std::shared_ptr<const BodyLocator>& located()
    {
        if (!locator) {
            locator = std::make_shared<const BodyLocator>(source.body);
        }
        return locator;
    }
    BodyCover asCover()
    {
        return {located(), source.heightfield->columns(), source.heightfield->rows()};
    }

    MapSides sides() const
    {
        return source.body && source.body->closes() ? MapSides::Meet : MapSides::End;
    }

    HeightRange range() const { return source.heightfield->range().value_or(HeightRange{}); }
    // Of a layer on its body.
    BodySubject onBody(double exaggeration, std::vector<BodyCover> covers) const
    {
        const Ellipsoid& body = source.body->ellipsoid();
        const double radius_m = std::max(body.equatorial_m, body.polar_m);
        const HeightRange heights = range();
        const double reach_m =
            exaggeration * std::max(std::abs(heights.minimum_m), std::abs(heights.maximum_m));
        constexpr double kReachShare = 1.5; // so that few exaggerations need another lattice
        return {.surface = &surface,
                .grid = source.body.get(),
                .frame = source.frame,
                .lattice =
                    BodyLattice::reaching(std::max(kReachShare * radius_m, radius_m + reach_m)),
                .exaggeration = exaggeration,
                .pole_heights_m = pole_heights_m,
                .covers = std::move(covers)};
    }

    SceneBox box(double exaggeration) const
    {
        const Heightfield& heightfield = *source.heightfield;
        return sceneBox(source.frame, heightfield.columns(), heightfield.rows(),
                        heightfield.range().value_or(HeightRange{}), exaggeration);
    }
    DetailNode wholeNode() const
    {
        return {std::max(source.analysis->errors.levelCount() - 1, kReliefLevelMin), 0, 0};
    }
    bool hasVoids() const { return source.heightfield->hasVoids(); }

    void sendRamp() const
    {
        const std::vector<Rgb8> colors = rampTexels(*source.ramp);
        static_assert(sizeof(Rgb8) == 3);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, ramp.id());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, static_cast<GLsizei>(colors.size()), 1, 0, GL_RGB,
                     GL_UNSIGNED_BYTE, colors.data());
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    }
};

// How many different reliefs a selection wears.
std::size_t reliefCount(const DetailSelection& selection)
{
    std::unordered_set<std::size_t> seen;
    for (const SelectedNode& selected : selection.nodes) {
        seen.insert(LayerNodeHash{}({.layer = 0, .node = selected.relief}));
    }
    return seen.size();
}

DetailView viewOf(const DrawRequest& request, double exaggeration)
{
    return {.camera = request.camera,
            .viewport = request.viewport,
            .exaggeration = exaggeration,
            .part = request.part,
            .pose = request.body_pose};
}

// In pixels that are drawn.
Viewport drawnSize(const DrawRequest& request)
{
    const auto scaled = [&request](int pixels) {
        return std::max(1, static_cast<int>(std::lround(pixels * request.scale)));
    };
    return {.width = scaled(request.viewport.width), .height = scaled(request.viewport.height)};
}

// The width of a pixel that is drawn, at a distance of 1.
double pixelSlope(const DrawRequest& request)
{
    return 2.0 * std::tan(0.5 * request.pose().field_of_view.radians()) / drawnSize(request).height;
}

std::array<GLfloat, 16> asFloats(const Matrix4& matrix)
{
    std::array<GLfloat, 16> values{};
    std::transform(matrix.values.begin(), matrix.values.end(), values.begin(),
                   [](double v) { return static_cast<GLfloat>(v); });
    return values;
}

} // namespace

struct TerrainRenderer::Impl {
    TerrainShaders shaders;
    std::string driver_name;
    bool is_software = false;
    HeightAtlas atlas;
    std::optional<BodyAtlas> body_atlas; // once a layer lies on its body
    ReliefCache reliefs;
    FrameTarget frame_target;
    Viewport kept_size;
    std::function<void()> notify;
    std::vector<std::unique_ptr<Layer>> layers; // uppermost first
    std::uint32_t next_layer_number = 0;

    GlBuffer cell_vertices;
    GlBuffer cell_indices;
    GlBuffer instances;
    GlVertexArray node_array;
    GlVertexArray empty_array;
    // Of a page of relief: nodes of which all is drawn, and single quadrants of others.
    struct Batch {
        std::vector<NodeInstance> nodes;
        std::array<std::vector<NodeInstance>, kQuadrantCount> quadrants;
        std::array<std::vector<NodeInstance>, 2> poles; // at the first and the last row

        bool isEmpty() const
        {
            const auto is_empty = [](const auto& part) { return part.empty(); };
            return nodes.empty() && std::all_of(quadrants.begin(), quadrants.end(), is_empty) &&
                   std::all_of(poles.begin(), poles.end(), is_empty);
        }
    };
    std::vector<Batch> batches; // one a page
    WallDrawing walls;
    UnfinishedDraws unfinished;

    Impl(TerrainShaders compiled,
         std::string name,
         bool has_no_gpu,
         const StoreSizes& stores,
         std::function<void()> notify_when_drawable)
        : shaders(std::move(compiled))
        , driver_name(std::move(name))
        , is_software(has_no_gpu)
        , atlas(stores.atlas_columns, stores.atlas_rows)
        , reliefs(stores.relief_tiles, notify_when_drawable)
        , notify(std::move(notify_when_drawable))
        , batches(reliefs.pageCount())
    {
        makeNodeMesh();
    }

    void makeNodeMesh();
    void relateLayers(); // after any change of them
    void drawSky(const DrawStyle& style) const;
    DetailSelection select(Layer& layer, const DrawRequest& request, double exaggeration) const;
    // The meshes of all layers are exact to `error_px`.
    void drawLayer(std::size_t index,
                   const DetailSelection& selection,
                   double error_px,
                   const DrawRequest& request,
                   const DrawStyle& style);
    void setUniforms(const GlProgram& program,
                     std::size_t index,
                     const DrawRequest& request,
                     const DrawStyle& style,
                     GridPoint anchor) const;
    void drawBatches(const DrawRequest& request);
    void drawWalls(std::size_t index,
                   const DetailSelection& selection,
                   double error_px,
                   const DrawRequest& request,
                   const DrawStyle& style);
    // Pictures in motion omit effects that are slow in software.
    bool isCheap(const DrawRequest& request) const { return request.is_hasty && is_software; }
    void setRays(const GlProgram& program,
                 const DrawRequest& request,
                 const SceneFrame& frame,
                 double exaggeration) const;
    void drawInstances(std::vector<NodeInstance>& instances_of, const IndexRange& range);
    ClipRange clip(const CameraPose& camera, double exaggeration) const;
    std::optional<NodeSlots::Place>
    placeOf(Layer& layer, const DetailNode& node, const std::optional<BodySubject>& on_body);
    void beginRound(const Layer& layer);
    BodySubject onBody(std::size_t index, double exaggeration) const;
    static void addPoles(const DetailNode& node,
                         const BodyGrid& body,
                         const NodeInstance& instance,
                         Batch& batch);
};

void TerrainRenderer::Impl::makeNodeMesh()
{
    std::vector<std::uint8_t> cells;
    cells.reserve(std::size_t{2} * (kSide * kSide + 2 * kCells));
    for (int row = 0; row < kSide; ++row) {
        for (int column = 0; column < kSide; ++column) {
            cells.push_back(static_cast<std::uint8_t>(column));
            cells.push_back(static_cast<std::uint8_t>(row));
        }
    }
    for (const int row : {kFirstPoleRow, kLastPoleRow}) {
        for (int column = 0; column < kCells; ++column) {
            cells.push_back(static_cast<std::uint8_t>(column));
            cells.push_back(static_cast<std::uint8_t>(row));
        }
    }
    std::vector<std::uint16_t> indices;
    indices.reserve(std::size_t{6} * kCells * kCells + 2 * kPoleIndices);
    // One quadrant after the other.
    constexpr int kQuadrantCells = kHalf * kHalf;
    for (int cell = 0; cell < kCells * kCells; ++cell) {
        const int quadrant = cell / kQuadrantCells;
        const int row = quadrant / 2 * kHalf + cell % kQuadrantCells / kHalf;
        const int column = quadrant % 2 * kHalf + cell % kHalf;
        const int upper_left = row * kSide + column;
        const int lower_left = upper_left + kSide;
        for (const int index : {upper_left, lower_left + 1, upper_left + 1, // upper
                                upper_left, lower_left, lower_left + 1}) {  // lower
            indices.push_back(static_cast<std::uint16_t>(index));
        }
    }
    // From the first and from the last row to a pole.
    for (int column = 0; column < kCells; ++column) {
        for (const int index : {column, column + 1, kSide * kSide + column}) {
            indices.push_back(static_cast<std::uint16_t>(index));
        }
    }
    for (int column = 0; column < kCells; ++column) {
        const int corner = kCells * kSide + column;
        for (const int index : {corner, kSide * kSide + kCells + column, corner + 1}) {
            indices.push_back(static_cast<std::uint16_t>(index));
        }
    }
    glBindVertexArray(node_array.id());
    glBindBuffer(GL_ARRAY_BUFFER, cell_vertices.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(cells.size()), cells.data(),
                 GL_STATIC_DRAW);
    glEnableVertexAttribArray(kCellAttribute);
    glVertexAttribPointer(kCellAttribute, 2, GL_UNSIGNED_BYTE, GL_FALSE, 2, nullptr);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, cell_indices.id());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint16_t)), indices.data(),
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, instances.id());
    describeNodeInstances();
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void TerrainRenderer::Impl::drawSky(const DrawStyle& style) const
{
    const Color3 top = asFloats(style.sky_top);
    const Color3 bottom = asFloats(style.sky_bottom);
    glUseProgram(shaders.sky().id());
    glUniform3f(shaders.sky().uniform("u_top"), top.red, top.green, top.blue);
    glUniform3f(shaders.sky().uniform("u_bottom"), bottom.red, bottom.green, bottom.blue);
    glBindVertexArray(empty_array.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

// Where a picture would need more relief than there is room for, texels become larger. So they are
// where relief comes from a server.
DetailSelection
TerrainRenderer::Impl::select(Layer& layer, const DrawRequest& request, double exaggeration) const
{
    const auto room = static_cast<std::size_t>(
        kReliefShareMax * static_cast<double>(reliefs.size()) / static_cast<double>(layers.size()));
    DetailTarget target = request.detail;
    const Heightfield& heightfield = *layer.source.heightfield;
    if (heightfield.isTiled() && heightfield.tiles()->layout().is_remote) {
        target.texel_px *= kRemoteTexel;
    }
    for (int i = 0;; ++i) {
        DetailSelection selection = layer.selector.select(viewOf(request, exaggeration), target);
        if (reliefCount(selection) <= room || i == kCoarserMax) {
            layer.texel_px = target.texel_px;
            return selection;
        }
        target.texel_px *= 1.4;
    }
}

void TerrainRenderer::Impl::drawLayer(std::size_t index,
                                      const DetailSelection& selection,
                                      double error_px,
                                      const DrawRequest& request,
                                      const DrawStyle& style)
{
    Layer& layer = *layers[index];
    const Heightfield& heightfield = *layer.source.heightfield;
    const BodyGrid* body = layer.source.body.get();
    const GridPoint anchor = body != nullptr
                                 ? GridPoint{}
                                 : nodeAnchor(layer.source.frame.toGrid(eyeOf(request.camera)),
                                              heightfield.columns(), heightfield.rows());
    const auto cover_count = static_cast<int>(std::min<std::size_t>(index, kCoversMax));
    const GlProgram& program = shaders.terrain(
        {.mode = style.look.mode,
         .has_contours = style.look.has_contours,
         .has_voids = layer.hasVoids(),
         .is_ray_corrected = !isCheap(request) && !(request.is_interim && is_software),
         .cover_count = cover_count,
         .is_on_body = body != nullptr,
         .is_sunlit = body != nullptr && style.look.light_frame == LightFrame::Body});
    glUseProgram(program.id());
    setUniforms(program, index, request, style, anchor);

    const std::size_t top = layer.source.analysis->errors.levelCount() - 1;
    const auto request_of = [&](const DetailNode& node) {
        return ReliefRequest{.key = {.layer = layer.number, .node = node},
                             .heightfield = layer.source.heightfield,
                             .frame = layer.source.frame,
                             .slope_max = layer.source.slope_max,
                             .sides = layer.sides()};
    };
    reliefs.find(request_of(layer.wholeNode()), top); // so that it is not given up
    const std::optional<BodySubject> on_body =
        body != nullptr ? std::optional(onBody(index, style.exaggeration)) : std::nullopt;
    beginRound(layer);
    layer.missing.clear();
    for (const SelectedNode& selected : selection.nodes) {
        std::optional<NodeSlots::Place> slot = placeOf(layer, selected.node, on_body);
        if (!slot) {
            drawBatches(request);
            beginRound(layer);
            slot = placeOf(layer, selected.node, on_body);
        }
        const auto relief = reliefs.find(request_of(selected.relief), top);
        if (!relief) {
            continue; // given up and asked for again
        }
        Batch& batch = batches[relief->page];
        const NodeInstance instance =
            nodeInstance(selected, anchor, layer.surface.baseMeters(), *slot, *relief);
        if (body != nullptr) {
            addPoles(selected.node, *body, instance, batch);
        }
        if (selected.quadrants == kAllQuadrants) {
            batch.nodes.push_back(instance);
            continue;
        }
        for (std::size_t i = 0; i < kQuadrantCount; ++i) {
            if ((selected.quadrants >> i & 1U) != 0) {
                batch.quadrants[i].push_back(instance);
            }
        }
    }
    drawBatches(request);
    if (layer.walls) {
        drawWalls(index, selection, error_px, request, style);
    }
}

// The steps at the layer's edges. All of its nodes are in the atlas by now, or find room again.
void TerrainRenderer::Impl::drawWalls(std::size_t index,
                                      const DetailSelection& selection,
                                      double error_px,
                                      const DrawRequest& request,
                                      const DrawStyle& style)
{
    Layer& layer = *layers[index];
    std::uint64_t generation = 0;
    for (std::size_t i = index; i < layers.size(); ++i) {
        generation += layers[i]->generation();
    }
    const std::optional<BodySubject> on_body = onBody(index, style.exaggeration);
    const auto draw = [&] {
        if (walls.isEmpty()) {
            return;
        }
        const GlProgram& program = shaders.terrain(
            {.mode = style.look.mode,
             .has_contours = style.look.has_contours,
             .cover_count = static_cast<int>(std::min<std::size_t>(index, kCoversMax)),
             .is_on_body = true,
             .is_wall = true,
             .is_sunlit = style.look.light_frame == LightFrame::Body});
        glUseProgram(program.id());
        setUniforms(program, index, request, style, {});
        glUniform1f(program.uniform("u_base"), static_cast<GLfloat>(layer.surface.baseMeters()));
        glUniform1f(program.uniform("u_pixel"), static_cast<GLfloat>(pixelSlope(request)));
        // No more than what the errors ask for: a wall that is longer than the body is wide stands
        // out of its other side.
        const double reach_px = std::max(error_px, kErrorPxAtRest);
        glUniform1f(program.uniform("u_wall_above_px"), static_cast<GLfloat>(reach_px));
        glUniform1f(program.uniform("u_wall_below_px"),
                    static_cast<GLfloat>(kWallBelowPx +
                                         static_cast<double>(DetailErrors::kPeak) * reach_px));
        walls.draw();
    };
    for (const SelectedNode& selected : selection.nodes) {
        // Corners as close together as the texels that show where the map ends.
        const std::size_t texel =
            selected.relief.level - std::min(selected.relief.level, kReliefLevelMin);
        const MapWalls::NodeWalls& of_node =
            layer.walls->of(selected.node, std::size_t{1} << std::min(texel, selected.node.level),
                            layer.source.analysis->means, generation);
        if (std::all_of(of_node.begin(), of_node.end(),
                        [](const auto& quadrant) { return quadrant.triangles.empty(); })) {
            continue;
        }
        std::optional<NodeSlots::Place> slot = placeOf(layer, selected.node, on_body);
        if (!slot) {
            draw();
            beginRound(layer);
            slot = placeOf(layer, selected.node, on_body);
        }
        walls.add(nodeInstance(selected, {}, layer.surface.baseMeters(), *slot,
                               {.node = selected.relief}),
                  of_node, selected.quadrants);
    }
    draw();
}

void TerrainRenderer::Impl::beginRound(const Layer& layer)
{
    if (!layer.source.body) {
        atlas.beginRound();
        return;
    }
    if (!body_atlas) {
        const StoreSizes& stores = is_software ? kStoresInSoftware : kStoresOnGpu;
        body_atlas.emplace(stores.atlas_columns, stores.atlas_rows);
    }
    body_atlas->beginRound();
    body_atlas->reserveCovers(std::min<std::size_t>(layers.size() - 1, kCoversMax));
    body_atlas->bind(GL_TEXTURE0 + FirstOnBody);
}

// With the layers right above it, the lowest first.
BodySubject TerrainRenderer::Impl::onBody(std::size_t index, double exaggeration) const
{
    std::vector<BodyCover> covers;
    for (std::size_t i = 0; i < std::min<std::size_t>(index, kCoversMax); ++i) {
        covers.push_back(layers[index - 1 - i]->asCover());
    }
    return layers[index]->onBody(exaggeration, std::move(covers));
}

std::optional<NodeSlots::Place> TerrainRenderer::Impl::placeOf(
    Layer& layer, const DetailNode& node, const std::optional<BodySubject>& on_body)
{
    return on_body ? body_atlas->place({.layer = layer.body_number, .node = node}, *on_body,
                                       layer.generation(), layer.missing)
                   : atlas.place({.layer = layer.number, .node = node}, layer.surface,
                                 layer.generation(), layer.missing);
}

// Triangles that close a map around its body at a pole.
void TerrainRenderer::Impl::addPoles(const DetailNode& node,
                                     const BodyGrid& body,
                                     const NodeInstance& instance,
                                     Batch& batch)
{
    if (node.row == 0 && body.poleAtFirstRow() != BodyGrid::Pole::None && !body.isPole(0)) {
        batch.poles.front().push_back(instance);
    }
    const std::size_t last_row = body.rows() - 1;
    if (body.poleAtLastRow() != BodyGrid::Pole::None && !body.isPole(last_row) &&
        (node.row + 1) * (DetailErrors::kNodeCells << node.level) >= last_row) {
        batch.poles.back().push_back(instance);
    }
}

void TerrainRenderer::Impl::drawBatches(const DrawRequest& request)
{
    glBindVertexArray(node_array.id());
    glBindBuffer(GL_ARRAY_BUFFER, instances.id());
    for (std::size_t page = 0; page < batches.size(); ++page) {
        Batch& batch = batches[page];
        if (batch.isEmpty()) {
            continue;
        }
        reliefs.bind(page, GL_TEXTURE0 + Relief,
                     isCheap(request) ? ReliefCache::Mixing::OneLevel
                                      : ReliefCache::Mixing::TwoLevels);
        constexpr auto kAll = static_cast<GLsizei>(kQuadrantCount);
        drawInstances(batch.nodes, {.first = 0, .count = kAll * kQuadrantIndices});
        for (std::size_t i = 0; i < kQuadrantCount; ++i) {
            drawInstances(batch.quadrants[i],
                          {.first = i * kQuadrantIndices, .count = kQuadrantIndices});
        }
        for (std::size_t i = 0; i < batch.poles.size(); ++i) {
            drawInstances(batch.poles[i], {.first = kAll * kQuadrantIndices + i * kPoleIndices,
                                           .count = kPoleIndices});
        }
    }
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

// And forgets them.
void TerrainRenderer::Impl::drawInstances(std::vector<NodeInstance>& instances_of,
                                          const IndexRange& range)
{
    for (std::size_t first = 0; first < instances_of.size(); first += kNodesPerDraw) {
        const std::size_t count = std::min(kNodesPerDraw, instances_of.size() - first);
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * sizeof(NodeInstance)),
                     instances_of.data() + first, GL_STREAM_DRAW);
        glDrawElementsInstanced(GL_TRIANGLES, range.count, GL_UNSIGNED_SHORT,
                                reinterpret_cast<const void*>(range.first * sizeof(std::uint16_t)),
                                static_cast<GLsizei>(count));
        if (is_software) {
            unfinished.add(count * static_cast<std::size_t>(range.count) / 3);
        }
    }
    instances_of.clear();
}

void TerrainRenderer::Impl::setUniforms(const GlProgram& program,
                                        std::size_t index,
                                        const DrawRequest& request,
                                        const DrawStyle& style,
                                        GridPoint anchor) const
{
    const Layer& layer = *layers[index];
    const SceneFrame& frame = layer.source.frame;
    const Heightfield& heightfield = *layer.source.heightfield;
    const auto set = [&program](const char* name, auto... values) {
        const GLint location = program.uniform(name);
        if constexpr (sizeof...(values) == 1) {
            glUniform1f(location, static_cast<GLfloat>(values)...);
        } else if constexpr (sizeof...(values) == 2) {
            glUniform2f(location, static_cast<GLfloat>(values)...);
        } else if constexpr (sizeof...(values) == 3) {
            glUniform3f(location, static_cast<GLfloat>(values)...);
        } else {
            glUniform4f(location, static_cast<GLfloat>(values)...);
        }
    };
    const CameraPose pose = request.pose();
    if (layer.source.body) {
        setBodyUniforms(program, pose, onBody(index, style.exaggeration), FirstOnBody);
    } else {
        atlas.bind(GL_TEXTURE0 + Heights);
        glUniform1i(program.uniform("u_heights"), Heights);
    }
    glActiveTexture(GL_TEXTURE0 + Ramp);
    glBindTexture(GL_TEXTURE_2D, layer.ramp.id());
    glUniform1i(program.uniform("u_ramp"), Ramp);
    glUniform1i(program.uniform("u_relief"), Relief);

    const Matrix4 clip_from_eye =
        projection(pose, request.viewport, clip(pose, style.exaggeration)) * viewRotation(pose);
    glUniformMatrix4fv(program.uniform("u_clip_from_eye"), 1, GL_FALSE,
                       asFloats(clip_from_eye).data());
    const double base_m = layer.surface.baseMeters();
    const Vec3 anchor_from_eye = frame.toScene(anchor, base_m * style.exaggeration) - pose.eye;
    set("u_anchor_from_eye", anchor_from_eye.x, anchor_from_eye.y, anchor_from_eye.z);
    set("u_frame", frame.east_per_column, frame.east_per_row, frame.north_per_column,
        frame.north_per_row);
    set("u_exaggeration", style.exaggeration);
    const std::size_t columns =
        layer.source.body ? layer.source.body->columns() : heightfield.columns();
    set("u_last_sample", static_cast<double>(columns - 1) - anchor.column,
        static_cast<double>(heightfield.rows() - 1) - anchor.row);

    setRays(program, request, frame, style.exaggeration);
    set("u_sample_px", request.detail.has_every_sample
                           ? kLargeSample
                           : std::max(std::hypot(frame.east_per_column, frame.north_per_column),
                                      std::hypot(frame.east_per_row, frame.north_per_row)) /
                                 (pixelSlope(request) * request.pixels_shown_as_one));
    const HeightRange& tinted = layer.source.tint_range;
    const double tinted_m = tinted.maximum_m - tinted.minimum_m;
    // A flat map has the middle color.
    set("u_tint", tinted_m > 0.0 ? 1.0 / tinted_m : 0.0,
        tinted_m > 0.0 ? (base_m - tinted.minimum_m) / tinted_m : 0.5);
    const TerrainLook& look = style.look;
    const double slope_unit = layer.source.slope_max * style.exaggeration;
    const auto set_light = [&](const char* name, Angle azimuth, Angle altitude, double strength) {
        const double level = strength * slope_unit * std::cos(altitude.radians());
        set(name, -level * std::sin(azimuth.radians()), -level * std::cos(azimuth.radians()),
            strength * std::sin(altitude.radians()));
    };
    if (layer.source.body && look.light_frame == LightFrame::Body) {
        const Vec3 sun = directionToSun(look.subsolar.value_or(GeographicPoint{}),
                                        layer.source.body->ellipsoid()) *
                         kSunShare;
        set("u_sun", sun.x, sun.y, sun.z);
        set("u_slope_unit", slope_unit);
    } else {
        set_light("u_light", look.light_azimuth, look.light_altitude, kDirectLight);
        set_light("u_fill_light", look.light_azimuth + kFillAzimuth, kFillAltitude, kFillLight);
    }
    set("u_slope_square", slope_unit * slope_unit);
    set("u_slope_unit_true", layer.source.slope_max);
    const SlopeRange& slopes = layer.source.slope_range;
    const double slopes_rad = (slopes.maximum - slopes.minimum).radians();
    set("u_slope_tint", slopes_rad > 0.0 ? 1.0 / slopes_rad : 0.0,
        slopes_rad > 0.0 ? -slopes.minimum.radians() / slopes_rad : 0.5);

    const HeightRange range = heightfield.range().value_or(HeightRange{});
    const double pixel_m = metersPerPixel(pose, request.viewport) * request.pixels_shown_as_one;
    const double interval_m = contourInterval(look, range, pixel_m, style.exaggeration);
    if (interval_m > 0.0) {
        // Lines are counted in fives, so a multiple of five intervals may be left out.
        const double lines = std::fmod(base_m / interval_m, 5.0);
        set("u_contour", 1.0 / interval_m, lines);
    } else {
        set("u_contour", 0.0, 0.5);
    }
    set("u_contour_px", request.pixels_shown_as_one);

    for (std::size_t i = 0; i < std::min<std::size_t>(index, kCoversMax); ++i) {
        Layer& cover = *layers[index - 1 - i];
        const GLint unit = FirstCover + static_cast<GLint>(i);
        cover.cover->bind(GL_TEXTURE0 + static_cast<GLenum>(unit));
        const std::string element = fmt::format("[{}]", i);
        glUniform1i(program.uniform(("u_cover" + element).c_str()), unit);
        const CoverTexture::Placement& to = cover.cover->placement();
        set(("u_cover_texture" + element).c_str(), to.column_scale, to.row_scale, to.column_offset,
            to.row_offset);
        const SceneFrame& above_frame = cover.source.frame;
        const double sample_m =
            std::sqrt(std::abs(above_frame.east_per_column * above_frame.north_per_row -
                               above_frame.east_per_row * above_frame.north_per_column));
        // One cell reaches as far as both maps are drawn.
        double reach = 0.0;
        if (layer.source.body) {
            const BodyCover::Overlap overlap =
                cover.asCover().overlap(layer.source.body->stepMaxM());
            const Heightfield& above = *cover.source.heightfield;
            reach = std::max(overlap.columns * static_cast<double>(above.columns() - 1),
                             overlap.rows * static_cast<double>(above.rows() - 1)) /
                    to.square_samples;
        }
        const double decisive = std::max(0.0, std::ceil(std::log2(std::max(reach, 1.0))));
        constexpr double kMiddle = 0.0;
        constexpr double kFirstCorner = 1.0;
        constexpr double kNowhere = 5.0;
        set(("u_cover_level" + element).c_str(),
            cover.texel_px * pixelSlope(request) / (sample_m * to.square_samples),
            static_cast<double>(to.level_max), decisive,
            !to.has_voids                                   ? kNowhere
            : decisive <= static_cast<double>(to.level_max) ? kMiddle
                                                            : kFirstCorner);
        if (layer.source.body) {
            continue; // vertices have their places on covers
        }
        const Heightfield& above = *cover.source.heightfield;
        const auto place = [&](GridPoint grid) {
            const GridPoint there = cover.source.frame.toGrid(frame.toScene(grid, 0.0));
            return GridPoint{there.column / static_cast<double>(above.columns() - 1),
                             there.row / static_cast<double>(above.rows() - 1)};
        };
        const GridPoint at = place(anchor);
        const GridPoint right = place({anchor.column + 1.0, anchor.row});
        const GridPoint down = place({anchor.column, anchor.row + 1.0});
        set(("u_cover_linear" + element).c_str(), right.column - at.column, down.column - at.column,
            right.row - at.row, down.row - at.row);
        set(("u_cover_offset" + element).c_str(), at.column, at.row);
    }
}

// The rays through the pixels that are drawn, from the lower left corner of the target.
void TerrainRenderer::Impl::setRays(const GlProgram& program,
                                    const DrawRequest& request,
                                    const SceneFrame& frame,
                                    double exaggeration) const
{
    const Viewport drawn = drawnSize(request);
    const Matrix4 rotation = viewRotation(request.pose());
    const auto axis = [&rotation](std::size_t row) {
        return Vec3{rotation(row, 0), rotation(row, 1), rotation(row, 2)};
    };
    const double half_height = std::tan(request.pose().field_of_view.radians() / 2.0);
    const double half_width = half_height * request.viewport.aspect();
    const Vec3 right = axis(0) * (2.0 * half_width / drawn.width);
    const Vec3 up = axis(1) * (2.0 * half_height / drawn.height);
    const PixelArea part = request.part.value_or(PixelArea{});
    const Vec3 corner = axis(0) * -half_width - axis(1) * half_height - axis(2) +
                        right * part.left + up * part.bottom;
    const std::array<Vec3, 3> rays{corner, right, up};
    std::array<GLfloat, 9> values{};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        values.at(3 * i) = static_cast<GLfloat>(rays.at(i).x);
        values.at(3 * i + 1) = static_cast<GLfloat>(rays.at(i).y);
        values.at(3 * i + 2) = static_cast<GLfloat>(rays.at(i).z / exaggeration);
    }
    glUniform3fv(program.uniform("u_ray"), 3, values.data());
    const double determinant =
        frame.east_per_column * frame.north_per_row - frame.east_per_row * frame.north_per_column;
    glUniform4f(program.uniform("u_grid"), static_cast<GLfloat>(frame.north_per_row / determinant),
                static_cast<GLfloat>(-frame.east_per_row / determinant),
                static_cast<GLfloat>(-frame.north_per_column / determinant),
                static_cast<GLfloat>(frame.east_per_column / determinant));
}

// All layers share one depth range, so that their depths can be compared.
ClipRange TerrainRenderer::Impl::clip(const CameraPose& camera, double exaggeration) const
{
    if (!layers.empty() && layers.front()->source.body) {
        HeightRange all = layers.front()->range();
        for (const auto& layer : layers) {
            const HeightRange range = layer->range();
            all = {std::min(all.minimum_m, range.minimum_m),
                   std::max(all.maximum_m, range.maximum_m)};
        }
        return bodyClipRange(camera, layers.front()->source.body->ellipsoid(),
                             all.minimum_m * exaggeration, all.maximum_m * exaggeration);
    }
    SceneBox box;
    for (const auto& layer : layers) {
        const SceneBox more = layer->box(exaggeration);
        box = layer == layers.front() ? more : united(box, more);
    }
    return clipRange(camera, box);
}

TerrainRenderer::TerrainRenderer(std::unique_ptr<Impl> impl)
    : impl_(std::move(impl))
{}

TerrainRenderer::~TerrainRenderer() = default;

Result<std::unique_ptr<TerrainRenderer>> TerrainRenderer::create(std::function<void()> notify)
{
    const int version = epoxy_gl_version();
    if (!epoxy_is_desktop_gl() || version < 33) {
        return Error{
            ErrorCode::Unsupported,
            fmt::format("OpenGL 3.3 is required, but the graphics driver offers {}{}.{}; install "
                        "a newer driver or Mesa's software one",
                        epoxy_is_desktop_gl() ? "" : "OpenGL ES ", version / 10, version % 10)};
    }
    Result<TerrainShaders> shaders = TerrainShaders::create();
    if (!shaders) {
        return std::move(shaders).error();
    }
    const std::string driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const auto says = [&driver](const char* word) {
        return driver.find(word) != std::string::npos;
    };
    const bool is_software = says("llvmpipe") || says("softpipe") || says("SwiftShader");
    auto renderer = std::unique_ptr<TerrainRenderer>(new TerrainRenderer(
        std::make_unique<Impl>(std::move(shaders).value(), driver, is_software,
                               is_software ? kStoresInSoftware : kStoresOnGpu, std::move(notify))));
    if (is_software) {
        warmUp(*renderer);
    }
    return renderer;
}

const std::string& TerrainRenderer::driver() const
{
    return impl_->driver_name;
}

bool TerrainRenderer::isSoftware() const
{
    return impl_->is_software;
}

void TerrainRenderer::setLayers(const std::vector<TerrainLayer>& layers)
{
    std::vector<std::unique_ptr<Layer>> before = std::exchange(impl_->layers, {});
    for (const TerrainLayer& layer : layers) {
        MARSVIEW_CHECK(layer.heightfield && layer.analysis && layer.ramp != nullptr);
        const auto known = std::find_if(before.begin(), before.end(), [&](const auto& old) {
            return old && old->source.heightfield == layer.heightfield &&
                   old->source.analysis == layer.analysis && old->source.frame == layer.frame &&
                   old->source.body == layer.body;
        });
        if (known == before.end()) {
            auto added = std::make_unique<Layer>(layer, impl_->next_layer_number++, impl_->notify);
            // There is always a relief: this one replaces any that is missing.
            const LayerNode whole{.layer = added->number, .node = added->wholeNode()};
            if (added->sides() == MapSides::End) {
                impl_->reliefs.keep(whole, *layer.relief);
            } else {
                impl_->reliefs.keepInPlaceOf(whole, *layer.relief); // it has no sides that meet
            }
            impl_->layers.push_back(std::move(added));
            continue;
        }
        const bool has_new_ramp = (*known)->source.ramp != layer.ramp;
        (*known)->source = layer;
        if (has_new_ramp) {
            (*known)->sendRamp();
        }
        impl_->layers.push_back(std::move(*known));
    }
    impl_->relateLayers();
}

void TerrainRenderer::Impl::relateLayers()
{
    std::vector<std::uint32_t> above;
    for (const auto& layer : layers) {
        if (std::exchange(layer->covered_by, above) != above) {
            layer->body_number = next_layer_number++; // places on covers are found again
        }
        above.push_back(layer->number);
    }
    double lowest_m = HUGE_VAL;
    for (const auto& layer : layers) {
        lowest_m = std::min(lowest_m, layer->range().minimum_m);
    }
    std::vector<std::uint32_t> below;
    std::vector<LowerMap> lower;
    std::optional<HeightRange> lower_range;
    for (std::size_t i = layers.size(); i-- > 0;) {
        Layer& layer = *layers[i];
        layer.setReach(lowest_m, lower_range);
        if (i + 1 < layers.size() && !layer.cover) {
            layer.cover.emplace(*layer.source.heightfield, layer.source.analysis->means);
        }
        if (!layer.source.body) {
            continue;
        }
        if (std::exchange(layer.lies_on, below) != below) {
            layer.walls.reset();
            if (!lower.empty()) {
                layer.walls.emplace(layer.source.heightfield, layer.source.body, lower);
            }
        }
        const HeightRange range = layer.range();
        lower_range = lower_range ? HeightRange{std::min(lower_range->minimum_m, range.minimum_m),
                                                std::max(lower_range->maximum_m, range.maximum_m)}
                                  : range;
        below.insert(below.begin(), layer.number);
        lower.insert(lower.begin(),
                     {.locator = layer.located(), .heightfield = layer.source.heightfield});
    }
}

ClipRange TerrainRenderer::clip(const CameraPose& camera, double exaggeration) const
{
    return impl_->clip(camera, exaggeration);
}

DrawReport
TerrainRenderer::draw(const DrawRequest& request, const DrawStyle& style, unsigned target)
{
    Impl& impl = *impl_;
    DrawReport report;
    impl.reliefs.beginRound(request.is_hasty ? kHastyUploads : impl.reliefs.size());
    std::vector<DetailSelection> selections;
    for (const auto& layer : impl.layers) {
        selections.push_back(impl.select(*layer, request, style.exaggeration));
        report.triangle_count += selections.back().triangle_count;
        report.node_count += selections.back().nodes.size();
        report.error_px = std::max(report.error_px, selections.back().error_px);
    }
    const Viewport drawn = drawnSize(request);
    const bool is_straight = request.scale == 1.0 && request.samples <= 1 && !request.is_kept;
    MARSVIEW_CHECK(is_straight || !request.part);
    if (is_straight) {
        glBindFramebuffer(GL_FRAMEBUFFER, target);
    } else {
        impl.frame_target.begin(drawn, request.samples);
    }
    const PixelArea part = request.part.value_or(PixelArea{});
    glViewport(-part.left, -part.bottom, drawn.width, drawn.height);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LEQUAL);  // the sky lies at the far end
    glDisable(GL_CULL_FACE); // rasters that are mirrored or rotated turn the triangles around
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glClear(GL_DEPTH_BUFFER_BIT);
    for (std::size_t i = 0; i < impl.layers.size(); ++i) {
        impl.drawLayer(i, selections[i], report.error_px, request, style);
    }
    impl.drawSky(style); // last: what the terrain hides is not drawn
    glBindVertexArray(0);
    glUseProgram(0);
    glActiveTexture(GL_TEXTURE0);
    if (!is_straight) {
        impl.frame_target.end();
        impl.kept_size = request.viewport;
        present(target);
    }
    report.is_complete = impl.reliefs.endRound();
    for (const auto& layer : impl.layers) {
        layer->askForMissing(report);
    }
    if (!report.problem) {
        report.problem = impl.reliefs.problem();
    }
    return report;
}

bool TerrainRenderer::isLoading() const
{
    return impl_->reliefs.isLoading() ||
           std::any_of(impl_->layers.begin(), impl_->layers.end(), [](const auto& layer) {
               return layer->requests && layer->requests->missingCount() > 0;
           });
}

void TerrainRenderer::present(unsigned target)
{
    impl_->frame_target.present(target, impl_->kept_size);
    glViewport(0, 0, impl_->kept_size.width, impl_->kept_size.height);
}

void TerrainRenderer::presentDepth(unsigned target, const PixelArea& area)
{
    impl_->frame_target.presentDepth(target, impl_->kept_size, area);
}

Picture TerrainRenderer::keptColors()
{
    return impl_->frame_target.colors();
}

void TerrainRenderer::setKeptColors(const Picture& colors)
{
    impl_->frame_target.setColors(colors);
}

KeptDepths TerrainRenderer::keptDepths() const
{
    return {.texture = impl_->frame_target.drawn().depthTexture()};
}

std::size_t TerrainRenderer::countTriangles(const DrawRequest& request, double exaggeration)
{
    std::size_t count = 0;
    for (const auto& layer : impl_->layers) {
        count +=
            layer->selector.select(viewOf(request, exaggeration), request.detail).triangle_count;
    }
    return count;
}

bool TerrainRenderer::hasRoomFor(const DrawRequest& request, double exaggeration)
{
    std::size_t relief_count = 0;
    for (const auto& layer : impl_->layers) {
        relief_count +=
            reliefCount(layer->selector.select(viewOf(request, exaggeration), request.detail));
    }
    return 2 * relief_count <= impl_->reliefs.size();
}

DrawReport
TerrainRenderer::drawComplete(const DrawRequest& request, const DrawStyle& style, unsigned target)
{
    DrawReport report = draw(request, style, target);
    while (!report.is_complete) {
        waitForPending();
        report = draw(request, style, target);
    }
    return report;
}

void TerrainRenderer::waitForPending()
{
    impl_->reliefs.waitForPending();
    for (const auto& layer : impl_->layers) {
        if (layer->requests) {
            layer->requests->waitForPending();
        }
    }
}

} // namespace marsview
