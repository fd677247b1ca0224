#!/usr/bin/env bash
# lint.sh: checks formatting, spelling, scripts and metadata; the packages are in section [lint].
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

shellcheck -x .ci/run packaging/*.sh packaging/cluster/*.sh packaging/trial/*.sh tests/packaging/*.sh
desktop-file-validate packaging/linux/*.desktop
cmake --preset clang --log-level=WARNING
appstreamcli validate --no-net build/clang/packaging/*.metainfo.xml
cmake --build --preset clang --target format-check
codespell --ignore-words packaging/codespell-ignore.txt --skip '*.tif,*.png,*.svg,*.csv,*/samples/*' \
    app core haptics ui tests packaging resources ./*.md
