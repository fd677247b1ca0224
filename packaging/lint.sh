#!/usr/bin/env bash
# lint.sh: checks formatting, spelling, scripts, type stubs and metadata; the packages are in section [lint].
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

shellcheck -x .ci/run packaging/*.sh packaging/cluster/*.sh packaging/trial/*.sh tests/packaging/*.sh
desktop-file-validate packaging/linux/*.desktop
cmake --preset clang --log-level=WARNING
appstreamcli validate --no-net build/clang/packaging/*.metainfo.xml
cmake --build --preset clang --target format-check
mypy --strict --cache-dir build/mypy app/python/marsview/*.pyi
# flatpak-builder only warns of what it does not understand, and makes a folder where it runs.
warnings=$(cd build && flatpak-builder --show-manifest ../packaging/flatpak/*.yml 2>&1 >/dev/null)
[ -z "$warnings" ] || {
    echo "$warnings" >&2
    exit 1
}
# The spelling of English: without German texts, the letters behind & in menus, and \n.
codespell=(codespell --ignore-words packaging/codespell-ignore.txt --ignore-regex '\w+&\w+|\\n')
"${codespell[@]}" --skip '*.tif,*.png,*.svg,*.csv,*/samples/*,*.ts,packaging/linux/*' \
    app core haptics ui tests packaging resources ./*.md
sed -e '/xml:lang="de"/,/<\//d' -e '/\[de\]=/d' packaging/linux/* | "${codespell[@]}" -
