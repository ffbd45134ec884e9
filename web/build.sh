#!/usr/bin/env bash
# Builds the playground: `web/dist/`, a folder that any static host serves and a double click opens.
# The library as WebAssembly, its worker and pictures of the examples lie in the one page.
set -euo pipefail
cd "$(dirname "$0")/.."

[ -d web/page/node_modules ] || npm --prefix web/page ci --no-audit --no-fund --silent
wasm=$(web/engine/build.sh | tail -n 1)
mkdir -p web/dist
gallery=$(mktemp)
trap 'rm -f "$gallery"' EXIT
node web/page/gallery.mjs "$wasm" >"$gallery"
node web/page/build.mjs --playground "$wasm" "$gallery" web/dist
