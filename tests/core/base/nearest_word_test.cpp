#include "core/base/nearest_word.h"

#include <gtest/gtest.h>

#include <array>

namespace marsview::test {
namespace {

const std::array<std::string, 5> kWords{"--exaggeration", "--azimuth", "--json", "info", "Mars"};

} // namespace

TEST(NearestWord, FindsWordsWithInsertedMissingReplacedAndSwappedLetters)
{
    for (const char* typed : {"--exagerration", "--exageration", "--exagggeration",
                              "--exaggaration", "--EXAGGERATION", "--exag"}) {
        EXPECT_EQ(nearestWord(typed, kWords), "--exaggeration") << typed;
    }
    EXPECT_EQ(nearestWord("--jsno", kWords), "--json");
    EXPECT_EQ(nearestWord("inof", kWords), "info");
    EXPECT_EQ(nearestWord("mras", kWords), "Mars");
}

TEST(NearestWord, SuggestsNothingForOtherWords)
{
    for (const std::string& typed : {std::string("--flight"), std::string("fly"), std::string("zz"),
                                     std::string(), std::string(100'000, 'a')}) {
        EXPECT_EQ(nearestWord(typed, kWords), "") << typed.substr(0, 20);
    }
}

TEST(NearestWord, IsQuotedInTheQuestion)
{
    EXPECT_EQ(didYouMean("inof", kWords), ". Did you mean \"info\"?");
    EXPECT_EQ(didYouMean("fly", kWords), "");
    EXPECT_EQ(didYouMeanOrKnown("inof", kWords), ". Did you mean \"info\"?");
    EXPECT_EQ(didYouMeanOrKnown("fly", kWords),
              "; known ones are --exaggeration, --azimuth, --json, info, Mars");
}

} // namespace marsview::test
