#!/usr/bin/env bash
# test.sh: installs missing packages, builds the release preset with its tests, and runs them all.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

./packaging/install-packages.sh run test
cmake --preset release --log-level=WARNING
cmake --build --preset release
# Two more than the number of cores: tests of windows and servers wait half of their time.
exec ctest --preset release --parallel "$(($(nproc) + 2))"
