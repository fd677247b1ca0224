#include "core/session/annotations.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

std::vector<Annotation> points(std::size_t count)
{
    const auto source = std::make_shared<const AnnotationSource>(
        AnnotationSource{.name = "points.gpkg", .crs = *Crs::fromText("IAU_2015:49900")});
    std::vector<Annotation> annotations(count);
    for (std::size_t i = 0; i < count; ++i) {
        annotations[i].name = "P" + std::to_string(i);
        annotations[i].parts = {{.points = {{static_cast<double>(i % 360), 1.5}}}};
        annotations[i].source = source;
    }
    return annotations;
}

VectorFile read(const std::string& path)
{
    JobMonitor monitor;
    Result<VectorFile> file = readVectorFile(path, monitor);
    EXPECT_TRUE(file) << (file ? "" : file.error().message);
    return file ? std::move(*file) : VectorFile{};
}

} // namespace

TEST(AnnotationList, ChangesLeaveEarlierListsAsTheyWere)
{
    const AnnotationList empty;
    const AnnotationList full = empty.withAdded(points(5000));
    EXPECT_TRUE(empty.isEmpty());
    EXPECT_EQ(full.size(), 5000U);
    Annotation renamed = *full.find(2500);
    renamed.name = "Gale";
    const AnnotationList changed = full.withReplaced(renamed);
    EXPECT_EQ(changed.find(2500)->name, "Gale");
    EXPECT_EQ(full.find(2500)->name, "P2499");
    const AnnotationList fewer = changed.without({1, 2500, 5000});
    EXPECT_EQ(fewer.size(), 4997U);
    EXPECT_EQ(fewer.find(2500), nullptr);
    EXPECT_EQ(fewer.find(2501)->name, "P2500");
    EXPECT_EQ(changed.size(), 5000U);
    EXPECT_TRUE(changed.withReplaced(*full.find(2500)).find(2500)->name == "P2499");
}

TEST(AnnotationList, IdsAreNotUsedAgain)
{
    const AnnotationList list = AnnotationList().withAdded(points(3)).without({3});
    const AnnotationList more = list.withAdded(points(1));
    EXPECT_EQ(more.find(3), nullptr);
    EXPECT_NE(more.find(4), nullptr);
    std::uint32_t last = 0;
    more.forEach([&](const Annotation& annotation) {
        EXPECT_GT(annotation.id, last);
        last = annotation.id;
    });
    EXPECT_EQ(last, 4U);
    EXPECT_EQ(list.without({1, 2}).size(), 0U);
}

TEST(Annotations, ComeBackFromEveryFormatWithNameNoteColorAndAttributes)
{
    auto source = std::make_shared<AnnotationSource>();
    source->name = "outcrops.gpkg";
    source->crs = *Crs::fromText("IAU_2015:49900");
    source->fields = {{.name = "layers", .type = FieldType::Integer},
                      {.name = "dip", .type = FieldType::Real}};
    std::vector<Annotation> drawn(2);
    for (Annotation& annotation : drawn) {
        annotation.source = source;
    }
    drawn[0] = {.name = "Olympus Möns",
                .note = "see \"notes\", page 3",
                .color = {1, 128, 255},
                .parts = {{.points = {{226.2, 18.65}}}},
                .values = {std::int64_t{12}, 7.25},
                .source = source};
    drawn[1].name = "Two";
    drawn[1].parts = {{.points = {{-10.0, -45.0}}}};
    drawn[1].values = {FieldValue{}, FieldValue{}};
    const AnnotationList list = AnnotationList().withAdded(drawn);
    const auto content = collectionOf(list);
    ASSERT_TRUE(content) << content.error().message;
    const TempFolder folder;
    for (const char* name : {"a.gpkg", "a.geojson", "a.shp", "a.csv", "a.kml"}) {
        SCOPED_TRACE(name);
        JobMonitor monitor;
        const auto written = writeVectorFile(folder.file(name), *content, monitor);
        ASSERT_TRUE(written) << written.error().message;
        const auto back = annotationsOf(read(folder.file(name)), name, source->crs, Rgb8{9, 9, 9});
        ASSERT_EQ(back.size(), 2U);
        EXPECT_EQ(back[0].name, "Olympus Möns");
        EXPECT_EQ(back[0].note, "see \"notes\", page 3");
        EXPECT_EQ(back[0].color, (Rgb8{1, 128, 255}));
        ASSERT_EQ(back[0].parts.size(), 1U);
        EXPECT_NEAR(back[0].parts[0].points[0].y, 18.65, 1e-9);
        EXPECT_EQ(back[1].name, "Two");
        const auto& fields = back[0].source->fields;
        const auto field = std::find_if(fields.begin(), fields.end(),
                                        [](const FeatureField& f) { return f.name == "dip"; });
        ASSERT_NE(field, fields.end());
    }
}

TEST(Annotations, OfSeveralCrsAreSavedInLongitudeAndLatitude)
{
    auto annotations = points(1);
    auto projected = std::make_shared<AnnotationSource>();
    projected->crs = *Crs::fromText("+proj=eqc +R=3396190 +units=m");
    Annotation other;
    other.source = projected;
    // A degree on the sphere of 3 396 190 m is 59 274.697 m.
    other.parts = {{.points = {{592746.97, 1185493.95}}}};
    annotations.push_back(other);
    const auto content = collectionOf(AnnotationList().withAdded(annotations));
    ASSERT_TRUE(content) << content.error().message;
    ASSERT_TRUE(content->crs);
    EXPECT_EQ(content->crs->kind(), CrsKind::Geographic);
    const MapPoint& point = content->layers[0].features[1].parts[0].points[0];
    EXPECT_NEAR(point.x, 10.0, 1e-6);
    EXPECT_NEAR(point.y, 20.0, 1e-6);
    EXPECT_NEAR(content->layers[0].features[0].parts[0].points[0].y, 1.5, 1e-9);
}

} // namespace marsview::test
