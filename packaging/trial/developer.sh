#!/usr/bin/env bash
# Somebody who writes programs with the contact models, and a device plugin: builds the examples of
# marsview-doc against the installed packages.
# shellcheck source=packaging/trial/common.sh
. /trial/common.sh
fresh trial-developer

apt install --no-install-recommends ./packages/libmarsview-contact1_*.deb \
    ./packages/libmarsview-contact-dev_*.deb ./packages/marsview-doc_*.deb
examples=/usr/share/doc/marsview/examples
as_user cmake -S $examples/library_example -B touch
as_user cmake --build touch
as_user touch/touch_a_crater | tee printed
grep -q 'updates in contact' printed || fail "no contact"
show ldd /home/visitor/touch/touch_a_crater | tee libraries
grep -q 'libmarsview-contact.so.1 => /' libraries || fail "the library is not found"
! grep -E 'Qt6|gdal' libraries || fail "the library needs Qt or GDAL"
as_user sh -c "g++ -std=c++17 $examples/library_example/touch_a_crater.cpp \
    \$(pkg-config --cflags --libs marsview-contact) -o by-pkg-config && ./by-pkg-config"
say "a program is built with CMake and with pkg-config, and touches"

apt install --no-install-recommends ./packages/marsview_*.deb
as_user cmake -S $examples/plugin_example -B hand
as_user cmake --build hand
as_user marsview-cli devices --check hand/rocking_hand.so
cmake --install /home/visitor/hand
as_user marsview-cli devices | tee devices
grep -q rocking devices || fail "the installed plugin is not found"
say "a device plugin is built, conforms and is found"

apt install ./newer/libmarsview-contact1_*.deb ./newer/libmarsview-contact-dev_*.deb
as_user touch/touch_a_crater
say "the program runs with the upgraded library"
