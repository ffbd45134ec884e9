#!/usr/bin/env bash
# Tests the page in a real browser: its build, its lints, a session behind it, the playground.
# Installs what it needs; where no browser can be had, says so and tests the rest.
set -euo pipefail
cd "$(dirname "$0")/.."

[ -d web/page/node_modules ] || npm --prefix web/page ci --no-audit --no-fund --silent
npm --prefix web/page run --silent check

find_browser() {
    for name in "${CHROMIUM:-}" chromium chromium-browser google-chrome-stable google-chrome; do
        if [ -n "$name" ] && command -v "$name"; then return; fi
    done
    return 1
}

install_browser() {
    [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null || return 1
    echo "web/test.sh: installing Debian's chromium" >&2
    { apt-get update && apt-get install --yes --no-install-recommends chromium fonts-dejavu-core; } >/dev/null 2>&1
}

if ! CHROMIUM=$(find_browser) && ! { install_browser && CHROMIUM=$(find_browser); }; then
    echo "web/test.sh: SKIPPED, no browser: there is no Chromium here and none can be installed" >&2
    exit 0
fi
export CHROMIUM

cargo build --quiet
export LINKWORK="${CARGO_TARGET_DIR:-$PWD/target}/debug/linkwork"
if web/build.sh; then
    export PLAYGROUND="$PWD/web/dist/index.html"
else
    echo "web/test.sh: the playground is SKIPPED, it cannot be built here" >&2
fi
node --test --test-concurrency=1 web/page/test/*.test.mjs
