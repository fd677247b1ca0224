// The log of annotations against a map that is kept beside it.
#include "core/annotations/annotation_log.h"
#include "tests/support/random.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

LoggedAnnotation someAnnotation(std::uint32_t id, Random& random)
{
    LoggedAnnotation logged{.id = id};
    logged.annotation.name = "p\n\"" + std::to_string(random.below(1000)) + "\" ä";
    logged.annotation.note = random.chance(0.5) ? "note" : "";
    if (random.chance(0.5)) {
        logged.layer = static_cast<std::uint32_t>(random.below(5));
    }
    if (random.chance(0.5)) {
        logged.annotation.color = Rgb8{1, 2, 250};
    }
    logged.annotation.body = {.name = "Mars", .ellipsoid = Ellipsoid{3396190.0, 3376200.0}};
    logged.annotation.time = DrawnTime(std::chrono::milliseconds(random.below(2'000'000'000'000)));
    logged.annotation.shape = random.chance(0.5) ? FeatureShape::Point : FeatureShape::Line;
    const int vertices = logged.annotation.shape == FeatureShape::Point ? 1 : 3;
    for (int i = 0; i < vertices; ++i) {
        logged.annotation.vertices.emplace_back(
            GeographicPoint{Angle::degrees(0.001 * static_cast<double>(random.below(360'000))),
                            Angle::degrees(0.001 * static_cast<double>(random.below(90'000)))});
    }
    return logged;
}

std::vector<LoggedAnnotation> valuesOf(const std::map<std::uint32_t, LoggedAnnotation>& known)
{
    std::vector<LoggedAnnotation> values;
    for (const auto& [id, logged] : known) {
        values.push_back(logged);
    }
    return values;
}

} // namespace

// Of every state that was committed, also when more was written later, or half of a line.
TEST(AnnotationLog, KeepsEveryStateThatWasCommitted)
{
    Random random;
    const TempFolder folder;
    const fs::path path = folder.path() / "a.annotations";
    auto log = AnnotationLog::create(path);
    ASSERT_TRUE(log);
    std::map<std::uint32_t, LoggedAnnotation> known;
    std::vector<std::pair<std::uint64_t, std::vector<LoggedAnnotation>>> states;
    for (int state = 0; state < 20; ++state) {
        for (int change = 0; change < 15; ++change) {
            const auto id = static_cast<std::uint32_t>(1 + random.below(60));
            if (random.chance(0.25)) {
                ASSERT_TRUE(log->remove(id));
                known.erase(id);
            } else {
                known[id] = someAnnotation(id, random);
                ASSERT_TRUE(log->put(known[id]));
            }
        }
        const auto bytes = log->commit();
        ASSERT_TRUE(bytes);
        EXPECT_EQ(fs::file_size(path), *bytes);
        states.emplace_back(*bytes, valuesOf(known));
    }
    EXPECT_EQ(log->lines(), 300U);
    JobMonitor monitor;
    for (const std::uint64_t cut : {std::uint64_t{0}, std::uint64_t{3}}) {
        fs::resize_file(path, fs::file_size(path) - cut);
        for (std::size_t i = 0; i + (cut > 0 ? 1 : 0) < states.size(); ++i) {
            const auto found = readAnnotationLog(path, states[i].first, monitor);
            ASSERT_TRUE(found) << found.error().message;
            EXPECT_EQ(*found, states[i].second);
        }
    }
    const auto cut = readAnnotationLog(path, states.back().first, monitor);
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().code, ErrorCode::Damaged);
    EXPECT_THAT(cut.error().message, HasSubstr("shorter than it was"));
    monitor.cancel();
    EXPECT_EQ(readAnnotationLog(path, states.front().first, monitor).error().code,
              ErrorCode::Canceled);
}

TEST(AnnotationLog, RefusesOtherFiles)
{
    const TempFolder folder;
    JobMonitor monitor;
    const std::string other = folder.write("b.annotations", "MarsView annotations 2\n{\"id\":1}\n");
    EXPECT_THAT(readAnnotationLog(other, 32, monitor).error().message, HasSubstr("not a log"));
    const std::string line = folder.write("c.annotations", "MarsView annotations 1\n{\"id\":-1}\n");
    EXPECT_THAT(readAnnotationLog(line, 33, monitor).error().message,
                HasSubstr("damaged at byte 23"));
    EXPECT_FALSE(readAnnotationLog(folder.path() / "none", 10, monitor));
    EXPECT_FALSE(AnnotationLog::create(folder.path() / "no/such/folder.annotations"));
}

} // namespace marsview::test
