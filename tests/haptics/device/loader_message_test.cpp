#include "haptics/device/loader_message.h"

#include <gtest/gtest.h>

namespace marsview::test {

// Messages as glibc 2.36 prints them.
TEST(LoaderMessage, NamesTheMissingPartAndTheRemedy)
{
    EXPECT_EQ(loaderSentence("/p/hand.so",
                             "libusb-9.so.0: cannot open shared object file: No such "
                             "file or directory"),
              "needs the library libusb-9.so.0, which is not installed; install it");
    EXPECT_EQ(loaderSentence("libHD.so.3",
                             "libHD.so.3: cannot open shared object file: No such "
                             "file or directory"),
              "is not installed or may not be read");
    for (const char* message : {"/p/hand.so: file too short", "/p/hand.so: invalid ELF header",
                                "/p/hand.so: wrong ELF class: ELFCLASS32"}) {
        EXPECT_EQ(loaderSentence("/p/hand.so", message),
                  "is not a library for this computer, or is damaged; get a build for this system");
    }
    EXPECT_EQ(loaderSentence("/p/hand.so", "/p/hand.so: undefined symbol: hdInit (fatal)"),
              "does not fit the installed libraries (the function hdInit is missing); get a build "
              "for this system");
    EXPECT_EQ(loaderSentence("/p/hand.so", "something new"), "cannot be loaded: something new");
}

} // namespace marsview::test
